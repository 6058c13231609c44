/* One ray against shapes of the plane, in double precision: where does it enter? Shapes are kept by
 * shape_set.c.
 *
 * All but polygons are convex, so a ray is inside them over one span of t. */
#include "bvh/shape.h"

#include <math.h>

/* A ray on its way through shapes. */
typedef struct query {
    const dpl_packed_shape *packed;
    const double (*points)[2];
    int32_t first_object;
    dpl_hit hit;
    bool any; /* the first hit that is found will do */
    double origin[2];
    double direction[2];
    double near;
    double length2; /* of the direction, squared */
} query;

/* Over which t the ray is inside; nothing when from > to. */
typedef struct span {
    double from;
    double to;
} span;

static const span nothing = {1.0, 0.0};

static inline double dot(const double a[2], const double b[2]) {
    return a[0] * b[0] + a[1] * b[1];
}

static inline double cross(const double a[2], const double b[2]) {
    return a[0] * b[1] - a[1] * b[0];
}

/* ---- spans of convex shapes ----------------------------------------------------------------------- */

/* Measured from the point of the ray that is nearest to the centre, so that nothing large cancels. */
static span disc_span(const query *q, double x, double y, double radius) {
    const double to_center[2] = {x - q->origin[0], y - q->origin[1]};
    double nearest = dot(to_center, q->direction) / q->length2;
    double off_x = to_center[0] - nearest * q->direction[0], off_y = to_center[1] - nearest * q->direction[1];
    double rest = radius * radius - (off_x * off_x + off_y * off_y);
    if (!(rest >= 0.0))
        return nothing;
    double half = sqrt(rest / q->length2);
    return (span){nearest - half, nearest + half};
}

/* Narrows a span to where |at + t * step| <= half. */
static span clip(span s, double at, double step, double half) {
    if (step == 0.0)
        return fabs(at) <= half ? s : nothing;
    double first = (-half - at) / step, second = (half - at) / step;
    if (first > second) {
        double swapped = first;
        first = second;
        second = swapped;
    }
    return (span){first > s.from ? first : s.from, second < s.to ? second : s.to};
}

static span box_span(const query *q, const dpl_packed_shape *shape) {
    const double from_center[2] = {q->origin[0] - shape->center[0], q->origin[1] - shape->center[1]};
    span s = {-HUGE_VAL, HUGE_VAL};
    s = clip(s, dot(shape->axis, from_center), dot(shape->axis, q->direction), shape->half[0]);
    return clip(s, cross(shape->axis, from_center), cross(shape->axis, q->direction), shape->half[1]);
}

/* From the first of two overlapping spans to the last; either may be nothing. */
static span join(span a, span b) {
    if (a.from > a.to)
        return b;
    if (b.from > b.to)
        return a;
    return (span){fmin(a.from, b.from), fmax(a.to, b.to)};
}

/* A thick line: its rectangle and a disc at each end, together convex. */
static span segment_span(const query *q, const dpl_packed_shape *shape) {
    double x = shape->half[0] * shape->axis[0], y = shape->half[0] * shape->axis[1];
    double radius = shape->half[1];
    span ends = join(disc_span(q, shape->center[0] - x, shape->center[1] - y, radius),
                     disc_span(q, shape->center[0] + x, shape->center[1] + y, radius));
    return join(ends, box_span(q, shape));
}

/* ---- polygons ------------------------------------------------------------------------------------- */

/* A corner as the ray sees it: how far along (t times length2), and on which side. */
typedef struct corner {
    double along;
    double side;
} corner;

static inline corner look_at(const query *q, const double point[2]) {
    const double from_origin[2] = {point[0] - q->origin[0], point[1] - q->origin[1]};
    return (corner){dot(from_origin, q->direction), cross(q->direction, from_origin)};
}

/* Where the ray meets an edge at or after `near`; HUGE_VAL if nowhere. */
static double edge_t(const query *q, corner a, corner b) {
    if ((a.side > 0.0 && b.side > 0.0) || (a.side < 0.0 && b.side < 0.0))
        return HUGE_VAL;
    double t;
    if (a.side == b.side) { /* the edge lies on the ray's line */
        double first = fmin(a.along, b.along) / q->length2, last = fmax(a.along, b.along) / q->length2;
        t = last >= q->near ? fmax(first, q->near) : -HUGE_VAL;
    } else {
        t = (a.along + (b.along - a.along) * (a.side / (a.side - b.side))) / q->length2;
    }
    return t >= q->near ? t : HUGE_VAL;
}

