/* The public face of a tile world: argument checks, making, reading back. Updates are in src/flood/update.c,
 * bytes in src/flood/save.c. */
#include "flood/flood.h"
#include "api/output_fault.h"

#include "base/desc.h"

#include <math.h>
#include <string.h>

/* ---- making --------------------------------------------------------------------------------------- */

static bool levels_are_good(const uint16_t level[DPL_FLOOD_MAX_CHANNELS]) {
    for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++)
        if (level[c] > DPL_FLOOD_FULL)
            return false;
    return true;
}

static bool is_within(int32_t value, int32_t low, int32_t high) {
    return value >= low && value <= high;
}

static dpl_status check_size(dpl_context *context, const dpl_flood_desc *desc) {
    if (!is_within(desc->width, 1, DPL_FLOOD_MAX_SIZE) || !is_within(desc->height, 1, DPL_FLOOD_MAX_SIZE) ||
        !is_within(desc->depth, 1, DPL_FLOOD_MAX_SIZE))
        return dpl_fail(context, DPL_ERROR_SIZE, "a world is 1 .. %d cells a side, not %d x %d x %d",
                        DPL_FLOOD_MAX_SIZE, (int)desc->width, (int)desc->height, (int)desc->depth);
    if (!dpl_flood_size_fits(desc->width, desc->height, desc->depth))
        return dpl_fail(context, DPL_ERROR_SIZE, "a world of %d x %d x %d is 2^31 cells or more",
                        (int)desc->width, (int)desc->height, (int)desc->depth);
    return DPL_OK;
}

/* What is wrong with the materials, or NULL. */
static const char *material_fault(const dpl_flood_desc *desc) {
    static const dpl_flood_material air = {{0}};
    if (!is_within(desc->material_count, 1, DPL_FLOOD_MAX_MATERIALS))
        return "there may be 1 to 127 materials";
    for (int32_t i = 0; i < desc->material_count; i++)
        if (!levels_are_good(desc->materials[i].attenuation))
            return "an attenuation must be 0 .. 32767";
    if (memcmp(desc->materials[0].attenuation, air.attenuation, sizeof air.attenuation) != 0)
        return "material 0 is air and must attenuate nothing";
    return NULL;
}

static const char *rule_fault(const dpl_flood_desc *desc) {
    if (!is_within(desc->channels, 1, DPL_FLOOD_MAX_CHANNELS))
        return "a world has 1 to 4 channels";
    if (!is_within((int32_t)desc->falloff, DPL_FLOOD_SUBTRACTIVE, DPL_FLOOD_ROUND))
        return "there is no such falloff";
    if (!is_within(desc->step, 1, 32767) || !is_within(desc->keep, 1, 32767))
        return "step and keep must be 1 .. 32767";
    if (!is_within((int32_t)desc->sun, DPL_FLOOD_SUN_NONE, DPL_FLOOD_SUN_Z_DOWN))
        return "there is no such sun";
    if (!levels_are_good(desc->sun_level))
        return "the sun's level must be 0 .. 32767";
    return desc->reserve < 0 ? "the reserve must not be negative" : NULL;
}

static const dpl_flood_material default_materials[2] = {
    {{0, 0, 0, 0}},
    {{DPL_FLOOD_OPAQUE, DPL_FLOOD_OPAQUE, DPL_FLOOD_OPAQUE, DPL_FLOOD_OPAQUE}},
};

static void keep_desc(dpl_flood *flood, const dpl_flood_desc *desc) {
    flood->desc = *desc;
    memcpy(flood->materials, desc->materials, (size_t)desc->material_count * sizeof *desc->materials);
    flood->desc.materials = flood->materials;
}

dpl_status dpl_flood_create(dpl_context *context, const dpl_flood_desc *given, dpl_flood **out) {
    if (!context || !given || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(given))
        return dpl_fail(context, DPL_ERROR_DESC, "the flood desc was not made by dpl_flood_desc_default()");
    dpl_flood_desc desc = *given;
    if (!desc.materials) {
        desc.materials = default_materials;
        desc.material_count = 2;
    }
    DPL_TRY(check_size(context, &desc));
    const char *fault = rule_fault(&desc);
    if (!fault)
        fault = material_fault(&desc);
    if (fault)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "flood: %s", fault);
    dpl_flood *flood = dpl_allocate(context, 1, sizeof *flood);
    if (!flood)
        return DPL_ERROR_MEMORY;
    memset(flood, 0, sizeof *flood);
    flood->context = context;
    keep_desc(flood, &desc);
    dpl_status status = dpl_flood_build(flood);
    if (status != DPL_OK) {
        dpl_flood_destroy(flood);
        return status;
    }
    *out = flood;
    return DPL_OK;
}

