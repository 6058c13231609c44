/* Tile worlds for tests: a generator of random edits, reading all levels, and light worked out slowly from
 * the definition alone. Used by test_flood*.c. */
#ifndef DPL_TEST_FLOOD_WORLD_H
#define DPL_TEST_FLOOD_WORLD_H

#include "shared_context.h"

#include <dapple/flood.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static inline uint32_t random_below(uint64_t *state, uint32_t end) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 33) % end);
}

static inline dpl_flood_desc world_desc(dpl_flood *flood) {
    dpl_flood_desc desc;
    assert_ok(dpl_flood_read_desc(flood, &desc));
    return desc;
}

static inline dpl_flood_box whole_world(const dpl_flood_desc *desc) {
    return (dpl_flood_box){0, 0, 0, desc->width, desc->height, desc->depth};
}

static inline size_t world_cells(const dpl_flood_desc *desc) {
    return (size_t)desc->width * (size_t)desc->height * (size_t)desc->depth;
}

/* All levels, shape [depth][height][width][channels]; malloc'ed. */
static inline uint16_t *read_world(dpl_flood *flood) {
    dpl_flood_desc desc = world_desc(flood);
    dpl_flood_box box = whole_world(&desc);
    uint16_t *levels = malloc(world_cells(&desc) * (size_t)desc.channels * sizeof *levels);
    assert_non_null(levels);
    assert_ok(dpl_flood_read_levels(flood, &box, levels, 0, 0));
    return levels;
}

static inline uint16_t level_at(dpl_flood *flood, int32_t x, int32_t y, int32_t z) {
    uint16_t levels[DPL_FLOOD_MAX_CHANNELS];
    dpl_flood_box box = {x, y, z, 1, 1, 1};
    assert_ok(dpl_flood_read_levels(flood, &box, levels, 0, 0));
    return levels[0];
}

/* ---- light from the definition -------------------------------------------------------------------- */

/* One channel of a small world as plain arrays: cells[z][y][x] with 1 around, which nothing enters. */
typedef struct slow_world {
    dpl_flood_desc desc;
    int channel;
    uint8_t *cells;
    uint16_t *sources; /* lights and sun, same shape as levels */
    uint16_t *levels;
} slow_world;

static inline int32_t slow_attenuation(const slow_world *w, int32_t x, int32_t y, int32_t z) {
    const dpl_flood_desc *d = &w->desc;
    if (x < 0 || y < 0 || z < 0 || x >= d->width || y >= d->height || z >= d->depth)
        return DPL_FLOOD_OPAQUE;
    return d->materials[w->cells[((size_t)z * (size_t)d->height + (size_t)y) * (size_t)d->width + (size_t)x]]
        .attenuation[w->channel];
}

static inline int32_t slow_least(int32_t a, int32_t b) {
    return a < b ? a : b;
}

static inline int32_t slow_most(int32_t a, int32_t b) {
    return a > b ? a : b;
}

/* The greatest attenuation that a diagonal step cannot avoid beside itself. */
static inline int32_t slow_beside(const slow_world *w, const int32_t at[3], const int32_t d[3]) {
    int32_t best = DPL_FLOOD_OPAQUE;
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int o = 0; o < 6; o++) {
        int32_t p[3] = {at[0], at[1], at[2]}, worst = 0;
        int left = (d[0] != 0) + (d[1] != 0) + (d[2] != 0);
        for (int i = 0; i < 3; i++) {
            if (d[order[o][i]] == 0)
                continue;
            p[order[o][i]] += d[order[o][i]];
            if (--left > 0)
                worst = slow_most(worst, slow_attenuation(w, p[0], p[1], p[2]));
        }
        best = slow_least(best, worst);
    }
    return best;
}

static inline int32_t slow_step(const slow_world *w, int32_t light, const int32_t at[3], const int32_t d[3]) {
    int32_t a = slow_attenuation(w, at[0] + d[0], at[1] + d[1], at[2] + d[2]);
    int axes = (d[0] != 0) + (d[1] != 0) + (d[2] != 0);
    if (axes > 1)
        a = slow_most(a, slow_beside(w, at, d));
    if (a == DPL_FLOOD_OPAQUE)
        return 0;
    if (w->desc.falloff == DPL_FLOOD_ROUND && axes > 1)
        return (int32_t)(light *
                         (int64_t)(32768 * pow(w->desc.keep * (32768.0 - a) / 32768 / 32768, sqrt(axes))) /
                         32768);
    if (w->desc.falloff == DPL_FLOOD_MULTIPLICATIVE || w->desc.falloff == DPL_FLOOD_ROUND)
        return (int32_t)((int64_t)light * ((int64_t)w->desc.keep * (32768 - a) / 32768) / 32768);
    return slow_most(0, light - (int32_t)floor(sqrt(axes) * (w->desc.step + a) + 0.5));
}

static inline bool slow_sweep(slow_world *w) {
    const dpl_flood_desc *d = &w->desc;
    bool changed = false;
    int most = d->falloff >= DPL_FLOOD_EUCLIDEAN ? 3 : 1;
    for (int32_t z = 0; z < d->depth; z++)
        for (int32_t y = 0; y < d->height; y++)
            for (int32_t x = 0; x < d->width; x++)
                for (int32_t i = 0; i < 27; i++) {
                    const int32_t at[3] = {x, y, z}, m[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
                    int32_t to[3] = {x + m[0], y + m[1], z + m[2]};
                    int axes = (m[0] != 0) + (m[1] != 0) + (m[2] != 0);
                    if (axes < 1 || axes > most ||
                        slow_attenuation(w, to[0], to[1], to[2]) == DPL_FLOOD_OPAQUE)
                        continue;
                    size_t row = (size_t)d->width, slice = row * (size_t)d->height;
                    size_t from = (size_t)z * slice + (size_t)y * row + (size_t)x;
                    size_t n = (size_t)to[2] * slice + (size_t)to[1] * row + (size_t)to[0];
                    int32_t light = slow_step(w, w->levels[from], at, m);
                    if (light > w->levels[n]) {
                        w->levels[n] = (uint16_t)light;
                        changed = true;
                    }
                }
    return changed;
}

/* Until nothing changes. */
static inline void slow_solve(slow_world *w) {
    memcpy(w->levels, w->sources, world_cells(&w->desc) * sizeof *w->levels);
    while (slow_sweep(w)) {
    }
}

#endif
