/* What has changed since the last update: a list of cells, each once. Called by lights.c, sun.c and
 * src/api/flood.c. A list that is full gives up: the next update solves from scratch. */
#include "flood/flood.h"

void dpl_flood_edit(dpl_flood *flood, uint32_t cell, bool doomed) {
    if (flood->stale)
        return;
    uint64_t *levels = &flood->levels[cell];
    if (!(*levels & DPL_MARK_EDITED)) {
        if (flood->edit_count == flood->edit_capacity) {
            flood->stale = true;
            return;
        }
        flood->edits[flood->edit_count++] = cell;
        *levels |= DPL_MARK_EDITED;
    }
    if (doomed)
        *levels |= DPL_MARK_DOOMED;
}

/* Does a step into material `b` cost more than into `a`, in any channel? */
static bool is_darker(const dpl_flood *flood, uint8_t b, uint8_t a) {
    const uint16_t *before = flood->materials[a].attenuation, *after = flood->materials[b].attenuation;
    for (int c = 0; c < flood->desc.channels; c++)
        if (after[c] > before[c])
            return true;
    return false;
}

void dpl_flood_place(dpl_flood *flood, uint32_t cell, uint8_t material) {
    uint8_t before = flood->cells[cell] & DPL_CELL_MATERIAL;
    if (before == material)
        return;
    flood->cells[cell] = (uint8_t)((flood->cells[cell] & DPL_CELL_SOURCE) | material);
    flood->levels[cell] &= ~DPL_MARK_SOLID;
    flood->levels[cell] |= material ? DPL_MARK_SOLID : 0;
    dpl_flood_edit(flood, cell, is_darker(flood, material, before));
    dpl_flood_sun_follow(flood, cell);
}
