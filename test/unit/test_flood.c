/* Flood-fill light in closed form: diamonds, cones, power laws, round balls, coloured glass, sun under roofs;
 * and every argument that is refused. */
#include "flood_world.h"

static const uint16_t full[4] = {32767, 32767, 32767, 32767};

static dpl_flood *world_of(dpl_flood_desc desc) {
    dpl_flood *flood;
    assert_ok(dpl_flood_create(context, &desc, &flood));
    return flood;
}

static dpl_flood_desc sized(int32_t width, int32_t height, int32_t depth) {
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = width;
    desc.height = height;
    desc.depth = depth;
    return desc;
}

static dpl_flood_light light_at(dpl_flood *flood, int32_t x, int32_t y, int32_t z, uint16_t level) {
    const uint16_t levels[4] = {level, level, level, level};
    dpl_flood_light light;
    assert_ok(dpl_flood_add_light(flood, x, y, z, levels, &light));
    return light;
}

static int32_t taxicab(int32_t dx, int32_t dy, int32_t dz) {
    return abs(dx) + abs(dy) + abs(dz);
}

static void a_level_14_torch_is_a_diamond(void **state) {
    (void)state;
    dpl_flood *flood = world_of(sized(40, 40, 1));
    light_at(flood, 20, 20, 0, 14 * 2048);
    assert_ok(dpl_flood_update(flood, NULL));
    for (int32_t y = 0; y < 40; y++)
        for (int32_t x = 0; x < 40; x++) {
            int32_t level = 14 - taxicab(x - 20, y - 20, 0);
            assert_int_equal(level_at(flood, x, y, 0), level > 0 ? level * 2048 : 0);
        }
    dpl_flood_destroy(flood);
}

static void a_torch_in_3d_is_an_octahedron(void **state) {
    (void)state;
    dpl_flood *flood = world_of(sized(31, 29, 33));
    light_at(flood, 15, 14, 16, 14 * 2048);
    assert_ok(dpl_flood_update(flood, NULL));
    int32_t lit = 0;
    for (int32_t z = 0; z < 33; z++)
        for (int32_t y = 0; y < 29; y++)
            for (int32_t x = 0; x < 31; x++) {
                int32_t level = 14 - taxicab(x - 15, y - 14, z - 16);
                assert_int_equal(level_at(flood, x, y, z), level > 0 ? level * 2048 : 0);
                lit += level > 0;
            }
    assert_int_equal(lit, 3303);
    dpl_flood_destroy(flood);
}

static void light_goes_round_a_wall_and_loses_a_step_for_each_cell(void **state) {
    (void)state;
    dpl_flood *flood = world_of(sized(9, 9, 1));
    for (int32_t y = 0; y < 8; y++)
        assert_ok(dpl_flood_set_cell(flood, 4, y, 0, 1)); /* a gap is left at the bottom */
    light_at(flood, 3, 6, 0, 10 * 2048);
    assert_ok(dpl_flood_update(flood, NULL));
    assert_int_equal(level_at(flood, 4, 6, 0), 0);
    assert_int_equal(level_at(flood, 5, 6, 0), 4 * 2048); /* 2 down, 2 across, 2 up */
    dpl_flood_destroy(flood);
}

static void multiplicative_light_falls_by_a_power(void **state) {
    (void)state;
    dpl_flood_desc desc = sized(64, 3, 1);
    desc.falloff = DPL_FLOOD_MULTIPLICATIVE;
    desc.keep = 29491; /* 0.9 */
    dpl_flood *flood = world_of(desc);
    light_at(flood, 0, 1, 0, 32767);
    assert_ok(dpl_flood_update(flood, NULL));
    double keep = 29491.0 / 32768.0;
    for (int32_t x = 0; x < 64; x++) {
        /* Each step is rounded down by less than one level, and later steps shrink that too. */
        double level = 32767.0 * pow(keep, x), error = level - level_at(flood, x, 1, 0);
        assert_true(error >= 0.0 && error < 1.0 / (1.0 - keep));
    }
    dpl_flood_destroy(flood);
}

