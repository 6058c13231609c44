/* Worlds that change from frame to frame, for tests of reuse: shapes that are moved, recoloured, added and
 * taken away by chance, and drawn anew for each frame as a game does. */
#ifndef DPL_TEST_MOVING_WORLD_H
#define DPL_TEST_MOVING_WORLD_H

#include "world.h"

#include <stdlib.h>
#include <string.h>

enum { MOVING_SHAPES = 14 };

typedef struct moving_world {
    dpl_field *field;
    int32_t width, height, margin;
    uint32_t seed;
    int fog;
    dpl_shape shapes[MOVING_SHAPES];
    int there[MOVING_SHAPES];
    float sky[3];
    int rooms; /* so many walls across the world, either way, drawn last */
    double walls[2][8];
} moving_world;

static inline double moving_chance(moving_world *w, double low, double high) {
    return dpl_test_random(&w->seed, low, high);
}

static inline int moving_pick(moving_world *w, int end) {
    return (int)moving_chance(w, 0.0, end);
}

static inline double *moving_center(dpl_shape *shape) {
    return shape->kind == DPL_SHAPE_DISC ? shape->disc.center : shape->box.center;
}

static inline void moving_place(moving_world *w, dpl_shape *shape) {
    double *center = moving_center(shape);
    center[0] = moving_chance(w, -w->margin, w->width + w->margin);
    center[1] = moving_chance(w, -w->margin, w->height + w->margin);
}

static inline void moving_colour(moving_world *w, dpl_shape *shape) {
    for (int c = 0; c < 3; c++)
        shape->material.emission[c] = (float)moving_chance(w, 0.2, 2.0);
}

static inline void moving_start(moving_world *w, dpl_context *owner, int32_t width, int32_t height,
                                uint32_t seed, int fog) {
    dpl_field_desc desc = dpl_field_desc_default();
    *w = (moving_world){
        .width = width, .height = height, .margin = seed % 3 ? 0 : 7, .seed = seed, .fog = fog};
    desc.width = width;
    desc.height = height;
    desc.margin = w->margin;
    assert_ok(dpl_field_create(owner, &desc, &w->field));
    for (int i = 0; i < MOVING_SHAPES; i++) {
        double size = moving_chance(w, 0.5, 0.1 * (width < height ? width : height) + 2.0);
        w->shapes[i] = dpl_shape_default(i % 3 ? DPL_SHAPE_BOX : DPL_SHAPE_DISC);
        if (i % 3)
            w->shapes[i].box = (dpl_box){{0, 0}, {size, 0.3 * size + 1.0}, moving_chance(w, 0, 3)};
        else
            w->shapes[i].disc = (dpl_disc){{0, 0}, size};
        moving_place(w, &w->shapes[i]);
        if (i % 3 == 0)
            moving_colour(w, &w->shapes[i]);
        for (int c = 0; c < 3 && fog && i % 4 == 0; c++)
            w->shapes[i].material.extinction[c] = (float)moving_chance(w, 0.001, 0.1);
        w->there[i] = 1;
    }
}

/* One edit by chance; now and then none. */
static inline void moving_edit(moving_world *w) {
    int i = moving_pick(w, MOVING_SHAPES), what = moving_pick(w, 9);
    dpl_shape *shape = &w->shapes[i];
    if (what < 3) {
        for (int axis = 0; axis < 2; axis++)
            moving_center(shape)[axis] += moving_chance(w, -2.0, 2.0);
    } else if (what == 3)
        moving_place(w, shape);
    else if (what == 4)
        moving_colour(w, shape);
    else if (what == 5)
        w->there[i] = !w->there[i];
    else if (what == 6 && moving_pick(w, 3) == 0)
        w->sky[moving_pick(w, 3)] = (float)moving_chance(w, 0.0, 0.2);
}

/* Closed rooms, of all sizes. */
static inline void moving_build_rooms(moving_world *w, int count) {
    w->rooms = count;
    for (int i = 0; i < count; i++) {
        w->walls[0][i] = moving_chance(w, 0, w->width);
        w->walls[1][i] = moving_chance(w, 0, w->height);
    }
}

static inline void moving_draw_rooms(moving_world *w) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    for (int i = 0; i < w->rooms; i++)
        for (int axis = 0; axis < 2; axis++) {
            double along = w->walls[axis][i], reach = w->width + w->height;
            shape.box = axis ? (dpl_box){{0, along}, {reach, 2}, 0} : (dpl_box){{along, 0}, {2, reach}, 0};
            assert_ok(dpl_field_draw_shapes(w->field, &shape, 1));
        }
}

static inline void moving_draw(moving_world *w) {
    dpl_field_clear(w->field);
    assert_ok(dpl_field_set_sky(w->field, w->sky));
    for (int i = 0; i < MOVING_SHAPES; i++)
        if (w->there[i])
            assert_ok(dpl_field_draw_shapes(w->field, &w->shapes[i], 1));
    moving_draw_rooms(w);
}

static inline size_t moving_values(const moving_world *w) {
    return 3 * (size_t)w->width * (size_t)w->height;
}

static inline void moving_solve(const moving_world *w, dpl_solver *solver, float *rgb) {
    dpl_output output = {.data = rgb, .width = w->width, .height = w->height, .channels = 3};
    assert_ok(dpl_solver_solve(solver, w->field, &output));
}

/* What a new solver makes of the world. */
static inline dpl_solver_stats moving_solve_anew(const moving_world *w, dpl_context *owner,
                                                 const dpl_solver_desc *desc, float *rgb) {
    dpl_solver_desc plain = *desc;
    dpl_solver *solver;
    dpl_solver_stats stats;
    plain.reuse = 0;
    assert_ok(dpl_solver_create(owner, &plain, &solver));
    moving_solve(w, solver, rgb);
    dpl_solver_read_stats(solver, &stats);
    dpl_solver_destroy(solver);
    return stats;
}

#endif
