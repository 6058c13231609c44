/* Small seeded worlds for solver tests: walls, lamps and fog, without scene files. */
#ifndef DPL_TEST_WORLD_H
#define DPL_TEST_WORLD_H

#include "testing.h"

#include <dapple/dapple.h>

static inline double dpl_test_random(uint32_t *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (*seed >> 8) / 16777216.0;
}

/* A field with a few painted boxes, lamps and, if asked for, patches of coloured fog; its sky is not black.
 */
static inline dpl_field *dpl_test_world(dpl_context *owner, int32_t width, int32_t height, uint32_t seed,
                                        int fog) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = width;
    desc.height = height;
    desc.sky[0] = 0.02f;
    desc.sky[1] = 0.03f;
    desc.sky[2] = 0.05f;
    assert_ok(dpl_field_create(owner, &desc, &field));
    for (int i = 0; i < 12; i++) {
        dpl_shape shape = dpl_shape_default(i % 2 ? DPL_SHAPE_DISC : DPL_SHAPE_BOX);
        double x = dpl_test_random(&seed, 0, width), y = dpl_test_random(&seed, 0, height);
        double size = dpl_test_random(&seed, 0.04, 0.12) * (width < height ? width : height);
        if (i % 2) {
            shape.disc = (dpl_disc){{x, y}, size};
            for (int c = 0; c < 3; c++)
                shape.material.emission[c] = (float)dpl_test_random(&seed, 0.2, 2.0);
        } else {
            shape.box = (dpl_box){{x, y}, {size, 2 * size}, dpl_test_random(&seed, 0, 3)};
        }
        for (int c = 0; c < 3 && fog && i % 3 == 0; c++)
            shape.material.extinction[c] = (float)dpl_test_random(&seed, 0.001, 0.1);
        for (int c = 0; c < 3; c++)
            shape.material.albedo[c] = 0.25f * (float)(c + 1);
        assert_ok(dpl_field_draw_shapes(field, &shape, 1));
    }
    return field;
}

static inline dpl_solver *dpl_test_solver(dpl_context *owner, dpl_solver_kind kind, dpl_merge merge,
                                          int32_t bounces) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = kind;
    desc.reference.directions = 32;
    desc.cascades.merge = merge;
    desc.bounces = bounces;
    assert_ok(dpl_solver_create(owner, &desc, &solver));
    return solver;
}

#endif
