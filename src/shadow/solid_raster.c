/* Depths of the nearest triangles as the light sees them, one sample in the middle of each texel. Bands of
 * rows are tasks; each looks at all triangles and draws its part of them. The nearest depth wins, in whatever
 * order. Called by solid_map.c. */
#include "job/jobs.h"
#include "shadow/solid_shadow.h"

#include <math.h>

/* Rows that are drawn together. */
#define BAND 16

/* Triangles that are looked at together. */
#define BATCH 256

/* A triangle in the frame's axes, and the rows it may touch. */
typedef struct seen_triangle {
    float corner[3][3];
    float low; /* [texel]; low > high: none */
    float high;
} seen_triangle;

typedef struct raster {
    const dpl_mesh *mesh;
    const dpl_solid_map *map;
    seen_triangle *triangles;
} raster;

/* A polygon on the map: a triangle, or what is left of one before the view's near end. */
typedef struct polygon {
    float at[4][2]; /* [texel] */
    int count;
} polygon;

/* What is interpolated across a map, depth or its inverse: at (0, 0), per texel along u, along v. */
typedef struct plane {
    double base;
    double per_u;
    double per_v;
    float nearest; /* depths of the triangle itself */
    float farthest;
} plane;

static void project(const dpl_solid_map *map, const float seen[3], float at[2]) {
    float scale = map->frame.parallel ? map->frame.scale : map->frame.scale / seen[2];
    at[0] = 0.5f * (float)map->size + scale * seen[0];
    at[1] = 0.5f * (float)map->size + scale * seen[1];
}

/* ---- triangles as the view sees them -------------------------------------------------------------- */

static void find_rows(const dpl_solid_map *map, seen_triangle *t) {
    bool all = true, any = false;
    t->low = INFINITY;
    t->high = -INFINITY;
    for (int k = 0; k < 3; k++) {
        float at[2];
        bool before = map->frame.parallel || t->corner[k][2] >= map->frame.near;
        all = all && before;
        any = any || before;
        if (!before)
            continue;
        project(map, t->corner[k], at);
        t->low = fminf(t->low, at[1]);
        t->high = fmaxf(t->high, at[1]);
    }
    if (any && !all) {
        t->low = 0.0f;
        t->high = (float)map->size;
    }
}

static void see_triangles(int32_t begin, int32_t end, int32_t worker, void *task) {
    const raster *r = task;
    const dpl_mesh_corners *corners = dpl_mesh_corners_of(r->mesh);
    (void)worker;
    for (int32_t i = begin * BATCH; i < end * BATCH && i < r->mesh->facts.triangles; i++) {
        for (int k = 0; k < 3; k++)
            dpl_solid_look(&r->map->frame, corners[i][k], r->triangles[i].corner[k]);
        find_rows(r->map, &r->triangles[i]);
    }
}

/* ---- one triangle --------------------------------------------------------------------------------- */

static void add_point(polygon *p, const dpl_solid_map *map, const float seen[3]) {
    project(map, seen, p->at[p->count++]);
}

/* Cuts off what is nearer than the view begins. */
static polygon clip(const dpl_solid_map *map, const seen_triangle *t) {
    polygon p = {.count = 0};
    float near = map->frame.near;
    for (int k = 0; k < 3; k++) {
        const float *from = t->corner[k], *to = t->corner[(k + 1) % 3];
        bool from_in = map->frame.parallel || from[2] >= near, to_in = map->frame.parallel || to[2] >= near;
        if (from_in)
            add_point(&p, map, from);
        if (from_in == to_in)
            continue;
        float share = (near - from[2]) / (to[2] - from[2]);
        float cut[3] = {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), near};
        add_point(&p, map, cut);
    }
    return p;
}

/* False for a triangle seen edge on. */
static bool plane_of(const dpl_solid_map *map, const seen_triangle *t, plane *result) {
    double u[3], v[3], n[3], middle = 0.5 * map->size, scale = (double)map->frame.scale;
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = (double)t->corner[1][axis] - (double)t->corner[0][axis];
        v[axis] = (double)t->corner[2][axis] - (double)t->corner[0][axis];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    double offset =
        n[0] * (double)t->corner[0][0] + n[1] * (double)t->corner[0][1] + n[2] * (double)t->corner[0][2];
    /* Parallel: z = (offset - n.x x - n.y y) / n.z. Perspective: 1/z = (n.x x/z + n.y y/z + n.z) / offset. */
    double over = map->frame.parallel ? n[2] : offset, sign = map->frame.parallel ? -1.0 : 1.0;
    result->per_u = sign * n[0] / (over * scale);
    result->per_v = sign * n[1] / (over * scale);
    result->base = (map->frame.parallel ? offset : n[2]) / over - middle * (result->per_u + result->per_v);
    result->nearest = fminf(t->corner[0][2], fminf(t->corner[1][2], t->corner[2][2]));
    result->farthest = fmaxf(t->corner[0][2], fmaxf(t->corner[1][2], t->corner[2][2]));
    return isfinite(result->base) && isfinite(result->per_u) && isfinite(result->per_v);
}

