/* Rays through the pixel world in vectors: marches through pixels and through a distance field of shapes, and
 * strips that are proved empty. In lanes what ref.c does in sequence, operation for operation. Included by
 * vector.c alone. */
#ifndef DPL_KERNEL_VECTOR_MARCH_H
#define DPL_KERNEL_VECTOR_MARCH_H

#include "kernel/hints.h"
#include "kernel/kernel.h"
#include "kernel/march.h"
#include "kernel/simd.h"

typedef struct rays {
    vfloat x, y;
    vfloat dx, dy;
    vfloat inverse_x, inverse_y;
    vfloat length;
} rays;

static inline vfloat inverse_or_never(vfloat d) {
    return select_float(d != 0.0f, 1.0f / d, all_float(NEVER));
}

static inline rays rays_from_to(vfloat x0, vfloat y0, vfloat x1, vfloat y1) {
    rays r = {.x = x0, .y = y0};
    vfloat dx = x1 - x0, dy = y1 - y0;
    r.length = square_root(dx * dx + dy * dy);
    vfloat scale = inverse_or_never(r.length);
    r.dx = dx * scale;
    r.dy = dy * scale;
    r.inverse_x = inverse_or_never(r.dx);
    r.inverse_y = inverse_or_never(r.dy);
    return r;
}

static inline rays rays_between(const dpl_segments *segments, int32_t first, int32_t count) {
    return rays_from_to(load_some(segments->x0 + first, count), load_some(segments->y0 + first, count),
                        load_some(segments->x1 + first, count), load_some(segments->y1 + first, count));
}

/* What the rays have gathered so far. */
typedef struct gathered {
    vfloat radiance[3];
    vfloat passed[3];
} gathered;

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

/* ---- march ---------------------------------------------------------------------------------------- */

static inline vfloat enter_axis(vfloat start, vfloat direction, vfloat inverse, float size) {
    vfloat below = select_float(direction > 0.0f, -start * inverse, all_float(NEVER));
    vfloat above = select_float(direction < 0.0f, (size - start) * inverse, all_float(NEVER));
    return select_float(start < 0.0f, below, select_float(start > size, above, all_float(0.0f)));
}

static inline vint clamp_ints(vint v, int32_t high) {
    v = select_int(v < 0, all_int(0), v);
    return select_int(v > high, all_int(high), v);
}

/* dpl_exp_negative() in lanes: the same operations. */
static inline vfloat exp_negative(vfloat x) {
    vint near = x < 87.0f;
    x = select_float(near, x, all_float(0.0f));
    vint n = to_int(x * 1.44269504f + 0.5f);
    vfloat r = (x - to_float(n) * 0.693359375f) + to_float(n) * 2.12194440e-4f;
    vfloat p = all_float(1.0f / 720.0f);
    p = 1.0f / 120.0f - r * p;
    p = 1.0f / 24.0f - r * p;
    p = 1.0f / 6.0f - r * p;
    p = 0.5f - r * p;
    p = 1.0f - r * p;
    p = 1.0f - r * p;
    return select_float(near, p * (vfloat)((127 - n) << 23), all_float(0.0f));
}

static inline void cross_media(const dpl_grid *grid, vint lanes, vint cell, vfloat length, gathered *g) {
    for (int c = 0; c < 3; c++) {
        vfloat extinction = gather(lanes, &grid->extinction[0][0], 4 * cell + c, all_float(0.0f));
        vfloat emission = gather(lanes, &grid->emission[0][0], 4 * cell + c, all_float(0.0f));
        vfloat through = exp_negative(extinction * length);
        vfloat radiance = g->radiance[c] + g->passed[c] * (emission * (1.0f - through));
        g->radiance[c] = select_float(lanes, radiance, g->radiance[c]);
        g->passed[c] = select_float(lanes, g->passed[c] * through, g->passed[c]);
    }
}

static inline void hit_opaque(const dpl_grid *grid, vint lanes, vint cell, gathered *g) {
    for (int c = 0; c < 3; c++) {
        vfloat emission = gather(lanes, &grid->emission[0][0], 4 * cell + c, all_float(0.0f));
        g->radiance[c] = select_float(lanes, g->radiance[c] + g->passed[c] * emission, g->radiance[c]);
        g->passed[c] = select_float(lanes, all_float(0.0f), g->passed[c]);
    }
}

/* Where every ray is: pixel and travelled length. */
typedef struct walk {
    vfloat t;
    vint x, y;
    vint active;
} walk;

static inline vint inside(const dpl_grid *grid, vint x, vint y) {
    return (x >= 0) & (y >= 0) & (x < grid->width) & (y < grid->height);
}

