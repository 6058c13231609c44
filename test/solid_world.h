/* Meshes for tests: built-in shapes as dpl_mesh, alone and as the reference scene. */
#ifndef DPL_TEST_SOLID_WORLD_H
#define DPL_TEST_SOLID_WORLD_H

#include "shared_context.h"

#include "../meshes/mesh_data.h"
#include "../scenes/solid_reference.h"

#include <dapple/dapple.h>
#include <math.h>

static inline dpl_mesh_transform solid_at(double x, double y, double z, double hx, double hy, double hz,
                                          double turn) {
    const double scale[3] = {hx, hy, hz}, angles[3] = {0.3 * turn, turn, 0.0}, move[3] = {x, y, z};
    return dpl_mesh_transform_of(scale, angles, move);
}

/* Takes the data. */
static inline dpl_mesh *solid_mesh(dpl_context *of, dpl_mesh_data *data) {
    dpl_mesh_desc desc = dpl_mesh_data_desc(data);
    dpl_mesh *mesh = NULL;
    assert_ok(dpl_mesh_create(of, &desc, &mesh));
    dpl_mesh_data_free(data);
    return mesh;
}

static inline dpl_mesh *solid_sphere(dpl_context *of, double x, double y, double z, double radius,
                                     int32_t rings) {
    dpl_mesh_data data = {0};
    dpl_mesh_transform t = solid_at(x, y, z, radius, radius, radius, 0.0);
    assert_true(dpl_mesh_data_add_sphere(&data, &t, rings, NULL));
    return solid_mesh(of, &data);
}

static inline dpl_mesh *solid_box(dpl_context *of, double x, double y, double z, double hx, double hy,
                                  double hz, double turn) {
    dpl_mesh_data data = {0};
    dpl_mesh_transform t = solid_at(x, y, z, hx, hy, hz, turn);
    assert_true(dpl_mesh_data_add_box(&data, &t, NULL));
    return solid_mesh(of, &data);
}

static inline dpl_mesh_field *solid_field(dpl_context *of, const dpl_mesh *mesh, int32_t resolution) {
    dpl_mesh_field_desc desc = dpl_mesh_field_desc_default();
    dpl_mesh_field *field = NULL;
    desc.resolution = resolution;
    assert_ok(dpl_mesh_field_create(of, &desc, &field));
    assert_ok(dpl_mesh_field_measure(field, mesh));
    return field;
}

/* Calls `each` for every sample of a field with its place and distance. */
typedef void solid_visit(const double place[3], double distance, double spacing, void *user);

static inline void solid_each_sample(const dpl_mesh_field *field, solid_visit *each, void *user) {
    dpl_mesh_grid grid = dpl_mesh_field_grid(field);
    const float *sample = dpl_mesh_field_samples(field);
    for (int32_t k = 0; k < grid.size[2]; k++)
        for (int32_t j = 0; j < grid.size[1]; j++)
            for (int32_t i = 0; i < grid.size[0]; i++) {
                double place[3] = {(double)(grid.origin[0] + grid.spacing * (float)i),
                                   (double)(grid.origin[1] + grid.spacing * (float)j),
                                   (double)(grid.origin[2] + grid.spacing * (float)k)};
                each(place, (double)*sample++, (double)grid.spacing, user);
            }
}

#endif
