/* Receivers, one after another: what the light looks like from there, what its map says at first sight, and
 * then one of the ways to find the visibility. Called by src/api/solid_shadow.c. */
#include "shadow/solid_shadow.h"

#include "job/jobs.h"
#include "shadow/solid_blend.h"

#include <math.h>

/* Receivers that are worked on together. */
#define BATCH DPL_DEPTH_MOST

/* Receivers as far apart as this share of the light's disc ask their rays together. */
#define GROUP_WIDTH 0.5f

typedef struct work {
    dpl_solid_shadow *shadow;
    const float (*positions)[3];
    const float (*normals)[3];
    int64_t count;
    float *visibility;
} work;

/* Fills a receiver; false when it is no point. */
static bool prepare(const work *w, int64_t i, dpl_solid_receiver *r) {
    static const float none[3] = {0.0f, 0.0f, 0.0f};
    const dpl_solid_light *light = &w->shadow->light;
    memcpy(r->position, w->positions[i], sizeof r->position);
    memcpy(r->normal, w->normals ? w->normals[i] : none, sizeof r->normal);
    float square = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        bool sun = light->kind == DPL_SOLID_LIGHT_DIRECTIONAL;
        r->toward[axis] = sun ? -light->direction[axis] : light->position[axis] - r->position[axis];
        square += r->toward[axis] * r->toward[axis];
    }
    float length = sqrtf(square);
    for (int axis = 0; axis < 3; axis++)
        r->toward[axis] /= length;
    dpl_solid_across(r->toward, r->right, r->up);
    r->distance = light->kind == DPL_SOLID_LIGHT_DIRECTIONAL ? INFINITY : length;
    r->spread = light->kind == DPL_SOLID_LIGHT_DIRECTIONAL ? w->shadow->sun_spread : light->radius / length;
    float sum = dpl_solid_dot(r->position, r->position) + dpl_solid_dot(r->normal, r->normal);
    return isfinite(sum) && isfinite(r->spread);
}

double dpl_solid_above_horizon(const dpl_solid_receiver *r) {
    float height = dpl_solid_dot(r->normal, r->toward);
    if (height >= r->spread || !(dpl_solid_dot(r->normal, r->normal) > 0.0f))
        return 1.0;
    float across = dpl_solid_dot(r->normal, r->right), up = dpl_solid_dot(r->normal, r->up);
    float tilt = r->spread * sqrtf(across * across + up * up);
    return dpl_solid_disc_share(tilt > 0.0f ? (double)(height / tilt) : copysign(2.0, (double)height));
}

/* ---- methods -------------------------------------------------------------------------------------- */

static bool is_near_eye(const dpl_solid_shadow_desc *desc, const dpl_solid_receiver *r) {
    float away[3];
    for (int axis = 0; axis < 3; axis++)
        away[axis] = r->position[axis] - desc->eye[axis];
    return sqrtf(dpl_solid_dot(away, away)) <= desc->refine_distance;
}

/* Map and march are bounds that fail in different places. Where they are far apart one of them has failed,
 * and only there rays are worth their cost; and in contact, where both fail alike. True when rays are to
 * decide; else V. */
static bool blend(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, const dpl_solid_site *site,
                  double *visibility, dpl_solid_counts *counts) {
    const dpl_solid_shadow_desc *desc = &shadow->desc;
    bool may_refine = desc->refine_rays > 0 && is_near_eye(desc, r);
    if (may_refine && (!(desc->refine_threshold > 0.0f) || dpl_solid_is_contact(shadow, r)))
        return true;
    double map = dpl_solid_by_moments(r, site);
    *visibility = 0.0;
    if (desc->weight != DPL_SOLID_WEIGHT_CONSTANT && map <= 0.0)
        return false;
    double march = dpl_solid_by_march(shadow, r, &counts->steps);
    *visibility = dpl_solid_blend(desc, map, march);
    return may_refine && fabs(map - march) > (double)desc->refine_threshold;
}

/* As blend(), by the method that is asked for. */
static bool see_past(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, const dpl_solid_site *site,
                     double *visibility, dpl_solid_counts *counts) {
    switch (shadow->desc.method) {
    case DPL_SOLID_MOMENTS:
        *visibility = dpl_solid_by_moments(r, site);
        return false;
    case DPL_SOLID_MARCH:
        *visibility = dpl_solid_by_march(shadow, r, &counts->steps);
        return false;
    default:
        return blend(shadow, r, site, visibility, counts);
    }
}

/* ---- receivers that wait for rays ----------------------------------------------------------------- */

/* Receivers near each other, whose rays are asked for together. */
typedef struct waiting {
    int32_t count;
    int64_t which[DPL_SOLID_GROUP];
    dpl_solid_receiver receivers[DPL_SOLID_GROUP];
} waiting;

static void ask_rays(const work *w, waiting *g, dpl_solid_counts *counts) {
    double visibility[DPL_SOLID_GROUP];
    if (g->count == 0)
        return;
    dpl_solid_by_cover(w->shadow, g->receivers, g->count, visibility, &counts->walk);
    for (int32_t i = 0; i < g->count; i++)
        w->visibility[g->which[i]] = (float)fmin(visibility[i], dpl_solid_above_horizon(&g->receivers[i]));
    counts->refined += g->count;
    counts->rays += (int64_t)g->count * w->shadow->desc.refine_rays;
    g->count = 0;
}

