/* Rays through the pixel world in vectors: in lanes what ref.c does in sequence, operation for operation.
 * Included by vector.c alone.
 *
 * Rays are followed in rounds: each takes all that still fly one pixel or jump further, and packs them side
 * by side again. So vectors are full however long single rays are, many rays are on their way at once, and
 * hardly a branch depends on one. */
#ifndef DPL_KERNEL_VECTOR_MARCH_H
#define DPL_KERNEL_VECTOR_MARCH_H

#include "kernel/hints.h"
#include "kernel/vector_rays.h"

/* ---- what rays meet ------------------------------------------------------------------------------- */

static inline vfloat enter_axis(vfloat start, vfloat direction, float size) {
    vfloat inverse = inverse_or_never(direction), zero = all_float(0.0f), end = all_float(size);
    vfloat below = choose(lanes_below(zero, direction), -start * inverse, all_float(NEVER));
    vfloat above = choose(lanes_below(direction, zero), (size - start) * inverse, all_float(NEVER));
    return choose(lanes_below(start, zero), below, choose(lanes_below(end, start), above, zero));
}

/* dpl_exp_negative() in lanes: the same operations. */
static inline vfloat exp_negative(vfloat x) {
    vlanes near = lanes_below(x, all_float(87.0f));
    x = choose(near, x, all_float(0.0f));
    vint n = to_int(x * 1.44269504f + 0.5f);
    vfloat r = (x - to_float(n) * 0.693359375f) + to_float(n) * 2.12194440e-4f;
    vfloat p = all_float(1.0f / 720.0f);
    p = 1.0f / 120.0f - r * p;
    p = 1.0f / 24.0f - r * p;
    p = 1.0f / 6.0f - r * p;
    p = 0.5f - r * p;
    p = 1.0f - r * p;
    p = 1.0f - r * p;
    return choose(near, p * (vfloat)((127 - n) << 23), all_float(0.0f));
}

static inline void cross_media(const dpl_grid *grid, vlanes there, vint cell, vfloat length, gathered *g) {
    vfloat extinction[3], emission[3];
    gather_rgb(grid->extinction, cell, extinction);
    gather_rgb(grid->emission, cell, emission);
    length = choose(there, length, all_float(0.0f));
    for (int c = 0; c < 3; c++) {
        vfloat through = exp_negative(extinction[c] * length);
        vfloat radiance = g->radiance[c] + g->passed[c] * (emission[c] * (1.0f - through));
        g->radiance[c] = choose(there, radiance, g->radiance[c]);
        g->passed[c] = choose(there, g->passed[c] * through, g->passed[c]);
    }
}

/* Where every ray is: pixel and travelled length. */
typedef struct walk {
    vfloat t;
    vint x, y;
    vlanes active;
} walk;

/* Unsigned, for lanes of nobody may hold anything. */
typedef uint32_t vuint __attribute__((vector_size(sizeof(vint))));

static inline vint pixel_number(const dpl_grid *grid, vint x, vint y) {
    return (vint)((vuint)y * (uint32_t)grid->width + (vuint)x);
}

static inline vlanes inside(const dpl_grid *grid, vint x, vint y) {
    return lanes_within(x, grid->width) & lanes_within(y, grid->height);
}

/* Further than `slack` from the picture. */
static inline vlanes outside(const dpl_grid *grid, vfloat x, vfloat y, float slack) {
    vfloat low = all_float(-slack);
    return lanes_below(x, low) | lanes_below(y, low) | lanes_below(all_float((float)grid->width + slack), x) |
           lanes_below(all_float((float)grid->height + slack), y);
}

static inline void enter_picture(const dpl_grid *grid, const rays *r, vlanes there, walk *w) {
    const vfloat zero = all_float(0.0f);
    if (!any_lane(outside(grid, r->x, r->y, 0.0f))) { /* what follows, where nobody travels to the picture */
        w->t = zero;
        w->x = to_int(r->x);
        w->y = to_int(r->y);
        w->active = there & lanes_below(zero, r->length) & inside(grid, w->x, w->y);
        return;
    }
    vfloat in_x = enter_axis(r->x, r->dx, (float)grid->width),
           in_y = enter_axis(r->y, r->dy, (float)grid->height);
    vfloat t = choose(lanes_below(in_y, in_x), in_x, in_y), x = r->x + t * r->dx, y = r->y + t * r->dy;
    vlanes late = lanes_below(zero, t), meets = there & lanes_below(t, r->length);
    meets = lanes_but(meets, late & outside(grid, x, y, ENTRY_SLACK)); /* those pass by a corner */
    vint column = floor_to_ints(choose(meets, x, zero)), row = floor_to_ints(choose(meets, y, zero));
    w->t = t;
    w->x = choose_ints(late, clamp_ints(column, grid->width - 1), column);
    w->y = choose_ints(late, clamp_ints(row, grid->height - 1), row);
    w->active = meets & inside(grid, w->x, w->y);
}

