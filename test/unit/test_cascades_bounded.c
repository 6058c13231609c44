/* Ray skipping within a bound: psnr_display against no skipping stays above what was asked for, on scenes
 * that nothing was tuned on; guesses are made, checked, and given up where that shows them to be wrong. */
#include "testing.h"
#include "world.h"

#include "../../scenes/families.h"

#include "shared_context.h" /* behind the others: they have parameters called context */

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 224 };

static float off[SIZE * SIZE * 3], bounded[SIZE * SIZE * 3], other[SIZE * SIZE * 3];

static dpl_solver_stats solve(dpl_context *with, dpl_field *field, const dpl_cascades_desc *cascades,
                              float *rgb) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    dpl_solver *solver;
    dpl_solver_stats stats;
    desc.cascades = *cascades;
    assert_ok(dpl_solver_create(with, &desc, &solver));
    dpl_output output = {.data = rgb, .width = SIZE, .height = SIZE, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &stats);
    dpl_solver_destroy(solver);
    return stats;
}

static dpl_cascades_desc settings(dpl_skip_mode mode, double bound) {
    return (dpl_cascades_desc){.interval = 1.0, .skip = {.mode = mode, .bound_db = bound}};
}

static dpl_field *family_field(dpl_context *with, const char *family, uint64_t seed, int32_t index) {
    dpl_scene scene = {0};
    dpl_error error = {""};
    dpl_field *field;
    assert_true(dpl_scene_family_find(family)->make(seed, index, SIZE, &scene, &error));
    assert_true(dpl_scene_build_field(&scene, with, false, &field, &error));
    dpl_scene_free(&scene);
    return field;
}

static double psnr(const float *test, const float *reference) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    dpl_metrics metrics;
    desc.test = (dpl_pixels){test, DPL_FORMAT_F32, SIZE, SIZE, 3, 0};
    desc.reference = (dpl_pixels){reference, DPL_FORMAT_F32, SIZE, SIZE, 3, 0};
    assert_ok(dpl_metrics_compare(context, &desc, &metrics));
    return metrics.psnr_display;
}

/* Seeds from 201 on: 101 and up were tuned on, 1 and up are what bench_skipping judges. */
static void the_bound_is_kept_on_scenes_that_nothing_was_tuned_on(void **state) {
    (void)state;
    static const char *const families[] = {"arc", "maze", "rooms", "thin", "tiny", "area", "clutter"};
    static const double bounds[] = {35.0, 50.0};
    int64_t guessed = 0;
    for (size_t f = 0; f < sizeof families / sizeof families[0]; f++)
        for (int i = 0; i < 2; i++) {
            dpl_field *field = family_field(context, families[f], 201 + (uint64_t)i, 3 + i);
            dpl_cascades_desc cascades = settings(DPL_SKIP_OFF, 0.0);
            solve(context, field, &cascades, off);
            cascades = settings(DPL_SKIP_BOUNDED, bounds[i]);
            dpl_solver_stats stats = solve(context, field, &cascades, bounded);
            assert_true(psnr(bounded, off) >= bounds[i]);
            assert_int_equal(stats.skip.mode, DPL_SKIP_BOUNDED);
            guessed += stats.skip.guessed;
            dpl_field_destroy(field);
        }
    assert_true(guessed > 10000);
}

static void every_merge_and_interval_keeps_the_bound(void **state) {
    (void)state;
    dpl_field *field = family_field(context, "rooms", 203, 4);
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
        dpl_cascades_desc cascades = {.merge = (dpl_merge)merge, .directions = merge == 2 ? 8 : 4};
        solve(context, field, &cascades, off);
        cascades.skip = (dpl_skip_desc){.mode = DPL_SKIP_BOUNDED, .bound_db = 45.0};
        dpl_solver_stats stats = solve(context, field, &cascades, bounded);
        assert_true(psnr(bounded, off) >= 45.0);
        assert_true(stats.skip.guessed > 0);
    }
    dpl_field_destroy(field);
}

static void a_stricter_bound_guesses_less_and_checks_no_smaller_share(void **state) {
    (void)state;
    dpl_field *field = family_field(context, "rooms", 204, 2);
    dpl_solver_stats loose, strict, hopeless;
    dpl_cascades_desc cascades = settings(DPL_SKIP_BOUNDED, 40.0);
    loose = solve(context, field, &cascades, bounded);
    cascades = settings(DPL_SKIP_BOUNDED, 62.0);
    strict = solve(context, field, &cascades, bounded);
    cascades = settings(DPL_SKIP_BOUNDED, 120.0);
    hopeless = solve(context, field, &cascades, bounded);
    assert_true(loose.skip.guessed > 0);
    assert_true(strict.skip.guessed <= loose.skip.guessed);
    assert_true(loose.rays_traced < strict.rays_traced);
    assert_int_equal(hopeless.skip.guessed, 0); /* so all is traced: the picture of off */
    cascades = settings(DPL_SKIP_OFF, 0.0);
    solve(context, field, &cascades, off);
    assert_memory_equal(bounded, off, sizeof off);
    dpl_field_destroy(field);
}

