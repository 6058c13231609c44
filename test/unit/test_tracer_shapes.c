/* Tracers of shapes: closed forms, the same answers naively and through a hierarchy, pictures of light. */
#include "world.h"

#include "shared_context.h"

#include <stdlib.h>

enum { MOST = 500, RAYS = 1500, POINTS = 5 };

static double corners[MOST][POINTS][2];

static dpl_tracer *make(dpl_tracer_method method) {
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    dpl_tracer *tracer;
    desc.method = method;
    assert_ok(dpl_tracer_create(context, &desc, &tracer));
    return tracer;
}

static dpl_ray ray_of(double x, double y, double dx, double dy) {
    return (dpl_ray){
        .origin = {(float)x, (float)y, 0}, .direction = {(float)dx, (float)dy, 0}, .far = INFINITY};
}

/* The nearest hit among these shapes, which must be the same for both methods. */
static dpl_hit trace(const dpl_shape *shapes, int32_t count, dpl_ray ray) {
    dpl_hit hits[2];
    for (int method = 0; method < 2; method++) {
        dpl_tracer *tracer = make((dpl_tracer_method)method);
        uint8_t occluded;
        assert_ok(dpl_tracer_set_shapes(tracer, DPL_TRACER_STATIC, shapes, count));
        assert_ok(dpl_tracer_trace(tracer, &ray, 1, &hits[method]));
        assert_ok(dpl_tracer_occluded(tracer, &ray, 1, &occluded));
        assert_int_equal(occluded, hits[method].object >= 0);
        dpl_tracer_destroy(tracer);
    }
    assert_memory_equal(&hits[0], &hits[1], sizeof hits[0]);
    return hits[0];
}

/* t, or -1 where nothing is hit. */
static double t_of(dpl_shape shape, dpl_ray ray) {
    dpl_hit hit = trace(&shape, 1, ray);
    return hit.object < 0 ? -1.0 : (double)hit.t;
}

static void assert_t(double found, double wanted) {
    assert_true(fabs(found - wanted) <= 1e-5);
}

static dpl_shape disc(double x, double y, double radius) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    shape.disc = (dpl_disc){{x, y}, radius};
    return shape;
}

static dpl_shape box(double x, double y, double half_x, double half_y, double angle) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    shape.box = (dpl_box){{x, y}, {half_x, half_y}, angle};
    return shape;
}

static dpl_shape segment(double x, double y, double to_x, double to_y, double width) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_SEGMENT);
    shape.segment = (dpl_segment){{x, y}, {to_x, to_y}, width};
    return shape;
}

static dpl_shape polygon(const double (*points)[2], int32_t count) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_POLYGON);
    shape.polygon = (dpl_polygon){points, count};
    return shape;
}

static void entry_points_are_those_of_geometry(void **state) {
    (void)state;
    const double quarter = 0.78539816339744831;
    assert_t(t_of(disc(10, 0, 3), ray_of(0, 0, 1, 0)), 7.0);
    assert_t(t_of(disc(10, 0, 3), ray_of(0, 0, 2, 0)), 3.5);
    assert_t(t_of(disc(10, 0, 3), ray_of(0, 1.8, 1, 0)), 10 - 2.4);
    assert_t(t_of(disc(10, 0, 3), ray_of(0, 3.01, 1, 0)), -1.0);
    assert_t(t_of(disc(-10, 0, 3), ray_of(0, 0, 1, 0)), -1.0);
    assert_t(t_of(box(10, 0, 2, 1, 0), ray_of(0, 0.5, 1, 0)), 8.0);
    assert_t(t_of(box(10, 0, 1, 1, quarter), ray_of(0, 0, 1, 0)), 10 - sqrt(2.0));
    assert_t(t_of(box(10, 0, 1, 1, quarter), ray_of(0, 1, 1, 0)), 10 - sqrt(2.0) + 1);
    assert_t(t_of(segment(10, -5, 10, 5, 2), ray_of(0, 0, 1, 0)), 9.0);
    assert_t(t_of(segment(10, -5, 10, 5, 2), ray_of(10, 20, 0, -1)), 14.0);
    assert_t(t_of(segment(10, 0, 10, 0, 2), ray_of(0, 0, 1, 0)), 9.0);
    static const double arrow[][2] = {{10, -4}, {14, 0}, {10, 4}, {12, 0}};
    assert_t(t_of(polygon(arrow, 4), ray_of(0, 0, 1, 0)), 12.0);
    assert_t(t_of(polygon(arrow, 4), ray_of(0, 2, 1, 0)), 11.0);
    assert_t(t_of(polygon(arrow, 4), ray_of(20, 0, -1, 0)), 6.0);
}

