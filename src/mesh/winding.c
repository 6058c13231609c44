/* What open parts enclose, as far as they do: samples around which their triangles turn more than half way.
 * Far triangles are taken together as one dipole (Barill et al. 2018, first order), near ones one by one by
 * their solid angle (van Oosterom and Strackee 1983). Called by dpl_mesh_field_fill().
 *
 * The winding number changes slowly away from triangles, so a block of samples far from all of them, where it
 * is far from one half, is decided by its middle; other blocks are cut into eight. */
#include "job/jobs.h"
#include "mesh/closest.h"
#include "mesh/field.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Samples along the side of the largest blocks, a power of two. */
#define BLOCK 16

/* A block whose middle is this many half diagonals away from all triangles, and whose winding number there
 * is this far from one half, is on one side as a whole. */
#define CLEAR 1.0f
#define SURE 0.25

/* How many of its radii a group must be away to be a dipole. */
#define FAR 1.6

typedef struct winding {
    const dpl_mesh *mesh;
    dpl_mesh_field *field;
    const dpl_bvh_node *nodes;
    const int32_t *slots;   /* of the tree: which open triangle */
    const int32_t *numbers; /* of the open triangles */
    const dpl_mesh_dipole *dipoles;
    int32_t blocks[3];
} winding;

static const dpl_mesh_corners *corners_in(const winding *w, int32_t slot) {
    return &dpl_mesh_corners_of(w->mesh)[w->numbers[w->slots[slot]]];
}

/* ---- dipoles -------------------------------------------------------------------------------------- */

/* The sums that a dipole is made of. */
typedef struct moment {
    double area;
    double center[3]; /* times area */
    double normal[3];
} moment;

static void add(moment *to, const moment *m) {
    to->area += m->area;
    for (int axis = 0; axis < 3; axis++) {
        to->center[axis] += m->center[axis];
        to->normal[axis] += m->normal[axis];
    }
}

static moment moment_of_triangle(const dpl_mesh_corners corner) {
    moment m = {0};
    double u[3], v[3];
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = (double)corner[1][axis] - (double)corner[0][axis];
        v[axis] = (double)corner[2][axis] - (double)corner[0][axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        m.normal[axis] = 0.5 * (u[next] * v[last] - u[last] * v[next]);
    }
    m.area = sqrt(dpl_mesh_dot(m.normal, m.normal));
    for (int axis = 0; axis < 3; axis++)
        m.center[axis] =
            m.area / 3.0 * ((double)corner[0][axis] + (double)corner[1][axis] + (double)corner[2][axis]);
    return m;
}

/* Of one child of a node: its box says how far its triangles reach. */
static dpl_mesh_dipole dipole_of(const moment *m, const dpl_bvh_node *node, int32_t child) {
    dpl_mesh_dipole d = {.radius = 0.0f};
    double square = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double low = (double)node->planes[axis][0][child], high = (double)node->planes[axis][1][child];
        double center = m->area > 0.0 ? m->center[axis] / m->area : 0.5 * (low + high);
        double reach = fmax(center - low, high - center);
        square += reach * reach;
        d.center[axis] = (float)center;
        d.normal[axis] = (float)m->normal[axis];
    }
    d.radius = (float)sqrt(square);
    return d;
}

static moment moment_of_dipole(const dpl_mesh_dipole *d, double area) {
    moment m = {.area = area};
    for (int axis = 0; axis < 3; axis++) {
        m.center[axis] = area * (double)d->center[axis];
        m.normal[axis] = (double)d->normal[axis];
    }
    return m;
}

