/* Updates by edits: after any history of blocks, lights and sun the light is what a solve from scratch gives,
 * and the box that an update returns is exactly that of the cells that changed. */
#include "flood_world.h"

static const dpl_flood_material materials[] = {
    {{0, 0, 0, 0}}, {{32767, 32767, 32767, 32767}}, {{900, 700, 100, 3000}}, {{0, 32767, 32767, 0}},
    {{0, 0, 0, 0}},
};
enum { MATERIALS = sizeof materials / sizeof materials[0], LIGHTS = 24 };

/* Two worlds with the same history: one is updated, the other solved from scratch to compare with. */
typedef struct pair {
    dpl_flood *edited;
    dpl_flood *fresh;
    dpl_flood_desc desc;
    dpl_flood_light lights[LIGHTS]; /* the same names in both */
    bool alive[LIGHTS];
    uint64_t seed;
    int64_t by_edits; /* updates that did not solve from scratch */
} pair;

static uint32_t pick(pair *p, int32_t end) {
    return random_below(&p->seed, (uint32_t)end);
}

static void pick_cell(pair *p, int32_t at[3]) {
    at[0] = (int32_t)pick(p, p->desc.width);
    at[1] = (int32_t)pick(p, p->desc.height);
    at[2] = (int32_t)pick(p, p->desc.depth);
}

static void pick_level(pair *p, uint16_t level[4]) {
    for (int c = 0; c < 4; c++)
        level[c] = (uint16_t)(pick(p, 16) * 2047u + pick(p, 2) * pick(p, 2000));
}

static void edit_block(pair *p, dpl_flood *const worlds[2]) {
    int32_t at[3], material = pick(p, 2) ? 0 : (int32_t)pick(p, MATERIALS);
    pick_cell(p, at);
    for (int i = 0; i < 2; i++)
        assert_ok(dpl_flood_set_cell(worlds[i], at[0], at[1], at[2], material));
}

static void edit_box(pair *p, dpl_flood *const worlds[2]) {
    uint8_t cells[64];
    int32_t at[3];
    pick_cell(p, at);
    dpl_flood_box box = {
        at[0], at[1], at[2], 1 + (int32_t)pick(p, 4), 1 + (int32_t)pick(p, 4), 1 + (int32_t)pick(p, 4)};
    box.width = box.x + box.width > p->desc.width ? p->desc.width - box.x : box.width;
    box.height = box.y + box.height > p->desc.height ? p->desc.height - box.y : box.height;
    box.depth = box.z + box.depth > p->desc.depth ? p->desc.depth - box.z : box.depth;
    for (int i = 0; i < 64; i++)
        cells[i] = (uint8_t)(pick(p, 3) ? 0 : pick(p, MATERIALS));
    for (int i = 0; i < 2; i++)
        assert_ok(dpl_flood_set_cells(worlds[i], &box, cells, 0, 0));
}

/* Adds, moves or removes one of LIGHTS lights. */
static void edit_light(pair *p, dpl_flood *const worlds[2]) {
    uint32_t which = pick(p, LIGHTS);
    int32_t at[3];
    uint16_t level[4];
    pick_cell(p, at);
    pick_level(p, level);
    bool move = pick(p, 2);
    for (int i = 0; i < 2; i++) {
        if (!p->alive[which]) {
            assert_ok(dpl_flood_add_light(worlds[i], at[0], at[1], at[2], level, &p->lights[which]));
        } else if (move) {
            assert_ok(dpl_flood_move_light(worlds[i], p->lights[which], at[0], at[1], at[2]));
        } else {
            assert_ok(dpl_flood_remove_light(worlds[i], p->lights[which]));
        }
    }
    p->alive[which] = !p->alive[which] || move;
}

static void edit_sun(pair *p, dpl_flood *const worlds[2]) {
    uint16_t level[4];
    pick_level(p, level);
    for (int i = 0; i < 2 && p->desc.sun != DPL_FLOOD_SUN_NONE; i++)
        assert_ok(dpl_flood_set_sun(worlds[i], level));
}

static void edit(pair *p) {
    dpl_flood *const worlds[2] = {p->edited, p->fresh};
    uint32_t what = pick(p, 4000);
    if (what < 2200)
        edit_block(p, worlds);
    else if (what < 3980)
        edit_light(p, worlds);
    else if (what < 3996)
        edit_box(p, worlds);
    else
        edit_sun(p, worlds);
}