/* ---- rounds --------------------------------------------------------------------------------------- */

/* Rays that fly together; and so few that others join them, if there are any: with fewer vectors on their way
 * each waits for itself. */
enum { PIECE = 512, FEW = 8 * LANES };

/* Those that still fly, side by side. A round reads a few rays ahead of where it writes. Rows are 2 KiB long,
 * not more and not less, so that no processor that compares the low 12 bits of addresses takes a load from
 * one row for what was just stored in another: with 32 bytes more the march takes a tenth longer. */
typedef struct crowd {
    _Alignas(vfloat) float x[PIECE];
    float y[PIECE], dx[PIECE], dy[PIECE], length[PIECE];
    float inverse_x[PIECE], inverse_y[PIECE]; /* of the direction; from the second round on */
    float t[PIECE];
    int32_t column[PIECE], row[PIECE];
    int32_t number[PIECE];                      /* of the ray in its segments */
    float radiance[3][PIECE], passed[3][PIECE]; /* so far; in media alone */
    int32_t count;
} crowd;

/* Rays, and where those are that have ended at an opaque pixel. */
typedef struct journey {
    const dpl_grid *grid;
    const dpl_segments *segments;
    const dpl_intervals *intervals; /* what rays have gathered in media; NULL: nobody asks */
    int32_t hits;
    int32_t number[PIECE + LANES], cell[PIECE + LANES];
    crowd flying;
} journey;

/* A vector of them. */
typedef struct flight {
    rays r;
    vfloat inverse_x, inverse_y;
    walk w;
    vint number;
    gathered g;
} flight;

static DPL_ALWAYS_INLINE void note_hits(journey *j, vlanes hits, vint number, vint cell) {
    packing p = packing_of(hits);
    pack_ints(&p, j->number + j->hits, number);
    pack_ints(&p, j->cell + j->hits, cell);
    j->hits += p.count;
}

/* ---- a pixel or jump further ---------------------------------------------------------------------- */

/* Jumps over what is proved empty. */
static DPL_ALWAYS_INLINE void jump(const rays *r, vlanes jumps, vfloat clearance, walk *w) {
    vfloat t = w->t + (clearance - TWO_HALF_DIAGONALS);
    w->t = choose(jumps, t, w->t);
    w->active = lanes_but(w->active, jumps & lanes_at_most(r->length, t));
    jumps = jumps & w->active;
    w->x = choose_ints(jumps, floor_to_ints(r->x + t * r->dx), w->x);
    w->y = choose_ints(jumps, floor_to_ints(r->y + t * r->dy), w->y);
}

/* Crosses pixels to their edges, the nearer of one in x and one in y, and what is in them. */
static DPL_ALWAYS_INLINE void step(const dpl_grid *grid, flight *f, vlanes steps, vfloat clearance, vint here,
                                   bool media) {
    const vint back = all_int(-1), on = all_int(1), none = all_int(0);
    walk *w = &f->w;
    vlanes left = lanes_below(f->r.dx, all_float(0.0f)), up = lanes_below(f->r.dy, all_float(0.0f));
    vfloat x = (to_float(w->x + choose_ints(left, none, on)) - f->r.x) * f->inverse_x;
    vfloat y = (to_float(w->y + choose_ints(up, none, on)) - f->r.y) * f->inverse_y;
    vfloat leave = choose(lanes_below(x, y), x, y);
    if (media) {
        vfloat until = choose(lanes_below(leave, f->r.length), leave, f->r.length);
        vlanes lit = steps & lanes_equal(clearance, all_float(0.0f)) & lanes_below(w->t, until);
        if (any_lane(lit))
            cross_media(grid, lit, here, until - w->t, &f->g);
    }
    w->active = lanes_but(w->active, steps & lanes_at_most(f->r.length, leave));
    steps = steps & w->active;
    w->t = choose(steps, leave, w->t);
    vlanes by_x = lanes_at_most(x, y);
    w->x = choose_ints(steps & by_x, w->x + choose_ints(left, back, on), w->x);
    w->y = choose_ints(lanes_but(steps, by_x), w->y + choose_ints(up, back, on), w->y);
}

static DPL_ALWAYS_INLINE void keep(crowd *c, const packing *p, const rays *r, const walk *w, vint number) {
    int32_t at = c->count;
    pack_floats(p, c->x + at, r->x);
    pack_floats(p, c->y + at, r->y);
    pack_floats(p, c->dx + at, r->dx);
    pack_floats(p, c->dy + at, r->dy);
    pack_floats(p, c->length + at, r->length);
    pack_floats(p, c->t + at, w->t);
    pack_ints(p, c->column + at, w->x);
    pack_ints(p, c->row + at, w->y);
    pack_ints(p, c->number + at, number);
}