/* How far the light reaches from a lamp with a range of 100 cells, in the direction of an offset, over that
 * direction's true length: 1 on a perfect ball. */
static void deviation_of(dpl_flood *flood, const dpl_flood_desc *desc, int32_t step, double *least,
                         double *most) {
    uint16_t *levels = read_world(flood);
    *least = 10;
    *most = 0;
    int32_t cx = desc->width / 2, cy = desc->height / 2, cz = desc->depth / 2;
    for (size_t i = 0; i < world_cells(desc); i++) {
        double x = (int32_t)i % desc->width - cx, y = (int32_t)i / desc->width % desc->height - cy;
        double z = (int32_t)i / desc->width / desc->height - cz;
        double distance = sqrt(x * x + y * y + z * z);
        if (distance < 1 || levels[i] == 0)
            continue;
        double ratio = (32767.0 - levels[i]) / step / distance;
        *least = ratio < *least ? ratio : *least;
        *most = ratio > *most ? ratio : *most;
    }
    free(levels);
}

static void euclidean_light_is_round_within_the_stated_deviation(void **state) {
    (void)state;
    for (int deep = 0; deep < 2; deep++) {
        dpl_flood_desc desc = deep ? sized(61, 61, 61) : sized(151, 151, 1);
        double least, most;
        desc.falloff = DPL_FLOOD_EUCLIDEAN;
        desc.step = 400;
        desc.channels = 1;
        dpl_flood *flood = world_of(desc);
        light_at(flood, desc.width / 2, desc.height / 2, desc.depth / 2, 32767);
        assert_ok(dpl_flood_update(flood, NULL));
        deviation_of(flood, &desc, 400, &least, &most);
        assert_true(least > 0.999);
        assert_true(most < (deep ? 1.1285 : 1.083));
        assert_true(most > (deep ? 1.12 : 1.08)); /* the stated figure is not generous */
        dpl_flood_destroy(flood);
    }
}

static void diagonal_light_does_not_leak_through_a_diagonal_wall(void **state) {
    (void)state;
    dpl_flood_desc desc = sized(16, 16, 1);
    desc.falloff = DPL_FLOOD_EUCLIDEAN;
    dpl_flood *flood = world_of(desc);
    for (int32_t i = 0; i < 16; i++)
        assert_ok(dpl_flood_set_cell(flood, i, i, 0, 1));
    light_at(flood, 4, 10, 0, 32767);
    assert_ok(dpl_flood_update(flood, NULL));
    assert_true(level_at(flood, 8, 10, 0) > 0);
    for (int32_t y = 0; y < 16; y++)
        for (int32_t x = y + 1; x < 16; x++)
            assert_int_equal(level_at(flood, x, y, 0), 0);
    dpl_flood_destroy(flood);
}

static void coloured_glass_tints_what_passes(void **state) {
    (void)state;
    const dpl_flood_material materials[] = {
        {{0, 0, 0, 0}}, {{32767, 32767, 32767, 0}}, {{0, 32767, 4096, 0}}};
    uint16_t rgb[3];
    dpl_flood_desc desc = sized(9, 3, 1);
    desc.materials = materials;
    desc.material_count = 3;
    dpl_flood *flood = world_of(desc);
    for (int32_t y = 0; y < 3; y++)
        assert_ok(dpl_flood_set_cell(flood, 4, y, 0, 2));
    light_at(flood, 2, 1, 0, 10 * 2048);
    assert_ok(dpl_flood_update(flood, NULL));
    dpl_flood_box behind = {5, 1, 0, 1, 1, 1};
    assert_ok(dpl_flood_read_levels(flood, &behind, rgb, 0, 0));
    assert_int_equal(rgb[0], 7 * 2048);
    assert_int_equal(rgb[1], 0);
    assert_int_equal(rgb[2], 7 * 2048 - 4096);
    dpl_flood_destroy(flood);
}

