/* Triangles: keeping them in leaf order, and the test of one ray against one triangle.
 *
 * The test is watertight: corners are projected along the ray to single precision, once and the same for
 * every triangle that shares them; the products of the edge tests are then exact in double precision, so
 * their signs are right. A ray cannot pass between triangles that share an edge or a corner.
 *
 * Source: Woop, Benthin, Wald 2013, "Watertight ray/triangle intersection". */
#include "bvh/triangle.h"

#include <math.h>

/* ---- keeping -------------------------------------------------------------------------------------- */

static void read_corners(const dpl_triangles_source *source, int32_t i, float corner[3][3]) {
    for (int32_t k = 0; k < 3; k++) {
        int32_t vertex = source->indices ? source->indices[i][k] : 3 * i + k;
        memcpy(corner[k], source->vertices[vertex], 3 * sizeof(float));
    }
}

static void measure(dpl_triangles *set, const dpl_triangles_source *source) {
    dpl_bounds *bounds = set->bounds.data;
    for (int32_t i = 0; i < source->count; i++) {
        float corner[3][3];
        read_corners(source, i, corner);
        bounds[i] = dpl_bounds_empty();
        for (int32_t k = 0; k < 3; k++)
            dpl_bounds_add_point(&bounds[i], corner[k]);
        dpl_bounds_pad(&bounds[i], 3);
    }
}

static void pack(dpl_triangles *set, const dpl_triangles_source *source) {
    const int32_t *objects = set->bvh.objects.data;
    dpl_triangle *packed = set->packed.data;
    for (int32_t slot = 0; slot < source->count; slot++) {
        int32_t i = set->has_tree ? objects[slot] : slot;
        read_corners(source, i, packed[slot].corner);
        packed[slot].object = i;
    }
}

dpl_status dpl_triangles_set(dpl_context *context, dpl_triangles *set, const dpl_triangles_source *source,
                             bool tree) {
    set->count = 0;
    set->has_tree = tree;
    DPL_TRY(dpl_buffer_reserve(context, &set->packed, (size_t)source->count, sizeof(dpl_triangle)));
    DPL_TRY(dpl_buffer_reserve(context, &set->bounds, (size_t)source->count, sizeof(dpl_bounds)));
    measure(set, source);
    if (tree)
        DPL_TRY(dpl_bvh_update(context, &set->bvh, 3, set->bounds.data, source->count));
    set->count = source->count;
    pack(set, source);
    return DPL_OK;
}

void dpl_triangles_free(dpl_context *context, dpl_triangles *set) {
    dpl_buffer_free(context, &set->packed);
    dpl_buffer_free(context, &set->bounds);
    dpl_bvh_free(context, &set->bvh);
    *set = (dpl_triangles){0};
}

/* ---- one ray, one triangle ------------------------------------------------------------------------ */

/* A ray on its way through triangles, with the axes renamed so that it runs mostly along z. */
typedef struct query {
    const dpl_triangle *packed;
    int32_t first_object;
    dpl_hit hit;
    bool any; /* the first hit that is found will do */
    int32_t x, y, z;
    float shear[2]; /* x and y per z */
    double inverse_z;
} query;

static query query_begin(const dpl_triangles *set, const dpl_ray *ray, const dpl_hit *hit) {
    const float *d = ray->direction;
    query q = {.packed = set->packed.data, .first_object = set->first_object, .hit = *hit};
    q.z = fabsf(d[0]) > fabsf(d[1]) ? 0 : 1;
    q.z = fabsf(d[2]) > fabsf(d[q.z]) ? 2 : q.z;
    q.x = (q.z + 1) % 3;
    q.y = (q.z + 2) % 3;
    q.shear[0] = d[q.x] / d[q.z];
    q.shear[1] = d[q.y] / d[q.z];
    q.inverse_z = 1.0 / (double)d[q.z];
    return q;
}

/* A corner as seen along the ray: x and y on the plane across it, z along its main axis. */
typedef struct seen {
    double x, y, z;
} seen;

static inline seen look_at(const query *q, const dpl_walk_ray *ray, const float corner[3]) {
    float z = corner[q->z] - ray->origin[q->z];
    float x = (corner[q->x] - ray->origin[q->x]) - q->shear[0] * z;
    float y = (corner[q->y] - ray->origin[q->y]) - q->shear[1] * z;
    return (seen){(double)x, (double)y, (double)z};
}

/* As dpl_walk_ask. One function for both questions, so that the walk is compiled once, around it. */
static inline bool ask_triangle(void *asker, int32_t slot, float enter, dpl_walk_ray *ray) {
    query *q = asker;
    const dpl_triangle *triangle = &q->packed[slot];
    seen a = look_at(q, ray, triangle->corner[0]);
    seen b = look_at(q, ray, triangle->corner[1]);
    seen c = look_at(q, ray, triangle->corner[2]);
    double of_a = c.x * b.y - c.y * b.x, of_b = a.x * c.y - a.y * c.x, of_c = b.x * a.y - b.y * a.x;
    double sum = of_a + of_b + of_c;
    bool some_below = (of_a < 0.0) | (of_b < 0.0) | (of_c < 0.0);
    bool some_above = (of_a > 0.0) | (of_b > 0.0) | (of_c > 0.0);
    if ((some_below & some_above) | (sum == 0.0))
        return false;
    double share = 1.0 / sum;
    float t = (float)((of_a * a.z + of_b * b.z + of_c * c.z) * share * q->inverse_z);
    if (!(t >= ray->near))
        return false;
    int32_t object = q->first_object + triangle->object;
    t = t > enter ? t : enter;
    if (t > ray->far || (t == ray->far && q->hit.object > object))
        return false;
    ray->far = t;
    q->hit = (dpl_hit){t, object, (float)(of_b * share), (float)(of_c * share)};
    return q->any;
}

/* ---- one ray, all triangles ----------------------------------------------------------------------- */

static bool walk(const dpl_triangles *set, query *q, dpl_walk_ray *ray, dpl_walk_counts *counts) {
    if (set->has_tree)
        return dpl_walk(&set->bvh, 3, ray, ask_triangle, q, counts);
    return dpl_walk_all(set->bounds.data, set->count, 3, ray, ask_triangle, q, counts);
}

void dpl_triangles_closest(const dpl_triangles *set, const dpl_ray *ray, dpl_hit *hit,
                           dpl_walk_counts *counts) {
    dpl_walk_ray prepared;
    if (!dpl_walk_ray_prepare(ray, 3, &prepared))
        return;
    prepared.far = hit->t < prepared.far ? hit->t : prepared.far;
    query q = query_begin(set, ray, hit);
    (void)walk(set, &q, &prepared, counts);
    *hit = q.hit;
}

bool dpl_triangles_occluded(const dpl_triangles *set, const dpl_ray *ray, dpl_walk_counts *counts) {
    dpl_walk_ray prepared;
    if (!dpl_walk_ray_prepare(ray, 3, &prepared))
        return false;
    dpl_hit none = dpl_hit_none();
    query q = query_begin(set, ray, &none);
    q.any = true;
    return walk(set, &q, &prepared, counts);
}