/* The first round, of rays first .. end-1: most jump, many to their end. Those that would step wait. */
static DPL_ALWAYS_INLINE void take_off(journey *j, int32_t first, int32_t end) {
    const dpl_grid *grid = j->grid;
    for (; first < end; first += LANES) {
        int32_t count = end - first < LANES ? end - first : LANES;
        vint number = first + lane_numbers();
        rays r = rays_between(j->segments, first, count);
        walk w;
        enter_picture(grid, &r, first_lanes(count), &w);
        vint here = pixel_number(grid, w.x, w.y);
        vfloat clearance = gather_lanes(w.active, grid->clearance, here, all_float(0.0f));
        vlanes hits = lanes_below(clearance, all_float(0.0f));
        note_hits(j, hits, number, here);
        w.active = lanes_but(w.active, hits);
        jump(&r, lanes_at_most(all_float(JUMP_FROM), clearance), clearance, &w);
        w.active = w.active & inside(grid, w.x, w.y);
        packing p = packing_of(w.active);
        if (p.count > 0) {
            keep(&j->flying, &p, &r, &w, number);
            j->flying.count += p.count;
        }
    }
}

/* One pixel or jump further. */
static DPL_ALWAYS_INLINE void fly_on(journey *j, flight *f, bool media) {
    walk *w = &f->w;
    vint here = pixel_number(j->grid, w->x, w->y);
    if (media) /* its pixel is read, wherever it is */
        here = choose_ints(w->active, here, all_int(0));
    vfloat clearance = gather_lanes(w->active, j->grid->clearance, here, all_float(JUMP_FROM));
    vlanes jumps = w->active & lanes_at_most(all_float(JUMP_FROM), clearance);
    vlanes hits = lanes_below(clearance, all_float(0.0f)); /* active all of them */
    vlanes steps = lanes_but(w->active, jumps | hits);
    note_hits(j, hits, f->number, here);
    w->active = lanes_but(w->active, hits);
    if (!media || any_lane(jumps))
        jump(&f->r, jumps, clearance, w);
    step(j->grid, f, steps, clearance, here, media);
    w->active = w->active & inside(j->grid, w->x, w->y);
}

/* Rays that have ended leave what they have gathered. */
static inline void leave_light(journey *j, const flight *f, vlanes ended) {
    float radiance[3][LANES], passed[3][LANES];
    int32_t number[LANES];
    store_some_ints(number, f->number, LANES);
    for (int c = 0; c < 3; c++) {
        store_some(radiance[c], f->g.radiance[c], LANES);
        store_some(passed[c], f->g.passed[c], LANES);
    }
    for (uint32_t left = bits_of_lanes(ended); left; left &= left - 1) {
        int i = __builtin_ctz(left);
        for (int c = 0; c < 3; c++) {
            j->intervals->radiance[c][number[i]] = radiance[c][i];
            j->intervals->transmittance[c][number[i]] = passed[c][i];
        }
    }
}

static DPL_ALWAYS_INLINE void load_flight(const crowd *c, int32_t at, flight *f, bool media) {
    f->r = (rays){.x = load_some(c->x + at, LANES),
                  .y = load_some(c->y + at, LANES),
                  .dx = load_some(c->dx + at, LANES),
                  .dy = load_some(c->dy + at, LANES),
                  .length = load_some(c->length + at, LANES)};
    f->inverse_x = load_some(c->inverse_x + at, LANES);
    f->inverse_y = load_some(c->inverse_y + at, LANES);
    f->w.t = load_some(c->t + at, LANES);
    f->w.x = load_some_ints(c->column + at, LANES);
    f->w.y = load_some_ints(c->row + at, LANES);
    f->number = load_some_ints(c->number + at, LANES);
    for (int k = 0; media && k < 3; k++) {
        f->g.radiance[k] = load_some(c->radiance[k] + at, LANES);
        f->g.passed[k] = load_some(c->passed[k] + at, LANES);
    }
}

static DPL_ALWAYS_INLINE void keep_flight(crowd *c, const flight *f, bool media) {
    packing p = packing_of(f->w.active);
    keep(c, &p, &f->r, &f->w, f->number);
    pack_floats(&p, c->inverse_x + c->count, f->inverse_x);
    pack_floats(&p, c->inverse_y + c->count, f->inverse_y);
    for (int k = 0; media && k < 3; k++) {
        pack_floats(&p, c->radiance[k] + c->count, f->g.radiance[k]);
        pack_floats(&p, c->passed[k] + c->count, f->g.passed[k]);
    }
    c->count += p.count;
}

