/* The schedule as numbers: probes, directions and intervals of every level. */
#include "testing.h"

#include <dapple/dapple.h>
#include <math.h>

static void the_default_at_512_has_six_levels_of_equal_rays(void **state) {
    (void)state;
    dpl_schedule s;
    dpl_cascades_desc desc = {.interval = 1.0};
    assert_ok(dpl_schedule_compute(&desc, 512, 512, &s));
    assert_int_equal(s.level_count, 6);
    for (int32_t n = 0; n < 6; n++) {
        const dpl_schedule_level *level = &s.levels[n];
        assert_int_equal(level->probes_x, 512 >> n);
        assert_int_equal(level->probes_y, 512 >> n);
        assert_int_equal(level->directions, 4 << 2 * n);
        assert_int_equal(level->slots, 1 << 2 * n);
        assert_true(level->spacing == ldexp(1.0, n));
        assert_true(level->t1 == ldexp(1.0, 2 * n));
        assert_true(level->t0 == (n == 0 ? 0.0 : s.levels[n - 1].t1));
        assert_int_equal(level->rays, 4 * 512 * 512);
        assert_int_equal(level->bytes, 512 * 512 * 12);
    }
    assert_int_equal(s.rays, 6 * 4 * 512 * 512);
}

static void the_arc_papers_geometry_is_a_schedule(void **state) {
    (void)state;
    dpl_schedule s;
    dpl_cascades_desc desc = {
        .spacing = 2, .directions = 16, .interval = 724.0773439350247 * 4 / 1023, .levels = 5};
    assert_ok(dpl_schedule_compute(&desc, 512, 512, &s));
    assert_int_equal(s.level_count, 5);
    assert_int_equal(s.rays, 5242880);
    assert_int_equal(s.levels[4].directions, 4096);
    assert_float_equal(s.levels[0].t1, 2.8312, 1e-4);
    assert_float_equal(s.levels[4].t1, 724.8, 0.1);
}

static void the_last_interval_covers_the_diagonal(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{1, 1}, {1, 16384}, {16384, 16384}, {37, 512}, {100, 3}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int merge = 0; merge < 3; merge++) {
            dpl_schedule s;
            dpl_cascades_desc desc = {.merge = (dpl_merge)merge};
            assert_ok(dpl_schedule_compute(&desc, sizes[i][0], sizes[i][1], &s));
            double diagonal = hypot(sizes[i][0], sizes[i][1]);
            assert_true(s.levels[s.level_count - 1].t1 >= diagonal);
            if (s.level_count > 1)
                assert_true(s.levels[s.level_count - 2].t1 < diagonal);
            for (int32_t n = 0; n < s.level_count; n++) { /* every pixel lies within the probes' cells */
                assert_true(s.levels[n].probes_x * s.levels[n].spacing >= sizes[i][0]);
                assert_true((s.levels[n].probes_x - 1) * s.levels[n].spacing < sizes[i][0]);
            }
        }
}

static void only_the_fix_traces_four_rays_and_not_at_the_top(void **state) {
    (void)state;
    dpl_schedule s;
    dpl_cascades_desc desc = {.merge = DPL_MERGE_BILINEAR_FIX, .interval = 1.0};
    assert_ok(dpl_schedule_compute(&desc, 512, 512, &s));
    for (int32_t n = 0; n < 6; n++)
        assert_int_equal(s.levels[n].aims, n < 5 ? 4 : 1);
    assert_int_equal(s.rays, (5 * 4 + 1) * 4 * 512 * 512);
}

static void settings_out_of_range_are_refused(void **state) {
    (void)state;
    static const dpl_cascades_desc bad[] = {
        {.spacing = -1},           {.spacing = 65},      {.directions = 2},
        {.directions = 6},         {.levels = -1},       {.levels = DPL_MAX_LEVELS + 1},
        {.interval = -1},          {.interval = 0.1},    {.merge = (dpl_merge)3},
        {.interval = (double)NAN}, {.directions = 1028},
    };
    dpl_schedule s;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(dpl_schedule_compute(&bad[i], 64, 64, &s), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_schedule_compute(NULL, 0, 64, &s), DPL_ERROR_SIZE);
    assert_int_equal(dpl_schedule_compute(NULL, 64, 16385, &s), DPL_ERROR_SIZE);
    assert_int_equal(dpl_schedule_compute(NULL, 64, 64, NULL), DPL_ERROR_ARGUMENT);
    dpl_cascades_desc too_many = {.directions = 1024, .levels = DPL_MAX_LEVELS};
    assert_int_equal(dpl_schedule_compute(&too_many, 64, 64, &s), DPL_ERROR_ARGUMENT); /* 2^32 directions */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_default_at_512_has_six_levels_of_equal_rays),
        cmocka_unit_test(the_arc_papers_geometry_is_a_schedule),
        cmocka_unit_test(the_last_interval_covers_the_diagonal),
        cmocka_unit_test(only_the_fix_traces_four_rays_and_not_at_the_top),
        cmocka_unit_test(settings_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
