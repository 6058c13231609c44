/* One scene, one result: the same bytes for every thread count and for a user's own task system, and nothing
 * is allocated once the first frame at a size is done. */
#include "counting.h"
#include "testing.h"
#include "world.h"

#include <pthread.h>
#include <stdlib.h>

enum { WIDTH = 150, HEIGHT = 67 };

typedef float picture[WIDTH * HEIGHT * 3];

/* What is solved: every solver and merge, and bounces where there are any. */
static const struct {
    dpl_solver_kind kind;
    dpl_merge merge;
    int32_t bounces;
    dpl_storage storage;
} methods[] = {
    {.merge = DPL_MERGE_BILINEAR},
    {.merge = DPL_MERGE_BILINEAR_FIX},
    {.merge = DPL_MERGE_NEAREST_FIX},
    {.kind = DPL_SOLVER_REFERENCE},
    {.kind = DPL_SOLVER_REFERENCE, .bounces = 2},
    {.kind = DPL_SOLVER_HOLOGRAPHIC},
    {.kind = DPL_SOLVER_HOLOGRAPHIC, .storage = DPL_STORAGE_HALF},
};
enum { METHOD_COUNT = sizeof methods / sizeof methods[0] };

static dpl_solver_desc desc_of(int method) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = methods[method].kind;
    desc.cascades.merge = methods[method].merge;
    desc.reference.directions = 32;
    desc.holographic.storage = methods[method].storage;
    desc.bounces = methods[method].bounces;
    return desc;
}

static void solve_all(const dpl_context_desc *desc, picture results[METHOD_COUNT],
                      int64_t rays[METHOD_COUNT]) {
    dpl_context *context;
    assert_ok(dpl_context_create(desc, &context));
    dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 11, 1);
    for (int i = 0; i < METHOD_COUNT; i++) {
        const dpl_solver_desc solver_desc = desc_of(i);
        dpl_solver *solver;
        assert_ok(dpl_solver_create(context, &solver_desc, &solver));
        dpl_output output = {.data = results[i], .width = WIDTH, .height = HEIGHT, .channels = 3};
        assert_ok(dpl_solver_solve(solver, field, &output));
        dpl_solver_stats stats;
        dpl_solver_read_stats(solver, &stats);
        rays[i] = stats.rays_traced;
        dpl_solver_destroy(solver);
    }
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

/* ---- a user's task system: one thread per range, ranges handed out backwards ---------------------- */

enum { USER_WORKERS = 5 };

typedef struct user_range {
    dpl_task_function function;
    void *task;
    int32_t begin, end, worker;
    pthread_t thread;
} user_range;

static void *run_user_range(void *argument) {
    user_range *range = argument;
    range->function(range->begin, range->end, range->worker, range->task);
    return NULL;
}

static void *user_enqueue(dpl_task_function function, int32_t item_count, int32_t min_range, void *task,
                          void *user) {
    (void)min_range;
    user_range *ranges = user;
    for (int32_t i = 0; i < USER_WORKERS; i++) {
        user_range *range = &ranges[USER_WORKERS - 1 - i];
        *range = (user_range){
            function, task, item_count * i / USER_WORKERS, item_count * (i + 1) / USER_WORKERS, i, 0};
        if (pthread_create(&range->thread, NULL, run_user_range, range) != 0)
            abort();
    }
    return ranges;
}

static void user_finish(void *handle, void *user) {
    (void)user;
    user_range *ranges = handle;
    for (int32_t i = 0; i < USER_WORKERS; i++)
        pthread_join(ranges[i].thread, NULL);
}

/* ---- the tests ------------------------------------------------------------------------------------ */

static void every_thread_count_gives_the_same_bytes(void **state) {
    (void)state;
    static picture expected[METHOD_COUNT], found[METHOD_COUNT];
    int64_t expected_rays[METHOD_COUNT], rays[METHOD_COUNT];
    user_range ranges[USER_WORKERS];
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 1;
    solve_all(&desc, expected, expected_rays);
    static const int32_t thread_counts[] = {2, 3, 7, 16, 0};
    for (int i = 0; i < 5; i++) {
        desc.thread_count = thread_counts[i];
        if (thread_counts[i] == 0) {
            desc.thread_count = USER_WORKERS;
            desc.tasks = (dpl_task_hooks){user_enqueue, user_finish, ranges};
        }
        solve_all(&desc, found, rays);
        assert_memory_equal(expected, found, sizeof expected);
        assert_memory_equal(expected_rays, rays, sizeof rays);
    }
}

/* Progress cuts the work into pieces; that must not show either. */
static int count_progress(double done, void *user) {
    double *last = user;
    assert_true(done > *last && done <= 1.000001);
    *last = done;
    return 1;
}

static void assert_progress(dpl_context *context, dpl_solver_kind kind) {
    static picture plain, watched;
    dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 4, 0);
    dpl_solver_desc desc = dpl_solver_desc_default();
    double last = -1.0;
    desc.kind = kind;
    for (int i = 0; i < 2; i++) {
        dpl_solver *solver;
        desc.progress = i ? count_progress : NULL;
        desc.progress_user = &last;
        assert_ok(dpl_solver_create(context, &desc, &solver));
        dpl_output output = {.data = i ? watched : plain, .width = WIDTH, .height = HEIGHT, .channels = 3};
        assert_ok(dpl_solver_solve(solver, field, &output));
        dpl_solver_destroy(solver);
    }
    assert_true(last > 0.99);
    assert_memory_equal(plain, watched, sizeof plain);
    dpl_field_destroy(field);
}