dpl_status dpl_flood_read_desc(const dpl_flood *flood, dpl_flood_desc *desc) {
    if (!flood || !desc)
        return DPL_ERROR_ARGUMENT;
    *desc = flood->desc;
    return DPL_OK;
}

/* ---- cells ---------------------------------------------------------------------------------------- */

static bool has_cell(const dpl_flood *flood, int32_t x, int32_t y, int32_t z) {
    return is_within(x, 0, flood->desc.width - 1) && is_within(y, 0, flood->desc.height - 1) &&
           is_within(z, 0, flood->desc.depth - 1);
}

static dpl_status no_such_cell(const dpl_flood *flood, int32_t x, int32_t y, int32_t z) {
    return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "the world has no cell (%d, %d, %d)", (int)x, (int)y,
                    (int)z);
}

dpl_status dpl_flood_set_cell(dpl_flood *flood, int32_t x, int32_t y, int32_t z, int32_t material) {
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    if (!has_cell(flood, x, y, z))
        return no_such_cell(flood, x, y, z);
    if (!is_within(material, 0, flood->desc.material_count - 1))
        return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "there is no material %d", (int)material);
    dpl_flood_place(flood, dpl_flood_number(flood, x, y, z), (uint8_t)material);
    return DPL_OK;
}

static bool box_is_inside(const dpl_flood *flood, const dpl_flood_box *box) {
    return box->width >= 1 && box->height >= 1 && box->depth >= 1 &&
           has_cell(flood, box->x, box->y, box->z) && box->width <= flood->desc.width - box->x &&
           box->height <= flood->desc.height - box->y && box->depth <= flood->desc.depth - box->z;
}

/* A box of a world beside the caller's rows. */
typedef struct rows {
    const dpl_flood *flood;
    const dpl_flood_box *box;
    ptrdiff_t row_stride;
    ptrdiff_t slice_stride;
} rows;

/* Checks a box and makes its strides explicit. `bytes` per cell of the caller's. */
static dpl_status open_rows(const dpl_flood *flood, const dpl_flood_box *box, const void *data, size_t bytes,
                            ptrdiff_t row_stride, ptrdiff_t slice_stride, rows *r) {
    if (!flood || !box || !data)
        return DPL_ERROR_ARGUMENT;
    if (!box_is_inside(flood, box))
        return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "the box is empty or not inside the world");
    if (row_stride % (ptrdiff_t)(bytes % 2 ? 1 : 2) || slice_stride % (ptrdiff_t)(bytes % 2 ? 1 : 2))
        return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "strides of levels must be even");
    *r = (rows){flood, box, row_stride, slice_stride};
    if (row_stride == 0)
        r->row_stride = (ptrdiff_t)((size_t)box->width * bytes);
    if (slice_stride == 0)
        r->slice_stride = r->row_stride * box->height;
    return DPL_OK;
}

static uint32_t row_number(const rows *r, int32_t y, int32_t z) {
    return dpl_flood_number(r->flood, r->box->x, r->box->y + y, r->box->z + z);
}

static ptrdiff_t row_offset(const rows *r, int32_t y, int32_t z) {
    return y * r->row_stride + z * r->slice_stride;
}

static dpl_status check_materials(const rows *r, const uint8_t *materials) {
    for (int32_t z = 0; z < r->box->depth; z++)
        for (int32_t y = 0; y < r->box->height; y++) {
            const uint8_t *row = materials + row_offset(r, y, z);
            for (int32_t x = 0; x < r->box->width; x++)
                if (row[x] >= r->flood->desc.material_count)
                    return dpl_fail(r->flood->context, DPL_ERROR_ARGUMENT,
                                    "cell (%d, %d, %d): there is no material %d", (int)(r->box->x + x),
                                    (int)(r->box->y + y), (int)(r->box->z + z), (int)row[x]);
        }
    return DPL_OK;
}

