/* Built-in shapes: sphere, box, plane. Triangles run counter-clockwise seen from outside. */
#include "mesh_data.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* The ring at an angle from the pole, `around` corners of it. */
static void add_ring(dpl_mesh_data *data, const dpl_mesh_transform *transform, double angle, int32_t around) {
    for (int32_t j = 0; j < around; j++) {
        double turn = 2.0 * PI * j / around;
        dpl_mesh_data_add_vertex(data, transform, sin(angle) * sin(turn), cos(angle), sin(angle) * cos(turn));
    }
}

bool dpl_mesh_data_add_sphere(dpl_mesh_data *data, const dpl_mesh_transform *transform, int32_t rings,
                              dpl_error *error) {
    int32_t around = 2 * rings;
    if (!dpl_mesh_data_reserve(data, 2 + (int64_t)(rings - 1) * around, 2 * (int64_t)(rings - 1) * around,
                               error))
        return false;
    int32_t top = dpl_mesh_data_add_vertex(data, transform, 0.0, 1.0, 0.0);
    int32_t first = data->vertex_count;
    for (int32_t i = 1; i < rings; i++)
        add_ring(data, transform, PI * i / rings, around);
    int32_t bottom = dpl_mesh_data_add_vertex(data, transform, 0.0, -1.0, 0.0);
    int32_t last = bottom - around;
    for (int32_t j = 0; j < around; j++) {
        int32_t next = (j + 1) % around;
        dpl_mesh_data_add_triangle(data, top, first + j, first + next);
        dpl_mesh_data_add_triangle(data, bottom, last + next, last + j);
        for (int32_t ring = first; ring < last; ring += around) {
            dpl_mesh_data_add_triangle(data, ring + j, ring + around + j, ring + around + next);
            dpl_mesh_data_add_triangle(data, ring + j, ring + around + next, ring + next);
        }
    }
    return true;
}

bool dpl_mesh_data_add_box(dpl_mesh_data *data, const dpl_mesh_transform *transform, dpl_error *error) {
    /* Corners have bits x, y, z; each face by its four corners. */
    static const int faces[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                    {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
    int32_t first = data->vertex_count;
    if (!dpl_mesh_data_reserve(data, 8, 12, error))
        return false;
    for (int corner = 0; corner < 8; corner++)
        dpl_mesh_data_add_vertex(data, transform, corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0,
                                 corner & 4 ? 1.0 : -1.0);
    for (int face = 0; face < 6; face++) {
        const int *c = faces[face];
        dpl_mesh_data_add_triangle(data, first + c[0], first + c[1], first + c[2]);
        dpl_mesh_data_add_triangle(data, first + c[0], first + c[2], first + c[3]);
    }
    return true;
}

bool dpl_mesh_data_add_plane(dpl_mesh_data *data, const dpl_mesh_transform *transform, dpl_error *error) {
    if (!dpl_mesh_data_reserve(data, 4, 2, error))
        return false;
    int32_t first = dpl_mesh_data_add_vertex(data, transform, -1.0, 0.0, -1.0);
    dpl_mesh_data_add_vertex(data, transform, -1.0, 0.0, 1.0);
    dpl_mesh_data_add_vertex(data, transform, 1.0, 0.0, 1.0);
    dpl_mesh_data_add_vertex(data, transform, 1.0, 0.0, -1.0);
    dpl_mesh_data_add_triangle(data, first, first + 1, first + 2);
    dpl_mesh_data_add_triangle(data, first, first + 2, first + 3);
    return true;
}
