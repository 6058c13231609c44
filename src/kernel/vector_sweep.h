/* Strips that are proved empty, and rays through a distance field of shapes, in vectors: in lanes what ref.c
 * does in sequence, operation for operation. Included by vector.c alone. */
#ifndef DPL_KERNEL_VECTOR_SWEEP_H
#define DPL_KERNEL_VECTOR_SWEEP_H

#include "kernel/vector_rays.h"

/* ---- sweep ---------------------------------------------------------------------------------------- */

static inline vfloat clamp_floats(vfloat v, float high) {
    v = select_float(v < 0.0f, all_float(0.0f), v);
    return select_float(v > high, all_float(high), v);
}

static inline vfloat free_radius(const dpl_clearances *d, vint active, vfloat x, vfloat y) {
    vfloat near_x = clamp_floats(x, (float)d->width), near_y = clamp_floats(y, (float)d->height);
    vint column = clamp_ints(to_int(near_x), d->width - 1), row = clamp_ints(to_int(near_y), d->height - 1);
    vfloat off_x = near_x - (to_float(column) + 0.5f), off_y = near_y - (to_float(row) + 0.5f);
    vfloat out_x = x - near_x, out_y = y - near_y;
    vfloat distance = gather(active, d->plane, (row * d->width + column) * d->stride, all_float(0.0f));
    vfloat inner = distance - square_root(off_x * off_x + off_y * off_y);
    vfloat outer = square_root(out_x * out_x + out_y * out_y);
    return (select_float(inner > outer, inner, outer) - d->spare) * SWEEP_SHRINK;
}

/* Vectors of strips that are swept at once. */
#define SWEEPS_IN_FLIGHT 4

/* A vector of strips on its way. */
typedef struct sweeping {
    int32_t first, count; /* of strips; none behind the last */
    rays axis;
    vfloat width0, slope, steep, scale;
    vfloat t;
    vint active, whole;
} sweeping;

static inline sweeping start_sweep(const dpl_strips *strips, int32_t first) {
    int32_t all = strips->axis.count;
    sweeping s = {.first = first < all ? first : all};
    s.count = all - s.first < LANES ? all - s.first : LANES;
    s.axis = rays_between(&strips->axis, s.first, s.count);
    s.width0 = load_some(strips->width0 + s.first, s.count);
    s.active = lane_numbers() < s.count;
    s.slope = (load_some(strips->width1 + s.first, s.count) - s.width0) * inverse_or_never(s.axis.length);
    s.steep = 1.0f + s.slope * s.slope;
    s.scale = 1.0f / s.steep;
    return s;
}

/* One disc further. */
static inline void sweep_on(const dpl_clearances *d, sweeping *s) {
    vfloat width = s->width0 + s->slope * s->t;
    vfloat radius = free_radius(d, s->active, s->axis.x + s->t * s->axis.dx, s->axis.y + s->t * s->axis.dy);
    s->active &= radius > width;
    vfloat square = select_float(s->active, radius * radius * s->steep - width * width, all_float(0.0f));
    vfloat advance = (square_root(square) - s->slope * width) * s->scale;
    s->active &= advance >= SWEEP_LEAST;
    s->t = select_float(s->active, s->t + advance, s->t);
    s->whole |= s->active & (s->t >= s->axis.length);
    s->active &= ~s->whole;
}

static inline void end_sweep(const sweeping *s, float *share) {
    vfloat part = s->t * inverse_or_never(s->axis.length) * SWEEP_SHRINK;
    store_some(share + s->first, select_float(s->whole, all_float(1.0f), part), s->count);
}