/* The box of cells that differ. */
static dpl_flood_box difference(const dpl_flood_desc *d, const uint16_t *a, const uint16_t *b) {
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {-1, -1, -1};
    size_t channels = (size_t)d->channels;
    for (size_t i = 0; i < world_cells(d); i++) {
        if (memcmp(a + i * channels, b + i * channels, channels * sizeof *a) == 0)
            continue;
        const int32_t at[3] = {(int32_t)i % d->width, (int32_t)i / d->width % d->height,
                               (int32_t)i / d->width / d->height};
        for (int k = 0; k < 3; k++) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    if (high[0] < 0)
        return (dpl_flood_box){0};
    return (dpl_flood_box){
        low[0], low[1], low[2], high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1};
}

/* `before`: the light before the update. Returns the light now. */
static uint16_t *check_light(pair *p, uint16_t *before, const dpl_flood_box *changed) {
    dpl_flood_stats stats;
    uint16_t *now = read_world(p->edited);
    assert_ok(dpl_flood_solve(p->fresh));
    uint16_t *truth = read_world(p->fresh);
    assert_memory_equal(now, truth, world_cells(&p->desc) * (size_t)p->desc.channels * sizeof *now);
    dpl_flood_read_stats(p->edited, &stats);
    dpl_flood_box exact = difference(&p->desc, before, now);
    if (!stats.from_scratch)
        assert_memory_equal(changed, &exact, sizeof exact);
    free(before);
    free(truth);
    return now;
}

/* `edits` edits, an update after each few, compared after every `every`. */
static void live(dpl_flood_desc desc, int32_t edits, int32_t most_at_once, int32_t every, uint64_t seed) {
    pair p = {.seed = seed};
    desc.materials = materials;
    desc.material_count = MATERIALS;
    assert_ok(dpl_flood_create(context, &desc, &p.edited));
    assert_ok(dpl_flood_create(context, &desc, &p.fresh));
    p.desc = world_desc(p.edited);
    uint16_t *before = read_world(p.edited);
    int64_t updates = 0;
    for (int32_t done = 0; done < edits;) {
        int32_t count = 1 + (int32_t)pick(&p, most_at_once);
        bool check = (done + count) / every > done / every || done + count >= edits;
        if (check) {
            free(before);
            before = read_world(p.edited);
        }
        for (int32_t i = 0; i < count; i++)
            edit(&p);
        done += count;
        dpl_flood_box changed;
        dpl_flood_stats stats;
        assert_ok(dpl_flood_update(p.edited, &changed));
        dpl_flood_read_stats(p.edited, &stats);
        p.by_edits += !stats.from_scratch;
        updates++;
        if (check)
            before = check_light(&p, before, &changed);
    }
    if (desc.reserve == 0) /* it was not solving from scratch that made them equal */
        assert_true(most_at_once > 3 ? p.by_edits > updates / 8 : p.by_edits > updates / 10 * 9);
    free(before);
    dpl_flood_destroy(p.edited);
    dpl_flood_destroy(p.fresh);
}

static dpl_flood_desc sized(int32_t width, int32_t height, int32_t depth, dpl_flood_falloff falloff) {
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = width;
    desc.height = height;
    desc.depth = depth;
    desc.falloff = falloff;
    desc.sun = DPL_FLOOD_SUN_Y_UP;
    return desc;
}

static void a_hundred_thousand_edits_in_2d_equal_a_fresh_solve(void **state) {
    (void)state;
    live(sized(40, 31, 1, DPL_FLOOD_SUBTRACTIVE), 100000, 3, 997, 11);
}

static void a_hundred_thousand_edits_in_3d_equal_a_fresh_solve(void **state) {
    (void)state;
    dpl_flood_desc desc = sized(14, 12, 13, DPL_FLOOD_SUBTRACTIVE);
    desc.step = 4500;
    live(desc, 100000, 3, 997, 12);
}

static void every_falloff_survives_edits(void **state) {
    (void)state;
    for (int f = 0; f < 4; f++)
        for (int deep = 0; deep < 2; deep++) {
            dpl_flood_desc desc = sized(deep ? 9 : 23, deep ? 8 : 19, deep ? 7 : 1, (dpl_flood_falloff)f);
            desc.channels = 4 - deep;
            desc.keep = 20000;
            live(desc, 2000, 2, 3, 20 + (uint64_t)(f * 2 + deep));
        }
}

static void every_sun_survives_edits(void **state) {
    (void)state;
    for (int sun = 0; sun <= 6; sun++) {
        dpl_flood_desc desc = sized(11, 9, 10, DPL_FLOOD_SUBTRACTIVE);
        desc.sun = (dpl_flood_sun)sun;
        live(desc, 1000, 2, 3, 30 + (uint64_t)sun);
    }
}

static void batches_of_edits_equal_a_fresh_solve(void **state) {
    (void)state;
    live(sized(64, 48, 1, DPL_FLOOD_SUBTRACTIVE), 3000, 60, 1, 40);
    live(sized(30, 20, 1, DPL_FLOOD_EUCLIDEAN), 2000, 20, 1, 41);
    live(sized(30, 20, 1, DPL_FLOOD_ROUND), 2000, 20, 1, 42);
}

static void queues_that_are_too_small_cost_time_and_not_light(void **state) {
    (void)state;
    const int32_t reserves[] = {1, 2, 40, 300};
    for (int i = 0; i < 4; i++)
        for (int f = 0; f < 4; f++) {
            dpl_flood_desc desc = sized(30, 24, 1, (dpl_flood_falloff)f);
            desc.reserve = reserves[i];
            live(desc, 400, 5, 1, 50 + (uint64_t)i);
        }
}

static void edits_that_cancel_out_change_nothing(void **state) {
    (void)state;
    const uint16_t level[4] = {14 * 2048, 9 * 2048, 4 * 2048, 0};
    dpl_flood_desc desc = sized(32, 32, 1, DPL_FLOOD_SUBTRACTIVE);
    desc.sun = DPL_FLOOD_SUN_NONE;
    dpl_flood *flood;
    dpl_flood_box changed;
    dpl_flood_light keep, brief;
    assert_ok(dpl_flood_create(context, &desc, &flood));
    assert_ok(dpl_flood_add_light(flood, 10, 10, 0, level, &keep));
    assert_ok(dpl_flood_update(flood, &changed));
    assert_true(changed.x == 0 && changed.y == 0 && changed.width == 24 && changed.height == 24);
    assert_ok(dpl_flood_set_cell(flood, 12, 10, 0, 1));
    assert_ok(dpl_flood_set_cell(flood, 12, 10, 0, 0));
    assert_ok(dpl_flood_add_light(flood, 20, 20, 0, level, &brief));
    assert_ok(dpl_flood_remove_light(flood, brief));
    assert_ok(dpl_flood_move_light(flood, keep, 11, 10, 0));
    assert_ok(dpl_flood_move_light(flood, keep, 10, 10, 0));
    assert_ok(dpl_flood_update(flood, &changed));
    assert_int_equal(changed.width, 0);
    assert_ok(dpl_flood_update(flood, &changed));
    assert_int_equal(changed.width, 0);
    dpl_flood_destroy(flood);
}

static void the_same_history_gives_the_same_counters(void **state) {
    (void)state;
    const uint16_t level[4] = {14 * 2048, 14 * 2048, 14 * 2048, 0};
    dpl_flood_stats stats[2];
    for (int i = 0; i < 2; i++) {
        dpl_flood_desc desc = sized(40, 40, 40, DPL_FLOOD_SUBTRACTIVE);
        desc.sun = DPL_FLOOD_SUN_NONE;
        dpl_flood *flood;
        dpl_flood_light light;
        assert_ok(dpl_flood_create(context, &desc, &flood));
        assert_ok(dpl_flood_add_light(flood, 20, 20, 20, level, &light));
        assert_ok(dpl_flood_update(flood, NULL));
        dpl_flood_read_stats(flood, &stats[i]);
        assert_int_equal(stats[i].visits,
                         2625); /* cells at distances 0 .. 12; those at 13 have nothing left */
        assert_int_equal(stats[i].pushes, 2625);
        assert_ok(dpl_flood_remove_light(flood, light));
        assert_ok(dpl_flood_update(flood, NULL));
        dpl_flood_read_stats(flood, &stats[i]);
        assert_int_equal(stats[i].removals, 3303); /* distances 0 .. 13 */
        dpl_flood_destroy(flood);
    }
    assert_memory_equal(&stats[0], &stats[1], sizeof stats[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hundred_thousand_edits_in_2d_equal_a_fresh_solve),
        cmocka_unit_test(a_hundred_thousand_edits_in_3d_equal_a_fresh_solve),
        cmocka_unit_test(every_falloff_survives_edits),
        cmocka_unit_test(every_sun_survives_edits),
        cmocka_unit_test(batches_of_edits_equal_a_fresh_solve),
        cmocka_unit_test(queues_that_are_too_small_cost_time_and_not_light),
        cmocka_unit_test(edits_that_cancel_out_change_nothing),
        cmocka_unit_test(the_same_history_gives_the_same_counters),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
