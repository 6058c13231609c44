/* The public face of a field: argument checks, making and freeing, reading back. */
#include "field/field.h"

#include "api/shape_fault.h"
#include "base/desc.h"
#include "base/layout.h"

/* ---- making and freeing --------------------------------------------------------------------------- */

static dpl_status allocate_planes(dpl_field *field, bool surface) {
    size_t pixels = dpl_field_pixels(field);
    if (surface)
        DPL_TRY(dpl_buffer_reserve(field->context, &field->surface, pixels, 4 * sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(field->context, &field->kind, pixels, 1));
    return dpl_buffer_reserve(field->context, &field->emission, pixels, 4 * sizeof(float));
}

static dpl_status check_size(dpl_context *context, const dpl_field_desc *desc) {
    if (desc->width < 1 || desc->height < 1 || desc->width > DPL_MAX_SIZE || desc->height > DPL_MAX_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE, "a field is 1 .. %d pixels a side, not %d x %d",
                        DPL_MAX_SIZE, desc->width, desc->height);
    if (desc->margin < 0 || desc->margin > DPL_MAX_MARGIN)
        return dpl_fail(context, DPL_ERROR_SIZE, "the margin is 0 .. %d pixels, not %d", DPL_MAX_MARGIN,
                        desc->margin);
    if (desc->width + 2 * desc->margin > DPL_MAX_SIZE || desc->height + 2 * desc->margin > DPL_MAX_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE,
                        "with a margin of %d, %d x %d pixels are more than %d a side", desc->margin,
                        desc->width, desc->height, DPL_MAX_SIZE);
    return DPL_OK;
}

dpl_status dpl_field_create(dpl_context *context, const dpl_field_desc *desc, dpl_field **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the field desc was not made by dpl_field_desc_default()");
    DPL_TRY(check_size(context, desc));
    if (!colour_is_good(desc->sky, HIGHEST_RADIANCE))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the sky must be finite and not negative");
    dpl_field *field = dpl_allocate(context, 1, sizeof *field);
    if (!field)
        return DPL_ERROR_MEMORY;
    memset(field, 0, sizeof *field);
    field->context = context;
    field->width = desc->width + 2 * desc->margin;
    field->height = desc->height + 2 * desc->margin;
    field->margin = desc->margin;
    dpl_status status = allocate_planes(field, desc->keep_shape_distance != 0);
    if (status == DPL_OK)
        status = dpl_field_set_sky(field, desc->sky);
    if (status != DPL_OK) {
        dpl_field_destroy(field);
        return status;
    }
    dpl_field_clear(field);
    *out = field;
    return DPL_OK;
}

void dpl_field_destroy(dpl_field *field) {
    if (!field)
        return;
    dpl_context *context = field->context;
    dpl_buffer *buffers[] = {&field->kind,      &field->emission, &field->extinction, &field->albedo,
                             &field->clearance, &field->surface,  &field->scratch,    &field->sky};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(context, buffers[i]);
    dpl_release(context, field, 1, sizeof *field);
}

int32_t dpl_field_width(const dpl_field *field) {
    return dpl_field_picture_width(field);
}

int32_t dpl_field_height(const dpl_field *field) {
    return dpl_field_picture_height(field);
}

int32_t dpl_field_margin(const dpl_field *field) {
    return field->margin;
}

void dpl_field_clear(dpl_field *field) {
    size_t pixels = dpl_field_pixels(field);
    memset(field->kind.data, DPL_PIXEL_EMPTY, pixels);
    memset(field->emission.data, 0, pixels * 4 * sizeof(float));
    if (field->albedo.data)
        memset(field->albedo.data, 0, pixels * 4 * sizeof(float));
    dpl_field_clear_surface(field);
    dpl_field_touch(field);
}

dpl_status dpl_field_set_sky(dpl_field *field, const float sky[3]) {
    if (!field || !sky)
        return DPL_ERROR_ARGUMENT;
    if (!colour_is_good(sky, HIGHEST_RADIANCE))
        return dpl_fail(field->context, DPL_ERROR_ARGUMENT, "the sky must be finite and not negative");
    float one[1][3];
    memcpy(one[0], sky, sizeof one[0]);
    return dpl_field_hold_sky(field, (const float(*)[3])one, 1);
}

dpl_status dpl_field_set_sky_ring(dpl_field *field, const float (*rgb)[3], int32_t count) {
    if (!field || !rgb)
        return DPL_ERROR_ARGUMENT;
    if (count < 1 || count > DPL_MAX_SKY_SECTORS)
        return dpl_fail(field->context, DPL_ERROR_ARGUMENT, "a sky has 1 .. %d sectors, not %d",
                        DPL_MAX_SKY_SECTORS, count);
    for (int32_t k = 0; k < count; k++)
        if (!colour_is_good(rgb[k], HIGHEST_RADIANCE))
            return dpl_fail(field->context, DPL_ERROR_ARGUMENT,
                            "sector %d of the sky must be finite and not negative", k);
    return dpl_field_hold_sky(field, rgb, count);
}

/* ---- shapes --------------------------------------------------------------------------------------- */

dpl_status dpl_field_draw_shapes(dpl_field *field, const dpl_shape *shapes, int32_t count) {
    if (!field || count < 0 || (!shapes && count > 0))
        return DPL_ERROR_ARGUMENT;
    for (int32_t i = 0; i < count; i++) {
        const char *fault = dpl_shape_fault(&shapes[i]);
        if (fault)
            return dpl_fail(field->context, DPL_ERROR_ARGUMENT, "shape %d: %s", i, fault);
    }
    DPL_TRY(dpl_field_rasterise(field, shapes, count));
    return dpl_field_add_surface(field, shapes, count);
}

/* ---- layers --------------------------------------------------------------------------------------- */

/* Checks one picture of a layer against the size of the first, and makes its stride explicit. */
static dpl_status check_pixels(dpl_context *context, dpl_pixels *p, const char *name,
                               const dpl_pixels *first) {
    if (!p->data)
        return DPL_OK;
    if (dpl_format_bytes(p->format) == 0)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s has no known format", name);
    if (p->channels < 1 || p->channels > 4)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s has %d channels, not 1 .. 4", name, p->channels);
    if (p->width < 1 || p->height < 1 || p->width > DPL_MAX_SIZE || p->height > DPL_MAX_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE, "%s is %d x %d, not 1 .. %d a side", name, p->width,
                        p->height, DPL_MAX_SIZE);
    if (p->width != first->width || p->height != first->height)
        return dpl_fail(context, DPL_ERROR_SIZE, "%s is %d x %d, another picture of the layer %d x %d", name,
                        p->width, p->height, first->width, first->height);
    ptrdiff_t packed = (ptrdiff_t)((size_t)p->width * (size_t)p->channels * dpl_format_bytes(p->format));
    if (p->row_stride == 0)
        p->row_stride = packed;
    if (p->row_stride < packed && -p->row_stride < packed)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the rows of %s overlap", name);
    return DPL_OK;
}

dpl_status dpl_field_draw_layer(dpl_field *field, const dpl_layer *given) {
    if (!field || !given)
        return DPL_ERROR_ARGUMENT;
    dpl_context *context = field->context;
    if (!DPL_DESC_IS_GOOD(given))
        return dpl_fail(context, DPL_ERROR_DESC, "the layer was not made by dpl_layer_default()");
    if (field->surface.data)
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "a field that keeps the distance to shapes takes no layers");
    dpl_layer layer = *given;
    const dpl_pixels *first = layer.emission.data     ? &given->emission
                              : layer.extinction.data ? &given->extinction
                                                      : &given->albedo;
    if (!layer.emission.data && !layer.extinction.data)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "a layer needs a picture of emission or extinction");
    if (!(layer.intensity >= 0.0f && layer.intensity <= HIGHEST_RADIANCE))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the intensity must be finite and not negative");
    DPL_TRY(check_pixels(context, &layer.emission, "emission", first));
    DPL_TRY(check_pixels(context, &layer.extinction, "extinction", first));
    DPL_TRY(check_pixels(context, &layer.albedo, "albedo", first));
    return dpl_field_lay(field, &layer);
}

