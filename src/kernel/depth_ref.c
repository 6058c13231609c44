/* The scalar reference of the kernel `classify`: which receivers are surely lit or dark, from the nearest and
 * farthest depths of the region of the map that anything between them and the light can be in.
 *
 * A blocker before the receiver at depth z is within disc_at(z) of the receiver's place, and the map shows
 * something at most as deep there. So the region for the nearest depth of all is enough; what is nearest in
 * that makes the region smaller, and again. */
#include "kernel/depth_ref.h"

#include <math.h>

/* A receiver as the view sees it. */
typedef struct place {
    float u, v, depth, stretch, slope;
} place;

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Fills `p`, and says whether the whole disc is above the horizon. False for what is out of view. */
static bool find_place(const dpl_depth_view *view, const float position[3], const float normal[3], place *p,
                       bool *rising) {
    float away[3], seen[3], turned[3];
    for (int axis = 0; axis < 3; axis++)
        away[axis] = position[axis] - view->eye[axis];
    for (int axis = 0; axis < 3; axis++) {
        seen[axis] = dot(view->axis[axis], away);
        turned[axis] = dot(view->axis[axis], normal);
    }
    float along = dot(turned, seen), size_of_normal = dot(normal, normal);
    float distance = sqrtf(dot(seen, seen)), middle = 0.5f * (float)view->size;
    float facing = view->parallel ? turned[2] : along;
    float scale = view->parallel ? view->scale : view->scale / seen[2];
    float turn = fabsf(view->parallel ? turned[2] : along / (seen[2] * seen[2])) * view->scale;
    float slope = (fabsf(turned[0]) + fabsf(turned[1])) / (turn > DEPTH_LEAST_TURN ? turn : DEPTH_LEAST_TURN);
    p->u = middle + scale * seen[0];
    p->v = middle + scale * seen[1];
    p->depth = seen[2];
    p->stretch = view->parallel ? 1.0f : distance / seen[2];
    p->slope = slope < view->steepest ? slope : view->steepest;
    *rising = -facing >= view->light || !(size_of_normal > 0.0f);
    return dot(position, position) + size_of_normal < INFINITY &&
           (view->parallel || (seen[2] > 0.0f && seen[2] >= distance * view->cone_cosine));
}

/* Half the width of what lies between the receiver and the disc at a depth before it [texel]. */
static float region_at(const dpl_depth_view *view, const place *p, float depth) {
    float half = view->light * view->scale * (p->depth - depth);
    half = (view->parallel ? half : half / (p->depth * depth)) * p->stretch;
    return (depth < p->depth ? half : 0.0f) + DEPTH_TEXEL;
}

/* Pairs of a level. */
typedef struct region {
    bool outside; /* of the map */
    int32_t first, side, x0, x1, y0, y1;
} region;

static int32_t texel_of(float at, int32_t size) {
    float last = (float)(size - 1);
    at = at < last ? at : last;
    return (int32_t)(at > 0.0f ? at : 0.0f);
}

static region region_around(const dpl_depth_view *view, const place *p, float half) {
    float size = (float)view->size;
    region r = {.x0 = texel_of(p->u - half, view->size), .x1 = texel_of(p->u + half, view->size)};
    r.y0 = texel_of(p->v - half, view->size);
    r.y1 = texel_of(p->v + half, view->size);
    r.outside = p->u + half < 0.0f || p->u - half > size || p->v + half < 0.0f || p->v - half > size;
    int32_t level = 0;
    while ((r.x1 >> level) - (r.x0 >> level) >= DEPTH_READS ||
           (r.y1 >> level) - (r.y0 >> level) >= DEPTH_READS)
        level++;
    r.x0 >>= level;
    r.x1 >>= level;
    r.y0 >>= level;
    r.y1 >>= level;
    r.first = view->first[level];
    r.side = view->side[level];
    return r;
}

static float nearest_in(const dpl_depth_view *view, const region *r) {
    float near = INFINITY;
    for (int32_t y = r->y0; y <= r->y1 && !r->outside; y++)
        for (int32_t x = r->x0; x <= r->x1; x++) {
            float depth = view->ranges[2 * (r->first + y * r->side + x)];
            near = depth < near ? depth : near;
        }
    return near;
}

static float farthest_in(const dpl_depth_view *view, const region *r) {
    float far = -INFINITY;
    for (int32_t y = r->y0; y <= r->y1; y++)
        for (int32_t x = r->x0; x <= r->x1; x++) {
            float depth = view->ranges[2 * (r->first + y * r->side + x) + 1];
            far = depth > far ? depth : far;
        }
    return far;
}

/* Everything in the region is before the receiver, and no ray passes between what its texels show: not where
 * they show one surface. Between depths near and far a disc passes a gap as wide as the regions at the two
 * differ. */
static bool is_dark(const dpl_depth_view *view, const place *p, float half, float near) {
    region r = region_around(view, p, half);
    float far = farthest_in(view, &r);
    return far < p->depth - DEPTH_SAME * p->depth - p->slope * (half + DEPTH_TEXEL) &&
           region_at(view, p, near) - region_at(view, p, far) < 2.0f * DEPTH_TEXEL;
}

static dpl_depth_class classify(const dpl_depth_view *view, const place *p, float *near) {
    float before = view->near, half = 0.0f;
    for (int i = 0; i < DEPTH_ROUNDS; i++) {
        half = region_at(view, p, before);
        region r = region_around(view, p, half);
        *near = nearest_in(view, &r);
        float bias = DEPTH_SAME * p->depth;
        bias = half < 3.0f * DEPTH_TEXEL ? p->slope * (half + DEPTH_TEXEL) + bias : bias;
        if (*near >= p->depth - bias)
            return DPL_DEPTH_LIT;
        if (i > 0 && *near <= before)
            break;
        before = *near;
    }
    return is_dark(view, p, half, *near) ? DPL_DEPTH_DARK : DPL_DEPTH_OPEN;
}

void dpl_classify_ref(const dpl_depth_view *view, dpl_depth_receivers *d) {
    for (int32_t i = 0; i < d->count; i++) {
        float position[3] = {d->position[0][i], d->position[1][i], d->position[2][i]};
        float normal[3] = {d->normal[0][i], d->normal[1][i], d->normal[2][i]};
        place p;
        bool rising;
        if (!find_place(view, position, normal, &p, &rising)) {
            d->class[i] = DPL_DEPTH_OUTSIDE;
            continue;
        }
        d->class[i] = (int32_t)classify(view, &p, &d->near[i]);
        d->rising[i] = rising ? -1 : 0;
        d->u[i] = p.u;
        d->v[i] = p.v;
        d->depth[i] = p.depth;
        d->stretch[i] = p.stretch;
        d->slope[i] = p.slope;
    }
}
