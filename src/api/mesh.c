/* The public face of meshes and of the distances to them: argument checks, making and freeing. */
#include "base/desc.h"
#include "mesh/field.h"
#include "mesh/sample.h"

/* ---- meshes --------------------------------------------------------------------------------------- */

static dpl_status check_vertices(dpl_context *context, const dpl_mesh_desc *desc) {
    for (int32_t i = 0; i < desc->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!(fabsf(desc->vertices[i][axis]) <= DPL_MAX_MESH_COORDINATE))
                return dpl_fail(context, DPL_ERROR_ARGUMENT,
                                "corner %d: coordinates must be finite and within 1e9", i);
    return DPL_OK;
}

static bool spans_area(const dpl_mesh_desc *desc, int32_t i) {
    double u[3], v[3];
    for (int axis = 0; axis < 3; axis++) {
        double from = (double)desc->vertices[desc->indices[i][0]][axis];
        u[axis] = (double)desc->vertices[desc->indices[i][1]][axis] - from;
        v[axis] = (double)desc->vertices[desc->indices[i][2]][axis] - from;
    }
    double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return x * x + y * y + z * z > 0.0;
}

static dpl_status check_triangles(dpl_context *context, const dpl_mesh_desc *desc) {
    bool any = false;
    for (int32_t i = 0; i < desc->triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            if (desc->indices[i][k] < 0 || desc->indices[i][k] >= desc->vertex_count)
                return dpl_fail(context, DPL_ERROR_ARGUMENT, "triangle %d: there is no corner %d among %d", i,
                                desc->indices[i][k], desc->vertex_count);
        any = any || spans_area(desc, i);
    }
    return any ? DPL_OK : dpl_fail(context, DPL_ERROR_ARGUMENT, "no triangle of the mesh has an area");
}

static dpl_status check_mesh(dpl_context *context, const dpl_mesh_desc *desc) {
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the mesh desc was not made by dpl_mesh_desc_default()");
    if (desc->triangle_count < 1 || desc->triangle_count > DPL_MAX_MESH_TRIANGLES || desc->vertex_count < 0)
        return dpl_fail(context, DPL_ERROR_SIZE, "a mesh has 1 .. %d triangles, not %d",
                        DPL_MAX_MESH_TRIANGLES, desc->triangle_count);
    if (!desc->vertices || !desc->indices)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "a mesh needs corners and triangles");
    DPL_TRY(check_vertices(context, desc));
    return check_triangles(context, desc);
}

dpl_status dpl_mesh_create(dpl_context *context, const dpl_mesh_desc *desc, dpl_mesh **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    dpl_mesh *mesh = dpl_allocate(context, 1, sizeof *mesh);
    if (!mesh)
        return DPL_ERROR_MEMORY;
    memset(mesh, 0, sizeof *mesh);
    mesh->context = context;
    dpl_status status = dpl_mesh_set(mesh, desc);
    if (status != DPL_OK)
        dpl_mesh_destroy(mesh);
    else
        *out = mesh;
    return status;
}

dpl_status dpl_mesh_set(dpl_mesh *mesh, const dpl_mesh_desc *desc) {
    if (!mesh || !desc)
        return DPL_ERROR_ARGUMENT;
    memset(&mesh->facts, 0, sizeof mesh->facts);
    DPL_TRY(check_mesh(mesh->context, desc));
    return dpl_mesh_keep(mesh, desc);
}

void dpl_mesh_destroy(dpl_mesh *mesh) {
    if (!mesh)
        return;
    dpl_mesh_free(mesh);
    dpl_release(mesh->context, mesh, 1, sizeof *mesh);
}

void dpl_mesh_read_facts(const dpl_mesh *mesh, dpl_mesh_facts *facts) {
    *facts = mesh->facts;
}

/* ---- distances ------------------------------------------------------------------------------------ */

static dpl_status check_field(dpl_context *context, const dpl_mesh_field_desc *desc) {
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC,
                        "the desc of distances was not made by dpl_mesh_field_desc_default()");
    if (desc->resolution < 8 || desc->resolution > DPL_MAX_MESH_RESOLUTION)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the resolution is 8 .. %d samples, not %d",
                        DPL_MAX_MESH_RESOLUTION, desc->resolution);
    if (desc->margin < 1 || desc->margin > desc->resolution / 4)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the margin is 1 .. %d samples, not %d",
                        desc->resolution / 4, desc->margin);
    if (desc->band < 1 || desc->band > 8)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the band is 1 .. 8 spacings, not %d", desc->band);
    return DPL_OK;
}

dpl_status dpl_mesh_field_create(dpl_context *context, const dpl_mesh_field_desc *desc,
                                 dpl_mesh_field **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    DPL_TRY(check_field(context, desc));
    dpl_mesh_field *field = dpl_allocate(context, 1, sizeof *field);
    if (!field)
        return DPL_ERROR_MEMORY;
    memset(field, 0, sizeof *field);
    field->context = context;
    field->desc = *desc;
    *out = field;
    return DPL_OK;
}

dpl_status dpl_mesh_field_measure(dpl_mesh_field *field, const dpl_mesh *mesh) {
    if (!field || !mesh)
        return DPL_ERROR_ARGUMENT;
    field->measured = false;
    if (mesh->facts.triangles == 0)
        return dpl_fail(field->context, DPL_ERROR_ARGUMENT, "the mesh has no triangles");
    return dpl_mesh_field_fill(field, mesh);
}

void dpl_mesh_field_destroy(dpl_mesh_field *field) {
    if (!field)
        return;
    dpl_mesh_field_free(field);
    dpl_release(field->context, field, 1, sizeof *field);
}

dpl_mesh_grid dpl_mesh_field_grid(const dpl_mesh_field *field) {
    return field->measured ? field->grid : (dpl_mesh_grid){.spacing = 0.0f};
}

const float *dpl_mesh_field_samples(const dpl_mesh_field *field) {
    return field->measured ? field->distance.data : NULL;
}

float dpl_mesh_field_distance(const dpl_mesh_field *field, const float point[3]) {
    const dpl_mesh_grid *grid = &field->grid;
    dpl_mesh_lattice lattice = dpl_mesh_lattice_of(grid, field->distance.data);
    float place[3], inside[3];
    for (int axis = 0; axis < 3; axis++)
        place[axis] = (point[axis] - grid->origin[axis]) / grid->spacing;
    float away = dpl_mesh_lattice_enter(&lattice, place, inside);
    return dpl_mesh_lattice_at(&lattice, inside) + away * grid->spacing;
}
