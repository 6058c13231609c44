/* The holographic solver's pictures of small worlds, for its tests. */
#ifndef DPL_TEST_HOLOGRAPHIC_H
#define DPL_TEST_HOLOGRAPHIC_H

#include "truth.h"

#include <stdlib.h>

static inline dpl_solver *hrc_solver_in(dpl_context *owner, dpl_storage storage) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.holographic.storage = storage;
    assert_ok(dpl_solver_create(owner, &desc, &solver));
    return solver;
}

static inline dpl_output hrc_output(const dpl_field *field, float *rgb) {
    return (dpl_output){
        .data = rgb, .width = dpl_field_width(field), .height = dpl_field_height(field), .channels = 3};
}

static inline size_t hrc_values(const dpl_field *field) {
    return 3 * (size_t)dpl_field_width(field) * (size_t)dpl_field_height(field);
}

/* A picture to free(). */
static inline float *hrc_solve_with(dpl_solver *solver, dpl_field *field) {
    float *rgb = malloc(hrc_values(field) * sizeof *rgb);
    assert_non_null(rgb);
    dpl_output output = hrc_output(field, rgb);
    assert_ok(dpl_solver_solve(solver, field, &output));
    return rgb;
}

/* The same from a solver of its own. */
static inline float *hrc_solve_in(dpl_context *owner, dpl_field *field, dpl_storage storage) {
    dpl_solver *solver = hrc_solver_in(owner, storage);
    float *rgb = hrc_solve_with(solver, field);
    dpl_solver_destroy(solver);
    return rgb;
}

static inline float *hrc_solve(dpl_field *field, dpl_storage storage) {
    return hrc_solve_in(context, field, storage);
}

/* A medium that glows alike in all channels. */
static inline dpl_material hrc_fog(double emission, double red, double green, double blue) {
    dpl_material material = truth_wall(emission, 0.0);
    material.extinction[0] = (float)red;
    material.extinction[1] = (float)green;
    material.extinction[2] = (float)blue;
    return material;
}

static inline void hrc_set_sky(dpl_field *field, double light) {
    const float sky[3] = {(float)light, (float)light, (float)light};
    assert_ok(dpl_field_set_sky(field, sky));
}

/* Every value of the picture is within `tolerance` of `expected`, relative to it. */
static inline void hrc_assert_uniform(const dpl_field *field, const float *rgb, double expected,
                                      double tolerance) {
    for (size_t i = 0; i < hrc_values(field); i++)
        if (!(fabs(rgb[i] - expected) <= tolerance * expected))
            fail_msg("%dx%d: value %zu is %.9g, not %.9g", dpl_field_width(field), dpl_field_height(field), i,
                     (double)rgb[i], expected);
}

/* Root of the mean square error of free pixels over their mean. */
static inline double hrc_error(const dpl_field *field, const float *rgb, const float *truth) {
    size_t pixels = hrc_values(field) / 3;
    uint8_t *opaque = malloc(pixels);
    assert_non_null(opaque);
    assert_ok(dpl_field_read_opaque(field, opaque, 0));
    double squares = 0.0, sum = 0.0, count = 0.0;
    for (size_t i = 0; i < 3 * pixels; i++)
        if (!opaque[i / 3]) {
            squares += pow((double)rgb[i] - (double)truth[i], 2.0);
            sum += (double)truth[i];
            count += 1.0;
        }
    free(opaque);
    return count > 0.0 ? sqrt(squares / count) / (sum / count) : 0.0;
}

#endif
