/* Filling light in: the hot loop. Called by update.c, retract.c and sun.c's sweep.
 *
 * One word holds all channels of a cell, so a neighbour costs one load and one comparison however many
 * channels there are. Each falloff has its own copy of the loop, with its constants folded in. */
#include "flood/flood.h"
#include "kernel/hints.h"

#include <string.h>

/* Raises the lanes of a cell that `light` exceeds; there must be one. */
static void raise_lanes(dpl_flood *flood, uint32_t cell, uint64_t now, uint64_t light) {
    uint64_t risen = light & ~dpl_lanes_mask(dpl_lanes_at_least(now, light));
    uint64_t marks = now & DPL_LANES_GUARDS;
    uint64_t levels = dpl_lanes_max(now & DPL_LANES_LEVELS, light);
    if (flood->tracking && !(now & DPL_MARK_RETRACTED))
        dpl_flood_widen_box(flood, cell);
    if (dpl_lanes_at_least(risen, flood->least)) {
        dpl_flood_queue_push(&flood->queue, cell, dpl_lanes_greatest(risen));
        marks |= DPL_MARK_QUEUED;
    }
    flood->levels[cell] = levels | marks;
}

static DPL_ALWAYS_INLINE bool exceeds(uint64_t light, uint64_t now) {
    return dpl_lanes_at_least(now, light) != DPL_LANES_GUARDS;
}

void dpl_flood_offer(dpl_flood *flood, uint32_t cell, uint64_t light) {
    uint64_t now = flood->levels[cell];
    if (exceeds(light, now))
        raise_lanes(flood, cell, now, light);
}

/* Light on its way into air, and what is known of it before any neighbour is looked at. */
typedef struct ray {
    uint64_t light;
    int32_t bucket; /* of its brightest lane; -1: too weak to go on from there */
} ray;

static DPL_ALWAYS_INLINE ray ray_of(const dpl_flood *flood, uint64_t light) {
    bool goes_on = dpl_lanes_at_least(light, flood->least) != 0;
    return (ray){light, goes_on ? (int32_t)(dpl_lanes_greatest(light) >> flood->queue.shift) : -1};
}

/* ---- one cell ------------------------------------------------------------------------------------- */

/* What cells that are visited one after the other have in common: mostly their light. */
typedef struct pen {
    uint64_t light;
    ray air[3];           /* of that light, after a step along one, two and three axes */
    ptrdiff_t row, slice; /* to the next */
} pen;

/* Which of the loops below: constants where they are called, so that each kind of world has its own copy. */
typedef struct kind {
    dpl_flood_falloff falloff;
    bool deep;
} kind;

static DPL_ALWAYS_INLINE int axes_of(kind k) {
    return !dpl_falloff_is_round(k.falloff) ? 1 : k.deep ? 3 : 2;
}

static DPL_ALWAYS_INLINE uint64_t after(kind k, uint64_t light, uint64_t cost) {
    return dpl_falloff_is_multiplicative(k.falloff) ? dpl_lanes_times(light, cost)
                                                    : dpl_lanes_minus(light, cost);
}

static DPL_ALWAYS_INLINE void dip(const dpl_flood *flood, kind k, pen *p, uint64_t light) {
    p->light = light;
    for (int axes = 0; axes < axes_of(k); axes++)
        p->air[axes] = ray_of(flood, after(k, light, flood->cost[axes][0]));
}

static DPL_ALWAYS_INLINE pen pen_of(const dpl_flood *flood, kind k) {
    pen p = {.row = (ptrdiff_t)flood->stride[1], .slice = (ptrdiff_t)flood->stride[2]};
    dip(flood, k, &p, 0);
    return p;
}

/* Into a cell that air would make brighter: is it air? Most often it is, and dark, and there is nothing to
 * compare lane by lane. */
