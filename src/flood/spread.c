/* Filling light in: the hot loop. Called by update.c, retract.c and sun.c's sweep.
 *
 * One word holds all channels of a cell, so a neighbour costs one load and one comparison however many
 * channels there are. Each falloff has its own copy of the loop, with its constants folded in. */
#include "flood/flood.h"

#include <string.h>

/* Raises the lanes of a cell that `light` exceeds; there must be one. */
static inline void raise(dpl_flood *flood, uint32_t cell, uint64_t now, uint64_t light) {
    uint64_t risen = light & ~dpl_lanes_mask(dpl_lanes_at_least(now, light));
    uint64_t marks = now & DPL_LANES_GUARDS;
    uint64_t levels = dpl_lanes_max(now & DPL_LANES_LEVELS, light);
    if (flood->tracking && !(now & DPL_MARK_RETRACTED))
        dpl_flood_widen_box(flood, cell);
    if (dpl_lanes_at_least(risen, flood->least)) {
        flood->stats.pushes += dpl_flood_queue_push(&flood->queue, cell, dpl_lanes_greatest(risen));
        marks |= DPL_MARK_QUEUED;
    }
    flood->levels[cell] = levels | marks;
}

static inline void offer(dpl_flood *flood, uint32_t cell, uint64_t light) {
    uint64_t now = flood->levels[cell];
    if (dpl_lanes_at_least(now, light) != DPL_LANES_GUARDS)
        raise(flood, cell, now, light);
}

void dpl_flood_offer(dpl_flood *flood, uint32_t cell, uint64_t light) {
    offer(flood, cell, light);
}

/* ---- one cell ------------------------------------------------------------------------------------- */

static inline void visit_axes(dpl_flood *flood, uint32_t cell, int neighbours, bool multiplicative) {
    uint64_t light = flood->levels[cell] & DPL_LANES_LEVELS;
    for (int i = 0; i < neighbours; i++) {
        uint32_t to = cell + flood->moves[i].offset;
        uint64_t cost = flood->cost[0][flood->cells[to] & DPL_CELL_MATERIAL];
        offer(flood, to, multiplicative ? dpl_lanes_times(light, cost) : dpl_lanes_minus(light, cost));
    }
}

static void visit_flat(dpl_flood *flood, uint32_t cell) {
    visit_axes(flood, cell, 4, false);
}

static void visit_deep(dpl_flood *flood, uint32_t cell) {
    visit_axes(flood, cell, 6, false);
}

static void visit_flat_times(dpl_flood *flood, uint32_t cell) {
    visit_axes(flood, cell, 4, true);
}

static void visit_deep_times(dpl_flood *flood, uint32_t cell) {
    visit_axes(flood, cell, 6, true);
}

/* Three cells of a row are air. */
static inline bool row_is_air(const uint8_t *cells) {
    static const uint8_t three[4] = {DPL_CELL_MATERIAL, DPL_CELL_MATERIAL, DPL_CELL_MATERIAL, 0};
    uint32_t row, mask;
    memcpy(&row, cells, sizeof row);
    memcpy(&mask, three, sizeof mask);
    return (row & mask) == 0;
}

static inline bool all_around_is_air(const dpl_flood *flood, uint32_t cell, bool deep) {
    const uint8_t *cells = flood->cells + cell - 1;
    for (int z = deep ? -1 : 0; z <= (deep ? 1 : 0); z++)
        for (int y = -1; y <= 1; y++)
            if (!row_is_air(cells + y * (ptrdiff_t)flood->stride[1] + z * (ptrdiff_t)flood->stride[2]))
                return false;
    return true;
}

