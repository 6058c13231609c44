/* Sunlight: how far it falls down each column of cells. Called by world.c, edits.c, update.c and
 * depth_first.c.
 *
 * A column is a line of cells along the sun's axis. The sun falls through cells that attenuate no channel and
 * ends at the first that does; how many it falls through is kept per column. Sunlit cells are sources like
 * lamps, so falling light needs no rule of its own in the queue. */
#include "flood/flood.h"

static size_t column_count(const dpl_flood *flood) {
    return (size_t)flood->sun_columns[0] * (size_t)flood->sun_columns[1];
}

static bool lets_sun_through(const dpl_flood *flood, uint32_t cell) {
    const uint16_t *attenuation = flood->materials[flood->cells[cell] & DPL_CELL_MATERIAL].attenuation;
    for (int c = 0; c < flood->desc.channels; c++)
        if (attenuation[c] != 0)
            return false;
    return true;
}

/* Axis, columns and strides from the desc. */
static void aim(dpl_flood *flood) {
    const int32_t size[3] = {flood->desc.width, flood->desc.height, flood->desc.depth};
    int axis = ((int)flood->desc.sun - 1) / 2;
    bool down = flood->desc.sun % 2 == 0; /* from the far end towards 0 */
    int across = axis == 0 ? 1 : 0, along = axis == 2 ? 1 : 2;
    flood->sun_axis = axis;
    flood->sun_length = size[axis];
    flood->sun_stride = down ? 0u - flood->stride[axis] : flood->stride[axis];
    flood->sun_entry = flood->origin + (down ? (uint32_t)(size[axis] - 1) * flood->stride[axis] : 0);
    flood->sun_columns[0] = size[across];
    flood->sun_columns[1] = size[along];
    flood->sun_across[0] = flood->stride[across];
    flood->sun_across[1] = flood->stride[along];
}

dpl_status dpl_flood_sun_build(dpl_flood *flood) {
    if (flood->desc.sun == DPL_FLOOD_SUN_NONE)
        return DPL_OK;
    aim(flood);
    flood->sunlit = dpl_allocate(flood->context, column_count(flood), sizeof *flood->sunlit);
    if (!flood->sunlit)
        return DPL_ERROR_MEMORY;
    flood->memory_bytes += (int64_t)(column_count(flood) * sizeof *flood->sunlit);
    flood->sun_level = dpl_flood_pack(flood, flood->desc.sun_level);
    dpl_flood_sun_measure(flood);
    return DPL_OK;
}

/* ---- single columns ------------------------------------------------------------------------------- */

typedef struct column {
    int32_t *sunlit;
    uint32_t top;   /* first cell */
    int32_t height; /* of the cell that was asked for: 0 at the top */
} column;

static uint32_t top_of(const dpl_flood *flood, int32_t a, int32_t b) {
    return flood->sun_entry + (uint32_t)a * flood->sun_across[0] + (uint32_t)b * flood->sun_across[1];
}

static column column_of(const dpl_flood *flood, uint32_t cell) {
    int32_t at[3];
    dpl_flood_locate(flood, cell, at);
    int axis = flood->sun_axis;
    int32_t a = at[axis == 0 ? 1 : 0], b = at[axis == 2 ? 1 : 2];
    bool down = flood->desc.sun % 2 == 0;
    return (column){
        flood->sunlit + (size_t)b * (size_t)flood->sun_columns[0] + (size_t)a,
        top_of(flood, a, b),
        down ? flood->sun_length - 1 - at[axis] : at[axis],
    };
}

static int32_t fall_from(const dpl_flood *flood, uint32_t top, int32_t height) {
    while (height < flood->sun_length && lets_sun_through(flood, top + (uint32_t)height * flood->sun_stride))
        height++;
    return height;
}

bool dpl_flood_is_sunlit(const dpl_flood *flood, uint32_t cell) {
    if (!flood->sunlit)
        return false;
    column c = column_of(flood, cell);
    return c.height < *c.sunlit;
}

