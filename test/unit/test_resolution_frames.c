/* Frames at another resolution: the same bytes however they are computed, no allocation after the first, and
 * nothing half done. */
#include "testing.h"
#include "world.h"

#include <stdbool.h>
#include <stdlib.h>

static const dpl_resolution resolutions[] = {DPL_RESOLUTION_FULL, DPL_RESOLUTION_HALF, DPL_RESOLUTION_QUARTER,
                                             DPL_RESOLUTION_DOUBLE};
enum { RESOLUTIONS = 4, WIDTH = 83, HEIGHT = 61 };

typedef float picture[WIDTH * HEIGHT * 3];

static dpl_solver_desc desc_at(dpl_resolution resolution) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.holographic.resolution = resolution;
    return desc;
}

static dpl_status solve(dpl_context *context, const dpl_solver_desc *desc, dpl_field *field, float *rgb) {
    dpl_solver *solver;
    dpl_status status = dpl_solver_create(context, desc, &solver);
    if (status != DPL_OK)
        return status;
    dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
    status = dpl_solver_solve(solver, field, &output);
    dpl_solver_destroy(solver);
    return status;
}

static void solve_all(int32_t threads, uint32_t isa, picture *results) {
    dpl_context_desc context_desc = dpl_context_desc_default();
    dpl_context *context;
    context_desc.thread_count = threads;
    context_desc.isa_mask = isa;
    assert_ok(dpl_context_create(&context_desc, &context));
    for (int i = 0; i < 2 * RESOLUTIONS; i++) {
        dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 21, i >= RESOLUTIONS);
        dpl_solver_desc desc = desc_at(resolutions[i % RESOLUTIONS]);
        assert_ok(solve(context, &desc, field, results[i]));
        dpl_field_destroy(field);
    }
    dpl_context_destroy(context);
}

static void every_thread_count_and_instruction_set_gives_the_same_bytes(void **state) {
    (void)state;
    static picture expected[2 * RESOLUTIONS], results[2 * RESOLUTIONS];
    static const struct {
        int32_t threads;
        uint32_t isa;
    } ways[] = {{2, DPL_ISA_ALL}, {5, DPL_ISA_ALL}, {3, DPL_ISA_SCALAR}, {1, DPL_ISA_SCALAR | DPL_ISA_SSE2}};
    solve_all(1, DPL_ISA_ALL, expected);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        memset(results, 0, sizeof results);
        solve_all(ways[i].threads, ways[i].isa, results);
        assert_memory_equal(results, expected, sizeof results);
    }
}

/* ---- memory --------------------------------------------------------------------------------------- */

typedef struct counter {
    int64_t held; /* [byte] */
    int allocations;
    int fail_at; /* counted from 1; 0: none */
} counter;

static void *count_allocate(size_t bytes, size_t alignment, void *user) {
    counter *c = user;
    if (++c->allocations == c->fail_at)
        return NULL;
    void *memory = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory)
        c->held += (int64_t)bytes;
    return memory;
}

static void count_release(void *memory, size_t bytes, void *user) {
    ((counter *)user)->held -= (int64_t)bytes;
    free(memory);
}

static dpl_context *counting_context(counter *c) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context = NULL;
    desc.thread_count = 2;
    desc.allocator = (dpl_allocator){count_allocate, count_release, c};
    (void)!dpl_context_create(&desc, &context);
    return context;
}

static void a_second_frame_allocates_nothing_and_memory_is_counted(void **state) {
    (void)state;
    static picture rgb;
    for (int r = 0; r < RESOLUTIONS; r++) {
        counter c = {0};
        dpl_context *context = counting_context(&c);
        dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 7, 1);
        dpl_solver_desc desc = desc_at(resolutions[r]);
        dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
        dpl_solver *solver;
        dpl_solver_stats stats;
        assert_ok(dpl_solver_create(context, &desc, &solver));
        int64_t before = c.held;
        assert_ok(dpl_solver_solve(solver, field, &output));
        dpl_solver_read_stats(solver, &stats);
        assert_int_equal(stats.memory_bytes, c.held - before);
        int allocations = c.allocations;
        assert_ok(dpl_solver_solve(solver, field, &output));
        assert_int_equal(c.allocations, allocations);
        dpl_solver_destroy(solver);
        dpl_field_destroy(field);
        dpl_context_destroy(context);
        assert_int_equal(c.held, 0);
    }
}