static inline void visit_round(dpl_flood *flood, uint32_t cell, bool deep) {
    uint64_t light = flood->levels[cell] & DPL_LANES_LEVELS;
    const dpl_flood_move *moves = flood->moves;
    int count = deep ? 26 : 8;
    if (!all_around_is_air(flood, cell, deep)) {
        for (int i = 0; i < count; i++)
            offer(flood, cell + moves[i].offset,
                  dpl_lanes_minus(light, dpl_flood_move_cost(flood, cell, &moves[i])));
        return;
    }
    const int ends[3] = {deep ? 6 : 4, deep ? 18 : 8, count};
    for (int axes = 0, i = 0; i < count; axes++) {
        uint64_t left = dpl_lanes_minus(light, flood->cost[axes][0]);
        for (; i < ends[axes]; i++)
            offer(flood, cell + moves[i].offset, left);
    }
}

static void visit_round_flat(dpl_flood *flood, uint32_t cell) {
    visit_round(flood, cell, false);
}

static void visit_round_deep(dpl_flood *flood, uint32_t cell) {
    visit_round(flood, cell, true);
}

typedef void (*visit_function)(dpl_flood *flood, uint32_t cell);

/* [falloff][deep] */
static const visit_function visits[3][2] = {
    {visit_flat, visit_deep},
    {visit_flat_times, visit_deep_times},
    {visit_round_flat, visit_round_deep},
};

void dpl_flood_visit(dpl_flood *flood, uint32_t cell) {
    flood->stats.visits++;
    visits[flood->desc.falloff][dpl_flood_is_deep(flood)](flood, cell);
}

/* ---- all of them ---------------------------------------------------------------------------------- */

/* A cell may be queued twice, when it rose again before its turn; its mark is gone by the second time. */
static inline void drain_bucket(dpl_flood *flood, int32_t bucket, visit_function visit) {
    dpl_flood_queue *queue = &flood->queue;
    uint32_t chunk = dpl_flood_queue_take(queue, bucket);
    while (chunk != DPL_NO_CHUNK) {
        for (uint32_t i = 0; i < queue->chunks[chunk].count; i++) {
            uint32_t cell = queue->chunks[chunk].cells[i];
            uint64_t now = flood->levels[cell];
            if (!(now & DPL_MARK_QUEUED))
                continue;
            flood->levels[cell] = now & ~DPL_MARK_QUEUED;
            flood->stats.visits++;
            visit(flood, cell);
        }
        chunk = dpl_flood_queue_release(queue, chunk);
    }
}

static inline void drain_with(dpl_flood *flood, visit_function visit) {
    dpl_flood_queue *queue = &flood->queue;
    for (int32_t bucket = queue->brightest; bucket >= 0; bucket--)
        while (queue->first[bucket] != DPL_NO_CHUNK)
            drain_bucket(flood, bucket, visit);
    queue->brightest = -1;
}

/* One copy of the loops per falloff: `visit` is inlined. */
static void drain_once(dpl_flood *flood) {
    bool deep = dpl_flood_is_deep(flood);
    switch (flood->desc.falloff) {
    case DPL_FLOOD_SUBTRACTIVE:
        if (deep)
            drain_with(flood, visit_deep);
        else
            drain_with(flood, visit_flat);
        break;
    case DPL_FLOOD_MULTIPLICATIVE:
        drain_with(flood, visits[DPL_FLOOD_MULTIPLICATIVE][deep]);
        break;
    case DPL_FLOOD_EUCLIDEAN:
        drain_with(flood, visits[DPL_FLOOD_EUCLIDEAN][deep]);
        break;
    }
}

/* Queues cells whose push found no room. */
static void find_lost(dpl_flood *flood) {
    flood->queue.lost = false;
    for (uint32_t cell = 0; cell < flood->padded && !flood->queue.lost; cell++) {
        uint64_t now = flood->levels[cell];
        if (now & DPL_MARK_QUEUED)
            flood->stats.pushes +=
                dpl_flood_queue_push(&flood->queue, cell, dpl_lanes_greatest(now & DPL_LANES_LEVELS));
    }
}

void dpl_flood_drain(dpl_flood *flood) {
    drain_once(flood);
    while (flood->queue.lost) {
        find_lost(flood);
        drain_once(flood);
    }
}