static void shade(dpl_flood *flood, const column *c, int32_t end) {
    for (int32_t h = c->height; h < end; h++) {
        uint32_t cell = c->top + (uint32_t)h * flood->sun_stride;
        if (!dpl_flood_lamps_at(flood, cell))
            flood->cells[cell] &= DPL_CELL_MATERIAL;
        dpl_flood_edit(flood, cell, true);
    }
    *c->sunlit = c->height;
}

static void open_up(dpl_flood *flood, const column *c) {
    *c->sunlit = fall_from(flood, c->top, c->height);
    for (int32_t h = c->height; h < *c->sunlit; h++) {
        uint32_t cell = c->top + (uint32_t)h * flood->sun_stride;
        flood->cells[cell] |= DPL_CELL_SOURCE;
        dpl_flood_edit(flood, cell, false);
    }
}

void dpl_flood_sun_follow(dpl_flood *flood, uint32_t cell) {
    if (!flood->sunlit)
        return;
    column c = column_of(flood, cell);
    int32_t end = *c.sunlit;
    bool clear = lets_sun_through(flood, cell);
    if (!clear && c.height < end)
        shade(flood, &c, end);
    else if (clear && c.height == end)
        open_up(flood, &c);
}

/* ---- all columns ---------------------------------------------------------------------------------- */

void dpl_flood_sun_measure(dpl_flood *flood) {
    if (!flood->sunlit)
        return;
    int32_t *sunlit = flood->sunlit;
    for (int32_t b = 0; b < flood->sun_columns[1]; b++)
        for (int32_t a = 0; a < flood->sun_columns[0]; a++) {
            uint32_t top = top_of(flood, a, b);
            *sunlit = fall_from(flood, top, 0);
            for (int32_t h = 0; h < *sunlit; h++)
                flood->cells[top + (uint32_t)h * flood->sun_stride] |= DPL_CELL_SOURCE;
            sunlit++;
        }
}

/* Cells of one height in all columns: neighbours in memory, but for a sun along x. */
static void shine_at(dpl_flood *flood, int32_t height) {
    const int32_t *sunlit = flood->sunlit;
    for (int32_t b = 0; b < flood->sun_columns[1]; b++) {
        uint32_t cell = top_of(flood, 0, b) + (uint32_t)height * flood->sun_stride;
        for (int32_t a = 0; a < flood->sun_columns[0]; a++, cell += flood->sun_across[0])
            if (height < *sunlit++)
                flood->levels[cell] |= flood->sun_level;
    }
}

void dpl_flood_sun_shine(dpl_flood *flood) {
    if (!flood->sunlit)
        return;
    for (int32_t height = 0; height < flood->sun_length; height++)
        shine_at(flood, height);
}

/* The least of a column and those around it. */
static int32_t least_around(const dpl_flood *flood, int32_t a, int32_t b) {
    int32_t least = flood->sun_length;
    for (int32_t j = b - 1; j <= b + 1; j++)
        for (int32_t i = a - 1; i <= a + 1; i++) {
            if (i < 0 || j < 0 || i >= flood->sun_columns[0] || j >= flood->sun_columns[1])
                continue;
            int32_t sunlit = flood->sunlit[(size_t)j * (size_t)flood->sun_columns[0] + (size_t)i];
            least = sunlit < least ? sunlit : least;
        }
    return least;
}

void dpl_flood_sun_each(dpl_flood *flood, void (*visit)(dpl_flood *flood, uint32_t cell)) {
    if (!flood->sunlit)
        return;
    const int32_t *sunlit = flood->sunlit;
    for (int32_t b = 0; b < flood->sun_columns[1]; b++)
        for (int32_t a = 0; a < flood->sun_columns[0]; a++, sunlit++) {
            int32_t least = least_around(flood, a, b);
            for (int32_t h = least > 0 ? least - 1 : 0; h < *sunlit; h++)
                visit(flood, top_of(flood, a, b) + (uint32_t)h * flood->sun_stride);
        }
}