static void the_sun_falls_without_loss_and_creeps_under_overhangs(void **state) {
    (void)state;
    dpl_flood_desc desc = sized(20, 12, 1);
    desc.sun = DPL_FLOOD_SUN_Y_UP;
    dpl_flood *flood = world_of(desc);
    for (int32_t x = 0; x < 10; x++)
        assert_ok(dpl_flood_set_cell(flood, x, 4, 0, 1)); /* a roof over the left half */
    assert_ok(dpl_flood_update(flood, NULL));
    for (int32_t y = 0; y < 12; y++)
        for (int32_t x = 0; x < 20; x++) {
            int32_t under = x < 10 && y > 4 ? (10 - x) * 2048 : 0;
            assert_int_equal(level_at(flood, x, y, 0), x < 10 && y == 4 ? 0 : 32767 - under);
        }
    assert_ok(dpl_flood_set_cell(flood, 3, 4, 0, 0)); /* a hole in the roof: a shaft of light */
    assert_ok(dpl_flood_update(flood, NULL));
    for (int32_t y = 4; y < 12; y++)
        assert_int_equal(level_at(flood, 3, y, 0), 32767);
    dpl_flood_destroy(flood);
}

static void depth_first_gives_the_same_light_for_a_hundred_times_the_visits(void **state) {
    (void)state;
    dpl_flood_desc desc = sized(128, 128, 1);
    desc.step = 127; /* a range of 258 cells: the world is lit to its corners */
    desc.channels = 1;
    dpl_flood *flood = world_of(desc);
    dpl_flood_stats breadth, depth;
    light_at(flood, 64, 64, 0, 32767);
    assert_ok(dpl_flood_solve(flood));
    dpl_flood_read_stats(flood, &breadth);
    uint16_t *truth = read_world(flood);
    assert_ok(dpl_flood_solve_depth_first(flood));
    dpl_flood_read_stats(flood, &depth);
    uint16_t *levels = read_world(flood);
    assert_memory_equal(levels, truth, 128 * 128 * sizeof *levels);
    assert_int_equal(breadth.visits, 128 * 128);
    assert_true(depth.visits > 82 * breadth.visits && depth.visits < 168 * breadth.visits);
    free(truth);
    free(levels);
    dpl_flood_destroy(flood);
}

/* ---- reading light -------------------------------------------------------------------------------- */

static void light_reads_as_weighted_linear_rgb_in_any_rows(void **state) {
    (void)state;
    const uint16_t level[4] = {32767, 16384, 0, 8192};
    const float weights[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.25f, 2}};
    float pixels[2][3][4];
    dpl_flood_desc desc = sized(3, 2, 1);
    desc.channels = 4;
    dpl_flood *flood = world_of(desc);
    dpl_flood_light light;
    assert_ok(dpl_flood_add_light(flood, 1, 1, 0, level, &light));
    assert_ok(dpl_flood_update(flood, NULL));
    dpl_output flipped = {.data = &pixels[1][0][0],
                          .width = 3,
                          .height = 2,
                          .channels = 4,
                          .row_stride = -(ptrdiff_t)sizeof pixels[0]};
    assert_ok(dpl_flood_read_light(flood, 0, weights, &flipped));
    float sun = 8192.0f / 32767.0f;
    assert_true(pixels[0][1][0] == 1.0f + 0.5f * sun);
    assert_true(pixels[0][1][1] == 16384.0f / 32767.0f + 0.25f * sun);
    assert_true(pixels[0][1][2] == 2 * sun && pixels[0][1][3] == 1.0f);
    dpl_flood_destroy(flood);
}

static void boxes_of_cells_and_levels_keep_to_their_strides(void **state) {
    (void)state;
    uint8_t cells[2][4][8], back[2][4][8];
    dpl_flood *flood = world_of(sized(7, 6, 5));
    for (int i = 0; i < 64; i++)
        (&cells[0][0][0])[i] = (uint8_t)(i % 3 == 0);
    memset(back, 9, sizeof back);
    dpl_flood_box box = {2, 1, 3, 5, 3, 2};
    assert_ok(dpl_flood_set_cells(flood, &box, &cells[0][0][0], 8, 32));
    assert_ok(dpl_flood_read_cells(flood, &box, &back[0][0][0], 8, 32));
    for (int z = 0; z < 2; z++)
        for (int y = 0; y < 4; y++)
            for (int x = 0; x < 8; x++)
                assert_int_equal(back[z][y][x], x < 5 && y < 3 ? cells[z][y][x] : 9);
    dpl_flood_destroy(flood);
}