static void sweep(const dpl_clearances *distances, const dpl_strips *strips, float *share) {
    for (int32_t first = 0; first < strips->axis.count; first += SWEEPS_IN_FLIGHT * LANES) {
        sweeping s[SWEEPS_IN_FLIGHT];
        bool going = true;
        for (int k = 0; k < SWEEPS_IN_FLIGHT; k++)
            s[k] = start_sweep(strips, first + k * LANES);
        for (int i = 0; i < SWEEP_DISCS && going; i++) {
            going = false;
            for (int k = 0; k < SWEEPS_IN_FLIGHT; k++)
                if (any(s[k].active)) {
                    sweep_on(distances, &s[k]);
                    going = true;
                }
        }
        for (int k = 0; k < SWEEPS_IN_FLIGHT; k++)
            end_sweep(&s[k], share);
    }
}

/* ---- march through a distance field of shapes ----------------------------------------------------- */

static inline gathered nothing_gathered(void) {
    gathered g;
    for (int c = 0; c < 3; c++) {
        g.radiance[c] = all_float(0.0f);
        g.passed[c] = all_float(1.0f);
    }
    return g;
}

static inline void store_gathered(const gathered *g, const dpl_intervals *intervals, int32_t first,
                                  int32_t count) {
    for (int c = 0; c < 3; c++) {
        store_some(intervals->radiance[c] + first, g->radiance[c], count);
        store_some(intervals->transmittance[c] + first, g->passed[c], count);
    }
}

/* Where in `surface` a point's four floats begin, and in which lanes there is anything. */
static inline vint surface_index(const dpl_grid *grid, vfloat x, vfloat y, vint *lanes) {
    *lanes &= (x > -1.0f) & (y > -1.0f) & (x < (float)grid->width) & (y < (float)grid->height);
    vint column = to_int(select_float(*lanes, x, all_float(0.0f)));
    vint row = to_int(select_float(*lanes, y, all_float(0.0f)));
    return 4 * (row * grid->width + column);
}

static inline void hit_surface(const dpl_grid *grid, vint hits, vfloat x, vfloat y, gathered *g) {
    vint there = hits;
    vint index = surface_index(grid, x, y, &there);
    for (int c = 0; c < 3; c++) {
        vfloat emission = gather(there, &grid->surface[0][0], index + 1 + c, all_float(0.0f));
        g->radiance[c] = select_float(hits, emission, g->radiance[c]);
        g->passed[c] = select_float(hits, all_float(0.0f), g->passed[c]);
    }
}

static inline vfloat surface_distance(const dpl_grid *grid, vint lanes, vfloat x, vfloat y) {
    vint index = surface_index(grid, x, y, &lanes);
    return gather(lanes, &grid->surface[0][0], index, all_float(SURFACE_OUTSIDE));
}

static void march_surface(const dpl_grid *grid, const dpl_segments *segments,
                          const dpl_intervals *intervals) {
    float width = (float)grid->width, height = (float)grid->height;
    for (int32_t first = 0; first < segments->count; first += LANES) {
        int32_t left = segments->count - first, count = left < LANES ? left : LANES;
        rays r = rays_between(segments, first, count);
        gathered g = nothing_gathered();
        vint active = lane_numbers() < count;
        vint buried = active & (surface_distance(grid, active, r.x, r.y) <= 0.0f);
        hit_surface(grid, buried, r.x, r.y, &g);
        active &= ~buried;
        vfloat t = all_float(0.0f);
        for (int i = 0; i < SURFACE_STEPS && any(active); i++) {
            vfloat x = r.x + r.dx * t, y = r.y + r.dy * t;
            active &= ~((x < 0.0f) | (y < 0.0f) | (x >= width) | (y >= height));
            vfloat distance = surface_distance(grid, active, x, y);
            t += magnitude(distance);
            active &= ~(t >= r.length);
            vint hits = active & (t > SURFACE_LEAST_TRAVEL) & (distance < SURFACE_HIT);
            if (any(hits)) {
                hit_surface(grid, hits, r.x + r.dx * t, r.y + r.dy * t, &g);
                active &= ~hits;
            }
        }
        store_gathered(&g, intervals, first, count);
    }
}

#endif
