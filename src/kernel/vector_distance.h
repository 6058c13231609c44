/* The kernel `distance_along` in vectors. Included by vector.c. Equal to distance_ref.c to the bit, by
 * another way: whole squared distances come out of both, and any way to the least of them will do.
 *
 * SPAN neighbouring pixels at a time look along their row for a column whose squared distance, plus the
 * square of how far it is along, is less than what they have, nearest first. `limit`, which the squared
 * distances of the span cannot exceed, ends the search: distances grow by at most 1 from one row to the next,
 * so the row above gives a good one before anything was looked at. Further away whole groups of columns are
 * skipped by the least that is in them. Where that is much work (far from everything) the envelope does it.
 * docs/algorithms/distance-transform.md has the proof. */
#ifndef DPL_KERNEL_VECTOR_DISTANCE_H
#define DPL_KERNEL_VECTOR_DISTANCE_H

#include "kernel/distance_ref.h"
#include "kernel/simd.h"

#include <math.h>

enum {
    SPAN = 16,                       /* pixels that are looked for together */
    SPAN_VECTORS = SPAN / LANES,     /* of them */
    GROUP = 8,                       /* neighbouring offsets that are tried or skipped together */
    WINDOW = (SPAN + GROUP) / GROUP, /* blocks of GROUP columns that a span meets at a group's offsets */
    SPAN_PAD = 24,                   /* at both ends of rows, of what is further than anything */
    MOST_WORK = 4,                   /* per span, mean of a row: beyond, the envelope is faster */
    ENVELOPE_ROWS = 8                /* from one that was too much work to the next look */
};

#define SPAN_NOWHERE_BYTE 0x7f
#define SPAN_NOWHERE 3.3961514e38f /* 0x7f7f7f7f */

/* Squares are floats; below this all of them are whole numbers. */
#define SPAN_EXACT 16777216.0f

/* A row while it is worked on. */
typedef struct span_row {
    int32_t wide;   /* the width, filled up to spans */
    int32_t blocks; /* of GROUP columns */
    float *square;  /* of each column's distance */
    float *least;   /* per block; held once it is needed, as are the next */
    float *right;   /* least of WINDOW blocks from this one on */
    float *left;    /* the same, last first */
    float *found;   /* squared distances */
    bool has_windows;
    int32_t work; /* that is left */
} span_row;

static inline float span_greatest(const vfloat v[SPAN_VECTORS]) {
    vfloat most = v[0];
    for (int i = 1; i < SPAN_VECTORS; i++)
        most = greatest(most, v[i]);
    return greatest_lane(most);
}

/* Further than anything; every byte is the same. */
static inline void span_fill(float *to, int32_t count) {
    memset(to, SPAN_NOWHERE_BYTE, (size_t)count * sizeof *to);
}

static void span_row_open(span_row *r, const dpl_distance_rows *rows, const int32_t *run, void *scratch) {
    int32_t width = rows->width;
    r->wide = (width + SPAN - 1) / SPAN * SPAN;
    r->blocks = r->wide / GROUP;
    r->square = (float *)scratch + SPAN_PAD;
    r->least = r->square + r->wide + SPAN_PAD + WINDOW;
    r->right = r->least + r->blocks + WINDOW + SPAN_PAD;
    r->left = r->right + r->blocks + 2 * SPAN_PAD;
    r->found = r->left + r->blocks + SPAN_PAD;
    r->has_windows = false;
    r->work = MOST_WORK * r->wide / SPAN;
    vfloat most = to_float(all_int(rows->nowhere));
    int32_t x = 0;
    for (; x + LANES <= width; x += LANES) {
        vfloat known = least(to_float(load_ints(run + x)), most);
        store_some(r->square + x, known * known, LANES);
    }
    for (; x < width; x++) {
        float known = (float)(run[x] < rows->nowhere ? run[x] : rows->nowhere);
        r->square[x] = known * known;
    }
    span_fill(r->square - SPAN_PAD, SPAN_PAD);
    span_fill(r->square + width, r->wide - width + SPAN_PAD);
}

static void span_row_find_windows(span_row *r) {
    span_fill(r->least - WINDOW, (int32_t)(r->found - r->least) + WINDOW); /* pads of all three */
    for (int32_t b = 0; b < r->blocks; b++) {
        const float *in = r->square + b * GROUP;
        float lowest = in[0];
        for (int i = 1; i < GROUP; i++)
            lowest = in[i] < lowest ? in[i] : lowest;
        r->least[b] = lowest;
    }
    for (int32_t b = 1 - WINDOW; b < r->blocks; b++) {
        float lowest = r->least[b];
        for (int i = 1; i < WINDOW; i++)
            lowest = r->least[b + i] < lowest ? r->least[b + i] : lowest;
        r->right[b] = r->left[r->blocks - 1 - b] = lowest;
    }
    r->has_windows = true;
}

/* What the columns `offset` away, which begin at `from`, put up over the span. */
static inline void span_try(const float *from, float offset, vfloat nearest[SPAN_VECTORS]) {
    for (int v = 0; v < SPAN_VECTORS; v++)
        nearest[v] = least(nearest[v], load_some(from + v * LANES, LANES) + all_float(offset * offset));
}