static void a_ray_that_starts_inside_hits_where_it_starts(void **state) {
    (void)state;
    static const double arrow[][2] = {{10, -4}, {14, 0}, {10, 4}, {12, 0}};
    assert_t(t_of(disc(10, 0, 3), ray_of(11, 1, 1, 0)), 0.0);
    assert_t(t_of(box(10, 0, 2, 1, 0.5), ray_of(10, 0.2, 0, 1)), 0.0);
    assert_t(t_of(segment(0, 0, 10, 0, 2), ray_of(-0.9, 0, -1, 0)), 0.0);
    assert_t(t_of(polygon(arrow, 4), ray_of(13, 0, 0.3, 1)), 0.0);
    dpl_ray late = ray_of(0, 0, 1, 0);
    late.near = 9.0f;
    assert_t(t_of(disc(10, 0, 3), late), 9.0);
    late.near = 14.0f;
    assert_t(t_of(disc(10, 0, 3), late), -1.0);
    dpl_ray early = ray_of(0, 0, 1, 0);
    early.far = 6.9f;
    assert_t(t_of(disc(10, 0, 3), early), -1.0);
}

/* Of equal t the later shape wins, as it lies on top. */
static void the_topmost_shape_is_hit(void **state) {
    (void)state;
    const dpl_shape shapes[] = {disc(10, 0, 3), box(12, 0, 5, 5, 0), disc(10, 0, 3), box(30, 0, 23, 9, 0)};
    assert_int_equal(trace(shapes, 3, ray_of(0, 0, 1, 0)).object, 2);
    assert_int_equal(trace(shapes, 4, ray_of(0, 0, 1, 0)).object, 3);
    assert_int_equal(trace(shapes, 3, ray_of(10, 0, 0, 1)).object, 2);
    assert_int_equal(trace(shapes, 4, ray_of(10, 0, 0, 1)).object, 3);
}

static void bad_rays_hit_nothing(void **state) {
    (void)state;
    const dpl_shape shape = disc(0, 0, 1e9);
    const float bad[] = {NAN, INFINITY, -INFINITY};
    assert_t(t_of(shape, ray_of(0, 0, 1, 0)), 0.0);
    assert_t(t_of(shape, ray_of(0, 0, 0, 0)), -1.0);
    for (int i = 0; i < 3; i++) {
        assert_t(t_of(shape, ray_of((double)bad[i], 0, 1, 0)), -1.0);
        assert_t(t_of(shape, ray_of(0, 0, 1, (double)bad[i])), -1.0);
    }
    dpl_ray ray = ray_of(0, 0, 1, 0);
    ray.near = NAN;
    assert_t(t_of(shape, ray), -1.0);
    ray.near = 0.0f;
    ray.far = NAN;
    assert_t(t_of(shape, ray), -1.0);
    ray.far = -1.0f;
    assert_t(t_of(shape, ray), -1.0);
}

static void zero_sized_shapes_do_not_crash(void **state) {
    (void)state;
    static const double point[][2] = {{5, 0}, {5, 0}, {5, 0}}, line[][2] = {{5, -1}, {5, 1}, {5, 0}};
    dpl_shape shapes[] = {disc(5, 0, 0),           box(5, 0, 0, 0, 1), segment(5, 0, 5, 0, 0),
                          segment(5, -1, 5, 1, 0), polygon(point, 3),  polygon(line, 3)};
    for (int i = 0; i < 6; i++) {
        double t = t_of(shapes[i], ray_of(0, 0, 1, 0));
        assert_true(t == 5.0 || t == -1.0);
    }
    assert_t(t_of(shapes[3], ray_of(0, 0.5, 1, 0)), 5.0);
}

/* ---- random worlds -------------------------------------------------------------------------------- */

static dpl_shape random_shape(int32_t i, uint32_t *seed, double smallest, double largest) {
    dpl_shape shape = dpl_shape_default((dpl_shape_kind)(i % 4));
    double x = dpl_test_random(seed, 0, 100), y = dpl_test_random(seed, 0, 100);
    double size = smallest * pow(largest / smallest, dpl_test_random(seed, 0, 1));
    double other = size * dpl_test_random(seed, 0, 1), angle = dpl_test_random(seed, -4, 4);
    if (i % 7 == 0) { /* on whole numbers, along the axes */
        x = round(x / 4) * 4;
        y = round(y / 4) * 4;
        angle = 0.0;
    }
    switch (shape.kind) {
    case DPL_SHAPE_DISC:
        return disc(x, y, size);
    case DPL_SHAPE_BOX:
        return box(x, y, size, other, angle);
    case DPL_SHAPE_SEGMENT:
        return segment(x, y, x + size * cos(angle), y + size * sin(angle), 0.1 * other);
    case DPL_SHAPE_POLYGON:
        for (int k = 0; k < POINTS; k++) {
            corners[i][k][0] = x + dpl_test_random(seed, -size, size);
            corners[i][k][1] = i % 3 == 0 ? y : y + dpl_test_random(seed, -size, size);
        }
        return polygon((const double(*)[2])corners[i], POINTS);
    }
    return shape;
}