static inline walk enter_picture(const dpl_grid *grid, const rays *r, vint active) {
    float width = (float)grid->width, height = (float)grid->height;
    vint outside = (r->x < 0.0f) | (r->y < 0.0f) | (r->x > width) | (r->y > height);
    if (!any(outside)) { /* what follows, where nobody travels to the picture */
        walk w = {.x = to_int(r->x), .y = to_int(r->y)};
        w.active = active & (r->length > 0.0f) & inside(grid, w.x, w.y);
        return w;
    }
    vfloat in_x = enter_axis(r->x, r->dx, r->inverse_x, width),
           in_y = enter_axis(r->y, r->dy, r->inverse_y, height);
    walk w = {.t = select_float(in_x > in_y, in_x, in_y)};
    active &= w.t < r->length;
    vfloat x = r->x + w.t * r->dx, y = r->y + w.t * r->dy;
    vint late = w.t > 0.0f;
    vint misses = late & ((x < -ENTRY_SLACK) | (y < -ENTRY_SLACK) | (x > width + ENTRY_SLACK) |
                          (y > height + ENTRY_SLACK));
    active &= ~misses;
    w.x = floor_to_ints(select_float(active, x, all_float(0.0f)));
    w.y = floor_to_ints(select_float(active, y, all_float(0.0f)));
    w.x = select_int(late, clamp_ints(w.x, grid->width - 1), w.x);
    w.y = select_int(late, clamp_ints(w.y, grid->height - 1), w.y);
    w.active = active & inside(grid, w.x, w.y);
    return w;
}

/* Jumps over what is proved empty. */
static inline void jump(const rays *r, vint lanes, vfloat clearance, walk *w) {
    vfloat t = w->t + (clearance - TWO_HALF_DIAGONALS);
    w->t = select_float(lanes, t, w->t);
    w->active &= ~(lanes & (t >= r->length));
    lanes &= w->active;
    w->x = select_int(lanes, floor_to_ints(select_float(lanes, r->x + t * r->dx, all_float(0.0f))), w->x);
    w->y = select_int(lanes, floor_to_ints(select_float(lanes, r->y + t * r->dy, all_float(0.0f))), w->y);
}

/* Where rays leave their pixels: the nearer of an edge in x and one in y. */
typedef struct edges {
    vfloat x, y, leave;
    vint left, up; /* masks: -1 where the ray runs that way */
} edges;

static inline edges edges_ahead(const rays *r, const walk *w) {
    edges e = {.left = r->dx < 0.0f, .up = r->dy < 0.0f};
    e.x = (to_float(w->x + 1 + e.left) - r->x) * r->inverse_x;
    e.y = (to_float(w->y + 1 + e.up) - r->y) * r->inverse_y;
    e.leave = select_float(e.x < e.y, e.x, e.y);
    return e;
}

static inline void cross_edge(const rays *r, const edges *e, vint lanes, walk *w) {
    w->active &= ~(lanes & (e->leave >= r->length));
    lanes &= w->active;
    w->t = select_float(lanes, e->leave, w->t);
    vint by_x = lanes & (e->x <= e->y), by_y = lanes & ~(e->x <= e->y);
    w->x += by_x & (1 + 2 * e->left);
    w->y += by_y & (1 + 2 * e->up);
}

/* Vectors under way at once: while one waits for its clearances, another computes. */
#define IN_FLIGHT 3

/* A vector of rays on its way. */
typedef struct flight {
    rays r;
    walk w;
    vint cell;  /* the opaque pixel where a ray has ended, or -1 */
    gathered g; /* in media; used where light is asked for */
    int32_t first;
    int32_t count; /* of rays; 0: nothing is under way */
} flight;

/* Crosses pixels to their edges, and what is in them. */
static inline void step(const dpl_grid *grid, flight *f, vint lanes, vfloat clearance, vint here,
                        bool light) {
    edges e = edges_ahead(&f->r, &f->w);
    vint media = lanes & (clearance == 0.0f);
    if (light && any(media)) {
        vfloat until = select_float(e.leave < f->r.length, e.leave, f->r.length);
        cross_media(grid, media & (until > f->w.t), here, until - f->w.t, &f->g);
    }
    cross_edge(&f->r, &e, lanes, &f->w);
}

/* One pixel or jump further. */
static inline void fly_on(const dpl_grid *grid, flight *f, bool light) {
    walk *w = &f->w;
    vint here = w->y * grid->width + w->x;
    vfloat clearance = gather(w->active, grid->clearance, here, all_float(JUMP_FROM));
    vint jumps = w->active & (clearance >= JUMP_FROM), hits = w->active & (clearance < 0.0f);
    vint steps = w->active & ~jumps & ~hits;
    if (any(jumps))
        jump(&f->r, jumps, clearance, w);
    f->cell = select_int(hits, here, f->cell);
    w->active &= ~hits;
    if (any(steps))
        step(grid, f, steps, clearance, here, light);
    w->active &= inside(grid, w->x, w->y);
}

