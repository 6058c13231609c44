/* The kernel `classify` in vectors, a receiver to a lane. Included by vector.c. Equal to depth_ref.c to the
 * bit: read that file first. */
#ifndef DPL_KERNEL_VECTOR_DEPTH_H
#define DPL_KERNEL_VECTOR_DEPTH_H

#include "kernel/depth_view.h"
#include "kernel/simd.h"

#include <math.h>

/* Receivers as the view sees them. */
typedef struct depth_places {
    vint in_view, rising;
    vfloat u, v, depth, stretch, slope;
} depth_places;

static inline vfloat depth_dot(const float a[3], const vfloat b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline vfloat depth_square(const vfloat a[3]) {
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

static depth_places find_places(const dpl_depth_view *view, const vfloat position[3],
                                const vfloat normal[3]) {
    vfloat away[3], seen[3], turned[3];
    depth_places p;
    for (int axis = 0; axis < 3; axis++)
        away[axis] = position[axis] - view->eye[axis];
    for (int axis = 0; axis < 3; axis++) {
        seen[axis] = depth_dot(view->axis[axis], away);
        turned[axis] = depth_dot(view->axis[axis], normal);
    }
    vfloat along = turned[0] * seen[0] + turned[1] * seen[1] + turned[2] * seen[2];
    vfloat size_of_normal = depth_square(normal), distance = square_root(depth_square(seen));
    vfloat facing = view->parallel ? turned[2] : along;
    vfloat scale = view->parallel ? all_float(view->scale) : view->scale / seen[2];
    vfloat turn = magnitude(view->parallel ? turned[2] : along / (seen[2] * seen[2])) * view->scale;
    turn = select_float(turn > DEPTH_LEAST_TURN, turn, all_float(DEPTH_LEAST_TURN));
    vfloat slope = (magnitude(turned[0]) + magnitude(turned[1])) / turn;
    float middle = 0.5f * (float)view->size;
    p.u = middle + scale * seen[0];
    p.v = middle + scale * seen[1];
    p.depth = seen[2];
    p.stretch = view->parallel ? all_float(1.0f) : distance / seen[2];
    p.slope = select_float(slope < view->steepest, slope, all_float(view->steepest));
    p.rising = (-facing >= view->light) | ~(size_of_normal > 0.0f);
    p.in_view = depth_square(position) + size_of_normal < INFINITY;
    if (!view->parallel)
        p.in_view &= (seen[2] > 0.0f) & (seen[2] >= distance * view->cone_cosine);
    return p;
}

static inline vfloat depth_region_at(const dpl_depth_view *view, const depth_places *p, vfloat depth) {
    vfloat half = view->light * view->scale * (p->depth - depth);
    half = (view->parallel ? half : half / (p->depth * depth)) * p->stretch;
    return (vfloat)((depth < p->depth) & (vint)half) + DEPTH_TEXEL;
}

/* Pairs of a level, per lane. */
typedef struct depth_regions {
    vint outside, first, side, x0, x1, y0, y1;
} depth_regions;

static inline vint depth_texel_of(vfloat at, int32_t size) {
    float last = (float)(size - 1);
    at = select_float(at < last, at, all_float(last));
    return to_int((vfloat)((at > 0.0f) & (vint)at));
}

static depth_regions depth_regions_around(const dpl_depth_view *view, const depth_places *p, vfloat half) {
    float size = (float)view->size;
    vfloat u0 = p->u - half, u1 = p->u + half, v0 = p->v - half, v1 = p->v + half;
    depth_regions r = {.x0 = depth_texel_of(u0, view->size), .x1 = depth_texel_of(u1, view->size)};
    r.y0 = depth_texel_of(v0, view->size);
    r.y1 = depth_texel_of(v1, view->size);
    r.outside = (u1 < 0.0f) | (u0 > size) | (v1 < 0.0f) | (v0 > size);
    vint level = {0}, wide;
    while (any(wide = (r.x1 - r.x0 >= DEPTH_READS) | (r.y1 - r.y0 >= DEPTH_READS))) {
        level -= wide;
        r.x0 = select_int(wide, r.x0 >> 1, r.x0);
        r.x1 = select_int(wide, r.x1 >> 1, r.x1);
        r.y0 = select_int(wide, r.y0 >> 1, r.y0);
        r.y1 = select_int(wide, r.y1 >> 1, r.y1);
    }
    r.first = gather_ints(view->first, level);
    r.side = gather_ints(view->side, level);
    return r;
}

/* The least of a float per pair, `which` of the two and times `sign`, in the lanes of a mask. */
static vfloat depth_least_in(const dpl_depth_view *view, const depth_regions *r, vint lanes, int which,
                             float sign) {
    vfloat least = all_float(INFINITY), none = all_float(INFINITY);
    for (int32_t down = 0; down < DEPTH_READS; down++) {
        vint y = r->y0 + down, in_row = lanes & (y <= r->y1);
        if (!any(in_row))
            break;
        vint row = r->first + y * r->side;
        for (int32_t along = 0; along < DEPTH_READS; along++) {
            vint x = r->x0 + along, there = in_row & (x <= r->x1);
            vfloat depth = gather(there, view->ranges + which, 2 * (row + x), none);
            depth = select_float(there, sign * depth, none);
            least = select_float(depth < least, depth, least);
        }
    }
    return least;
}

static vint depth_is_dark(const dpl_depth_view *view, const depth_places *p, vint lanes, vfloat half,
                          vfloat near) {
    depth_regions r = depth_regions_around(view, p, half);
    vfloat far = -depth_least_in(view, &r, lanes, 1, -1.0f);
    vint before = far < p->depth - DEPTH_SAME * p->depth - p->slope * (half + DEPTH_TEXEL);
    return lanes & before &
           (depth_region_at(view, p, near) - depth_region_at(view, p, far) < 2.0f * DEPTH_TEXEL);
}

static vint depth_classes(const dpl_depth_view *view, const depth_places *p, vfloat *near) {
    vfloat before = all_float(view->near), half = {0};
    vint undecided = p->in_view, lit = {0};
    *near = before;
    vint running = undecided;
    for (int i = 0; i < DEPTH_ROUNDS && any(running); i++) {
        half = select_float(running, depth_region_at(view, p, before), half);
        depth_regions r = depth_regions_around(view, p, half);
        *near = select_float(running, depth_least_in(view, &r, running & ~r.outside, 0, 1.0f), *near);
        vfloat bias = DEPTH_SAME * p->depth;
        bias = select_float(half < 3.0f * DEPTH_TEXEL, p->slope * (half + DEPTH_TEXEL) + bias, bias);
        vint now = running & (*near >= p->depth - bias);
        lit |= now;
        running &= ~now;
        if (i > 0)
            running &= ~(*near <= before);
        before = select_float(running, *near, before);
    }
    undecided &= ~lit;
    vint dark = any(undecided) ? depth_is_dark(view, p, undecided, half, *near) : undecided;
    vint class = (lit & DPL_DEPTH_LIT) | (dark & DPL_DEPTH_DARK);
    return select_int(p->in_view, class, all_int(DPL_DEPTH_OUTSIDE));
}

static void classify(const dpl_depth_view *view, dpl_depth_receivers *d) {
    for (int32_t i = 0; i < d->count; i += LANES) {
        vfloat position[3], normal[3], near;
        for (int axis = 0; axis < 3; axis++) {
            position[axis] = load_some(d->position[axis] + i, LANES);
            normal[axis] = load_some(d->normal[axis] + i, LANES);
        }
        depth_places p = find_places(view, position, normal);
        /* what is behind the end is not to be worked on */
        p.in_view &= lane_numbers() < d->count - i;
        store_some_ints(d->class + i, depth_classes(view, &p, &near), LANES);
        store_some_ints(d->rising + i, p.rising, LANES);
        store_some(d->u + i, p.u, LANES);
        store_some(d->v + i, p.v, LANES);
        store_some(d->depth + i, p.depth, LANES);
        store_some(d->stretch + i, p.stretch, LANES);
        store_some(d->slope + i, p.slope, LANES);
        store_some(d->near + i, near, LANES);
    }
}

#endif
