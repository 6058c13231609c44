/* What closed parts enclose, by counting how often a line of samples crosses their triangles. Called by
 * dpl_mesh_field_fill().
 *
 * Lines run along x. Whether a line meets a triangle is decided in the plane across it, edge by edge, with
 * each edge's corners in a fixed order and a fixed answer for points on an edge; so of the triangles around
 * an edge or a corner a line meets as many as it would if it ran a little beside it, and counts are exact. */
#include "job/jobs.h"
#include "mesh/field.h"

#include <math.h>

typedef struct sign {
    const dpl_mesh *mesh;
    const dpl_mesh_grid *grid;
    float *distance;
    int16_t *lines; /* per worker: two counts per sample of a layer, and one more per row */
    size_t line_count;
} sign;

/* On which side of the line from a to b is the origin: +1 or -1; exactly opposite for b to a, and never 0
 * unless a equals b. Points are (y, z), relative to the line of samples. */
static int side(const double a[2], const double b[2]) {
    bool swapped = a[0] > b[0] || (a[0] >= b[0] && a[1] > b[1]);
    const double *low = swapped ? b : a, *high = swapped ? a : b;
    double area = low[0] * high[1] - low[1] * high[0];
    int answer = area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
    /* As if the origin were moved by a tiny step along y and by a far tinier one along z. */
    if (answer == 0)
        answer = low[1] > high[1] ? 1 : low[1] < high[1] ? -1 : 0;
    if (answer == 0)
        answer = high[0] > low[0] ? 1 : 0;
    return swapped ? -answer : answer;
}

/* How a line along x at (y, z) crosses a triangle: +1 or -1 by its orientation and where, or 0. */
static int cross(const dpl_mesh_corners corner, double y, double z, double *x) {
    double at[3][2];
    for (int k = 0; k < 3; k++) {
        at[k][0] = (double)corner[k][1] - y;
        at[k][1] = (double)corner[k][2] - z;
    }
    int way = side(at[0], at[1]);
    if (way == 0 || side(at[1], at[2]) != way || side(at[2], at[0]) != way)
        return 0;
    double weight[3], sum = 0.0;
    *x = 0.0;
    for (int k = 0; k < 3; k++) {
        const double *p = at[(k + 1) % 3], *q = at[(k + 2) % 3];
        weight[k] = fabs(p[0] * q[1] - p[1] * q[0]);
        sum += weight[k];
    }
    for (int k = 0; k < 3; k++)
        *x += (double)corner[k][0] * (sum > 0.0 ? weight[k] / sum : 1.0 / 3.0);
    return way;
}

/* First sample of an axis at or beyond a place: 0 .. size. */
static int32_t first_beyond(const dpl_mesh_grid *grid, int axis, double place) {
    double i = ceil((place - (double)grid->origin[axis]) / (double)grid->spacing);
    return i > 0.0 ? (int32_t)fmin(i, grid->size[axis]) : 0;
}

static void count_triangle(const sign *s, int32_t triangle, double z, int16_t *layer, bool oriented) {
    const dpl_mesh_grid *grid = s->grid;
    const dpl_bounds *bounds = (const dpl_bounds *)s->mesh->triangles.bounds.data + triangle;
    int32_t first = first_beyond(grid, 1, (double)bounds->low[1]);
    int32_t end = first_beyond(grid, 1, (double)bounds->high[1]) + 1;
    end = end < grid->size[1] ? end : grid->size[1];
    for (int32_t y = first; y < end; y++) {
        double x;
        int way = cross(dpl_mesh_corners_of(s->mesh)[triangle], dpl_mesh_coordinate(grid, 1, y), z, &x);
        if (way == 0)
            continue;
        int16_t *at =
            layer + 2 * ((size_t)y * (size_t)(grid->size[0] + 1) + (size_t)first_beyond(grid, 0, x));
        if (oriented)
            at[0] = (int16_t)(at[0] + way);
        else
            at[1] ^= 1;
    }
}

static void sign_layer(const sign *s, const int16_t *layer, int32_t z) {
    for (int32_t y = 0; y < s->grid->size[1]; y++) {
        const int16_t *at = layer + 2 * (size_t)y * (size_t)(s->grid->size[0] + 1);
        float *row = s->distance + dpl_mesh_cell_at(s->grid, 0, y, z);
        int32_t winding = 0, parity = 0;
        for (int32_t x = 0; x < s->grid->size[0]; x++) {
            winding += at[2 * x];
            parity ^= at[2 * x + 1];
            if (winding != 0 || parity != 0)
                row[x] = -row[x];
        }
    }
}

static void sign_layers(int32_t begin, int32_t end, int32_t worker, void *task) {
    const sign *s = task;
    const uint8_t *signs = s->mesh->signs.data;
    const dpl_bounds *bounds = s->mesh->triangles.bounds.data;
    int16_t *layer = s->lines + (size_t)worker * s->line_count;
    for (int32_t k = begin; k < end; k++) {
        double z = dpl_mesh_coordinate(s->grid, 2, k);
        memset(layer, 0, s->line_count * sizeof *layer);
        for (int32_t i = 0; i < s->mesh->facts.triangles; i++)
            if (signs[i] <= DPL_MESH_UNORIENTED && (double)bounds[i].low[2] <= z &&
                (double)bounds[i].high[2] >= z)
                count_triangle(s, i, z, layer, signs[i] == DPL_MESH_CLOSED);
        sign_layer(s, layer, k);
    }
}

dpl_status dpl_mesh_field_sign_closed(dpl_mesh_field *field, const dpl_mesh *mesh) {
    const int32_t *size = field->grid.size;
    sign s = {.mesh = mesh, .grid = &field->grid, .distance = field->distance.data};
    s.line_count = 2 * (size_t)(size[0] + 1) * (size_t)size[1];
    size_t workers = (size_t)dpl_jobs_worker_count(field->context->jobs);
    DPL_TRY(dpl_buffer_reserve(field->context, &field->lines, workers * s.line_count, sizeof *s.lines));
    s.lines = field->lines.data;
    return dpl_jobs_run(field->context, sign_layers, size[2], 1, &s);
}
