/* Small worlds of boxes under a chosen sky, and the reference's answer: for tests of what the truth is. */
#ifndef DPL_TEST_TRUTH_H
#define DPL_TEST_TRUTH_H

#include "shared_context.h"

#include <dapple/dapple.h>
#include <math.h>
#include <stdbool.h>

#define TRUTH_PI 3.14159265358979323846

/* An empty world with a black sky. */
static inline dpl_field *truth_field(int32_t width, int32_t height, int32_t margin) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = width;
    desc.height = height;
    desc.margin = margin;
    assert_ok(dpl_field_create(context, &desc, &field));
    return field;
}

/* Opaque and grey. */
static inline dpl_material truth_wall(double emission, double albedo) {
    dpl_material material = dpl_shape_default(DPL_SHAPE_BOX).material;
    for (int c = 0; c < 3; c++) {
        material.emission[c] = (float)emission;
        material.albedo[c] = (float)albedo;
    }
    return material;
}

static inline dpl_material truth_air(void) {
    dpl_material material = truth_wall(0.0, 0.0);
    memset(material.extinction, 0, sizeof material.extinction);
    return material;
}

/* Pixels [x0, x1) x [y0, y1). */
static inline void truth_box(dpl_field *field, double x0, double y0, double x1, double y1,
                             dpl_material material) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    shape.box = (dpl_box){{0.5 * (x0 + x1), 0.5 * (y0 + y1)}, {0.5 * (x1 - x0), 0.5 * (y1 - y0)}, 0.0};
    shape.material = material;
    assert_ok(dpl_field_draw_shapes(field, &shape, 1));
}

/* The sky is `inside` for angles in [from, to) quarter turns, black elsewhere. */
static inline void truth_sky_quarters(dpl_field *field, int from, int to, float inside) {
    float ring[4][3] = {{0.0f}};
    for (int q = from; q < to; q++)
        ring[q][0] = ring[q][1] = ring[q][2] = inside;
    assert_ok(dpl_field_set_sky_ring(field, (const float(*)[3])ring, 4));
}

static inline dpl_solver *truth_solver(int32_t directions, int32_t bounces) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = directions;
    desc.bounces = bounces;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    return solver;
}

/* The whole picture, tightly packed. */
static inline void truth_solve(dpl_field *field, int32_t directions, int32_t bounces, float *rgb) {
    dpl_solver *solver = truth_solver(directions, bounces);
    dpl_output output = {
        .data = rgb, .width = dpl_field_width(field), .height = dpl_field_height(field), .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_destroy(solver);
}

static inline void truth_assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g is not within %g of %.9g", value, tolerance, expected);
}

/* The same, relative to what is expected. */
static inline void truth_assert_close(double value, double expected, double tolerance) {
    truth_assert_near(value, expected, tolerance * fabs(expected));
}

#endif