/* ---- reading back --------------------------------------------------------------------------------- */

dpl_status dpl_field_read_distance(dpl_field *field, float *distance, ptrdiff_t row_stride) {
    if (!field || !distance)
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(dpl_field_measure(field));
    const float *clearance = field->clearance.data;
    int32_t width = dpl_field_picture_width(field);
    if (row_stride == 0)
        row_stride = (ptrdiff_t)((size_t)width * sizeof(float));
    for (int32_t y = 0; y < dpl_field_picture_height(field); y++) {
        float *row = (float *)(void *)((char *)distance + row_stride * y);
        const float *from = clearance + dpl_field_picture_cell(field, 0, y);
        for (int32_t x = 0; x < width; x++)
            row[x] = from[x] > 0.0f ? from[x] : 0.0f;
    }
    return DPL_OK;
}

dpl_status dpl_field_read_opaque(const dpl_field *field, uint8_t *opaque, ptrdiff_t row_stride) {
    if (!field || !opaque)
        return DPL_ERROR_ARGUMENT;
    const uint8_t *kind = field->kind.data;
    if (row_stride == 0)
        row_stride = dpl_field_picture_width(field);
    for (int32_t y = 0; y < dpl_field_picture_height(field); y++)
        for (int32_t x = 0; x < dpl_field_picture_width(field); x++)
            opaque[row_stride * y + x] = kind[dpl_field_picture_cell(field, x, y)] == DPL_PIXEL_OPAQUE;
    return DPL_OK;
}

dpl_status dpl_field_read_pixel(const dpl_field *field, int32_t x, int32_t y, dpl_material *material) {
    if (!field || !material || x < 0 || y < 0 || x >= dpl_field_picture_width(field) ||
        y >= dpl_field_picture_height(field))
        return DPL_ERROR_ARGUMENT;
    size_t cell = dpl_field_picture_cell(field, x, y);
    const float(*emission)[4] = field->emission.data, (*extinction)[4] = field->extinction.data;
    const float(*albedo)[4] = field->albedo.data;
    uint8_t kind = ((const uint8_t *)field->kind.data)[cell];
    memset(material, 0, sizeof *material);
    for (int c = 0; c < 3; c++) {
        material->emission[c] = emission[cell][c];
        if (kind == DPL_PIXEL_OPAQUE)
            material->extinction[c] = INFINITY;
        else if (kind == DPL_PIXEL_MEDIUM)
            material->extinction[c] =
                extinction[cell][c] < DPL_EXTINCTION_MAX ? extinction[cell][c] : INFINITY;
        if (albedo)
            material->albedo[c] = albedo[cell][c];
    }
    return DPL_OK;
}
