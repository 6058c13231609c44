/* Keeps the triangles of a mesh, see mesh.h. Called by src/api/mesh.c. */
#include "mesh/mesh.h"

static void copy_corners(dpl_mesh *mesh, const dpl_mesh_desc *desc) {
    dpl_mesh_corners *corners = mesh->corners.data;
    for (int32_t i = 0; i < desc->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++) /* minus zero and zero are one place */
                corners[i][k][axis] = desc->vertices[desc->indices[i][k]][axis] + 0.0f;
}

static void measure_extent(dpl_mesh *mesh, int32_t count) {
    const dpl_mesh_corners *corners = dpl_mesh_corners_of(mesh);
    dpl_bounds all = dpl_bounds_empty();
    for (int32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            dpl_bounds_add_point(&all, corners[i][k]);
    memcpy(mesh->facts.low, all.low, sizeof all.low);
    memcpy(mesh->facts.high, all.high, sizeof all.high);
}

static dpl_status keep(dpl_mesh *mesh, const dpl_mesh_desc *desc) {
    size_t count = (size_t)desc->triangle_count;
    DPL_TRY(dpl_buffer_reserve(mesh->context, &mesh->corners, count, sizeof(dpl_mesh_corners)));
    DPL_TRY(dpl_buffer_reserve(mesh->context, &mesh->signs, count, 1));
    copy_corners(mesh, desc);
    mesh->facts.triangles = desc->triangle_count;
    measure_extent(mesh, desc->triangle_count);
    DPL_TRY(dpl_mesh_sort_parts(mesh));
    dpl_triangles_source source = {.vertices = (const float(*)[3])mesh->corners.data,
                                   .count = desc->triangle_count};
    return dpl_triangles_set(mesh->context, &mesh->triangles, &source, true);
}

dpl_status dpl_mesh_keep(dpl_mesh *mesh, const dpl_mesh_desc *desc) {
    memset(&mesh->facts, 0, sizeof mesh->facts);
    dpl_status status = keep(mesh, desc);
    if (status != DPL_OK)
        memset(&mesh->facts, 0, sizeof mesh->facts);
    return status;
}

void dpl_mesh_free(dpl_mesh *mesh) {
    dpl_triangles_free(mesh->context, &mesh->triangles);
    dpl_buffer_free(mesh->context, &mesh->corners);
    dpl_buffer_free(mesh->context, &mesh->signs);
    dpl_buffer_free(mesh->context, &mesh->scratch);
}
