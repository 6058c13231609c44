/* The public face of a field: argument checks, making and freeing, reading back. */
#include "field/field.h"

#include "base/desc.h"

/* ---- making and freeing --------------------------------------------------------------------------- */

static bool colour_is_good(const float rgb[3], float highest) {
    for (int c = 0; c < 3; c++)
        if (!(rgb[c] >= 0.0f && rgb[c] <= highest))
            return false;
    return true;
}

#define HIGHEST_RADIANCE 3e38f

static dpl_status allocate_planes(dpl_field *field, bool surface) {
    size_t pixels = dpl_field_pixels(field);
    if (surface)
        DPL_TRY(dpl_buffer_reserve(field->context, &field->surface, pixels, 4 * sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(field->context, &field->kind, pixels, 1));
    return dpl_buffer_reserve(field->context, &field->emission, pixels, 4 * sizeof(float));
}

dpl_status dpl_field_create(dpl_context *context, const dpl_field_desc *desc, dpl_field **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the field desc was not made by dpl_field_desc_default()");
    if (desc->width < 1 || desc->height < 1 || desc->width > DPL_MAX_SIZE || desc->height > DPL_MAX_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE, "a field is 1 .. %d pixels a side, not %d x %d",
                        DPL_MAX_SIZE, desc->width, desc->height);
    if (!colour_is_good(desc->sky, HIGHEST_RADIANCE))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the sky must be finite and not negative");
    dpl_field *field = dpl_allocate(context, 1, sizeof *field);
    if (!field)
        return DPL_ERROR_MEMORY;
    memset(field, 0, sizeof *field);
    field->context = context;
    field->width = desc->width;
    field->height = desc->height;
    memcpy(field->sky, desc->sky, sizeof field->sky);
    dpl_status status = allocate_planes(field, desc->keep_shape_distance != 0);
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
                             &field->clearance, &field->surface,  &field->scratch};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(context, buffers[i]);
    dpl_release(context, field, 1, sizeof *field);
}

int32_t dpl_field_width(const dpl_field *field) {
    return field->width;
}

int32_t dpl_field_height(const dpl_field *field) {
    return field->height;
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
    memcpy(field->sky, sky, sizeof field->sky);
    return DPL_OK;
}

/* ---- shapes --------------------------------------------------------------------------------------- */

/* Coordinates beyond this are a mistake, and would make row and column numbers meaningless. */
#define HIGHEST_COORDINATE 1e9

static bool numbers_are_good(const double *numbers, int count) {
    for (int i = 0; i < count; i++)
        if (!(fabs(numbers[i]) <= HIGHEST_COORDINATE))
            return false;
    return true;
}

/* What is wrong with a shape's geometry, or NULL. */
static const char *geometry_fault(const dpl_shape *shape) {
    static const char range[] = "coordinates must be finite and within 1e9";
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        if (!numbers_are_good(shape->disc.center, 2))
            return range;
        return shape->disc.radius >= 0.0 && shape->disc.radius <= HIGHEST_COORDINATE
                   ? NULL
                   : "the radius must be finite and not negative";
    case DPL_SHAPE_BOX:
        if (!numbers_are_good(shape->box.center, 2) || !numbers_are_good(&shape->box.angle, 1) ||
            !numbers_are_good(shape->box.half, 2))
            return range;
        return shape->box.half[0] >= 0.0 && shape->box.half[1] >= 0.0 ? NULL
                                                                      : "half sizes must not be negative";
    case DPL_SHAPE_POLYGON:
        if (!shape->polygon.points || shape->polygon.count < 3)
            return "a polygon has at least 3 points";
        for (int32_t i = 0; i < shape->polygon.count; i++)
            if (!numbers_are_good(shape->polygon.points[i], 2))
                return range;
        return NULL;
    case DPL_SHAPE_SEGMENT:
        if (!numbers_are_good(shape->segment.from, 2) || !numbers_are_good(shape->segment.to, 2))
            return range;
        return shape->segment.width >= 0.0 && shape->segment.width <= HIGHEST_COORDINATE
                   ? NULL
                   : "the width must be finite and not negative";
    }
    return "there is no such kind of shape";
}