/* From the leaves up: parents come before their children. `areas` keeps what dipoles do not. */
static void make_dipoles(const winding *w, dpl_mesh_dipole *dipoles, double *areas) {
    for (int32_t n = w->field->tree.node_count - 1; n >= 0; n--) {
        const dpl_bvh_node *node = &w->nodes[n];
        for (int32_t child = 0; child < node->child_count; child++) {
            moment m = {0};
            int32_t below = node->child[child];
            if (below < 0)
                m = moment_of_triangle(*corners_in(w, ~below));
            for (int32_t k = 0; below >= 0 && k < w->nodes[below].child_count; k++) {
                size_t at = (size_t)below * DPL_BVH_CHILDREN + (size_t)k;
                moment part = moment_of_dipole(&dipoles[at], areas[at]);
                add(&m, &part);
            }
            dipoles[(size_t)n * DPL_BVH_CHILDREN + (size_t)child] = dipole_of(&m, node, child);
            areas[(size_t)n * DPL_BVH_CHILDREN + (size_t)child] = m.area;
        }
    }
}

/* ---- the winding number --------------------------------------------------------------------------- */

/* In parts of the whole sphere, signed. */
static double solid_angle(const dpl_mesh_corners corner, const double p[3]) {
    double a[3], b[3], c[3];
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = (double)corner[0][axis] - p[axis];
        b[axis] = (double)corner[1][axis] - p[axis];
        c[axis] = (double)corner[2][axis] - p[axis];
    }
    double la = sqrt(dpl_mesh_dot(a, a)), lb = sqrt(dpl_mesh_dot(b, b)), lc = sqrt(dpl_mesh_dot(c, c));
    double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                    a[2] * (b[0] * c[1] - b[1] * c[0]);
    double rest = la * lb * lc + dpl_mesh_dot(a, b) * lc + dpl_mesh_dot(b, c) * la + dpl_mesh_dot(c, a) * lb;
    return atan2(volume, rest) / (2.0 * PI);
}

/* What a dipole adds, or false when it is too near to be one. */
static bool take_together(const dpl_mesh_dipole *d, const double p[3], double *sum) {
    double away[3];
    for (int axis = 0; axis < 3; axis++)
        away[axis] = (double)d->center[axis] - p[axis];
    double square = dpl_mesh_dot(away, away), reach = FAR * (double)d->radius;
    if (square <= reach * reach)
        return false;
    double along =
        (double)d->normal[0] * away[0] + (double)d->normal[1] * away[1] + (double)d->normal[2] * away[2];
    *sum += along / (4.0 * PI * square * sqrt(square));
    return true;
}

static double winding_at(const winding *w, const double p[3]) {
    int32_t stack[DPL_BVH_MAX_DEPTH * (DPL_BVH_CHILDREN - 1) + 2], height = 0;
    double sum = 0.0;
    stack[height++] = 0;
    while (height > 0) {
        int32_t n = stack[--height];
        for (int32_t k = 0; k < w->nodes[n].child_count; k++) {
            int32_t child = w->nodes[n].child[k];
            if (take_together(&w->dipoles[(size_t)n * DPL_BVH_CHILDREN + (size_t)k], p, &sum))
                continue;
            if (child < 0)
                sum += solid_angle(*corners_in(w, ~child), p);
            else
                stack[height++] = child;
        }
    }
    return sum;
}

/* ---- blocks --------------------------------------------------------------------------------------- */

static void make_negative(const winding *w, const int32_t begin[3], const int32_t end[3]) {
    float *distance = w->field->distance.data;
    for (int32_t z = begin[2]; z < end[2]; z++)
        for (int32_t y = begin[1]; y < end[1]; y++)
            for (int32_t x = begin[0]; x < end[0]; x++) {
                float *d = &distance[dpl_mesh_cell_at(&w->field->grid, x, y, z)];
                *d = -fabsf(*d);
            }
}

/* Is all of a block of samples of this side, by its middle, far from triangles? */
static bool is_open_space(const winding *w, const int32_t middle[3], int32_t side) {
    const dpl_mesh_grid *grid = &w->field->grid;
    const float *distance = w->field->distance.data;
    float half_diagonal = 0.866f * (float)side * grid->spacing;
    return fabsf(distance[dpl_mesh_cell_at(grid, middle[0], middle[1], middle[2])]) > CLEAR * half_diagonal;
}

