/* Ray skipping in the cascade solver: rays are really left out and counted, dead rays are dropped without
 * changing a bit, and auto measures, chooses and reports. */
#include "testing.h"
#include "world.h"

#include "shared_context.h" /* behind the others: they have parameters called context */

#include <math.h>
#include <stdlib.h>

enum { SIZE = 128 };

/* A few opaque boxes and lamps, in a field that either profile can read. */
static dpl_field *make_field(uint32_t seed, int lamps, float brightness) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = desc.height = SIZE;
    desc.keep_shape_distance = 1;
    assert_ok(dpl_field_create(context, &desc, &field));
    for (int i = 0; i < 4 + lamps; i++) {
        dpl_shape shape = dpl_shape_default(i < 4 ? DPL_SHAPE_BOX : DPL_SHAPE_DISC);
        double x = dpl_test_random(&seed, 10, SIZE - 10), y = dpl_test_random(&seed, 10, SIZE - 10);
        if (i < 4)
            shape.box = (dpl_box){{x, y}, {dpl_test_random(&seed, 2, 9), dpl_test_random(&seed, 2, 16)}, 0.0};
        else
            shape.disc = (dpl_disc){{x, y}, dpl_test_random(&seed, 1, 5)};
        for (int c = 0; c < 3 && i >= 4; c++)
            shape.material.emission[c] = brightness * (float)dpl_test_random(&seed, 0.2, 1.0);
        assert_ok(dpl_field_draw_shapes(field, &shape, 1));
    }
    return field;
}

/* The paper's geometry in either profile. */
static dpl_cascades_desc paper_geometry(dpl_profile profile) {
    return (dpl_cascades_desc){.spacing = 2,
                               .directions = 16,
                               .levels = 5,
                               .interval = hypot(SIZE, SIZE) * 4 / 1023,
                               .profile = profile};
}

static dpl_solver_stats solve(dpl_field *field, const dpl_cascades_desc *cascades, float *rgb) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    dpl_solver_stats stats;
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades = *cascades;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {.data = rgb, .width = SIZE, .height = SIZE, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &stats);
    dpl_solver_destroy(solver);
    return stats;
}

static double reduction(const dpl_solver_stats *stats) {
    return 1.0 - (double)stats->rays_traced / (double)stats->rays_full;
}

static float picture[SIZE * SIZE * 3], other[SIZE * SIZE * 3];

static void counted_reductions_are_those_of_five_levels(void **state) {
    (void)state;
    static const double expected[] = {0.0, 0.10, 0.20, 0.25, 0.40};
    dpl_field *field = make_field(1, 5, 1.0f);
    for (int profile = DPL_PROFILE_DEFAULT; profile <= DPL_PROFILE_PAPER; profile++)
        for (int mode = DPL_SKIP_OFF; mode <= DPL_SKIP_L2; mode++) {
            dpl_cascades_desc desc = paper_geometry((dpl_profile)profile);
            desc.skip.mode = (dpl_skip_mode)mode;
            dpl_solver_stats stats = solve(field, &desc, picture);
            assert_float_equal(reduction(&stats), expected[mode], 1e-9);
            for (int32_t n = 0; n < stats.level_count; n++)
                assert_int_equal(stats.levels[n].traced * dpl_skip_factor(stats.skip.rule, n),
                                 stats.levels[n].full);
        }
    dpl_field_destroy(field);
}

static void dropping_dead_rays_changes_no_bit_and_saves_what_the_notes_say(void **state) {
    (void)state;
    static const double expected[] = {0.0, 0.10, 0.25, 0.275, 0.46875};
    dpl_field *field = make_field(2, 7, 1.0f);
    for (int profile = DPL_PROFILE_DEFAULT; profile <= DPL_PROFILE_PAPER; profile++)
        for (int mode = DPL_SKIP_L5; mode <= DPL_SKIP_L2; mode++) {
            dpl_cascades_desc desc = paper_geometry((dpl_profile)profile);
            desc.skip.mode = (dpl_skip_mode)mode;
            desc.skip.placement = DPL_PLACEMENT_FIRST;
            desc.skip.dead_rays = DPL_DEAD_RAYS_TRACE;
            solve(field, &desc, picture);
            desc.skip.dead_rays = DPL_DEAD_RAYS_DROP;
            dpl_solver_stats stats = solve(field, &desc, other);
            assert_memory_equal(picture, other, sizeof picture);
            assert_float_equal(reduction(&stats), expected[mode], 1e-9);
        }
    dpl_field_destroy(field);
}

static double display_psnr(const float *test, const float *reference) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    dpl_metrics metrics;
    desc.test = (dpl_pixels){test, DPL_FORMAT_F32, SIZE, SIZE, 3, 0};
    desc.reference = (dpl_pixels){reference, DPL_FORMAT_F32, SIZE, SIZE, 3, 0};
    assert_ok(dpl_metrics_compare(context, &desc, &metrics));
    return metrics.psnr_display;
}