static void watching_the_progress_changes_nothing(void **state) {
    (void)state;
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    assert_progress(context, DPL_SOLVER_CASCADES);
    assert_progress(context, DPL_SOLVER_HOLOGRAPHIC);
    dpl_context_destroy(context);
}

/* `user`: an int, 1 to stop half way. */
static int stop_half_way(double done, void *user) {
    return *(const int *)user == 0 || done < 0.5;
}

static void a_cancelled_solve_leaves_output_and_statistics_alone(void **state) {
    (void)state;
    static picture rgb;
    dpl_context *context;
    dpl_solver_stats before, after;
    int stop = 0;
    assert_ok(dpl_context_create(NULL, &context));
    dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 4, 0);
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.progress = stop_half_way;
    desc.progress_user = &stop;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &before);
    assert_true(before.rays_traced > 0);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        rgb[i] = -1.0f;
    stop = 1;
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_CANCELLED);
    dpl_solver_read_stats(solver, &after);
    assert_memory_equal(&before, &after, sizeof before);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        assert_true(rgb[i] == -1.0f);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

static void a_second_frame_allocates_nothing(void **state) {
    (void)state;
    static picture rgb;
    counting counter = {0};
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.allocator = (dpl_allocator){count_allocate, count_release, &counter};
    assert_ok(dpl_context_create(&desc, &context));
    dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 11, 1);
    for (int i = 0; i < METHOD_COUNT; i++) {
        const dpl_solver_desc solver_desc = desc_of(i);
        dpl_solver *solver;
        assert_ok(dpl_solver_create(context, &solver_desc, &solver));
        dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
        int after_first = 0;
        for (int frame = 0; frame < 4; frame++) {
            dpl_shape lamp = dpl_shape_default(DPL_SHAPE_DISC);
            lamp.disc = (dpl_disc){{20.0 + 5 * frame, 30.0}, 4.0};
            lamp.material.emission[1] = 1.0f;
            assert_ok(dpl_field_draw_shapes(field, &lamp, 1));
            if (methods[i].kind == DPL_SOLVER_REFERENCE && frame > 1)
                break; /* two slow frames tell as much as four */
            assert_ok(dpl_solver_solve(solver, field, &output));
            if (frame == 0)
                after_first = counter.allocations;
            assert_int_equal(counter.allocations, after_first);
        }
        dpl_solver_destroy(solver);
    }
    dpl_field_destroy(field);
    dpl_context_destroy(context);
    assert_int_equal(counter.live, 0);
}

/* One frame from nothing, as far as the memory reaches. */
static dpl_status one_frame(counting *counter, int method) {
    static float rgb[24 * 17 * 3];
    static const float sky[3][3] = {{1, 1, 1}, {0, 0, 0}, {0, 2, 0}};
    static const uint8_t walls[17 * 24] = {[40] = 255, [41] = 128};
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    dpl_field *field = NULL;
    dpl_solver *solver = NULL;
    desc.thread_count = 2;
    desc.allocator = (dpl_allocator){count_allocate, count_release, counter};
    dpl_status status = dpl_context_create(&desc, &context);
    if (status != DPL_OK)
        return status;
    dpl_field_desc field_desc = dpl_field_desc_default();
    field_desc.width = 24;
    field_desc.height = 17;
    dpl_solver_desc solver_desc = desc_of(method);
    solver_desc.reference.directions = 8;
    dpl_layer layer = dpl_layer_default();
    layer.extinction = (dpl_pixels){walls, DPL_FORMAT_UNORM8, 24, 17, 1, 0};
    layer.albedo = layer.extinction;
    dpl_output output = {.data = rgb, .width = 24, .height = 17, .channels = 3};
    status = dpl_field_create(context, &field_desc, &field);
    if (status == DPL_OK)
        status = dpl_field_set_sky_ring(field, sky, 3);
    if (status == DPL_OK)
        status = dpl_field_draw_layer(field, &layer);
    if (status == DPL_OK)
        status = dpl_solver_create(context, &solver_desc, &solver);
    if (status == DPL_OK)
        status = dpl_solver_solve(solver, field, &output);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(context);
    return status;
}

static void a_failing_allocation_is_reported_and_leaks_nothing(void **state) {
    (void)state;
    for (int i = 2; i < METHOD_COUNT; i++) { /* the merges of cascades allocate alike: one will do */
        int failed = 0;
        for (int n = 1;; n++) {
            counting counter = {.fail_at = n};
            dpl_status status = one_frame(&counter, i);
            assert_int_equal(counter.live, 0);
            if (counter.allocations < n) {
                assert_ok(status);
                break;
            }
            assert_int_equal(status, DPL_ERROR_MEMORY);
            failed++;
        }
        assert_true(failed > 8);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_thread_count_gives_the_same_bytes),
        cmocka_unit_test(watching_the_progress_changes_nothing),
        cmocka_unit_test(a_cancelled_solve_leaves_output_and_statistics_alone),
        cmocka_unit_test(a_second_frame_allocates_nothing),
        cmocka_unit_test(a_failing_allocation_is_reported_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
