/* Probes of a cascade in a row, in vectors: light of their parents, and what their rays bring added up. In
 * lanes what ref.c does in sequence, operation for operation. Included by vector.c alone. */
#ifndef DPL_KERNEL_VECTOR_PROBES_H
#define DPL_KERNEL_VECTOR_PROBES_H

#include "kernel/hints.h"
#include "kernel/probes.h"
#include "kernel/simd.h"

/* Lanes i/2 of a vector, one further where i is odd; the neighbour of each; and lanes i/2. */
#if LANES == 16
#define LEFT_PARENTS(v) __builtin_shufflevector(v, v, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8)
#define RIGHT_PARENTS(v) __builtin_shufflevector(v, v, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9)
#define PAIRS(v) __builtin_shufflevector(v, v, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7)
#elif LANES == 8
#define LEFT_PARENTS(v) __builtin_shufflevector(v, v, 0, 1, 1, 2, 2, 3, 3, 4)
#define RIGHT_PARENTS(v) __builtin_shufflevector(v, v, 1, 2, 2, 3, 3, 4, 4, 5)
#define PAIRS(v) __builtin_shufflevector(v, v, 0, 0, 1, 1, 2, 2, 3, 3)
#else
#define LEFT_PARENTS(v) __builtin_shufflevector(v, v, 0, 1, 1, 2)
#define RIGHT_PARENTS(v) __builtin_shufflevector(v, v, 1, 2, 2, 3)
#define PAIRS(v) __builtin_shufflevector(v, v, 0, 0, 1, 1)
#endif

static inline vfloat load_all(const float *from) {
    return load_some(from, LANES);
}

static inline int32_t at_most(int32_t a, int32_t b) {
    return a < b ? a : b;
}

static inline vfloat even_odd(float even, float odd) {
    return select_float((lane_numbers() & 1) == 0, all_float(even), all_float(odd));
}

static inline vfloat interpolate(vfloat row, vfloat next_row, float between) {
    vfloat v = row + (next_row - row) * between, left = LEFT_PARENTS(v);
    return left + (RIGHT_PARENTS(v) - left) * even_odd(0.75f, 0.25f);
}

static void spread(int32_t count, float *out, const float *row, const float *next_row, float between) {
    int32_t parents = count / 2 + 2;
    for (int32_t i = 0; i < count; i += LANES, row += LANES / 2, next_row += LANES / 2) {
        int32_t there = at_most(parents - i / 2, LANES);
        vfloat v = interpolate(load_some(row, there), load_some(next_row, there), between);
        store_some(out + i, v, at_most(count - i, LANES));
    }
}

/* What LANES probes from number i on see in one channel. */
static DPL_ALWAYS_INLINE vfloat see(dpl_parents parents, dpl_parents_seen seen, int c, int32_t i) {
    ptrdiff_t place = c * parents.plane + (seen == DPL_PARENT_SAME ? 0 : i / 2);
    const float *row = parents.row + place;
    switch (seen) {
    case DPL_PARENTS_FOUR:
        return interpolate(load_all(row), load_all(parents.next_row + place), parents.between);
    case DPL_PARENT_LEFT:
        return LEFT_PARENTS(load_all(row));
    case DPL_PARENT_NEAREST:
        return PAIRS(load_all(row + 1));
    default:
        return all_float(*row);
    }
}

/* Lanes of probes from number i on that let light through: whose bit is not set. */
static inline vint open_lanes(const uint64_t *hits, int32_t i) {
    return (all_int((int32_t)(hits[i / 64] >> i % 64)) >> lane_numbers() & 1) == 0;
}

/* Adds the light of n probes from number i on. By value is faster: floats that are stored might be those of a
 * struct. */
static DPL_ALWAYS_INLINE void add_some(dpl_probe_sums sums, dpl_parents parents, dpl_parents_seen seen,
                                       const dpl_intervals *intervals, const uint64_t *hits, int32_t i,
                                       int32_t n) {
    vfloat weights = even_odd(sums.weight[0], sums.weight[1]);
    vint open = intervals ? all_int(0) : open_lanes(hits, i);
    for (int c = 0; c < 3; c++) {
        vfloat light = see(parents, seen, c, i);
        if (intervals)
            light = load_some(intervals->radiance[c] + i, n) +
                    load_some(intervals->transmittance[c] + i, n) * light;
        else
            light = (vfloat)(open & (vint)light);
        store_some(sums.sum[c] + i, load_some(sums.sum[c] + i, n) + weights * light, n);
    }
}

static DPL_ALWAYS_INLINE void add_light(const dpl_probe_sums *sums, const dpl_parents *parents,
                                        dpl_parents_seen seen, const dpl_intervals *intervals,
                                        const uint64_t *hits) {
    const dpl_probe_sums own = *sums;
    const dpl_parents above = *parents;
    for (int32_t i = 0; i < own.count; i += LANES)
        add_some(own, above, seen, intervals, hits, i, at_most(own.count - i, LANES));
}

/* One loop for each way to see parents; in a WebAssembly module, whose size counts, one for all. */
static DPL_ALWAYS_INLINE void add_any(const dpl_probe_sums *sums, const dpl_parents *parents,
                                      const dpl_intervals *intervals, const uint64_t *hits) {
#if defined(__wasm__)
    add_light(sums, parents, parents->seen, intervals, hits);
#else
    switch (parents->seen) {
    case DPL_PARENTS_FOUR:
        add_light(sums, parents, DPL_PARENTS_FOUR, intervals, hits);
        break;
    case DPL_PARENT_LEFT:
        add_light(sums, parents, DPL_PARENT_LEFT, intervals, hits);
        break;
    case DPL_PARENT_NEAREST:
        add_light(sums, parents, DPL_PARENT_NEAREST, intervals, hits);
        break;
    case DPL_PARENT_SAME:
        add_light(sums, parents, DPL_PARENT_SAME, intervals, hits);
        break;
    }
#endif
}

static void merge(const dpl_probe_sums *sums, const dpl_parents *parents, const dpl_intervals *intervals) {
    add_any(sums, parents, intervals, NULL);
}

static void merge_hits(const dpl_probe_sums *sums, const dpl_parents *parents, const uint64_t *hits) {
    add_any(sums, parents, NULL, hits);
}

#endif