static void add_lamp(dpl_field *field, double x, double y, double half, float light) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    shape.box = (dpl_box){{x, y}, {half, half}, 0.0};
    for (int c = 0; c < 3; c++)
        shape.material.emission[c] = light;
    assert_ok(dpl_field_draw_shapes(field, &shape, 1));
}

/* Very bright lamps of 1 and 2 pixels right in front of black walls: what a guess between two rays overlooks.
 */
static void small_lamps_before_walls_do_not_break_the_bound(void **state) {
    (void)state;
    dpl_field *field = family_field(context, "rooms", 205, 1);
    uint32_t seed = 5;
    for (int i = 0; i < 12; i++)
        add_lamp(field, floor(dpl_test_random(&seed, 4, SIZE - 4)),
                 floor(dpl_test_random(&seed, 4, SIZE - 4)), i % 2 ? 1.0 : 0.5, 40.0f);
    dpl_cascades_desc cascades = settings(DPL_SKIP_OFF, 0.0);
    solve(context, field, &cascades, off);
    cascades = settings(DPL_SKIP_BOUNDED, 50.0);
    solve(context, field, &cascades, bounded);
    assert_true(psnr(bounded, off) >= 50.0);
    dpl_field_destroy(field);
}

/* Pixels of all colours, so that hardly two rays end at the same: guessing is given up before it begins. */
static void where_few_rays_can_be_guessed_none_is(void **state) {
    (void)state;
    dpl_field *field = family_field(context, "rooms", 208, 0);
    uint32_t seed = 7;
    for (int i = 0; i < 4000; i++)
        add_lamp(field, floor(dpl_test_random(&seed, 0, SIZE)) + 0.5,
                 floor(dpl_test_random(&seed, 0, SIZE)) + 0.5, 0.5, (float)dpl_test_random(&seed, 0.1, 1.0));
    dpl_cascades_desc cascades = settings(DPL_SKIP_OFF, 0.0);
    solve(context, field, &cascades, off);
    cascades = settings(DPL_SKIP_BOUNDED, 30.0);
    dpl_solver_stats stats = solve(context, field, &cascades, bounded);
    assert_int_equal(stats.skip.guessed, 0);
    assert_int_equal(stats.skip.checked, 0);
    assert_memory_equal(bounded, off, sizeof off);
    dpl_field_destroy(field);
}

static void threads_and_instruction_sets_guess_alike(void **state) {
    (void)state;
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_AVX2, DPL_ISA_AVX512};
    dpl_cascades_desc cascades = settings(DPL_SKIP_BOUNDED, 45.0);
    dpl_field *field = family_field(context, "thin", 206, 0);
    dpl_solver_stats first = solve(context, field, &cascades, bounded);
    dpl_field_destroy(field);
    for (int32_t i = 0; i < 3; i++) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *with;
        desc.isa_mask = (uint32_t)isas[i] | DPL_ISA_SCALAR;
        desc.thread_count = 1 + 2 * i;
        assert_ok(dpl_context_create(&desc, &with));
        field = family_field(with, "thin", 206, 0);
        dpl_solver_stats again = solve(with, field, &cascades, other);
        assert_memory_equal(other, bounded, sizeof other);
        assert_int_equal(again.rays_traced, first.rays_traced);
        assert_int_equal(again.skip.checked, first.skip.checked);
        dpl_field_destroy(field);
        dpl_context_destroy(with);
    }
    assert_true(first.skip.checked > 0);
}

static void another_seed_checks_other_guesses(void **state) {
    (void)state;
    dpl_field *field = family_field(context, "maze", 207, 1);
    dpl_cascades_desc cascades = settings(DPL_SKIP_BOUNDED, 45.0);
    dpl_solver_stats one = solve(context, field, &cascades, bounded);
    cascades.skip.seed = 12345;
    dpl_solver_stats two = solve(context, field, &cascades, other);
    assert_true(one.skip.checked != two.skip.checked);
    assert_true(fabs((double)one.skip.checked - (double)two.skip.checked) < 0.5 * (double)one.skip.checked);
    dpl_field_destroy(field);
}

/* Where light is let through in part nothing is guessed. */
static void scenes_with_media_are_skipped_exactly(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, SIZE, SIZE, 9, 1);
    dpl_cascades_desc cascades = settings(DPL_SKIP_OFF, 0.0);
    solve(context, field, &cascades, off);
    cascades = settings(DPL_SKIP_BOUNDED, 30.0);
    dpl_solver_stats stats = solve(context, field, &cascades, bounded);
    assert_memory_equal(bounded, off, sizeof off);
    assert_int_equal(stats.skip.guessed, 0);
    assert_true(stats.rays_traced < stats.rays_full);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bound_is_kept_on_scenes_that_nothing_was_tuned_on),
        cmocka_unit_test(every_merge_and_interval_keeps_the_bound),
        cmocka_unit_test(a_stricter_bound_guesses_less_and_checks_no_smaller_share),
        cmocka_unit_test(small_lamps_before_walls_do_not_break_the_bound),
        cmocka_unit_test(where_few_rays_can_be_guessed_none_is),
        cmocka_unit_test(threads_and_instruction_sets_guess_alike),
        cmocka_unit_test(another_seed_checks_other_guesses),
        cmocka_unit_test(scenes_with_media_are_skipped_exactly),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
