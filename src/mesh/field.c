/* Distances to a mesh: where the samples lie, and the order of the work. Called by src/api/mesh.c. */
#include "mesh/field.h"

#include <math.h>

static float extent(const dpl_mesh_facts *facts, int axis) {
    return facts->high[axis] - facts->low[axis];
}

/* As fine as the resolution allows along the longest side, with the margin on both. */
static void place_grid(dpl_mesh_field *field, const dpl_mesh_facts *facts) {
    dpl_mesh_grid *grid = &field->grid;
    int32_t steps = field->desc.resolution - 1 - 2 * field->desc.margin;
    float longest = fmaxf(extent(facts, 0), fmaxf(extent(facts, 1), extent(facts, 2)));
    grid->spacing = longest / (float)steps;
    for (int axis = 0; axis < 3; axis++) {
        int32_t needed = (int32_t)ceilf(extent(facts, axis) / grid->spacing - 1e-3f);
        needed = needed < steps ? needed : steps;
        grid->size[axis] = needed + 1 + 2 * field->desc.margin;
        float middle = 0.5f * (facts->low[axis] + facts->high[axis]);
        grid->origin[axis] = middle - 0.5f * grid->spacing * (float)(grid->size[axis] - 1);
    }
}

dpl_status dpl_mesh_field_fill(dpl_mesh_field *field, const dpl_mesh *mesh) {
    field->measured = false;
    place_grid(field, &mesh->facts);
    const int32_t *size = field->grid.size;
    size_t samples = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
    DPL_TRY(dpl_buffer_reserve(field->context, &field->distance, samples, sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(field->context, &field->cells, samples, sizeof(dpl_mesh_cell)));
    DPL_TRY(dpl_mesh_field_fill_band(field, mesh));
    DPL_TRY(dpl_mesh_field_sweep(field, mesh));
    DPL_TRY(dpl_mesh_field_sign_closed(field, mesh));
    DPL_TRY(dpl_mesh_field_sign_open(field, mesh));
    field->measured = true;
    return DPL_OK;
}

void dpl_mesh_field_free(dpl_mesh_field *field) {
    dpl_buffer *buffers[] = {&field->distance, &field->cells,  &field->lines,
                             &field->open,     &field->bounds, &field->dipoles};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(field->context, buffers[i]);
    dpl_bvh_free(field->context, &field->tree);
}
