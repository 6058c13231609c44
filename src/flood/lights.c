/* Lamps: a list of places with names that are never given out twice, and chains that find the lamps of a
 * cell. Called by src/api/flood.c, update.c and save.c. */
#include "flood/flood.h"

#include <string.h>

#define LEAST_CAPACITY 16

static uint32_t *chain_of(const dpl_flood_lamps *lamps, uint32_t cell) {
    uint32_t hash = cell * UINT32_C(2654435769); /* Knuth: 2^32 / golden ratio */
    return &lamps->chains[(hash ^ hash >> 16) & (lamps->capacity - 1)];
}

void dpl_flood_lamps_chain(dpl_flood *flood, uint32_t index) {
    dpl_flood_lamp *lamp = &flood->lamps.lamps[index];
    uint32_t *chain = chain_of(&flood->lamps, lamp->cell);
    lamp->next = *chain;
    *chain = index;
}

/* ---- room ----------------------------------------------------------------------------------------- */

static void rebuild_chains(dpl_flood *flood) {
    dpl_flood_lamps *lamps = &flood->lamps;
    memset(lamps->chains, 0xff, lamps->capacity * sizeof *lamps->chains);
    for (uint32_t i = 0; i < lamps->count; i++)
        if (lamps->lamps[i].cell != DPL_NO_CELL)
            dpl_flood_lamps_chain(flood, i);
}

static size_t lamp_bytes(void) {
    return sizeof(dpl_flood_lamp) + sizeof(uint32_t);
}

dpl_status dpl_flood_lamps_reserve(dpl_flood *flood, uint32_t count) {
    dpl_flood_lamps *old = &flood->lamps;
    dpl_flood_lamps grown = *old;
    grown.capacity = old->capacity ? old->capacity : LEAST_CAPACITY;
    while (grown.capacity < count)
        grown.capacity *= 2;
    if (grown.capacity == old->capacity)
        return DPL_OK;
    /* One piece: the lamps, then the chains. */
    grown.lamps = dpl_allocate(flood->context, grown.capacity, lamp_bytes());
    if (!grown.lamps)
        return DPL_ERROR_MEMORY;
    grown.chains = (uint32_t *)(void *)(grown.lamps + grown.capacity);
    if (old->count > 0)
        memcpy(grown.lamps, old->lamps, old->count * sizeof *old->lamps);
    flood->memory_bytes += (int64_t)((grown.capacity - old->capacity) * lamp_bytes());
    dpl_flood_lamps_free(flood);
    flood->lamps = grown;
    rebuild_chains(flood);
    return DPL_OK;
}

void dpl_flood_lamps_free(dpl_flood *flood) {
    dpl_release(flood->context, flood->lamps.lamps, flood->lamps.capacity, lamp_bytes());
}

/* ---- one lamp ------------------------------------------------------------------------------------- */

/* A lamp comes into its cell, or its cell has lost one. */
static void arrive(dpl_flood *flood, uint32_t index, uint32_t cell) {
    flood->lamps.lamps[index].cell = cell;
    dpl_flood_lamps_chain(flood, index);
    flood->cells[cell] |= DPL_CELL_SOURCE;
    dpl_flood_edit(flood, cell, false);
}

/* Light that shone brighter here than the lamp has other reasons: it stays. */
static void leave(dpl_flood *flood, dpl_flood_lamp *lamp) {
    uint32_t index = (uint32_t)(lamp - flood->lamps.lamps);
    uint32_t cell = lamp->cell;
    uint32_t *link = chain_of(&flood->lamps, cell);
    while (*link != index)
        link = &flood->lamps.lamps[*link].next;
    *link = lamp->next;
    if (!dpl_flood_lamps_at(flood, cell) && !dpl_flood_is_sunlit(flood, cell))
        flood->cells[cell] &= DPL_CELL_MATERIAL;
    uint64_t shown = dpl_lanes_at_least(lamp->level, flood->levels[cell] & DPL_LANES_LEVELS);
    if (lamp->level & dpl_lanes_mask(shown))
        dpl_flood_edit(flood, cell, true);
}

dpl_flood_light dpl_flood_lamps_add(dpl_flood *flood, uint32_t cell, uint64_t level) {
    dpl_flood_lamps *lamps = &flood->lamps;
    uint32_t index = lamps->free;
    if (index == DPL_NO_LAMP) {
        index = lamps->count++;
        lamps->lamps[index].generation = 0;
    } else {
        lamps->free = lamps->lamps[index].next;
    }
    dpl_flood_lamp *lamp = &lamps->lamps[index];
    lamp->generation++;
    lamp->level = level;
    arrive(flood, index, cell);
    return (dpl_flood_light){index, lamp->generation};
}

dpl_flood_lamp *dpl_flood_lamps_find(const dpl_flood *flood, dpl_flood_light light) {
    if (light.generation == 0 || light.index >= flood->lamps.count)
        return NULL;
    dpl_flood_lamp *lamp = &flood->lamps.lamps[light.index];
    return lamp->cell != DPL_NO_CELL && lamp->generation == light.generation ? lamp : NULL;
}

void dpl_flood_lamps_move(dpl_flood *flood, dpl_flood_lamp *lamp, uint32_t cell) {
    if (cell == lamp->cell)
        return;
    leave(flood, lamp);
    arrive(flood, (uint32_t)(lamp - flood->lamps.lamps), cell);
}

void dpl_flood_lamps_remove(dpl_flood *flood, dpl_flood_lamp *lamp) {
    leave(flood, lamp);
    lamp->cell = DPL_NO_CELL;
    if (lamp->generation == UINT32_MAX) /* worn out: its names are used up */
        return;
    lamp->next = flood->lamps.free;
    flood->lamps.free = (uint32_t)(lamp - flood->lamps.lamps);
}

uint64_t dpl_flood_lamps_at(const dpl_flood *flood, uint32_t cell) {
    const dpl_flood_lamps *lamps = &flood->lamps;
    uint64_t brightest = 0;
    if (lamps->capacity == 0)
        return 0;
    for (uint32_t i = *chain_of(lamps, cell); i != DPL_NO_LAMP; i = lamps->lamps[i].next)
        if (lamps->lamps[i].cell == cell)
            brightest = dpl_lanes_max(brightest, lamps->lamps[i].level);
    return brightest;
}