/* Where a row's middle crosses a polygon. Edges are cut from their upper end whichever way they run, so that
 * triangles that share one leave no gap. */
static bool cross_row(const polygon *p, float v, float *from, float *to) {
    *from = INFINITY;
    *to = -INFINITY;
    for (int k = 0; k < p->count; k++) {
        const float *a = p->at[k], *b = p->at[(k + 1) % p->count];
        if ((a[1] <= v) == (b[1] <= v))
            continue;
        const float *upper = a[1] < b[1] ? a : b, *lower = a[1] < b[1] ? b : a;
        float u = upper[0] + (v - upper[1]) / (lower[1] - upper[1]) * (lower[0] - upper[0]);
        *from = fminf(*from, u);
        *to = fmaxf(*to, u);
    }
    return *from <= *to;
}

/* First texel of 0 .. size whose middle is at or beyond a place. */
static int32_t first_texel(float place, int32_t size) {
    float i = ceilf(place - 0.5f);
    return i > 0.0f ? (int32_t)fminf(i, (float)size) : 0;
}

static void draw_row(const dpl_solid_map *map, const plane *p, int32_t y, int32_t begin, int32_t end) {
    dpl_solid_range *row = map->ranges[0] + (size_t)y * (size_t)map->size;
    double base = p->base + p->per_v * (y + 0.5);
    for (int32_t x = begin; x < end; x++) {
        float value = (float)(base + p->per_u * (x + 0.5));
        float depth = map->frame.parallel ? value : 1.0f / value;
        depth = depth > p->nearest ? depth : p->nearest; /* also for not-a-number */
        depth = depth < p->farthest ? depth : p->farthest;
        if (depth < row[x].near)
            row[x].near = depth;
    }
}

static void draw(const dpl_solid_map *map, const seen_triangle *t, int32_t begin, int32_t end) {
    polygon p = clip(map, t);
    plane depths;
    if (p.count < 3 || !plane_of(map, t, &depths))
        return;
    int32_t first = first_texel(t->low, map->size), last = first_texel(t->high, map->size);
    first = first > begin ? first : begin;
    last = last < end ? last : end;
    for (int32_t y = first; y < last; y++) {
        float from, to;
        if (cross_row(&p, (float)y + 0.5f, &from, &to))
            draw_row(map, &depths, y, first_texel(from, map->size), first_texel(to, map->size));
    }
}

/* ---- all triangles -------------------------------------------------------------------------------- */

static void draw_bands(int32_t from, int32_t to, int32_t worker, void *task) {
    const raster *r = task;
    const dpl_solid_map *map = r->map;
    (void)worker;
    for (int32_t band = from; band < to; band++) {
        int32_t begin = band * BAND, end = begin + BAND < map->size ? begin + BAND : map->size;
        dpl_solid_range *first = map->ranges[0] + (size_t)begin * (size_t)map->size;
        size_t count = (size_t)(end - begin) * (size_t)map->size;
        for (size_t i = 0; i < count; i++)
            first[i].near = INFINITY;
        for (int32_t i = 0; i < r->mesh->facts.triangles; i++)
            if (r->triangles[i].low < (float)end && r->triangles[i].high > (float)begin)
                draw(map, &r->triangles[i], begin, end);
        for (size_t i = 0; i < count; i++)
            first[i].far = first[i].near = fmaxf(first[i].near, map->frame.near);
    }
}

dpl_status dpl_solid_rasterise(dpl_solid_shadow *shadow, const dpl_solid_map *map) {
    raster r = {.mesh = shadow->mesh, .map = map, .triangles = shadow->corners.data};
    int32_t batches = (shadow->mesh->facts.triangles + BATCH - 1) / BATCH;
    DPL_TRY(dpl_jobs_run(shadow->context, see_triangles, batches, 1, &r));
    return dpl_jobs_run(shadow->context, draw_bands, (map->size + BAND - 1) / BAND, 1, &r);
}

size_t dpl_solid_seen_bytes(void) {
    return sizeof(seen_triangle);
}