static inline void take_off(const dpl_grid *grid, const dpl_segments *segments, int32_t first, flight *f) {
    f->first = first;
    f->count = segments->count - first < LANES ? segments->count - first : LANES;
    f->r = rays_between(segments, first, f->count);
    f->w = enter_picture(grid, &f->r, lane_numbers() < f->count);
    f->cell = all_int(-1);
    f->g = nothing_gathered();
}

static void march(const dpl_grid *grid, const dpl_segments *segments, const dpl_intervals *intervals) {
    flight flights[IN_FLIGHT];
    int32_t next = 0, flying = 0;
    for (int i = 0; i < IN_FLIGHT; i++)
        flights[i].count = 0;
    do {
        for (int i = 0; i < IN_FLIGHT; i++) {
            flight *f = &flights[i];
            if (f->count > 0 && any(f->w.active)) {
                fly_on(grid, f, true);
                continue;
            }
            if (f->count > 0) {
                vint hits = f->cell >= 0;
                if (any(hits))
                    hit_opaque(grid, hits, f->cell, &f->g);
                store_gathered(&f->g, intervals, f->first, f->count);
                f->count = 0;
                flying--;
            }
            if (next < segments->count) {
                take_off(grid, segments, next, f);
                next += f->count;
                flying++;
            }
        }
    } while (flying > 0);
}

/* ---- march_to_cell -------------------------------------------------------------------------------- */

/* Rays come in no order here, and the longest of a vector takes many times as long as the mean: lanes that
 * are done take new rays as soon as no more than this many others are under way. */
#define CROWDED (LANES / 2)

static inline void choose_rays(vint lanes, const rays *from, rays *r) {
    r->x = select_float(lanes, from->x, r->x);
    r->y = select_float(lanes, from->y, r->y);
    r->dx = select_float(lanes, from->dx, r->dx);
    r->dy = select_float(lanes, from->dy, r->dy);
    r->inverse_x = select_float(lanes, from->inverse_x, r->inverse_x);
    r->inverse_y = select_float(lanes, from->inverse_y, r->inverse_y);
    r->length = select_float(lanes, from->length, r->length);
}

/* Lanes that are done write down what they hit and take the next rays from `next` on; returns how many. */
static inline int32_t change_crew(const dpl_grid *grid, const dpl_segments *segments, int32_t next, flight *f,
                                  vint *number, int32_t *cell) {
    vint done = ~f->w.active, before = lanes_before(done);
    vint hits = f->cell >= 0;
    if (any(hits))
        scatter_ints(hits, cell, *number, f->cell);
    vint lanes = done & (before < segments->count - next);
    rays r =
        rays_from_to(expand(lanes, segments->x0 + next, before), expand(lanes, segments->y0 + next, before),
                     expand(lanes, segments->x1 + next, before), expand(lanes, segments->y1 + next, before));
    walk w = enter_picture(grid, &r, lanes);
    choose_rays(lanes, &r, &f->r);
    f->w.t = select_float(lanes, w.t, f->w.t);
    f->w.x = select_int(lanes, w.x, f->w.x);
    f->w.y = select_int(lanes, w.y, f->w.y);
    f->w.active |= w.active;
    f->cell = all_int(-1);
    *number = select_int(lanes, before + next, *number);
    return lane_count(lanes);
}

static void march_to_cell(const dpl_grid *grid, const dpl_segments *segments, int32_t *cell) {
    flight flights[IN_FLIGHT] = {0};
    vint numbers[IN_FLIGHT];
    int32_t next = 0;
    bool flying = true;
    memset(cell, -1, (size_t)segments->count * sizeof *cell);
    for (int i = 0; i < IN_FLIGHT; i++) {
        flights[i].cell = all_int(-1);
        numbers[i] = all_int(0);
    }
    while (flying || next < segments->count) {
        flying = false;
        for (int i = 0; i < IN_FLIGHT; i++) {
            flight *f = &flights[i];
            if (next < segments->count && lane_count(f->w.active) <= CROWDED)
                next += change_crew(grid, segments, next, f, &numbers[i], cell);
            if (any(f->w.active)) {
                fly_on(grid, f, false);
                flying = true;
            }
        }
    }
    for (int i = 0; i < IN_FLIGHT; i++)
        scatter_ints(flights[i].cell >= 0, cell, numbers[i], flights[i].cell);
}

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