/* ---- refusals ------------------------------------------------------------------------------------- */

static void sizes_that_are_zero_or_huge_are_refused(void **state) {
    (void)state;
    const int32_t bad[][3] = {{0, 1, 1},         {1, 0, 1},         {1, 1, 0},         {-1, 1, 1},
                              {16385, 1, 1},     {1, 1, INT32_MAX}, {INT32_MIN, 1, 1}, {16384, 16384, 16384},
                              {16384, 16384, 8}, {1290, 1290, 1290}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        dpl_flood_desc desc = sized(bad[i][0], bad[i][1], bad[i][2]);
        dpl_flood *flood = (dpl_flood *)&desc;
        assert_int_equal(dpl_flood_create(context, &desc, &flood), DPL_ERROR_SIZE);
        assert_null(flood);
    }
}

static void descs_with_a_fault_are_refused(void **state) {
    (void)state;
    static const dpl_flood_material dim_air = {{0, 1, 0, 0}}, too_much[2] = {{{0}}, {{32768, 0, 0, 0}}};
    dpl_flood_desc bad[12];
    for (int i = 0; i < 12; i++)
        bad[i] = sized(8, 8, 1);
    bad[0].channels = 0;
    bad[1].channels = 5;
    bad[2].falloff = (dpl_flood_falloff)4;
    bad[3].step = 0;
    bad[4].step = 32768;
    bad[5].keep = 0;
    bad[6].keep = 32768;
    bad[7].sun = (dpl_flood_sun)7;
    bad[8].sun_level[3] = 32768;
    bad[9].reserve = -1;
    bad[10].materials = &dim_air;
    bad[10].material_count = 1;
    bad[11].materials = too_much;
    bad[11].material_count = 2;
    for (int i = 0; i < 12; i++) {
        dpl_flood *flood;
        assert_int_equal(dpl_flood_create(context, &bad[i], &flood), DPL_ERROR_ARGUMENT);
        assert_null(flood);
    }
    dpl_flood *flood;
    bad[10].material_count = 128;
    assert_int_equal(dpl_flood_create(context, &bad[10], &flood), DPL_ERROR_ARGUMENT);
    bad[0].cookie = 0;
    assert_int_equal(dpl_flood_create(context, &bad[0], &flood), DPL_ERROR_DESC);
}

static void edits_outside_the_world_are_refused_and_change_nothing(void **state) {
    (void)state;
    uint8_t cells[4] = {1, 1, 1, 2};
    const uint16_t too_bright[4] = {0, 32768, 0, 0};
    dpl_flood *flood = world_of(sized(8, 8, 1));
    dpl_flood_light light;
    dpl_flood_box boxes[] = {{-1, 0, 0, 1, 1, 1},
                             {7, 0, 0, 2, 1, 1},
                             {0, 0, 0, 0, 1, 1},
                             {0, 0, 0, 1, 1, 2},
                             {0, 7, 0, 1, INT32_MAX, 1}};
    assert_int_equal(dpl_flood_set_cell(flood, 8, 0, 0, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_set_cell(flood, 0, 0, 0, 2), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_set_cell(flood, 0, 0, 1, 0), DPL_ERROR_ARGUMENT);
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++)
        assert_int_equal(dpl_flood_set_cells(flood, &boxes[i], cells, 0, 0), DPL_ERROR_ARGUMENT);
    dpl_flood_box box = {3, 2, 0, 4, 1, 1};
    assert_int_equal(dpl_flood_set_cells(flood, &box, cells, 0, 0), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context), "cell (6, 2, 0): there is no material 2");
    assert_int_equal(dpl_flood_add_light(flood, 0, -1, 0, full, &light), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_add_light(flood, 0, 0, 0, too_bright, &light), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_set_sun(flood, full), DPL_ERROR_ARGUMENT);
    dpl_flood_box all = {0, 0, 0, 8, 8, 1}, changed;
    uint8_t read[64];
    assert_ok(dpl_flood_read_cells(flood, &all, read, 0, 0));
    for (int i = 0; i < 64; i++)
        assert_int_equal(read[i], 0);
    assert_ok(dpl_flood_update(flood, &changed));
    assert_int_equal(changed.width, 0);
    dpl_flood_destroy(flood);
}

