/* Bringing light up to date: by edits, or all of it from nothing. Called by src/api/flood.c. */
#include "flood/flood.h"

#include <string.h>

uint64_t dpl_flood_source(const dpl_flood *flood, uint32_t cell) {
    if (!(flood->cells[cell] & DPL_CELL_SOURCE))
        return 0;
    uint64_t lamps = dpl_flood_lamps_at(flood, cell);
    return dpl_flood_is_sunlit(flood, cell) ? dpl_lanes_max(lamps, flood->sun_level) : lamps;
}

/* ---- from scratch --------------------------------------------------------------------------------- */

void dpl_flood_darken(dpl_flood *flood) {
    for (uint32_t cell = 0; cell < flood->padded; cell++)
        flood->levels[cell] &= DPL_MARK_SOLID;
    dpl_flood_sun_shine(flood);
    flood->edit_count = flood->removal_count = 0;
    flood->stale = flood->tracking = false;
    memset(&flood->stats, 0, sizeof flood->stats);
    flood->stats.from_scratch = 1;
}

void dpl_flood_start_over(dpl_flood *flood) {
    dpl_flood_darken(flood);
    dpl_flood_sun_each(flood, dpl_flood_visit);
    for (uint32_t i = 0; i < flood->lamps.count; i++)
        if (flood->lamps.lamps[i].cell != DPL_NO_CELL)
            dpl_flood_offer(flood, flood->lamps.lamps[i].cell, flood->lamps.lamps[i].level);
    dpl_flood_drain(flood);
}

/* ---- by edits ------------------------------------------------------------------------------------- */

static void open_box(dpl_flood *flood) {
    for (int axis = 0; axis < 3; axis++) {
        flood->low[axis] = INT32_MAX;
        flood->high[axis] = -1;
    }
}

static dpl_flood_box box_of(const dpl_flood *flood) {
    const int32_t *low = flood->low, *high = flood->high;
    if (high[0] < 0)
        return (dpl_flood_box){0};
    return (dpl_flood_box){
        low[0], low[1], low[2], high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1};
}

/* False: solve from scratch. */
static bool update_edits(dpl_flood *flood) {
    memset(&flood->stats, 0, sizeof flood->stats);
    flood->tracking = true;
    open_box(flood);
    if (!dpl_flood_retract(flood))
        return false;
    dpl_flood_drain(flood);
    dpl_flood_settle_removals(flood);
    flood->tracking = false;
    flood->edit_count = 0;
    return true;
}

dpl_status dpl_flood_update(dpl_flood *flood, dpl_flood_box *changed) {
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    dpl_flood_box box = {0, 0, 0, flood->desc.width, flood->desc.height, flood->desc.depth};
    if (!flood->stale && update_edits(flood))
        box = box_of(flood);
    else
        dpl_flood_start_over(flood);
    if (changed)
        *changed = box;
    return DPL_OK;
}

dpl_status dpl_flood_solve(dpl_flood *flood) {
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    dpl_flood_start_over(flood);
    return DPL_OK;
}
