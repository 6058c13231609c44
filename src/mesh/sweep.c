/* Hands nearest points on from sample to sample, along one axis at a time, to and fro, until every sample has
 * heard of the triangle that is nearest to it or of one that is hardly farther. Then measures the distance to
 * that triangle itself. Called by dpl_mesh_field_fill().
 *
 * A line of samples is one task and writes nothing else, so the order of tasks cannot show. */
#include "job/jobs.h"
#include "mesh/closest.h"
#include "mesh/field.h"

#include <math.h>

/* Once along x, y, z leaves some samples behind corners with a second best; again along all three mends
 * nearly all. */
#define ROUNDS 2

typedef struct sweep {
    const dpl_mesh *mesh;
    const dpl_mesh_grid *grid;
    dpl_mesh_cell *cells;
    float *distance;
} sweep;

static inline float square_to(const dpl_mesh_cell *cell, float x, float y, float z) {
    float dx = cell->point[0] - x, dy = cell->point[1] - y, dz = cell->point[2] - z;
    return dx * dx + dy * dy + dz * dz;
}

/* Tells `cell` at (x, y, z) what its neighbour knows. */
static inline void tell(dpl_mesh_cell *cell, const dpl_mesh_cell *neighbour, float x, float y, float z) {
    if (neighbour->triangle >= 0 &&
        (cell->triangle < 0 || square_to(neighbour, x, y, z) < square_to(cell, x, y, z)))
        *cell = *neighbour;
}

/* Tells row (y, z) what row `other` knows. */
static void tell_row(const sweep *s, int32_t y, int32_t z, const dpl_mesh_cell *other) {
    dpl_mesh_cell *row = s->cells + dpl_mesh_cell_at(s->grid, 0, y, z);
    float at_y = (float)dpl_mesh_coordinate(s->grid, 1, y), at_z = (float)dpl_mesh_coordinate(s->grid, 2, z);
    for (int32_t x = 0; x < s->grid->size[0]; x++)
        tell(&row[x], &other[x], (float)dpl_mesh_coordinate(s->grid, 0, x), at_y, at_z);
}

static void sweep_x(const sweep *s, int32_t y, int32_t z) {
    dpl_mesh_cell *row = s->cells + dpl_mesh_cell_at(s->grid, 0, y, z);
    float at_y = (float)dpl_mesh_coordinate(s->grid, 1, y), at_z = (float)dpl_mesh_coordinate(s->grid, 2, z);
    for (int32_t x = 1; x < s->grid->size[0]; x++)
        tell(&row[x], &row[x - 1], (float)dpl_mesh_coordinate(s->grid, 0, x), at_y, at_z);
    for (int32_t x = s->grid->size[0] - 2; x >= 0; x--)
        tell(&row[x], &row[x + 1], (float)dpl_mesh_coordinate(s->grid, 0, x), at_y, at_z);
}

/* Along x and then along y, layer by layer. */
static void sweep_layers(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sweep *s = task;
    (void)worker;
    for (int32_t z = begin; z < end; z++) {
        for (int32_t y = 0; y < s->grid->size[1]; y++)
            sweep_x(s, y, z);
        for (int32_t y = 1; y < s->grid->size[1]; y++)
            tell_row(s, y, z, s->cells + dpl_mesh_cell_at(s->grid, 0, y - 1, z));
        for (int32_t y = s->grid->size[1] - 2; y >= 0; y--)
            tell_row(s, y, z, s->cells + dpl_mesh_cell_at(s->grid, 0, y + 1, z));
    }
}

static void sweep_z(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sweep *s = task;
    (void)worker;
    for (int32_t y = begin; y < end; y++) {
        for (int32_t z = 1; z < s->grid->size[2]; z++)
            tell_row(s, y, z, s->cells + dpl_mesh_cell_at(s->grid, 0, y, z - 1));
        for (int32_t z = s->grid->size[2] - 2; z >= 0; z--)
            tell_row(s, y, z, s->cells + dpl_mesh_cell_at(s->grid, 0, y, z + 1));
    }
}

static void measure_layers(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sweep *s = task;
    const dpl_mesh_corners *corners = dpl_mesh_corners_of(s->mesh);
    (void)worker;
    for (int32_t z = begin; z < end; z++)
        for (int32_t y = 0; y < s->grid->size[1]; y++)
            for (int32_t x = 0; x < s->grid->size[0]; x++) {
                size_t at = dpl_mesh_cell_at(s->grid, x, y, z);
                double nearest[3], p[3] = {dpl_mesh_coordinate(s->grid, 0, x),
                                           dpl_mesh_coordinate(s->grid, 1, y),
                                           dpl_mesh_coordinate(s->grid, 2, z)};
                s->distance[at] =
                    (float)sqrt(dpl_mesh_closest(corners[s->cells[at].triangle], p, nearest));
            }
}

dpl_status dpl_mesh_field_sweep(dpl_mesh_field *field, const dpl_mesh *mesh) {
    sweep s = {mesh, &field->grid, field->cells.data, field->distance.data};
    for (int round = 0; round < ROUNDS; round++) {
        DPL_TRY(dpl_jobs_run(field->context, sweep_layers, field->grid.size[2], 1, &s));
        DPL_TRY(dpl_jobs_run(field->context, sweep_z, field->grid.size[1], 1, &s));
    }
    return dpl_jobs_run(field->context, measure_layers, field->grid.size[2], 1, &s);
}
