/* A world as bytes: header, materials, lamps, cells, checksum; numbers little-endian. Called by users.
 *
 * Light is not among them: it follows from the rest. Bytes that come back are checked before anything is made
 * of them, and what is made is made anew, so a bad file costs nothing. */
#include "flood/flood.h"

#include <string.h>

#define MAGIC "DPLFLOOD"
#define MAGIC_BYTES 8
#define VERSION 1
/* version, size, channels, falloff, step, keep, sun, sun's level, materials, reserve, lamps */
#define HEADER_BYTES (MAGIC_BYTES + 9 * 4 + 4 * 2 + 3 * 4)
#define MATERIAL_BYTES 8
#define LAMP_BYTES 20
#define CHECKSUM_BYTES 8
#define FREE_PLACE UINT32_MAX

/* ---- bytes ---------------------------------------------------------------------------------------- */

typedef struct writer {
    uint8_t *at;
} writer;

static void put(writer *w, uint64_t value, int bytes) {
    for (int i = 0; i < bytes; i++)
        *w->at++ = (uint8_t)(value >> (8 * i));
}

typedef struct reader {
    const uint8_t *at;
} reader;

static uint64_t get(reader *r, int bytes) {
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint64_t)*r->at++ << (8 * i);
    return value;
}

/* FNV-1a over 64 bits (Fowler, Noll, Vo): finds accidents, not forgers; nothing here trusts it further. */
static uint64_t checksum(const uint8_t *bytes, size_t size) {
    uint64_t sum = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ bytes[i]) * UINT64_C(1099511628211);
    return sum;
}

/* ---- writing -------------------------------------------------------------------------------------- */

static size_t cell_count(const dpl_flood_desc *desc) {
    return (size_t)desc->width * (size_t)desc->height * (size_t)desc->depth;
}

static uint64_t size_of(const dpl_flood_desc *desc, uint64_t lamps) {
    return HEADER_BYTES + (uint64_t)desc->material_count * MATERIAL_BYTES + lamps * LAMP_BYTES +
           cell_count(desc) + CHECKSUM_BYTES;
}

size_t dpl_flood_save_size(const dpl_flood *flood) {
    return flood ? (size_t)size_of(&flood->desc, flood->lamps.count) : 0;
}

static void put_header(writer *w, const dpl_flood *flood) {
    const dpl_flood_desc *desc = &flood->desc;
    const int32_t numbers[9] = {VERSION,     desc->width,    desc->height,
                                desc->depth, desc->channels, (int32_t)desc->falloff,
                                desc->step,  desc->keep,     (int32_t)desc->sun};
    memcpy(w->at, MAGIC, MAGIC_BYTES);
    w->at += MAGIC_BYTES;
    for (int i = 0; i < 9; i++)
        put(w, (uint32_t)numbers[i], 4);
    for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++)
        put(w, desc->sun_level[c], 2);
    put(w, (uint32_t)desc->material_count, 4);
    put(w, (uint32_t)desc->reserve, 4);
    put(w, flood->lamps.count, 4);
}

static void put_lamp(writer *w, const dpl_flood *flood, const dpl_flood_lamp *lamp) {
    int32_t at[3] = {0, 0, 0};
    bool is_free = lamp->cell == DPL_NO_CELL;
    if (!is_free)
        dpl_flood_locate(flood, lamp->cell, at);
    put(w, lamp->generation, 4);
    uint64_t cell = (uint64_t)at[0] + (uint64_t)flood->desc.width *
                                          ((uint64_t)at[1] + (uint64_t)flood->desc.height * (uint64_t)at[2]);
    put(w, is_free ? FREE_PLACE : cell, 8);
    put(w, is_free ? 0 : lamp->level, 8);
}

dpl_status dpl_flood_save(const dpl_flood *flood, void *bytes, size_t size) {
    if (!flood || !bytes)
        return DPL_ERROR_ARGUMENT;
    size_t needed = dpl_flood_save_size(flood);
    if (size < needed)
        return dpl_fail(flood->context, DPL_ERROR_SIZE, "the world needs %zu bytes, and there are %zu",
                        needed, size);
    writer w = {bytes};
    put_header(&w, flood);
    for (int32_t i = 0; i < flood->desc.material_count; i++)
        for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++)
            put(&w, flood->materials[i].attenuation[c], 2);
    for (uint32_t i = 0; i < flood->lamps.count; i++)
        put_lamp(&w, flood, &flood->lamps.lamps[i]);
    for (int32_t z = 0; z < flood->desc.depth; z++)
        for (int32_t y = 0; y < flood->desc.height; y++) {
            const uint8_t *row = flood->cells + dpl_flood_number(flood, 0, y, z);
            for (int32_t x = 0; x < flood->desc.width; x++)
                *w.at++ = row[x] & DPL_CELL_MATERIAL;
        }
    put(&w, checksum(bytes, needed - CHECKSUM_BYTES), CHECKSUM_BYTES);
    return DPL_OK;
}

/* ---- reading -------------------------------------------------------------------------------------- */

static dpl_status refuse(dpl_context *context, const char *why) {
    return dpl_fail(context, DPL_ERROR_ARGUMENT, "saved world: %s", why);
}