dpl_status dpl_flood_set_cells(dpl_flood *flood, const dpl_flood_box *box, const uint8_t *materials,
                               ptrdiff_t row_stride, ptrdiff_t slice_stride) {
    rows r;
    DPL_TRY(open_rows(flood, box, materials, 1, row_stride, slice_stride, &r));
    DPL_TRY(check_materials(&r, materials));
    for (int32_t z = 0; z < box->depth; z++)
        for (int32_t y = 0; y < box->height; y++) {
            const uint8_t *row = materials + row_offset(&r, y, z);
            uint32_t first = row_number(&r, y, z);
            for (int32_t x = 0; x < box->width; x++)
                dpl_flood_place(flood, first + (uint32_t)x, row[x]);
        }
    return DPL_OK;
}

dpl_status dpl_flood_read_cells(const dpl_flood *flood, const dpl_flood_box *box, uint8_t *materials,
                                ptrdiff_t row_stride, ptrdiff_t slice_stride) {
    rows r;
    DPL_TRY(open_rows(flood, box, materials, 1, row_stride, slice_stride, &r));
    for (int32_t z = 0; z < box->depth; z++)
        for (int32_t y = 0; y < box->height; y++) {
            uint8_t *row = materials + row_offset(&r, y, z);
            const uint8_t *cells = flood->cells + row_number(&r, y, z);
            for (int32_t x = 0; x < box->width; x++)
                row[x] = cells[x] & DPL_CELL_MATERIAL;
        }
    return DPL_OK;
}

/* ---- lights --------------------------------------------------------------------------------------- */

#define MOST_LIGHTS (1u << 28)

static dpl_status check_level(const dpl_flood *flood, const uint16_t level[DPL_FLOOD_MAX_CHANNELS]) {
    return levels_are_good(level)
               ? DPL_OK
               : dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "a level must be 0 .. %d", DPL_FLOOD_FULL);
}

dpl_status dpl_flood_add_light(dpl_flood *flood, int32_t x, int32_t y, int32_t z,
                               const uint16_t level[DPL_FLOOD_MAX_CHANNELS], dpl_flood_light *light) {
    if (!flood || !level || !light)
        return DPL_ERROR_ARGUMENT;
    *light = (dpl_flood_light){0, 0};
    if (!has_cell(flood, x, y, z))
        return no_such_cell(flood, x, y, z);
    DPL_TRY(check_level(flood, level));
    if (flood->lamps.free == DPL_NO_LAMP) {
        if (flood->lamps.count == MOST_LIGHTS)
            return dpl_fail(flood->context, DPL_ERROR_MEMORY, "a world has at most %u lights", MOST_LIGHTS);
        DPL_TRY(dpl_flood_lamps_reserve(flood, flood->lamps.count + 1));
    }
    *light = dpl_flood_lamps_add(flood, dpl_flood_number(flood, x, y, z), dpl_flood_pack(flood, level));
    return DPL_OK;
}

static dpl_status find_light(const dpl_flood *flood, dpl_flood_light light, dpl_flood_lamp **lamp) {
    *lamp = dpl_flood_lamps_find(flood, light);
    return *lamp ? DPL_OK
                 : dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "there is no light %u of generation %u",
                            (unsigned)light.index, (unsigned)light.generation);
}

dpl_status dpl_flood_move_light(dpl_flood *flood, dpl_flood_light light, int32_t x, int32_t y, int32_t z) {
    dpl_flood_lamp *lamp;
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(find_light(flood, light, &lamp));
    if (!has_cell(flood, x, y, z))
        return no_such_cell(flood, x, y, z);
    dpl_flood_lamps_move(flood, lamp, dpl_flood_number(flood, x, y, z));
    return DPL_OK;
}

dpl_status dpl_flood_remove_light(dpl_flood *flood, dpl_flood_light light) {
    dpl_flood_lamp *lamp;
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(find_light(flood, light, &lamp));
    dpl_flood_lamps_remove(flood, lamp);
    return DPL_OK;
}