/* Groups of a vector of lower bounds, given as bits: number `first` and on, to the right (1) or left (-1). */
static inline void span_try_groups(const float *at, uint32_t bits, int32_t first, int32_t side,
                                   vfloat nearest[SPAN_VECTORS]) {
    for (; bits; bits &= bits - 1) {
        int32_t offset = GROUP * (first + __builtin_ctz(bits));
        for (int32_t i = offset; i < offset + GROUP; i++)
            span_try(at + side * i, (float)i, nearest);
    }
}

/* Offsets from GROUP on. Returns the limit that is reached, or SPAN_EXACT when it is too much work. */
static float span_look_far(span_row *r, int32_t x, float limit, vfloat nearest[SPAN_VECTORS]) {
    if (!r->has_windows)
        span_row_find_windows(r);
    const float *at = r->square + x;
    int32_t block = x / GROUP;
    for (int32_t k = 1; (float)(GROUP * k) * (float)(GROUP * k) < limit; k += LANES) {
        /* group k meets blocks block + k and on to the right, block - k - 1 and on to the left */
        vfloat along = to_float(GROUP * (k + lane_numbers())), right = all_float(SPAN_NOWHERE), left = right;
        if (block + k < r->blocks)
            right = load_some(r->right + block + k, LANES);
        if (block - k - 1 > -WINDOW)
            left = load_some(r->left + r->blocks - block + k, LANES);
        uint32_t on_right = lane_bits(along * along + right < limit);
        uint32_t on_left = lane_bits(along * along + left < limit);
        r->work -= 1 + 2 * (__builtin_popcount(on_right) + __builtin_popcount(on_left));
        if (r->work < 0)
            return SPAN_EXACT;
        if (!(on_right | on_left))
            continue;
        span_try_groups(at, on_right, k, 1, nearest);
        span_try_groups(at, on_left, k, -1, nearest);
        float most = span_greatest(nearest);
        limit = most < limit ? most : limit;
    }
    return limit;
}

/* Finds the squared distances of the span at x. `above` are its clearances in the row above, NULL where the
 * span is not whole. */
static inline bool span_look(span_row *r, int32_t x, const float *above, vfloat nearest[SPAN_VECTORS]) {
    const float *at = r->square + x;
    vfloat bound[SPAN_VECTORS];
    for (int v = 0; v < SPAN_VECTORS; v++) {
        bound[v] = nearest[v] = load_some(at + v * LANES, LANES);
        if (above) {
            /* more than 1, as the one above is rounded */
            vfloat further = greatest(load_some(above + v * LANES, LANES), all_float(0.0f)) + 1.001f;
            bound[v] = least(bound[v], further * further);
        }
    }
    float limit = span_greatest(bound);
    for (int32_t i = 1; i < GROUP && (float)(i * i) < limit; i++) {
        span_try(at + i, (float)i, nearest);
        span_try(at - i, (float)i, nearest);
    }
    if (limit > GROUP * GROUP) {
        float most = span_greatest(nearest);
        limit = span_look_far(r, x, most < limit ? most : limit, nearest);
    }
    return limit < SPAN_EXACT;
}

/* Squared distances of row y, which has one above it, into r->found. Says when it is too much work. */
static bool span_row_look(span_row *r, const dpl_distance_rows *rows, int32_t y, void *scratch) {
    size_t row = (size_t)y * (size_t)rows->width;
    const float *above = rows->clearance + row - rows->width;
    span_row_open(r, rows, rows->runs + row, scratch);
    for (int32_t x = 0; x < r->wide; x += SPAN) {
        vfloat nearest[SPAN_VECTORS];
        if (!span_look(r, x, x + SPAN <= rows->width ? above + x : NULL, nearest))
            return false;
        memcpy(r->found + x, nearest, sizeof nearest);
    }
    return true;
}

/* Clearances of row y from squared distances. */
static void span_row_finish(const dpl_distance_rows *rows, int32_t y, const float *squared) {
    const uint8_t *kind = rows->kind + (size_t)y * (size_t)rows->width;
    float *clearance = rows->clearance + (size_t)y * (size_t)rows->width;
    const vfloat solid = all_float(-1.0f);
    int32_t x = 0;
    for (; x + LANES <= rows->width; x += LANES) {
        vfloat distance = square_root(load_some(squared + x, LANES));
        store_some(clearance + x, select_float(load_bytes(kind + x) == 2, solid, distance), LANES);
    }
    for (; x < rows->width; x++)
        clearance[x] = kind[x] == 2 ? -1.0f : sqrtf(squared[x]);
}

static void distance_along(const dpl_distance_rows *rows, void *scratch) {
    int32_t next_look = 1; /* the first row has none above it */
    for (int32_t y = 0; y < rows->height; y++) {
        span_row r;
        if (y >= next_look && span_row_look(&r, rows, y, scratch)) {
            span_row_finish(rows, y, r.found);
            continue;
        }
        if (y >= next_look)
            next_look = y + ENVELOPE_ROWS;
        dpl_distance_envelope(rows, y, scratch);
        span_row_finish(rows, y, rows->clearance + (size_t)y * (size_t)rows->width);
    }
}

#endif