static void centred_rays_lose_less_than_first_rays(void **state) {
    (void)state;
    double gain = 0.0;
    for (uint32_t seed = 10; seed < 16; seed++) {
        dpl_field *field = make_field(seed, 4, 1.0f);
        dpl_cascades_desc desc = paper_geometry(DPL_PROFILE_DEFAULT);
        solve(field, &desc, picture);
        desc.skip.mode = DPL_SKIP_L2;
        double psnr[3] = {0};
        for (int placement = DPL_PLACEMENT_CENTRED; placement <= DPL_PLACEMENT_FIRST; placement++) {
            desc.skip.placement = (dpl_skip_placement)placement;
            solve(field, &desc, other);
            psnr[placement] = display_psnr(other, picture);
        }
        gain += (psnr[DPL_PLACEMENT_CENTRED] - psnr[DPL_PLACEMENT_FIRST]) / 6;
        dpl_field_destroy(field);
    }
    assert_true(gain > 4.0); /* [dB]; the study measures it on the paper's scenes */
}

static void auto_measures_chooses_and_reports(void **state) {
    (void)state;
    for (int profile = DPL_PROFILE_DEFAULT; profile <= DPL_PROFILE_PAPER; profile++) {
        int seen[DPL_SKIP_CUSTOM + 1] = {0};
        for (int i = 0; i < 8; i++) {
            dpl_field *field = make_field(30, 8, 0.05f * (float)(1 << i));
            dpl_cascades_desc desc = paper_geometry((dpl_profile)profile);
            desc.skip.mode = DPL_SKIP_AUTO;
            desc.skip.dead_rays = i % 2 ? DPL_DEAD_RAYS_DROP : DPL_DEAD_RAYS_TRACE;
            dpl_solver_stats stats = solve(field, &desc, picture);
            static const double paper[2] = {0.45, 1.0};
            assert_int_equal(stats.skip.measured, 1);
            assert_true(stats.skip.signal_rays > 0);
            assert_true(fabs(stats.skip.signals.score - stats.skip.signals.mean - stats.skip.signals.stddev) <
                        1e-9);
            assert_int_equal(stats.skip.mode, dpl_skip_choose(stats.skip.signals.score, paper));
            seen[stats.skip.mode]++;
            /* The picture is that of the chosen mode, bit for bit. */
            desc.skip.mode = stats.skip.mode;
            solve(field, &desc, other);
            assert_memory_equal(picture, other, sizeof picture);
            dpl_field_destroy(field);
        }
        assert_true(seen[DPL_SKIP_L5] > 0 && seen[DPL_SKIP_L4] > 0 && seen[DPL_SKIP_L3] > 0);
    }
}

static void own_thresholds_and_rules_are_honoured(void **state) {
    (void)state;
    dpl_field *field = make_field(5, 6, 1.0f);
    dpl_cascades_desc desc = paper_geometry(DPL_PROFILE_DEFAULT);
    desc.skip.mode = DPL_SKIP_AUTO;
    desc.skip.thresholds[0] = 1e6;
    desc.skip.thresholds[1] = 2e6;
    assert_int_equal(solve(field, &desc, picture).skip.mode, DPL_SKIP_L5);
    desc.skip.thresholds[0] = 1e-9;
    desc.skip.thresholds[1] = 2e-9;
    assert_int_equal(solve(field, &desc, picture).skip.mode, DPL_SKIP_L3);
    desc.skip.mode = DPL_SKIP_CUSTOM;
    desc.skip.custom = (dpl_skip_rule){0, 2}; /* level 0 twofold, the rest fourfold */
    dpl_solver_stats stats = solve(field, &desc, picture);
    assert_float_equal(reduction(&stats), (0.5 + 4 * 0.75) / 5, 1e-9);
    dpl_field_destroy(field);
}

static void a_black_scene_has_the_documented_signals(void **state) {
    (void)state;
    dpl_field *field = make_field(6, 0, 1.0f); /* walls only: zero lights */
    for (int profile = DPL_PROFILE_DEFAULT; profile <= DPL_PROFILE_PAPER; profile++) {
        dpl_cascades_desc desc = paper_geometry((dpl_profile)profile);
        desc.skip.mode = DPL_SKIP_AUTO;
        dpl_solver_stats stats = solve(field, &desc, picture);
        assert_int_equal(stats.skip.mode, DPL_SKIP_L5);
        assert_true(stats.skip.signals.mean == 0.0 && stats.skip.signals.stddev == 0.0);
        assert_true(stats.skip.signals.score == 0.0 && stats.skip.signals.non_zero == 0.0);
        assert_true(stats.skip.signals.peak_to_average == 1.0);
        assert_true(stats.skip.signals.bandwidth90 == 1.0);
        for (int i = 0; i < SIZE * SIZE * 3; i++)
            assert_true(picture[i] == 0.0f);
    }
    dpl_field_destroy(field);
}