static void a_failing_allocation_is_reported_and_the_next_frame_is_right(void **state) {
    (void)state;
    static picture expected, rgb;
    for (int r = 0; r < RESOLUTIONS; r++) {
        bool failed = true;
        for (int n = 1; failed; n++) {
            counter c = {0};
            dpl_context *context = counting_context(&c);
            dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 7, 1);
            dpl_solver_desc desc = desc_at(resolutions[r]);
            dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
            dpl_solver *solver;
            assert_ok(solve(context, &desc, field, expected));
            assert_ok(dpl_solver_create(context, &desc, &solver));
            c.fail_at = c.allocations + n;
            dpl_status status = dpl_solver_solve(solver, field, &output);
            failed = status != DPL_OK;
            if (failed)
                assert_int_equal(status, DPL_ERROR_MEMORY);
            assert_ok(dpl_solver_solve(solver, field, &output));
            assert_memory_equal(rgb, expected, sizeof rgb);
            dpl_solver_destroy(solver);
            dpl_field_destroy(field);
            dpl_context_destroy(context);
            assert_int_equal(c.held, 0);
        }
    }
}

/* ---- change, progress, statistics ----------------------------------------------------------------- */

/* Memory of an earlier frame must not show in a later one: other size, no media, no albedo. */
static void a_solver_may_be_used_for_one_world_after_another(void **state) {
    (void)state;
    static picture expected, rgb;
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_field *large = dpl_test_world(context, 120, 90, 2, 1),
                  *field = dpl_test_world(context, WIDTH, HEIGHT, 3, 0);
        dpl_solver_desc desc = desc_at(resolutions[r]);
        dpl_solver *solver;
        static float other[120 * 90 * 3];
        dpl_output first = {.data = other, .width = 120, .height = 90, .channels = 3};
        dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
        assert_ok(solve(context, &desc, field, expected));
        assert_ok(dpl_solver_create(context, &desc, &solver));
        assert_ok(dpl_solver_solve(solver, large, &first));
        assert_ok(dpl_solver_solve(solver, field, &output));
        assert_memory_equal(rgb, expected, sizeof rgb);
        dpl_solver_destroy(solver);
        dpl_field_destroy(large);
        dpl_field_destroy(field);
    }
    dpl_context_destroy(context);
}

typedef struct watch {
    double last;
    double stop_at;
} watch;

static int follow(double done, void *user) {
    watch *w = user;
    assert_true(done >= w->last && done <= 1.0);
    w->last = done;
    return done < w->stop_at;
}

static void progress_rises_to_the_end_and_can_be_cancelled(void **state) {
    (void)state;
    static picture rgb;
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 3, 0);
    for (int r = 1; r < RESOLUTIONS; r++) {
        watch whole = {.stop_at = 2.0}, part = {.stop_at = 0.5};
        dpl_solver_desc desc = desc_at(resolutions[r]);
        desc.progress = follow;
        desc.progress_user = &whole;
        assert_ok(solve(context, &desc, field, rgb));
        assert_true(whole.last == 1.0);
        desc.progress_user = &part;
        for (size_t i = 0; i < sizeof rgb / sizeof rgb[0]; i++)
            rgb[i] = -1.0f;
        assert_int_equal(solve(context, &desc, field, rgb), DPL_ERROR_CANCELLED);
        for (size_t i = 0; i < sizeof rgb / sizeof rgb[0]; i++)
            assert_true(rgb[i] == -1.0f);
    }
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

static void fewer_rays_are_traced_at_lower_resolution(void **state) {
    (void)state;
    static float rgb[128 * 128 * 3];
    static const int32_t levels[RESOLUTIONS] = {7, 6, 5, 8};
    int64_t rays[RESOLUTIONS], probes[RESOLUTIONS];
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    dpl_field *field = dpl_test_world(context, 128, 128, 3, 0);
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_solver_desc desc = desc_at(resolutions[r]);
        dpl_output output = {.data = rgb, .width = 128, .height = 128, .channels = 3};
        dpl_solver *solver;
        dpl_solver_stats stats;
        assert_ok(dpl_solver_create(context, &desc, &solver));
        assert_ok(dpl_solver_solve(solver, field, &output));
        dpl_solver_read_stats(solver, &stats);
        rays[r] = stats.rays_traced;
        probes[r] = stats.levels[0].probes;
        assert_int_equal(stats.level_count, levels[r]);
        dpl_solver_destroy(solver);
    }
    assert_int_equal(probes[1] * 4, probes[0]);
    assert_int_equal(probes[2] * 16, probes[0]);
    assert_int_equal(probes[3], probes[0] * 4);
    assert_in_range(rays[0], 3 * rays[1], 5 * rays[1]);
    assert_in_range(rays[3], 3 * rays[0], 5 * rays[0]);
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_thread_count_and_instruction_set_gives_the_same_bytes),
        cmocka_unit_test(a_second_frame_allocates_nothing_and_memory_is_counted),
        cmocka_unit_test(a_failing_allocation_is_reported_and_the_next_frame_is_right),
        cmocka_unit_test(a_solver_may_be_used_for_one_world_after_another),
        cmocka_unit_test(progress_rises_to_the_end_and_can_be_cancelled),
        cmocka_unit_test(fewer_rays_are_traced_at_lower_resolution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
