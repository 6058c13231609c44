/* The exact part: for every sample near a triangle, which triangle is nearest. A triangle visits the samples
 * of its box, grown by the band, that are also near its plane. Called by dpl_mesh_field_fill(). */
#include "job/jobs.h"
#include "mesh/closest.h"
#include "mesh/field.h"

#include <math.h>

/* Layers of samples that are worked on together. */
#define SLAB 4

typedef struct band {
    const dpl_mesh *mesh;
    const dpl_mesh_grid *grid;
    dpl_mesh_cell *cells;
    float *square; /* of the distance to the nearest triangle so far */
    double reach;  /* [scene unit] */
} band;

/* A triangle on its way through samples. */
typedef struct visitor {
    const float (*corner)[3];
    int32_t triangle;
    double normal[3]; /* unit, or zero for a triangle without an area */
    double offset;    /* of its plane */
    double low[3];    /* its box, grown */
    double high[3];
} visitor;

static visitor visit(const band *b, int32_t triangle) {
    visitor v = {.corner = dpl_mesh_corners_of(b->mesh)[triangle], .triangle = triangle};
    double u[3], w[3];
    for (int axis = 0; axis < 3; axis++) {
        double c[3] = {(double)v.corner[0][axis], (double)v.corner[1][axis], (double)v.corner[2][axis]};
        u[axis] = c[1] - c[0];
        w[axis] = c[2] - c[0];
        v.low[axis] = fmin(c[0], fmin(c[1], c[2])) - b->reach;
        v.high[axis] = fmax(c[0], fmax(c[1], c[2])) + b->reach;
    }
    double normal[3] = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
    double length = sqrt(dpl_mesh_dot(normal, normal));
    for (int axis = 0; axis < 3 && length > 0.0; axis++) {
        v.normal[axis] = normal[axis] / length;
        v.offset += v.normal[axis] * (double)v.corner[0][axis];
    }
    return v;
}

/* The samples of an axis that lie within low .. high. */
static void samples_within(const dpl_mesh_grid *grid, int axis, double low, double high, int32_t *first,
                           int32_t *last) {
    double origin = (double)grid->origin[axis], spacing = (double)grid->spacing;
    double from = ceil((low - origin) / spacing), to = floor((high - origin) / spacing);
    *first = from > 0.0 ? (int32_t)fmin(from, 1e6) : 0;
    *last = to < grid->size[axis] - 1 ? (int32_t)fmax(to, -1.0) : grid->size[axis] - 1;
}

/* Narrows low .. high to what is within reach of the plane, along a row at y and z. */
static void narrow(const band *b, const visitor *v, double y, double z, double *low, double *high) {
    double rest = v->normal[1] * y + v->normal[2] * z - v->offset, slope = v->normal[0];
    double reach = 1.0001 * b->reach;
    if (fabs(slope) < 1e-6) {
        if (fabs(rest) > reach + 1e-6 * (fabs(*low) + fabs(*high)))
            *high = *low - 1.0;
        return;
    }
    double one = (-reach - rest) / slope, other = (reach - rest) / slope;
    *low = fmax(*low, fmin(one, other));
    *high = fmin(*high, fmax(one, other));
}

static void visit_row(const band *b, const visitor *v, int32_t y, int32_t z) {
    double p[3] = {0.0, dpl_mesh_coordinate(b->grid, 1, y), dpl_mesh_coordinate(b->grid, 2, z)};
    double low = v->low[0], high = v->high[0], nearest[3];
    int32_t first, last;
    narrow(b, v, p[1], p[2], &low, &high);
    samples_within(b->grid, 0, low, high, &first, &last);
    for (int32_t x = first; x <= last; x++) {
        size_t at = dpl_mesh_cell_at(b->grid, x, y, z);
        p[0] = dpl_mesh_coordinate(b->grid, 0, x);
        float square = (float)dpl_mesh_closest(v->corner, p, nearest);
        if (!(square < b->square[at]))
            continue;
        b->square[at] = square;
        b->cells[at] =
            (dpl_mesh_cell){{(float)nearest[0], (float)nearest[1], (float)nearest[2]}, v->triangle};
    }
}

static void visit_slab(const band *b, const visitor *v, int32_t begin, int32_t end) {
    int32_t first_y, last_y, first_z, last_z;
    samples_within(b->grid, 1, v->low[1], v->high[1], &first_y, &last_y);
    samples_within(b->grid, 2, v->low[2], v->high[2], &first_z, &last_z);
    first_z = first_z > begin ? first_z : begin;
    last_z = last_z < end - 1 ? last_z : end - 1;
    for (int32_t z = first_z; z <= last_z; z++)
        for (int32_t y = first_y; y <= last_y; y++)
            visit_row(b, v, y, z);
}

static void clear(const band *b, int32_t begin, int32_t end) {
    size_t from = dpl_mesh_cell_at(b->grid, 0, 0, begin), to = dpl_mesh_cell_at(b->grid, 0, 0, end);
    float reach = (float)(b->reach * b->reach) * 1.0001f;
    for (size_t i = from; i < to; i++) {
        b->cells[i].triangle = -1;
        b->square[i] = reach;
    }
}

/* Triangles come in their order, so which of two equally near ones is kept does not depend on the slabs. */
static void fill_slabs(int32_t from, int32_t to, int32_t worker, void *task) {
    const band *b = task;
    const dpl_bounds *bounds = b->mesh->triangles.bounds.data;
    const uint8_t *signs = b->mesh->signs.data;
    (void)worker;
    for (int32_t slab = from; slab < to; slab++) {
        int32_t begin = slab * SLAB, end = begin + SLAB;
        end = end < b->grid->size[2] ? end : b->grid->size[2];
        clear(b, begin, end);
        double low = dpl_mesh_coordinate(b->grid, 2, begin) - b->reach;
        double high = dpl_mesh_coordinate(b->grid, 2, end - 1) + b->reach;
        for (int32_t i = 0; i < b->mesh->facts.triangles; i++) {
            if ((double)bounds[i].high[2] < low || (double)bounds[i].low[2] > high ||
                signs[i] == DPL_MESH_NOTHING)
                continue;
            visitor v = visit(b, i);
            visit_slab(b, &v, begin, end);
        }
    }
}

dpl_status dpl_mesh_field_fill_band(dpl_mesh_field *field, const dpl_mesh *mesh) {
    band b = {.mesh = mesh,
              .grid = &field->grid,
              .cells = field->cells.data,
              .square = field->distance.data, /* until sweep.c writes the distances */
              .reach = (double)field->grid.spacing * field->desc.band};
    return dpl_jobs_run(field->context, fill_slabs, (field->grid.size[2] + SLAB - 1) / SLAB, 1, &b);
}