/* The desc as it was written; dpl_flood_create() judges its numbers. */
static dpl_status get_header(dpl_context *context, reader *r, size_t size, dpl_flood_desc *desc,
                             uint32_t *lamps) {
    if (size < HEADER_BYTES + CHECKSUM_BYTES || memcmp(r->at, MAGIC, MAGIC_BYTES) != 0)
        return refuse(context, "these bytes are none, or are cut short");
    r->at += MAGIC_BYTES;
    if (get(r, 4) != VERSION)
        return refuse(context, "its version is not known");
    int32_t *const numbers[4] = {&desc->width, &desc->height, &desc->depth, &desc->channels};
    for (int i = 0; i < 4; i++)
        *numbers[i] = (int32_t)(uint32_t)get(r, 4);
    desc->falloff = (dpl_flood_falloff)get(r, 4);
    desc->step = (int32_t)(uint32_t)get(r, 4);
    desc->keep = (int32_t)(uint32_t)get(r, 4);
    desc->sun = (dpl_flood_sun)get(r, 4);
    for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++)
        desc->sun_level[c] = (uint16_t)get(r, 2);
    desc->material_count = (int32_t)(uint32_t)get(r, 4);
    desc->reserve = (int32_t)(uint32_t)get(r, 4);
    *lamps = (uint32_t)get(r, 4);
    return DPL_OK;
}

/* Before a size is believed: does it fit the bytes that there are? */
static dpl_status check_size(dpl_context *context, const uint8_t *bytes, size_t size,
                             const dpl_flood_desc *desc, uint32_t lamps) {
    const int32_t sides[3] = {desc->width, desc->height, desc->depth};
    for (int i = 0; i < 3; i++)
        if (sides[i] < 1 || sides[i] > DPL_FLOOD_MAX_SIZE)
            return refuse(context, "its size is out of range");
    if (!dpl_flood_size_fits(desc->width, desc->height, desc->depth))
        return refuse(context, "its size is out of range");
    if (desc->material_count < 1 || desc->material_count > DPL_FLOOD_MAX_MATERIALS)
        return refuse(context, "its number of materials is out of range");
    if (size_of(desc, lamps) != size)
        return refuse(context, "its length does not match its header");
    reader tail = {bytes + size - CHECKSUM_BYTES};
    if (get(&tail, CHECKSUM_BYTES) != checksum(bytes, size - CHECKSUM_BYTES))
        return refuse(context, "its checksum does not match: it was damaged");
    return DPL_OK;
}

static dpl_status get_lamp(dpl_flood *flood, reader *r, uint32_t index) {
    const dpl_flood_desc *desc = &flood->desc;
    dpl_flood_lamp *lamp = &flood->lamps.lamps[index];
    lamp->generation = (uint32_t)get(r, 4);
    uint64_t cell = get(r, 8);
    lamp->level = get(r, 8);
    lamp->cell = DPL_NO_CELL;
    lamp->next = DPL_NO_LAMP;
    flood->lamps.count = index + 1;
    if (cell == FREE_PLACE)
        return DPL_OK;
    uint64_t lanes = desc->channels == 4 ? UINT64_MAX : (UINT64_C(1) << (16 * desc->channels)) - 1;
    if (cell >= cell_count(desc) || lamp->generation == 0 || lamp->level & ~(lanes & DPL_LANES_LEVELS))
        return refuse(flood->context, "a light is out of range");
    uint64_t row = cell / (uint64_t)desc->width;
    lamp->cell =
        dpl_flood_number(flood, (int32_t)(cell % (uint64_t)desc->width),
                         (int32_t)(row % (uint64_t)desc->height), (int32_t)(row / (uint64_t)desc->height));
    flood->cells[lamp->cell] |= DPL_CELL_SOURCE;
    dpl_flood_lamps_chain(flood, index);
    return DPL_OK;
}

static dpl_status get_lamps(dpl_flood *flood, reader *r, uint32_t count) {
    dpl_flood_lamps *lamps = &flood->lamps;
    if (count == 0)
        return DPL_OK;
    DPL_TRY(dpl_flood_lamps_reserve(flood, count));
    for (uint32_t i = 0; i < count; i++)
        DPL_TRY(get_lamp(flood, r, i));
    for (uint32_t i = count; i-- > 0;)
        if (lamps->lamps[i].cell == DPL_NO_CELL && lamps->lamps[i].generation != UINT32_MAX) {
            lamps->lamps[i].next = lamps->free;
            lamps->free = i;
        }
    return DPL_OK;
}

static dpl_status get_world(dpl_flood *flood, reader *r, uint32_t lamps) {
    const uint8_t *cells = r->at + (size_t)lamps * LAMP_BYTES;
    const dpl_flood_box all = {0, 0, 0, flood->desc.width, flood->desc.height, flood->desc.depth};
    flood->stale = true; /* nothing to note: it will be solved */
    DPL_TRY(dpl_flood_set_cells(flood, &all, cells, 0, 0));
    DPL_TRY(get_lamps(flood, r, lamps));
    return dpl_flood_solve(flood);
}

dpl_status dpl_flood_restore(dpl_context *context, const void *bytes, size_t size, dpl_flood **out) {
    if (!context || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!bytes)
        return refuse(context, "no bytes");
    dpl_flood_desc desc = dpl_flood_desc_default();
    dpl_flood_material materials[DPL_FLOOD_MAX_MATERIALS];
    reader r = {bytes};
    uint32_t lamps = 0;
    DPL_TRY(get_header(context, &r, size, &desc, &lamps));
    DPL_TRY(check_size(context, bytes, size, &desc, lamps));
    for (int32_t i = 0; i < desc.material_count; i++)
        for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++)
            materials[i].attenuation[c] = (uint16_t)get(&r, 2);
    desc.materials = materials;
    dpl_flood *flood;
    DPL_TRY(dpl_flood_create(context, &desc, &flood));
    dpl_status status = get_world(flood, &r, lamps);
    if (status != DPL_OK) {
        dpl_flood_destroy(flood);
        return status;
    }
    *out = flood;
    return DPL_OK;
}