dpl_status dpl_flood_set_sun(dpl_flood *flood, const uint16_t level[DPL_FLOOD_MAX_CHANNELS]) {
    if (!flood || !level)
        return DPL_ERROR_ARGUMENT;
    if (flood->desc.sun == DPL_FLOOD_SUN_NONE)
        return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "this world has no sun");
    DPL_TRY(check_level(flood, level));
    uint64_t lanes = dpl_flood_pack(flood, level);
    memcpy(flood->desc.sun_level, level, sizeof flood->desc.sun_level);
    if (lanes != flood->sun_level)
        flood->stale = true;
    flood->sun_level = lanes;
    return DPL_OK;
}

/* ---- reading light -------------------------------------------------------------------------------- */

dpl_status dpl_flood_read_levels(const dpl_flood *flood, const dpl_flood_box *box, uint16_t *levels,
                                 ptrdiff_t row_stride, ptrdiff_t slice_stride) {
    rows r;
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    int channels = flood->desc.channels;
    DPL_TRY(open_rows(flood, box, levels, (size_t)channels * sizeof *levels, row_stride, slice_stride, &r));
    for (int32_t z = 0; z < box->depth; z++)
        for (int32_t y = 0; y < box->height; y++) {
            uint16_t *row = levels + row_offset(&r, y, z) / (ptrdiff_t)sizeof *levels;
            const uint64_t *words = flood->levels + row_number(&r, y, z);
            for (int32_t x = 0; x < box->width; x++)
                for (int c = 0; c < channels; c++)
                    *row++ = (uint16_t)dpl_lanes_read(words[x], c);
        }
    return DPL_OK;
}

/* [channels - 1][channel]: what a channel adds to red, green and blue when the caller does not say. */
static const float default_weights[4][4][3] = {
    {{1, 1, 1}},
    {{1, 1, 1}, {1, 1, 1}},
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
};

static dpl_status check_light_output(const dpl_flood *flood, int32_t z, const float (*weights)[3],
                                     dpl_output *output) {
    if (!is_within(z, 0, flood->desc.depth - 1))
        return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "the world has no z of %d", (int)z);
    for (int i = 0; weights && i < flood->desc.channels * 3; i++)
        if (!isfinite(weights[i / 3][i % 3]))
            return dpl_fail(flood->context, DPL_ERROR_ARGUMENT, "weights must be finite");
    dpl_output_rules rules = {flood->desc.width, flood->desc.height, "world", false};
    return dpl_output_check(flood->context, &rules, output);
}

static void read_row(const uint64_t *words, int32_t width, int channels, const float (*weights)[3],
                     float *row, int32_t floats) {
    for (int32_t x = 0; x < width; x++, row += floats) {
        float rgb[3] = {0, 0, 0};
        for (int c = 0; c < channels; c++) {
            float share = (float)dpl_lanes_read(words[x], c) / DPL_FLOOD_FULL;
            for (int k = 0; k < 3; k++)
                rgb[k] += share * weights[c][k];
        }
        memcpy(row, rgb, sizeof rgb);
        if (floats == 4)
            row[3] = 1;
    }
}

dpl_status dpl_flood_read_light(const dpl_flood *flood, int32_t z, const float (*weights)[3],
                                const dpl_output *given) {
    if (!flood || !given)
        return DPL_ERROR_ARGUMENT;
    dpl_output output = *given;
    DPL_TRY(check_light_output(flood, z, weights, &output));
    int channels = flood->desc.channels;
    for (int32_t y = 0; y < flood->desc.height; y++)
        read_row(flood->levels + dpl_flood_number(flood, 0, y, z), flood->desc.width, channels,
                 weights ? weights : default_weights[channels - 1],
                 (float *)(void *)((char *)output.data + output.row_stride * y), output.channels);
    return DPL_OK;
}

/* ---- telling -------------------------------------------------------------------------------------- */

void dpl_flood_read_stats(const dpl_flood *flood, dpl_flood_stats *stats) {
    if (!stats)
        return;
    memset(stats, 0, sizeof *stats);
    if (!flood)
        return;
    *stats = flood->stats;
    stats->memory_bytes = flood->memory_bytes;
}

const char *dpl_flood_falloff_name(dpl_flood_falloff falloff) {
    static const char *const names[] = {"subtractive", "multiplicative", "euclidean", "round"};
    return is_within((int32_t)falloff, 0, 3) ? names[falloff] : "?";
}