/* In media two pixels: there is more to pack. */
static DPL_ALWAYS_INLINE void fly_round(journey *j, bool media) {
    crowd *c = &j->flying;
    int32_t count = c->count;
    flight f;
    c->count = 0;
    for (int32_t i = 0; i < count; i += LANES) {
        load_flight(c, i, &f, media);
        vlanes began = f.w.active = first_lanes(count - i);
        for (int k = 0; k < (media ? 2 : 1); k++)
            fly_on(j, &f, media);
        if (media)
            leave_light(j, &f, lanes_but(began, f.w.active));
        keep_flight(c, &f, media);
    }
}

/* Until few fly, or nobody. The last vector has nothing to be packed with. */
static DPL_ALWAYS_INLINE void fly_rounds(journey *j, bool media, bool all) {
    crowd *c = &j->flying;
    flight f;
    /* The same twice, for the processor. Small crowds are read right behind where they are written, and a
     * load that has once met a store that was still under way is made to wait for all stores for a while. */
    while (LANES > 4 && c->count > FEW)
        fly_round(j, media);
    while (c->count > (all ? LANES : FEW))
        fly_round(j, media);
    if (!all || c->count == 0)
        return;
    load_flight(c, 0, &f, media);
    vlanes began = f.w.active = first_lanes(c->count);
    do {
        fly_on(j, &f, media);
    } while (any_lane(f.w.active));
    c->count = 0;
    if (media)
        leave_light(j, &f, began);
}

/* Rays first .. end-1 join those that fly, until few do, or nobody. Both together are at most PIECE. */
static void fly(journey *j, int32_t first, int32_t end, bool all) {
    crowd *c = &j->flying;
    int32_t before = c->count / LANES * LANES;
    take_off(j, first, end);
    for (int32_t i = before; i < c->count; i += LANES) {
        store_some(c->inverse_x + i, inverse_or_never(load_some(c->dx + i, LANES)), LANES);
        store_some(c->inverse_y + i, inverse_or_never(load_some(c->dy + i, LANES)), LANES);
        for (int k = 0; j->intervals && k < 3; k++) {
            store_some(c->radiance[k] + i, all_float(0.0f), LANES);
            store_some(c->passed[k] + i, all_float(1.0f), LANES);
        }
    }
    if (j->intervals)
        fly_rounds(j, true, true);
    else
        fly_rounds(j, false, all);
}

static inline int32_t piece_of(const dpl_segments *s, int32_t first, dpl_segments *piece) {
    int32_t count = s->count - first < PIECE ? s->count - first : PIECE;
    *piece = (dpl_segments){count, s->x0 + first, s->y0 + first, s->x1 + first, s->y1 + first};
    return count;
}

static inline void fill_floats(float *out, float value, int32_t count) {
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES)
        store_some(out + i, all_float(value), LANES);
    for (; i < count; i++)
        out[i] = value;
}

/* Rays that end at an opaque pixel see it behind what they have gathered. */
static inline void see_hits(const journey *j, const dpl_intervals *out) {
    for (int32_t i = 0; i < j->hits; i++) {
        const float *emission = j->grid->emission[j->cell[i]];
        for (int c = 0; c < 3; c++) {
            float *radiance = &out->radiance[c][j->number[i]], *passed = &out->transmittance[c][j->number[i]];
            *radiance += *passed * emission[c];
            *passed = 0.0f;
        }
    }
}

static void march(const dpl_grid *grid, const dpl_segments *segments, const dpl_intervals *intervals) {
    dpl_segments piece;
    dpl_intervals out;
    journey j;
    j.grid = grid;
    j.segments = &piece;
    j.intervals = grid->extinction ? &out : NULL;
    for (int32_t first = 0; first < segments->count; first += PIECE) {
        int32_t count = piece_of(segments, first, &piece);
        for (int c = 0; c < 3; c++) {
            out.radiance[c] = intervals->radiance[c] + first;
            out.transmittance[c] = intervals->transmittance[c] + first;
            fill_floats(out.radiance[c], 0.0f, count);
            fill_floats(out.transmittance[c], 1.0f, count);
        }
        j.hits = j.flying.count = 0;
        fly(&j, 0, count, true);
        see_hits(&j, &out);
    }
}

/* ---- march_to_cell -------------------------------------------------------------------------------- */

static void march_to_cell(const dpl_grid *grid, const dpl_segments *segments, int32_t *cell) {
    int32_t count = segments->count;
    journey j;
    j.grid = grid;
    j.segments = segments;
    j.intervals = NULL;
    j.flying.count = 0;
    memset(cell, -1, (size_t)count * sizeof *cell);
    for (int32_t first = 0, end; first < count; first = end) {
        int32_t room = (PIECE - j.flying.count) / LANES * LANES;
        end = count - first < room ? count : first + room;
        j.hits = 0;
        fly(&j, first, end, end == count);
        for (int32_t i = 0; i < j.hits; i++)
            cell[j.number[i]] = j.cell[i];
    }
}

#endif