static const char *material_fault(const dpl_material *material) {
    if (!colour_is_good(material->emission, HIGHEST_RADIANCE))
        return "emission must be finite and not negative";
    if (!colour_is_good(material->extinction, INFINITY))
        return "extinction must not be negative or NaN";
    if (!colour_is_good(material->albedo, 1.0f))
        return "albedo must be 0 .. 1";
    return NULL;
}

dpl_status dpl_field_draw_shapes(dpl_field *field, const dpl_shape *shapes, int32_t count) {
    if (!field || count < 0 || (!shapes && count > 0))
        return DPL_ERROR_ARGUMENT;
    for (int32_t i = 0; i < count; i++) {
        const char *fault = geometry_fault(&shapes[i]);
        if (!fault)
            fault = material_fault(&shapes[i].material);
        if (fault)
            return dpl_fail(field->context, DPL_ERROR_ARGUMENT, "shape %d: %s", i, fault);
    }
    DPL_TRY(dpl_field_rasterise(field, shapes, count));
    return dpl_field_add_surface(field, shapes, count);
}

/* ---- layers --------------------------------------------------------------------------------------- */

static size_t channel_bytes(dpl_format format) {
    return format == DPL_FORMAT_F32 ? sizeof(float) : 1;
}

/* Checks one picture of a layer against the size of the first, and makes its stride explicit. */
static dpl_status check_pixels(dpl_context *context, dpl_pixels *p, const char *name,
                               const dpl_pixels *first) {
    if (!p->data)
        return DPL_OK;
    if (p->format != DPL_FORMAT_F32 && p->format != DPL_FORMAT_UNORM8 && p->format != DPL_FORMAT_SRGB8)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s has no known format", name);
    if (p->channels < 1 || p->channels > 4)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s has %d channels, not 1 .. 4", name, p->channels);
    if (p->width < 1 || p->height < 1 || p->width > DPL_MAX_SIZE || p->height > DPL_MAX_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE, "%s is %d x %d, not 1 .. %d a side", name, p->width,
                        p->height, DPL_MAX_SIZE);
    if (p->width != first->width || p->height != first->height)
        return dpl_fail(context, DPL_ERROR_SIZE, "%s is %d x %d, another picture of the layer %d x %d", name,
                        p->width, p->height, first->width, first->height);
    ptrdiff_t packed = (ptrdiff_t)((size_t)p->width * (size_t)p->channels * channel_bytes(p->format));
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
    if (row_stride == 0)
        row_stride = (ptrdiff_t)((size_t)field->width * sizeof(float));
    for (int32_t y = 0; y < field->height; y++) {
        float *row = (float *)(void *)((char *)distance + row_stride * y);
        for (int32_t x = 0; x < field->width; x++, clearance++)
            row[x] = *clearance > 0.0f ? *clearance : 0.0f;
    }
    return DPL_OK;
}

dpl_status dpl_field_read_opaque(const dpl_field *field, uint8_t *opaque, ptrdiff_t row_stride) {
    if (!field || !opaque)
        return DPL_ERROR_ARGUMENT;
    const uint8_t *kind = field->kind.data;
    if (row_stride == 0)
        row_stride = field->width;
    for (int32_t y = 0; y < field->height; y++)
        for (int32_t x = 0; x < field->width; x++, kind++)
            opaque[row_stride * y + x] = *kind == DPL_PIXEL_OPAQUE;
    return DPL_OK;
}

dpl_status dpl_field_read_pixel(const dpl_field *field, int32_t x, int32_t y, dpl_material *material) {
    if (!field || !material || x < 0 || y < 0 || x >= field->width || y >= field->height)
        return DPL_ERROR_ARGUMENT;
    size_t cell = (size_t)y * (size_t)field->width + (size_t)x;
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