static void a_light_that_is_gone_is_known_to_be_gone(void **state) {
    (void)state;
    dpl_flood *flood = world_of(sized(8, 8, 1));
    dpl_flood_light first = light_at(flood, 1, 1, 0, 100);
    assert_ok(dpl_flood_remove_light(flood, first));
    dpl_flood_light second = light_at(flood, 2, 2, 0, 100);
    assert_int_equal(second.index, first.index);
    assert_int_equal(dpl_flood_remove_light(flood, first), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_move_light(flood, first, 0, 0, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_move_light(flood, (dpl_flood_light){9, 1}, 0, 0, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_remove_light(flood, (dpl_flood_light){0, 0}), DPL_ERROR_ARGUMENT);
    assert_ok(dpl_flood_move_light(flood, second, 7, 7, 0));
    assert_int_equal(dpl_flood_move_light(flood, second, 8, 7, 0), DPL_ERROR_ARGUMENT);
    dpl_flood_destroy(flood);
}

static void null_arguments_are_refused(void **state) {
    (void)state;
    dpl_flood_desc desc = sized(4, 4, 1);
    dpl_flood_light light;
    dpl_flood *flood = world_of(desc), *none;
    dpl_flood_box box = {0, 0, 0, 1, 1, 1};
    uint16_t level[4] = {0};
    uint8_t cell = 0;
    float rgb[48];
    dpl_output output = {.data = rgb, .width = 4, .height = 4, .channels = 3},
               wrong = {.data = rgb, .width = 4, .height = 3, .channels = 3};
    assert_int_equal(dpl_flood_create(NULL, &desc, &none), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_create(context, NULL, &none), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_create(context, &desc, NULL), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_set_cells(flood, NULL, &cell, 0, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_set_cells(flood, &box, NULL, 0, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_add_light(flood, 0, 0, 0, NULL, &light), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_read_levels(flood, &box, level, 3, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_read_light(flood, 1, NULL, &output), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_read_light(flood, 0, NULL, &wrong), DPL_ERROR_SIZE);
    assert_ok(dpl_flood_read_light(flood, 0, NULL, &output));
    assert_int_equal(dpl_flood_update(NULL, NULL), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_solve(NULL), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_flood_solve_depth_first(NULL), DPL_ERROR_ARGUMENT);
    dpl_flood_destroy(NULL);
    dpl_flood_destroy(flood);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_14_torch_is_a_diamond),
        cmocka_unit_test(a_torch_in_3d_is_an_octahedron),
        cmocka_unit_test(light_goes_round_a_wall_and_loses_a_step_for_each_cell),
        cmocka_unit_test(multiplicative_light_falls_by_a_power),
        cmocka_unit_test(euclidean_light_is_round_within_the_stated_deviation),
        cmocka_unit_test(diagonal_light_does_not_leak_through_a_diagonal_wall),
        cmocka_unit_test(coloured_glass_tints_what_passes),
        cmocka_unit_test(the_sun_falls_without_loss_and_creeps_under_overhangs),
        cmocka_unit_test(depth_first_gives_the_same_light_for_a_hundred_times_the_visits),
        cmocka_unit_test(light_reads_as_weighted_linear_rgb_in_any_rows),
        cmocka_unit_test(boxes_of_cells_and_levels_keep_to_their_strides),
        cmocka_unit_test(sizes_that_are_zero_or_huge_are_refused),
        cmocka_unit_test(descs_with_a_fault_are_refused),
        cmocka_unit_test(edits_outside_the_world_are_refused_and_change_nothing),
        cmocka_unit_test(a_light_that_is_gone_is_known_to_be_gone),
        cmocka_unit_test(null_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
