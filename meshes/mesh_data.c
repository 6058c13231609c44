/* Memory and transforms of growing triangles, see mesh_data.h. */
#include "mesh_data.h"

#include <math.h>
#include <stdlib.h>

void dpl_mesh_data_free(dpl_mesh_data *data) {
    free(data->vertices);
    free(data->indices);
    *data = (dpl_mesh_data){0};
}

dpl_mesh_desc dpl_mesh_data_desc(const dpl_mesh_data *data) {
    dpl_mesh_desc desc = dpl_mesh_desc_default();
    desc.vertices = (const float(*)[3])data->vertices;
    desc.vertex_count = data->vertex_count;
    desc.indices = (const int32_t(*)[3])data->indices;
    desc.triangle_count = data->triangle_count;
    return desc;
}

/* Room for `needed` entries, at least twice what there was. */
static bool grow(void **memory, int32_t *room, int64_t needed, size_t size, dpl_error *error) {
    if (needed <= *room)
        return true;
    int64_t wanted = needed > 2 * (int64_t)*room ? needed : 2 * (int64_t)*room;
    wanted = wanted < INT32_MAX / 4 ? wanted : INT32_MAX / 4;
    if (needed > wanted)
        return dpl_error_set(error, "a mesh of more than %d corners", INT32_MAX / 4);
    void *larger = realloc(*memory, (size_t)wanted * size);
    if (!larger)
        return dpl_error_set(error, "out of memory");
    *memory = larger;
    *room = (int32_t)wanted;
    return true;
}

bool dpl_mesh_data_reserve(dpl_mesh_data *data, int64_t vertices, int64_t triangles, dpl_error *error) {
    void *corners = data->vertices, *indices = data->indices;
    bool good =
        grow(&corners, &data->vertex_room, data->vertex_count + vertices, sizeof *data->vertices, error);
    data->vertices = corners;
    good = good && grow(&indices, &data->triangle_room, data->triangle_count + triangles,
                        sizeof *data->indices, error);
    data->indices = indices;
    return good;
}

int32_t dpl_mesh_data_add_vertex(dpl_mesh_data *data, const dpl_mesh_transform *transform, double x, double y,
                                 double z) {
    float *to = data->vertices[data->vertex_count];
    for (int axis = 0; axis < 3; axis++) {
        const double *turn = transform->turn[axis];
        to[axis] = (float)(turn[0] * x + turn[1] * y + turn[2] * z + transform->move[axis]);
    }
    return data->vertex_count++;
}

void dpl_mesh_data_add_triangle(dpl_mesh_data *data, int32_t a, int32_t b, int32_t c) {
    int32_t *to = data->indices[data->triangle_count++];
    to[0] = a;
    to[1] = b;
    to[2] = c;
}

dpl_mesh_transform dpl_mesh_transform_none(void) {
    return (dpl_mesh_transform){.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

/* Turns what the transform does by an angle around an axis. */
static void turn_around(dpl_mesh_transform *t, int axis, double angle) {
    int y = (axis + 1) % 3, z = (axis + 2) % 3;
    double cosine = cos(angle), sine = sin(angle);
    for (int column = 0; column < 3; column++) {
        double of_y = t->turn[y][column], of_z = t->turn[z][column];
        t->turn[y][column] = cosine * of_y - sine * of_z;
        t->turn[z][column] = sine * of_y + cosine * of_z;
    }
}

dpl_mesh_transform dpl_mesh_transform_of(const double scale[3], const double angles[3],
                                         const double move[3]) {
    dpl_mesh_transform t = dpl_mesh_transform_none();
    for (int axis = 0; axis < 3; axis++) {
        t.turn[axis][axis] = scale[axis];
        t.move[axis] = move[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        turn_around(&t, axis, angles[axis]);
    return t;
}