/* Decides the block of samples at `begin`, `side` along each axis, or each of its eight parts. */
static void sign_block(const winding *w, const int32_t begin[3], int32_t side) {
    const dpl_mesh_grid *grid = &w->field->grid;
    int32_t middle[3], end[3];
    double p[3];
    for (int axis = 0; axis < 3; axis++) {
        if (begin[axis] >= grid->size[axis])
            return;
        end[axis] = begin[axis] + side < grid->size[axis] ? begin[axis] + side : grid->size[axis];
        middle[axis] = (begin[axis] + end[axis]) / 2;
        p[axis] = dpl_mesh_coordinate(grid, axis, middle[axis]);
    }
    double turns = side == 1 || is_open_space(w, middle, side) ? fabs(winding_at(w, p)) : 0.5;
    if (side == 1 || fabs(turns - 0.5) > SURE) {
        if (turns > 0.5)
            make_negative(w, begin, end);
        return;
    }
    for (int part = 0; part < 8; part++) {
        int32_t corner[3];
        for (int axis = 0; axis < 3; axis++)
            corner[axis] = begin[axis] + (part >> axis & 1 ? side / 2 : 0);
        sign_block(w, corner, side / 2);
    }
}

static void sign_blocks(int32_t begin, int32_t end, int32_t worker, void *task) {
    const winding *w = task;
    (void)worker;
    for (int32_t i = begin; i < end; i++) {
        int32_t corner[3] = {i % w->blocks[0] * BLOCK, i / w->blocks[0] % w->blocks[1] * BLOCK,
                             i / w->blocks[0] / w->blocks[1] * BLOCK};
        sign_block(w, corner, BLOCK);
    }
}

/* ---- the whole ------------------------------------------------------------------------------------ */

static dpl_status sort_open_triangles(dpl_mesh_field *field, const dpl_mesh *mesh) {
    const uint8_t *signs = mesh->signs.data;
    const dpl_bounds *all = mesh->triangles.bounds.data;
    int32_t count = 0;
    for (int32_t i = 0; i < mesh->facts.triangles; i++)
        count += signs[i] == DPL_MESH_OPEN;
    field->open_count = count;
    if (count == 0)
        return DPL_OK;
    DPL_TRY(dpl_buffer_reserve(field->context, &field->open, (size_t)count, sizeof(int32_t)));
    DPL_TRY(dpl_buffer_reserve(field->context, &field->bounds, (size_t)count, sizeof(dpl_bounds)));
    int32_t *open = field->open.data;
    dpl_bounds *bounds = field->bounds.data;
    for (int32_t i = 0, to = 0; i < mesh->facts.triangles; i++)
        if (signs[i] == DPL_MESH_OPEN) {
            bounds[to] = all[i];
            open[to++] = i;
        }
    return dpl_bvh_build(field->context, &field->tree, 3, bounds, count);
}

dpl_status dpl_mesh_field_sign_open(dpl_mesh_field *field, const dpl_mesh *mesh) {
    DPL_TRY(sort_open_triangles(field, mesh));
    if (field->open_count == 0)
        return DPL_OK;
    size_t children = (size_t)field->tree.node_count * DPL_BVH_CHILDREN;
    DPL_TRY(dpl_buffer_reserve(field->context, &field->dipoles, children,
                               sizeof(dpl_mesh_dipole) + sizeof(double)));
    double *areas = field->dipoles.data; /* doubles first: they want the alignment */
    dpl_mesh_dipole *dipoles = (dpl_mesh_dipole *)(void *)(areas + children);
    winding w = {.mesh = mesh,
                 .field = field,
                 .nodes = dpl_bvh_nodes(&field->tree),
                 .slots = field->tree.objects.data,
                 .numbers = field->open.data,
                 .dipoles = dipoles};
    make_dipoles(&w, dipoles, areas);
    for (int axis = 0; axis < 3; axis++)
        w.blocks[axis] = (field->grid.size[axis] + BLOCK - 1) / BLOCK;
    return dpl_jobs_run(field->context, sign_blocks, w.blocks[0] * w.blocks[1] * w.blocks[2], 1, &w);
}