static void one_level_skips_by_its_own_number(void **state) {
    (void)state;
    dpl_field *field = make_field(7, 3, 1.0f);
    dpl_cascades_desc desc = {.levels = 1, .directions = 64, .skip = {.mode = DPL_SKIP_L2}};
    dpl_solver_stats stats = solve(field, &desc, picture);
    assert_true(reduction(&stats) == 0.0); /* there is no level 2 */
    desc.skip.mode = DPL_SKIP_AUTO;
    stats = solve(field, &desc, picture);
    assert_int_equal(stats.skip.measured, 1);
    /* The paper reads its signals from level 1. */
    desc.profile = DPL_PROFILE_PAPER;
    dpl_solver_desc solver_desc = dpl_solver_desc_default();
    dpl_solver *solver;
    solver_desc.kind = DPL_SOLVER_CASCADES;
    solver_desc.cascades = desc;
    assert_ok(dpl_solver_create(context, &solver_desc, &solver));
    dpl_output output = {.data = picture, .width = SIZE, .height = SIZE, .channels = 3};
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_ARGUMENT);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

static void pictures_smaller_than_a_probe_are_lit(void **state) {
    (void)state;
    for (int32_t size = 1; size <= 3; size++) {
        dpl_field_desc field_desc = dpl_field_desc_default();
        dpl_field *field;
        field_desc.width = size;
        field_desc.height = 1;
        field_desc.keep_shape_distance = 1;
        field_desc.sky[1] = 0.5f;
        assert_ok(dpl_field_create(context, &field_desc, &field));
        for (int profile = DPL_PROFILE_DEFAULT; profile <= DPL_PROFILE_PAPER; profile++) {
            dpl_solver_desc desc = dpl_solver_desc_default();
            dpl_solver *solver;
            desc.kind = DPL_SOLVER_CASCADES;
            desc.cascades = (dpl_cascades_desc){.spacing = 2, .profile = (dpl_profile)profile};
            desc.cascades.skip.mode = DPL_SKIP_AUTO;
            assert_ok(dpl_solver_create(context, &desc, &solver));
            float rgb[9];
            dpl_output output = {.data = rgb, .width = size, .height = 1, .channels = 3};
            assert_ok(dpl_solver_solve(solver, field, &output));
            for (int32_t x = 0; x < size; x++)
                assert_float_equal(rgb[3 * x + 1], 0.5f, 1e-5f);
            dpl_solver_destroy(solver);
        }
        dpl_field_destroy(field);
    }
}

static void bad_settings_are_refused(void **state) {
    (void)state;
    static const dpl_skip_desc bad[] = {
        {.mode = (dpl_skip_mode)9},
        {.mode = DPL_SKIP_BOUNDED, .bound_db = 10.0},
        {.mode = DPL_SKIP_BOUNDED, .bound_db = (double)NAN},
        {.mode = DPL_SKIP_CUSTOM, .custom = {-1, 2}},
        {.mode = DPL_SKIP_CUSTOM, .custom = {1, 3}},
        {.mode = DPL_SKIP_AUTO, .thresholds = {1.0, 0.45}},
        {.mode = DPL_SKIP_AUTO, .thresholds = {0.5, 0.5}},
        {.mode = DPL_SKIP_AUTO, .thresholds = {-0.5, 0.5}},
        {.mode = DPL_SKIP_AUTO, .thresholds = {0.5, (double)NAN}},
        {.signal_probes = -1},
        {.placement = (dpl_skip_placement)3},
        {.dead_rays = (dpl_dead_rays)3},
        {.measure = 2},
    };
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_CASCADES;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        desc.cascades.skip = bad[i];
        assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
        assert_non_null(strstr(dpl_context_message(context), "skip: "));
    }
    desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.profile = DPL_PROFILE_PAPER; /* the default merge is bilinear-fix */
    assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
    desc.cascades.merge = DPL_MERGE_BILINEAR;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_field *field = dpl_test_world(context, SIZE, SIZE, 1, 0); /* keeps no distance to shapes */
    dpl_output output = {.data = picture, .width = SIZE, .height = SIZE, .channels = 3};
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_ARGUMENT);
    dpl_field_destroy(field);
    dpl_solver_destroy(solver);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counted_reductions_are_those_of_five_levels),
        cmocka_unit_test(dropping_dead_rays_changes_no_bit_and_saves_what_the_notes_say),
        cmocka_unit_test(centred_rays_lose_less_than_first_rays),
        cmocka_unit_test(auto_measures_chooses_and_reports),
        cmocka_unit_test(own_thresholds_and_rules_are_honoured),
        cmocka_unit_test(a_black_scene_has_the_documented_signals),
        cmocka_unit_test(one_level_skips_by_its_own_number),
        cmocka_unit_test(pictures_smaller_than_a_probe_are_lit),
        cmocka_unit_test(bad_settings_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
