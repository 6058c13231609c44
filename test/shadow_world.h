/* Worlds, shadows and planes of visibility for shadow tests. */
#ifndef DPL_TEST_SHADOW_WORLD_H
#define DPL_TEST_SHADOW_WORLD_H

#include "testing.h"

#include <dapple/dapple.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static inline dpl_field *dpl_test_field(dpl_context *context, int32_t width, int32_t height) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = width;
    desc.height = height;
    assert_ok(dpl_field_create(context, &desc, &field));
    return field;
}

/* Opaque from (left, top) to (right, bottom), by pixels; or a medium of that extinction. */
static inline void dpl_test_block(dpl_field *field, double left, double top, double right, double bottom,
                                  float extinction) {
    dpl_shape box = dpl_shape_default(DPL_SHAPE_BOX);
    box.box =
        (dpl_box){{(left + right) / 2, (top + bottom) / 2}, {(right - left) / 2, (bottom - top) / 2}, 0};
    for (int c = 0; c < 3; c++)
        box.material.extinction[c] = extinction;
    assert_ok(dpl_field_draw_shapes(field, &box, 1));
}

static inline dpl_light dpl_test_light(double x, double y, double radius) {
    return (dpl_light){{x, y}, radius, {1.0f, 0.5f, 0.25f}, 2.0f};
}

/* V of a light by a method, malloc'ed. */
static inline float *dpl_test_visibility(dpl_context *context, dpl_field *field, const dpl_light *light,
                                         const dpl_shadow_desc *desc) {
    size_t pixels = (size_t)dpl_field_width(field) * (size_t)dpl_field_height(field);
    float *v = malloc(pixels * sizeof *v);
    dpl_shadow *shadow;
    assert_non_null(v);
    assert_ok(dpl_shadow_create(context, desc, &shadow));
    assert_ok(dpl_shadow_visibility(shadow, field, light, v, 0));
    dpl_shadow_destroy(shadow);
    return v;
}

static inline dpl_shadow_desc dpl_test_method(dpl_shadow_method method) {
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    desc.method = method;
    return desc;
}

#endif