/* The wider a group beside the light, the more it finds that only some of it need. */
static bool belongs(const waiting *g, const dpl_solid_receiver *r, float longest) {
    float most = GROUP_WIDTH * r->spread * fminf(r->distance, longest);
    for (int axis = 0; axis < 3; axis++)
        if (!(fabsf(r->position[axis] - g->receivers[0].position[axis]) <= most))
            return false;
    return g->count < DPL_SOLID_GROUP;
}

static void wait_for_rays(const work *w, waiting *g, int64_t i, const dpl_solid_receiver *r,
                          dpl_solid_counts *counts) {
    if (g->count > 0 && !belongs(g, r, w->shadow->longest))
        ask_rays(w, g, counts);
    g->which[g->count] = i;
    g->receivers[g->count++] = *r;
}

/* ---- one receiver --------------------------------------------------------------------------------- */

static dpl_solid_site site_of(const dpl_solid_map *map, const dpl_depth_receivers *d, int32_t k) {
    return (dpl_solid_site){.map = map,
                            .place = {d->u[k], d->v[k], d->depth[k], d->stretch[k]},
                            .slope = d->slope[k],
                            .near = d->near[k]};
}

/* What classification alone has found, where it is asked for: lit with the whole disc above the horizon, or
 * dark. */
static bool is_settled(const dpl_solid_shadow_desc *desc, const dpl_depth_receivers *d, int32_t k) {
    return desc->classify && desc->method != DPL_SOLID_REFERENCE &&
           (d->class[k] == DPL_DEPTH_DARK || (d->class[k] == DPL_DEPTH_LIT && d->rising[k]));
}

/* V of receiver i, which is the k-th of those that were classified; or it is put among those that wait. */
static void solve_one(const work *w, int64_t i, const dpl_solid_map *map, const dpl_depth_receivers *d,
                      int32_t k, waiting *group, dpl_solid_counts *counts) {
    const dpl_solid_shadow *shadow = w->shadow;
    dpl_depth_class class = (dpl_depth_class)d->class[k];
    dpl_solid_receiver r;
    double above = 0.0, visibility = 0.0;
    if (is_settled(&shadow->desc, d, k)) {
        counts->lit += class == DPL_DEPTH_LIT;
        counts->dark += class == DPL_DEPTH_DARK;
        visibility = class == DPL_DEPTH_LIT ? 1.0 : 0.0;
    } else if (class == DPL_DEPTH_OUTSIDE || !prepare(w, i, &r) ||
               !((above = dpl_solid_above_horizon(&r)) > 0.0)) {
        counts->dark++;
    } else if (shadow->desc.method == DPL_SOLID_REFERENCE) {
        counts->rays += shadow->desc.samples;
        visibility = dpl_solid_by_rays(shadow, &r, shadow->desc.samples, &counts->walk);
    } else if (shadow->desc.classify && class == DPL_DEPTH_LIT) {
        counts->lit++;
        visibility = above;
    } else {
        dpl_solid_site site = site_of(map, d, k);
        if (see_past(shadow, &r, &site, &visibility, counts)) {
            wait_for_rays(w, group, i, &r, counts);
            return;
        }
        visibility = fmin(visibility, above);
    }
    w->visibility[i] = (float)visibility;
}

/* ---- all receivers -------------------------------------------------------------------------------- */

/* Receivers first .. first + count - 1 that belong to map `number`. */
static void solve_map(const work *w, int64_t first, int32_t count, int32_t number, dpl_solid_counts *counts) {
    const dpl_solid_map *map = &w->shadow->maps[number];
    dpl_depth_receivers d = {0};
    int32_t which[BATCH];
    for (int32_t i = 0; i < count; i++) {
        const float *position = w->positions[first + i];
        if (dpl_solid_map_of(w->shadow, position) != number)
            continue;
        for (int axis = 0; axis < 3; axis++) {
            d.position[axis][d.count] = position[axis];
            d.normal[axis][d.count] = w->normals ? w->normals[first + i][axis] : 0.0f;
        }
        which[d.count++] = i;
    }
    w->shadow->context->kernels->classify(&map->view, &d);
    waiting group = {.count = 0};
    for (int32_t k = 0; k < d.count; k++)
        solve_one(w, first + which[k], map, &d, k, &group, counts);
    ask_rays(w, &group, counts);
}

static void solve_batches(int32_t begin, int32_t end, int32_t worker, void *task) {
    const work *w = task;
    dpl_solid_counts *counts = (dpl_solid_counts *)w->shadow->counts.data + worker;
    for (int32_t batch = begin; batch < end; batch++) {
        int64_t first = (int64_t)batch * BATCH, left = w->count - first;
        for (int32_t map = 0; map < w->shadow->map_count; map++)
            solve_map(w, first, left < BATCH ? (int32_t)left : BATCH, map, counts);
    }
}

dpl_status dpl_solid_shadow_solve(dpl_solid_shadow *shadow, const float (*positions)[3],
                                  const float (*normals)[3], int64_t count, float *visibility) {
    work w = {shadow, positions, normals, count, visibility};
    shadow->receivers += count;
    return dpl_jobs_run(shadow->context, solve_batches, (int32_t)((count + BATCH - 1) / BATCH), 1, &w);
}