static dpl_ray random_flat_ray(int32_t i, uint32_t *seed) {
    dpl_ray ray = ray_of(dpl_test_random(seed, -10, 110), dpl_test_random(seed, -10, 110),
                         dpl_test_random(seed, -1, 1), dpl_test_random(seed, -1, 1));
    if (i % 4 == 0) {
        ray.direction[i / 4 % 2] = i % 8 == 0 ? 0.0f : -0.0f;
        ray.origin[0] = 4.0f * roundf(0.25f * ray.origin[0]);
        ray.origin[1] = 4.0f * roundf(0.25f * ray.origin[1]);
    }
    ray.far = i % 5 == 0 ? 10.0f : INFINITY;
    return ray;
}

static void compare_methods(const dpl_shape *shapes, int32_t count, uint32_t *seed) {
    static dpl_ray rays[RAYS];
    static dpl_hit hits[2][RAYS];
    static uint8_t occluded[2][RAYS];
    for (int32_t i = 0; i < RAYS; i++)
        rays[i] = random_flat_ray(i, seed);
    for (int method = 0; method < 2; method++) {
        dpl_tracer *tracer = make((dpl_tracer_method)method);
        assert_ok(dpl_tracer_set_shapes(tracer, DPL_TRACER_STATIC, shapes, count));
        assert_ok(dpl_tracer_trace(tracer, rays, RAYS, hits[method]));
        assert_ok(dpl_tracer_occluded(tracer, rays, RAYS, occluded[method]));
        dpl_tracer_destroy(tracer);
    }
    assert_memory_equal(hits[0], hits[1], sizeof hits[0]);
    assert_memory_equal(occluded[0], occluded[1], sizeof occluded[0]);
    for (int32_t i = 0; i < RAYS; i++)
        assert_int_equal(occluded[0][i], hits[0][i].object >= 0);
}

static void naive_and_hierarchy_agree_bit_for_bit(void **state) {
    (void)state;
    static dpl_shape shapes[MOST];
    static const double sizes[][2] = {{0.5, 3}, {1e-6, 1e-3}, {1e-4, 1e4}, {20, 60}};
    static const int32_t counts[] = {0, 1, 2, 5, MOST};
    uint32_t seed = 5;
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++)
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
            for (int32_t i = 0; i < counts[c]; i++)
                shapes[i] = i % 9 == 8 ? shapes[i - 4] : random_shape(i, &seed, sizes[k][0], sizes[k][1]);
            compare_methods(shapes, counts[c], &seed);
        }
}

/* A shape is entered where pixel centres along the ray begin to be its own. */
static void shapes_are_hit_where_fields_draw_them(void **state) {
    (void)state;
    uint32_t seed = 9;
    for (int32_t i = 0; i < 60; i++) {
        dpl_field_desc desc = dpl_field_desc_default();
        dpl_field *field;
        static uint8_t opaque[100][100];
        dpl_shape shape = random_shape(i, &seed, 5, 30);
        desc.width = desc.height = 100;
        assert_ok(dpl_field_create(context, &desc, &field));
        assert_ok(dpl_field_draw_shapes(field, &shape, 1));
        assert_ok(dpl_field_read_opaque(field, &opaque[0][0], 0));
        for (int32_t y = 3; y < 100; y += 16) {
            double t = t_of(shape, ray_of(0.5, y + 0.5, 1, 0));
            int32_t first = 0;
            while (first < 100 && !opaque[y][first])
                first++;
            if (first == 100)
                continue; /* the ray may still cross it between two centres */
            assert_true(t >= 0.0 && t <= first + 1e-4);
        }
        dpl_field_destroy(field);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entry_points_are_those_of_geometry),
        cmocka_unit_test(a_ray_that_starts_inside_hits_where_it_starts),
        cmocka_unit_test(the_topmost_shape_is_hit),
        cmocka_unit_test(bad_rays_hit_nothing),
        cmocka_unit_test(zero_sized_shapes_do_not_crash),
        cmocka_unit_test(naive_and_hierarchy_agree_bit_for_bit),
        cmocka_unit_test(shapes_are_hit_where_fields_draw_them),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
