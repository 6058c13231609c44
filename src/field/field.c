/* Planes of a field and what one pixel is. Called by the drawing files of this room and by solvers. */
#include "field/field.h"

void dpl_field_touch(dpl_field *field) {
    field->measured = false;
    field->revision = ++field->context->last_revision;
}

uint8_t dpl_material_kind(const dpl_material *material) {
    return dpl_extinction_kind(material->extinction);
}

bool dpl_material_has_albedo(const dpl_material *material) {
    return material->albedo[0] > 0.0f || material->albedo[1] > 0.0f || material->albedo[2] > 0.0f;
}

static dpl_status hold_plane(dpl_field *field, dpl_buffer *plane) {
    if (plane->data)
        return DPL_OK;
    DPL_TRY(dpl_buffer_reserve(field->context, plane, dpl_field_pixels(field), 4 * sizeof(float)));
    memset(plane->data, 0, plane->bytes);
    return DPL_OK;
}

dpl_status dpl_field_hold_media(dpl_field *field) {
    return hold_plane(field, &field->extinction);
}

dpl_status dpl_field_hold_albedo(dpl_field *field) {
    return hold_plane(field, &field->albedo);
}

void dpl_field_put(dpl_field *field, size_t cell, const dpl_material *material) {
    uint8_t kind = dpl_material_kind(material);
    float(*emission)[4] = field->emission.data, (*extinction)[4] = field->extinction.data;
    float(*albedo)[4] = field->albedo.data;
    ((uint8_t *)field->kind.data)[cell] = kind;
    for (int c = 0; c < 3; c++) {
        emission[cell][c] = kind == DPL_PIXEL_EMPTY ? 0.0f : material->emission[c];
        if (kind == DPL_PIXEL_MEDIUM)
            extinction[cell][c] = fminf(material->extinction[c], DPL_EXTINCTION_MAX);
        if (albedo)
            albedo[cell][c] = material->albedo[c];
    }
}

dpl_grid dpl_field_grid(const dpl_field *field) {
    return (dpl_grid){
        .width = field->width,
        .height = field->height,
        .clearance = field->clearance.data,
        .emission = field->emission.data,
        .extinction = field->extinction.data,
        .surface = field->surface.data,
    };
}