static DPL_ALWAYS_INLINE void enter(dpl_flood *flood, kind k, uint32_t cell, uint64_t now, uint64_t light,
                                    ray air) {
    if (now & DPL_MARK_SOLID) {
        uint64_t left = after(k, light, flood->cost[0][flood->cells[cell] & DPL_CELL_MATERIAL]);
        if (exceeds(left, now))
            raise_lanes(flood, cell, now, left);
    } else if (now != 0 || flood->tracking) {
        raise_lanes(flood, cell, now, air.light);
    } else if (air.bucket < 0) {
        flood->levels[cell] = air.light;
    } else {
        flood->levels[cell] = air.light | DPL_MARK_QUEUED;
        dpl_flood_queue_push_bucket(&flood->queue, cell, air.bucket);
    }
}

/* Two neighbours on opposite sides. No cell takes less than air: one that is bright enough for that need not
 * be asked what it is. */
static DPL_ALWAYS_INLINE void visit_sides(dpl_flood *flood, kind k, const pen *p, uint32_t cell,
                                          ptrdiff_t offset) {
    const uint64_t *level = flood->levels + cell;
    uint64_t before = level[-offset], behind = level[offset];
    ptrdiff_t beyond = 2 * offset * (ptrdiff_t)sizeof *level; /* where the wave goes from that neighbour */
    if (exceeds(p->air[0].light, before)) {
        dpl_prefetch(level, -beyond);
        enter(flood, k, cell - (uint32_t)offset, before, p->light, p->air[0]);
    }
    if (exceeds(p->air[0].light, behind)) {
        dpl_prefetch(level, beyond);
        enter(flood, k, cell + (uint32_t)offset, behind, p->light, p->air[0]);
    }
}

static DPL_ALWAYS_INLINE void visit_axes(dpl_flood *flood, kind k, const pen *p, uint32_t cell) {
    visit_sides(flood, k, p, cell, 1);
    visit_sides(flood, k, p, cell, p->row);
    if (k.deep)
        visit_sides(flood, k, p, cell, p->slice);
}

/* Three cells of a row are air. */
static inline bool row_is_air(const uint8_t *cells) {
    static const uint8_t three[4] = {DPL_CELL_MATERIAL, DPL_CELL_MATERIAL, DPL_CELL_MATERIAL, 0};
    uint32_t row, mask;
    memcpy(&row, cells, sizeof row);
    memcpy(&mask, three, sizeof mask);
    return (row & mask) == 0;
}

static DPL_ALWAYS_INLINE bool all_around_is_air(const dpl_flood *flood, uint32_t cell, bool deep) {
    const uint8_t *cells = flood->cells + cell - 1;
    for (int z = deep ? -1 : 0; z <= (deep ? 1 : 0); z++)
        for (int y = -1; y <= 1; y++)
            if (!row_is_air(cells + y * (ptrdiff_t)flood->stride[1] + z * (ptrdiff_t)flood->stride[2]))
                return false;
    return true;
}

static DPL_ALWAYS_INLINE void visit_round(dpl_flood *flood, kind k, const pen *p, uint32_t cell) {
    const int ends[3] = {k.deep ? 6 : 4, k.deep ? 18 : 8, 26};
    bool open = all_around_is_air(flood, cell, k.deep);
    for (int axes = 0, i = 0; axes < axes_of(k); axes++)
        for (; i < ends[axes]; i++) {
            uint32_t to = cell + flood->moves[i].offset;
            uint64_t now = flood->levels[to];
            if (!exceeds(p->air[axes].light, now))
                continue;
            if (open)
                enter(flood, k, to, now, p->light, p->air[axes]);
            else
                dpl_flood_offer(flood, to,
                                after(k, p->light, dpl_flood_move_cost(flood, cell, &flood->moves[i])));
        }
}

static DPL_ALWAYS_INLINE void visit(dpl_flood *flood, kind k, pen *p, uint32_t cell, uint64_t light) {
    if (light != p->light)
        dip(flood, k, p, light);
    if (dpl_falloff_is_round(k.falloff))
        visit_round(flood, k, p, cell);
    else
        visit_axes(flood, k, p, cell);
}

/* ---- all of them ---------------------------------------------------------------------------------- */