/* A ray that crosses the outline an odd number of times from here on is inside, as even-odd has it. */
static span polygon_span(const query *q, const dpl_packed_shape *shape) {
    const double(*points)[2] = q->points + shape->first_point;
    corner a = look_at(q, points[shape->point_count - 1]);
    double first = HUGE_VAL;
    bool inside = false;
    for (int32_t i = 0; i < shape->point_count; i++) {
        corner b = look_at(q, points[i]);
        double t = edge_t(q, a, b);
        first = t < first ? t : first;
        inside ^= t < HUGE_VAL && (a.side < 0.0) != (b.side < 0.0);
        a = b;
    }
    if (inside)
        first = q->near;
    return first < HUGE_VAL ? (span){first, first} : nothing;
}

/* ---- one ray, one shape --------------------------------------------------------------------------- */

static inline span shape_span(const query *q, const dpl_packed_shape *shape) {
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        return disc_span(q, shape->center[0], shape->center[1], shape->half[0]);
    case DPL_SHAPE_BOX:
        return box_span(q, shape);
    case DPL_SHAPE_SEGMENT:
        return segment_span(q, shape);
    case DPL_SHAPE_POLYGON:
        return polygon_span(q, shape);
    }
    return nothing;
}

/* As dpl_walk_ask. One function for both questions, so that the walk is compiled once, around it. */
static inline bool ask_shape(void *asker, int32_t slot, float enter, dpl_walk_ray *ray) {
    query *q = asker;
    const dpl_packed_shape *shape = &q->packed[slot];
    span s = shape_span(q, shape);
    if (!(s.from <= s.to && s.to >= q->near))
        return false;
    int32_t object = q->first_object + shape->object;
    float t = (float)s.from;
    t = t > enter ? t : enter;
    if (t > ray->far || (t == ray->far && q->hit.object > object))
        return false;
    ray->far = t;
    q->hit = (dpl_hit){t, object, 0.0f, 0.0f};
    return q->any;
}

/* ---- one ray, all shapes -------------------------------------------------------------------------- */

static query query_begin(const dpl_shapes *set, const dpl_ray *ray, const dpl_walk_ray *prepared,
                         const dpl_hit *hit) {
    query q = {
        .packed = set->packed.data,
        .points = set->points.data,
        .first_object = set->first_object,
        .hit = *hit,
        .origin = {(double)ray->origin[0], (double)ray->origin[1]},
        .direction = {(double)ray->direction[0], (double)ray->direction[1]},
        .near = (double)prepared->near,
    };
    q.length2 = dot(q.direction, q.direction);
    return q;
}

static bool walk(const dpl_shapes *set, query *q, dpl_walk_ray *ray, dpl_walk_counts *counts) {
    if (set->has_tree)
        return dpl_walk(&set->bvh, 2, ray, ask_shape, q, counts);
    return dpl_walk_all(set->bounds.data, set->count, 2, ray, ask_shape, q, counts);
}

void dpl_shapes_closest(const dpl_shapes *set, const dpl_ray *ray, dpl_hit *hit, dpl_walk_counts *counts) {
    dpl_walk_ray prepared;
    if (!dpl_walk_ray_prepare(ray, 2, &prepared))
        return;
    prepared.far = hit->t < prepared.far ? hit->t : prepared.far;
    query q = query_begin(set, ray, &prepared, hit);
    (void)walk(set, &q, &prepared, counts);
    *hit = q.hit;
}

bool dpl_shapes_occluded(const dpl_shapes *set, const dpl_ray *ray, dpl_walk_counts *counts) {
    dpl_walk_ray prepared;
    if (!dpl_walk_ray_prepare(ray, 2, &prepared))
        return false;
    dpl_hit none = dpl_hit_none();
    query q = query_begin(set, ray, &prepared, &none);
    q.any = true;
    return walk(set, &q, &prepared, counts);
}
