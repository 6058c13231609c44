/* Flood-fill light against its definition: random small worlds, every falloff and sun, worked out slowly. */
#include "flood_world.h"

#define SIDE 9

/* A lamp as the test remembers it. */
typedef struct lamp {
    int32_t at[3];
    uint16_t level[4];
} lamp;

/* Air, rock, water, clear glass that is not air, red and half green glass. */
static const dpl_flood_material materials[] = {
    {{0, 0, 0, 0}}, {{32767, 32767, 32767, 32767}}, {{900, 700, 100, 3000}},
    {{0, 0, 0, 0}}, {{0, 32767, 32767, 0}},         {{9000, 0, 9000, 40}},
};
enum { MATERIALS = sizeof materials / sizeof materials[0], LAMPS = 5 };

static bool sun_passes(uint8_t material, int channels) {
    for (int c = 0; c < channels; c++)
        if (materials[material].attenuation[c])
            return false;
    return true;
}

/* Is every cell from the sun's side down to this one clear? */
static bool sunlit(const dpl_flood_desc *d, const uint8_t *cells, int32_t x, int32_t y, int32_t z) {
    int32_t at[3] = {x, y, z};
    const int32_t size[3] = {d->width, d->height, d->depth};
    if (d->sun == DPL_FLOOD_SUN_NONE)
        return false;
    int axis = ((int)d->sun - 1) / 2, towards_sun = (int)d->sun % 2 ? -1 : 1;
    for (; at[axis] >= 0 && at[axis] < size[axis]; at[axis] += towards_sun)
        if (!sun_passes(cells[(at[2] * d->height + at[1]) * d->width + at[0]], d->channels))
            return false;
    return true;
}

static void compare(dpl_flood *flood, const uint8_t *cells, const lamp *lamps) {
    uint16_t sources[SIDE * SIDE * SIDE], levels[SIDE * SIDE * SIDE];
    slow_world slow = {.desc = world_desc(flood),
                       .cells = (uint8_t *)(uintptr_t)cells,
                       .sources = sources,
                       .levels = levels};
    const dpl_flood_desc *d = &slow.desc;
    uint16_t *fast = read_world(flood);
    for (slow.channel = 0; slow.channel < d->channels; slow.channel++) {
        for (int32_t i = 0; i < (int32_t)world_cells(d); i++) {
            bool sun = sunlit(d, cells, i % d->width, i / d->width % d->height, i / d->width / d->height);
            sources[i] = sun ? d->sun_level[slow.channel] : 0;
        }
        for (int i = 0; i < LAMPS; i++) {
            uint16_t *at =
                &sources[(lamps[i].at[2] * d->height + lamps[i].at[1]) * d->width + lamps[i].at[0]];
            *at = lamps[i].level[slow.channel] > *at ? lamps[i].level[slow.channel] : *at;
        }
        slow_solve(&slow);
        for (size_t i = 0; i < world_cells(d); i++)
            assert_int_equal(fast[i * (size_t)d->channels + (size_t)slow.channel], levels[i]);
    }
    free(fast);
}

static void try_world(uint64_t *seed, dpl_flood_desc desc) {
    uint8_t cells[SIDE * SIDE * SIDE];
    lamp lamps[LAMPS];
    dpl_flood *flood;
    desc.materials = materials;
    desc.material_count = MATERIALS;
    assert_ok(dpl_flood_create(context, &desc, &flood));
    uint32_t density = random_below(seed, 100);
    for (size_t i = 0; i < world_cells(&desc); i++)
        cells[i] = (uint8_t)(random_below(seed, 100) < density ? random_below(seed, MATERIALS) : 0);
    dpl_flood_box box = whole_world(&desc);
    assert_ok(dpl_flood_set_cells(flood, &box, cells, 0, 0));
    for (int i = 0; i < LAMPS; i++) {
        dpl_flood_light light;
        const int32_t size[3] = {desc.width, desc.height, desc.depth};
        for (int k = 0; k < 3; k++)
            lamps[i].at[k] = (int32_t)random_below(seed, (uint32_t)size[k]);
        for (int c = 0; c < 4; c++)
            lamps[i].level[c] = (uint16_t)random_below(seed, 32768);
        assert_ok(dpl_flood_add_light(flood, lamps[i].at[0], lamps[i].at[1], lamps[i].at[2], lamps[i].level,
                                      &light));
    }
    assert_ok(dpl_flood_update(flood, NULL));
    compare(flood, cells, lamps);
    assert_ok(dpl_flood_solve(flood));
    compare(flood, cells, lamps);
    assert_ok(dpl_flood_solve_depth_first(flood));
    compare(flood, cells, lamps);
    dpl_flood_destroy(flood);
}

static void try_worlds(dpl_flood_falloff falloff, uint64_t seed) {
    for (int round = 0; round < 60; round++) {
        dpl_flood_desc desc = dpl_flood_desc_default();
        desc.falloff = falloff;
        desc.width = 1 + (int32_t)random_below(&seed, SIDE);
        desc.height = 1 + (int32_t)random_below(&seed, SIDE);
        desc.depth = round % 2 ? 1 : 1 + (int32_t)random_below(&seed, SIDE);
        desc.channels = 1 + (int32_t)random_below(&seed, 4);
        desc.step = 500 + (int32_t)random_below(&seed, 6000);
        desc.keep = 10000 + (int32_t)random_below(&seed, 21000);
        desc.sun = (dpl_flood_sun)(round % 7);
        desc.reserve = round % 3 ? 0 : 1 + (int32_t)random_below(&seed, 20);
        for (int c = 0; c < 4; c++)
            desc.sun_level[c] = (uint16_t)random_below(&seed, 32768);
        try_world(&seed, desc);
    }
}

static void subtractive_light_is_what_the_definition_says(void **state) {
    (void)state;
    try_worlds(DPL_FLOOD_SUBTRACTIVE, 1);
}

static void multiplicative_light_is_what_the_definition_says(void **state) {
    (void)state;
    try_worlds(DPL_FLOOD_MULTIPLICATIVE, 2);
}

static void euclidean_light_is_what_the_definition_says(void **state) {
    (void)state;
    try_worlds(DPL_FLOOD_EUCLIDEAN, 3);
}

static void round_light_is_what_the_definition_says(void **state) {
    (void)state;
    try_worlds(DPL_FLOOD_ROUND, 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(subtractive_light_is_what_the_definition_says),
        cmocka_unit_test(multiplicative_light_is_what_the_definition_says),
        cmocka_unit_test(euclidean_light_is_what_the_definition_says),
        cmocka_unit_test(round_light_is_what_the_definition_says),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
