/* Tracers: the same bytes and counters for every number of threads, no memory asked for once a frame has been
 * seen, and memory that runs out at any point. */
#include "counting.h"
#include "world.h"

#include <stdlib.h>

enum { SIZE = 20, DIRECTIONS = 16, SHAPES = 90, RAYS = 3000, TRIANGLES = 200 };

typedef struct result {
    float rgb[SIZE][SIZE][4];
    dpl_hit flat[RAYS];
    dpl_hit solid[RAYS];
    uint8_t occluded[RAYS];
    dpl_tracer_stats stats[2];
} result;

static void random_shapes(dpl_shape *shapes, int32_t count, uint32_t seed) {
    static const double corners[][2] = {{3, 3}, {5, 4}, {2, 6}};
    for (int32_t i = 0; i < count; i++) {
        double x = dpl_test_random(&seed, 0, SIZE), y = dpl_test_random(&seed, 0, SIZE);
        shapes[i] = dpl_shape_default(i % 2 ? DPL_SHAPE_DISC : DPL_SHAPE_SEGMENT);
        shapes[i].material.emission[i % 3] = (float)dpl_test_random(&seed, 0, 1);
        if (i % 2)
            shapes[i].disc = (dpl_disc){{x, y}, 0.2};
        else
            shapes[i].segment = (dpl_segment){{x, y}, {x + 1, y + 0.3}, 0.1};
    }
    shapes[0].kind = DPL_SHAPE_POLYGON;
    shapes[0].polygon = (dpl_polygon){corners, 3};
}

static void random_rays(dpl_ray *rays, uint32_t seed) {
    for (int32_t i = 0; i < RAYS; i++) {
        rays[i] = (dpl_ray){.far = INFINITY};
        for (int k = 0; k < 3; k++) {
            rays[i].origin[k] = (float)dpl_test_random(&seed, 0, SIZE);
            rays[i].direction[k] = (float)dpl_test_random(&seed, -1, 1);
        }
    }
}

static dpl_status set_triangles(dpl_tracer *tracer, dpl_tracer_layer layer, uint32_t seed) {
    static float corners[3 * TRIANGLES][3];
    static int32_t indices[TRIANGLES][3];
    for (int32_t i = 0; i < 3 * TRIANGLES; i++) {
        indices[i / 3][i % 3] = i;
        for (int k = 0; k < 3; k++)
            corners[i][k] = i % 3 ? corners[i - 1][k] + (float)dpl_test_random(&seed, -1, 1)
                                  : (float)dpl_test_random(&seed, 0, SIZE);
    }
    return dpl_tracer_set_triangles(tracer, layer, (const float(*)[3])corners, 3 * TRIANGLES,
                                    (const int32_t(*)[3])indices, TRIANGLES);
}

/* A frame of shapes: they move, a picture is lit, rays are traced. */
static dpl_status trace_shapes(dpl_tracer *tracer, uint32_t seed, const dpl_ray *rays, result *r) {
    static dpl_shape shapes[SHAPES];
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    dpl_output output = {.data = &r->rgb[0][0][0], .width = SIZE, .height = SIZE, .channels = 4};
    desc.directions = DIRECTIONS;
    desc.keep_static = 1;
    random_shapes(shapes, SHAPES, seed);
    dpl_status status = dpl_tracer_set_shapes(tracer, DPL_TRACER_DYNAMIC, shapes, SHAPES);
    if (status == DPL_OK)
        status = dpl_tracer_light(tracer, &desc, &output);
    if (status == DPL_OK)
        status = dpl_tracer_trace(tracer, rays, RAYS, r->flat);
    dpl_tracer_read_stats(tracer, &r->stats[0]);
    return status;
}

static dpl_status trace_triangles(dpl_tracer *tracer, uint32_t seed, const dpl_ray *rays, result *r) {
    dpl_status status = set_triangles(tracer, DPL_TRACER_DYNAMIC, seed);
    if (status == DPL_OK)
        status = dpl_tracer_trace(tracer, rays, RAYS, r->solid);
    if (status == DPL_OK)
        status = dpl_tracer_occluded(tracer, rays, RAYS, r->occluded);
    dpl_tracer_read_stats(tracer, &r->stats[1]);
    return status;
}

typedef struct tracers {
    dpl_tracer *flat;
    dpl_tracer *solid;
} tracers;