/* A cell may be queued twice, when it rose again before its turn; its mark is gone by the second time. */
static DPL_ALWAYS_INLINE void drain_chunk(dpl_flood *flood, kind k, pen *p, const dpl_flood_chunk *chunk) {
    uint32_t visits = 0, count = chunk->count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t cell = chunk->cells[i];
        uint64_t now = flood->levels[cell];
        if (!(now & DPL_MARK_QUEUED))
            continue;
        flood->levels[cell] = now & ~DPL_MARK_QUEUED;
        visits++;
        visit(flood, k, p, cell, now & DPL_LANES_LEVELS);
    }
    flood->stats.visits += visits;
    flood->stats.pushes += count;
}

/* Bucket by bucket, the brightest first. Only after a lost push can a cell that is found again later make a
 * bucket above the present one. */
static DPL_ALWAYS_INLINE void drain_kind(dpl_flood *flood, kind k) {
    dpl_flood_queue *queue = &flood->queue;
    pen p = pen_of(flood, k);
    while (queue->brightest >= 0) {
        uint32_t chunk = dpl_flood_queue_take(queue, queue->brightest);
        if (chunk == DPL_NO_CHUNK)
            queue->brightest--;
        while (chunk != DPL_NO_CHUNK) {
            drain_chunk(flood, k, &p, &queue->chunks[chunk]);
            chunk = dpl_flood_queue_release(queue, chunk);
        }
    }
}

/* The two ways to call the loops, per kind of world. */
#define KINDS(X)                                                                                             \
    X(flat, DPL_FLOOD_SUBTRACTIVE, false)                                                                    \
    X(deep, DPL_FLOOD_SUBTRACTIVE, true)                                                                     \
    X(flat_times, DPL_FLOOD_MULTIPLICATIVE, false)                                                           \
    X(deep_times, DPL_FLOOD_MULTIPLICATIVE, true)                                                            \
    X(flat_round, DPL_FLOOD_EUCLIDEAN, false)                                                                \
    X(deep_round, DPL_FLOOD_EUCLIDEAN, true)                                                                 \
    X(flat_round_times, DPL_FLOOD_ROUND, false)                                                              \
    X(deep_round_times, DPL_FLOOD_ROUND, true)

#define DEFINE_KIND(name, falloff, deep)                                                                     \
    static void drain_##name(dpl_flood *flood) {                                                             \
        drain_kind(flood, (kind){falloff, deep});                                                            \
    }                                                                                                        \
    static void visit_##name(dpl_flood *flood, uint32_t cell) {                                              \
        pen p = pen_of(flood, (kind){falloff, deep});                                                        \
        visit(flood, (kind){falloff, deep}, &p, cell, flood->levels[cell] & DPL_LANES_LEVELS);               \
    }
KINDS(DEFINE_KIND)

#define ENTRY(name, falloff, deep) [falloff][deep] = {drain_##name, visit_##name},
static const struct {
    void (*drain)(dpl_flood *flood);
    void (*visit)(dpl_flood *flood, uint32_t cell);
} kinds[4][2] = {KINDS(ENTRY)};

void dpl_flood_visit(dpl_flood *flood, uint32_t cell) {
    flood->stats.visits++;
    kinds[flood->desc.falloff][dpl_flood_is_deep(flood)].visit(flood, cell);
}

/* Queues cells whose push found no room. */
static void find_lost(dpl_flood *flood) {
    flood->queue.lost = false;
    for (uint32_t cell = 0; cell < flood->padded && !flood->queue.lost; cell++) {
        uint64_t now = flood->levels[cell];
        if (now & DPL_MARK_QUEUED)
            dpl_flood_queue_push(&flood->queue, cell, dpl_lanes_greatest(now & DPL_LANES_LEVELS));
    }
}

void dpl_flood_drain(dpl_flood *flood) {
    void (*drain)(dpl_flood *) = kinds[flood->desc.falloff][dpl_flood_is_deep(flood)].drain;
    drain(flood);
    while (flood->queue.lost) {
        find_lost(flood);
        drain(flood);
    }
}
