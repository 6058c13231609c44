/* A world's memory and geometry, made once. Called by src/api/flood.c. */
#include "flood/flood.h"

#include <string.h>

/* A row of three cells is read as four bytes (spread.c). */
#define CELL_SLACK 4
#define LEAST_RESERVE 4096

/* ---- geometry ------------------------------------------------------------------------------------- */

static int64_t padded_cells(int32_t width, int32_t height, int32_t depth) {
    return ((int64_t)width + 2) * ((int64_t)height + 2) * (depth > 1 ? (int64_t)depth + 2 : 1);
}

bool dpl_flood_size_fits(int32_t width, int32_t height, int32_t depth) {
    return padded_cells(width, height, depth) < INT64_C(1) << 31;
}

/* For n and d below 2^31: factor = ceil(2^(31+b) / d) with d <= 2^b is exact and n * factor stays below 2^63.
 */
static dpl_flood_divider divider_by(uint32_t d) {
    int32_t bits = 0;
    while ((UINT64_C(1) << bits) < d)
        bits++;
    uint64_t power = UINT64_C(1) << (31 + bits);
    return (dpl_flood_divider){(power + d - 1) / d, 31 + bits};
}

static void measure(dpl_flood *flood) {
    const dpl_flood_desc *desc = &flood->desc;
    flood->padded = (uint32_t)padded_cells(desc->width, desc->height, desc->depth);
    flood->stride[0] = 1;
    flood->stride[1] = (uint32_t)desc->width + 2;
    flood->stride[2] = flood->stride[1] * ((uint32_t)desc->height + 2);
    flood->origin = flood->stride[1] + 1 + (dpl_flood_is_deep(flood) ? flood->stride[2] : 0);
    flood->rows = divider_by(flood->stride[1]);
    flood->slices = divider_by(flood->stride[2]);
}

uint64_t dpl_flood_pack(const dpl_flood *flood, const uint16_t level[DPL_FLOOD_MAX_CHANNELS]) {
    uint64_t lanes = 0;
    for (int c = 0; c < flood->desc.channels; c++)
        lanes |= (uint64_t)level[c] << (16 * c);
    return lanes;
}

/* ---- memory --------------------------------------------------------------------------------------- */

static void *take(dpl_flood *flood, size_t count, size_t size) {
    void *memory = dpl_allocate(flood->context, count, size);
    if (memory)
        flood->memory_bytes += (int64_t)(count * size);
    return memory;
}

static uint32_t reserve_of(const dpl_flood *flood) {
    uint32_t cells = flood->padded;
    uint32_t wanted = (uint32_t)flood->desc.reserve;
    if (wanted == 0)
        wanted = cells / 8 > LEAST_RESERVE ? cells / 8 : LEAST_RESERVE;
    return wanted < cells ? wanted : cells;
}

/* Each bucket in use holds a chunk that is not full; those come on top. */
static dpl_status take_queues(dpl_flood *flood) {
    uint32_t reserve = reserve_of(flood);
    uint32_t chunks = reserve / DPL_CHUNK_CELLS + (reserve < LEAST_RESERVE ? 1 : 64);
    int32_t step = dpl_falloff_is_multiplicative(flood->desc.falloff) ? 1 : flood->desc.step;
    dpl_flood_chunk *pool = take(flood, chunks, sizeof *pool);
    dpl_flood_queue_open(&flood->queue, pool, chunks, step);
    flood->edit_capacity = flood->removal_capacity = reserve / 2 + 1;
    flood->edits = take(flood, flood->edit_capacity, sizeof *flood->edits);
    flood->removals = take(flood, flood->removal_capacity, sizeof *flood->removals);
    return pool && flood->edits && flood->removals ? DPL_OK : DPL_ERROR_MEMORY;
}

dpl_status dpl_flood_build(dpl_flood *flood) {
    measure(flood);
    dpl_flood_make_moves(flood);
    flood->memory_bytes = sizeof *flood;
    flood->lamps.free = DPL_NO_LAMP;
    flood->levels = take(flood, flood->padded, sizeof *flood->levels);
    flood->cells = take(flood, (size_t)flood->padded + CELL_SLACK, 1);
    if (!flood->levels || !flood->cells)
        return DPL_ERROR_MEMORY;
    DPL_TRY(take_queues(flood));
    memset(flood->cells, DPL_MATERIAL_BORDER, (size_t)flood->padded + CELL_SLACK);
    for (int32_t z = 0; z < flood->desc.depth; z++)
        for (int32_t y = 0; y < flood->desc.height; y++)
            memset(flood->cells + dpl_flood_number(flood, 0, y, z), 0, (size_t)flood->desc.width);
    for (uint32_t cell = 0; cell < flood->padded; cell++)
        flood->levels[cell] = flood->cells[cell] ? DPL_MARK_SOLID : 0;
    DPL_TRY(dpl_flood_sun_build(flood));
    dpl_flood_start_over(flood);
    memset(&flood->stats, 0, sizeof flood->stats);
    return DPL_OK;
}

static void give_back(const dpl_flood *flood, void *memory, size_t count, size_t size) {
    dpl_release(flood->context, memory, count, size);
}

void dpl_flood_destroy(dpl_flood *flood) {
    if (!flood)
        return;
    dpl_context *context = flood->context;
    dpl_flood_lamps_free(flood);
    dpl_buffer_free(context, &flood->depth_first_path);
    give_back(flood, flood->sunlit, (size_t)flood->sun_columns[0] * (size_t)flood->sun_columns[1],
              sizeof *flood->sunlit);
    give_back(flood, flood->removals, flood->removal_capacity, sizeof *flood->removals);
    give_back(flood, flood->edits, flood->edit_capacity, sizeof *flood->edits);
    give_back(flood, flood->queue.chunks, flood->queue.capacity, sizeof *flood->queue.chunks);
    give_back(flood, flood->cells, (size_t)flood->padded + CELL_SLACK, 1);
    give_back(flood, flood->levels, flood->padded, sizeof *flood->levels);
    dpl_release(context, flood, 1, sizeof *flood);
}