static dpl_status create(dpl_context *context, tracers *t) {
    static dpl_shape shapes[SHAPES];
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    random_shapes(shapes, SHAPES, 1);
    dpl_status status = dpl_tracer_create(context, &desc, &t->flat);
    if (status == DPL_OK)
        status = dpl_tracer_set_shapes(t->flat, DPL_TRACER_STATIC, shapes, SHAPES);
    desc.geometry = DPL_TRACER_TRIANGLES;
    if (status == DPL_OK)
        status = dpl_tracer_create(context, &desc, &t->solid);
    if (status == DPL_OK)
        status = set_triangles(t->solid, DPL_TRACER_STATIC, 2);
    return status;
}

static dpl_status one_frame(tracers *t, uint32_t seed, const dpl_ray *rays, result *r) {
    dpl_status status = trace_shapes(t->flat, seed, rays, r);
    return status == DPL_OK ? trace_triangles(t->solid, seed, rays, r) : status;
}

static void destroy(tracers *t) {
    dpl_tracer_destroy(t->flat);
    dpl_tracer_destroy(t->solid);
}

static void every_thread_count_gives_the_same_bytes_and_counters(void **state) {
    (void)state;
    static const int32_t thread_counts[] = {1, 2, 3, 8};
    static dpl_ray rays[RAYS];
    static result first, other;
    random_rays(rays, 5);
    for (size_t i = 0; i < sizeof thread_counts / sizeof thread_counts[0]; i++) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *context;
        tracers t = {0};
        result *r = i == 0 ? &first : &other;
        desc.thread_count = thread_counts[i];
        assert_ok(dpl_context_create(&desc, &context));
        assert_ok(create(context, &t));
        for (uint32_t frame = 0; frame < 2; frame++)
            assert_ok(one_frame(&t, frame, rays, r));
        assert_memory_equal(&first, r, sizeof first);
        destroy(&t);
        dpl_context_destroy(context);
    }
    assert_int_equal(first.stats[0].rays, 2 * (SIZE * SIZE * DIRECTIONS + RAYS));
    assert_int_equal(first.stats[1].rays, 2 * 2 * RAYS);
}

/* ---- memory --------------------------------------------------------------------------------------- */

static void a_second_frame_allocates_nothing(void **state) {
    (void)state;
    static dpl_ray rays[RAYS];
    static result r;
    counting counter = {0};
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    tracers t = {0};
    desc.allocator = (dpl_allocator){count_allocate, count_release, &counter};
    random_rays(rays, 6);
    assert_ok(dpl_context_create(&desc, &context));
    assert_ok(create(context, &t));
    assert_ok(one_frame(&t, 0, rays, &r));
    int after_first = counter.allocations;
    for (uint32_t frame = 1; frame < 4; frame++)
        assert_ok(one_frame(&t, frame, rays, &r));
    assert_int_equal(counter.allocations, after_first);
    destroy(&t);
    dpl_context_destroy(context);
    assert_int_equal(counter.live, 0);
}

/* After a failure the tracers are asked once more: they must answer, and from what they hold. */
static dpl_status frame_from_nothing(counting *counter, const dpl_ray *rays, result *r) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    tracers t = {0};
    desc.thread_count = 1;
    desc.allocator = (dpl_allocator){count_allocate, count_release, counter};
    dpl_status status = dpl_context_create(&desc, &context);
    if (status != DPL_OK)
        return status;
    status = create(context, &t);
    if (status == DPL_OK)
        status = one_frame(&t, 1, rays, r);
    if (t.flat)
        assert_ok(dpl_tracer_trace(t.flat, rays, RAYS, r->flat));
    if (t.solid)
        assert_ok(dpl_tracer_trace(t.solid, rays, RAYS, r->solid));
    destroy(&t);
    dpl_context_destroy(context);
    return status;
}

static void a_failing_allocation_is_reported_and_leaks_nothing(void **state) {
    (void)state;
    static dpl_ray rays[RAYS];
    static result whole, r;
    int failed = 0;
    random_rays(rays, 7);
    counting unlimited = {0};
    assert_ok(frame_from_nothing(&unlimited, rays, &whole));
    for (int n = 1; n <= unlimited.allocations; n++) {
        counting counter = {.fail_at = n};
        assert_int_equal(frame_from_nothing(&counter, rays, &r), DPL_ERROR_MEMORY);
        assert_int_equal(counter.live, 0);
        failed++;
    }
    assert_true(failed > 15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_thread_count_gives_the_same_bytes_and_counters),
        cmocka_unit_test(a_second_frame_allocates_nothing),
        cmocka_unit_test(a_failing_allocation_is_reported_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
