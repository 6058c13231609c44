/* Reuse loses nothing: over sequences of edits by chance, every frame of a solver that keeps its last frame
 * has the bits of a new solver's, for every method, merge, skip mode, thread count and instruction set. */
#include "moving_world.h"

static dpl_context *context_with(uint32_t isa_mask, int32_t threads) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.isa_mask = isa_mask;
    desc.thread_count = threads;
    assert_ok(dpl_context_create(&desc, &context));
    return context;
}

enum { MOST_SIDE = 300 };
static float found[MOST_SIDE * MOST_SIDE * 3], expected[MOST_SIDE * MOST_SIDE * 3];

/* Returns the rays traced, and those of new solvers. */
typedef struct rays {
    int64_t traced, anew;
} rays;

static rays assert_same_frames(dpl_context *context, const dpl_solver_desc *given, moving_world *w,
                               int frames) {
    dpl_solver_desc desc = *given;
    dpl_solver *solver;
    rays sum = {0, 0};
    desc.reuse = 1;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    for (int frame = 0; frame < frames; frame++) {
        dpl_solver_stats stats;
        moving_draw(w);
        memset(found, 0, sizeof found);
        moving_solve(w, solver, found);
        dpl_solver_read_stats(solver, &stats);
        sum.traced += stats.rays_traced;
        sum.anew += moving_solve_anew(w, context, &desc, expected).rays_traced;
        if (memcmp(found, expected, moving_values(w) * sizeof *found) != 0)
            fail_msg("%d x %d px, frame %d differs", w->width, w->height, frame);
        moving_edit(w);
    }
    dpl_solver_destroy(solver);
    return sum;
}

static dpl_solver_desc cascades_with(dpl_merge merge, dpl_skip_mode mode) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.merge = merge;
    desc.cascades.skip.mode = mode;
    if (mode == DPL_SKIP_CUSTOM)
        desc.cascades.skip.custom = (dpl_skip_rule){1, 2};
    return desc;
}

static void every_merge_and_skip_mode_keeps_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    uint32_t seed = 0;
    rays sum = {0, 0};
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++)
        for (int mode = DPL_SKIP_OFF; mode <= DPL_SKIP_BOUNDED; mode++) {
            dpl_solver_desc desc = cascades_with((dpl_merge)merge, (dpl_skip_mode)mode);
            moving_world w;
            moving_start(&w, context, 40 + (int32_t)(seed * 7 % 40), 30 + (int32_t)(seed * 11 % 30), seed, 0);
            rays more = assert_same_frames(context, &desc, &w, 3);
            sum.traced += more.traced;
            sum.anew += more.anew;
            dpl_field_destroy(w.field);
            seed++;
        }
    assert_true(sum.traced < sum.anew);
    dpl_context_destroy(context);
}

/* Settings of every kind by chance, some of them absurd. */
static void random_settings_and_media_keep_every_bit(void **state) {
    (void)state;
    static const double intervals[] = {0.0, 0.25, 0.7, 1.0, 3.3, 40.0};
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    uint32_t seed = 77;
    for (uint32_t i = 0; i < 16; i++) {
        dpl_solver_desc desc = cascades_with((dpl_merge)dpl_test_random(&seed, 0, 3),
                                             (dpl_skip_mode)dpl_test_random(&seed, 0, 7));
        desc.cascades.spacing = (int32_t)dpl_test_random(&seed, 0, 5);
        desc.cascades.directions = 4 * (int32_t)dpl_test_random(&seed, 1, 4);
        desc.cascades.interval = intervals[(int)dpl_test_random(&seed, 0, 6)];
        desc.cascades.levels = (int32_t)dpl_test_random(&seed, 0, 6);
        desc.cascades.skip.placement = (dpl_skip_placement)dpl_test_random(&seed, 0, 3);
        desc.cascades.skip.dead_rays = (dpl_dead_rays)dpl_test_random(&seed, 0, 3);
        moving_world w;
        moving_start(&w, context, (int32_t)dpl_test_random(&seed, 1, 90),
                     (int32_t)dpl_test_random(&seed, 1, 90), i, i % 2 == 0);
        assert_same_frames(context, &desc, &w, 3);
        dpl_field_destroy(w.field);
    }
    dpl_context_destroy(context);
}

/* More than two words of probes, and more than one chunk. */
static void long_rows_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
        dpl_solver_desc desc = cascades_with((dpl_merge)merge, DPL_SKIP_OFF);
        moving_world w;
        moving_start(&w, context, 299, 20, 4 + (uint32_t)merge, 0);
        assert_same_frames(context, &desc, &w, 4);
        dpl_field_destroy(w.field);
    }
    dpl_context_destroy(context);
}

static void the_other_solvers_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    for (uint32_t i = 0; i < 8; i++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        desc.kind = i % 4 == 3 ? DPL_SOLVER_REFERENCE : DPL_SOLVER_HOLOGRAPHIC;
        desc.reference.directions = 16;
        desc.bounces = i < 4 ? 0 : 1;
        desc.holographic.resolution = i % 4 == 1 ? DPL_RESOLUTION_HALF : DPL_RESOLUTION_FULL;
        desc.holographic.storage = i % 4 == 2 ? DPL_STORAGE_HALF : DPL_STORAGE_FLOAT;
        moving_world w;
        moving_start(&w, context, 150, 70 + (int32_t)i, i, i % 2 == 0);
        assert_same_frames(context, &desc, &w, 4);
        dpl_field_destroy(w.field);
    }
    dpl_context_destroy(context);
}

/* Where walls stop a change, most of a frame is kept, and what is solved borders on it. */
static void closed_rooms_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    for (uint32_t i = 0; i < 4; i++) {
        dpl_solver_desc desc = cascades_with(DPL_MERGE_BILINEAR, DPL_SKIP_OFF);
        moving_world w;
        if (i % 4 != 3)
            desc.kind = DPL_SOLVER_HOLOGRAPHIC;
        moving_start(&w, context, i % 2 ? 300 : 200, 200, 40 + i, i == 2);
        moving_build_rooms(&w, 3);
        rays sum = assert_same_frames(context, &desc, &w, 4);
        assert_true((double)sum.traced < 0.8 * (double)sum.anew);
        dpl_field_destroy(w.field);
    }
    dpl_context_destroy(context);
}

static void counts_and_bits_do_not_depend_on_threads_or_instruction_set(void **state) {
    (void)state;
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
        rays first = {-1, -1};
        for (int i = 0; i < 4; i++)
            for (int32_t threads = 1; threads <= 3; threads += 2) {
                dpl_context *context = context_with((uint32_t)isas[i] | DPL_ISA_SCALAR, threads);
                dpl_solver_desc desc = cascades_with((dpl_merge)merge, DPL_SKIP_OFF);
                moving_world w;
                moving_start(&w, context, 40, 30, 9, 1);
                rays sum = assert_same_frames(context, &desc, &w, 3);
                assert_true(first.traced < 0 || sum.traced == first.traced);
                first = sum;
                dpl_field_destroy(w.field);
                dpl_context_destroy(context);
            }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_merge_and_skip_mode_keeps_every_bit),
        cmocka_unit_test(random_settings_and_media_keep_every_bit),
        cmocka_unit_test(long_rows_keep_every_bit),
        cmocka_unit_test(the_other_solvers_keep_every_bit),
        cmocka_unit_test(closed_rooms_keep_every_bit),
        cmocka_unit_test(counts_and_bits_do_not_depend_on_threads_or_instruction_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
