/* Keeps shapes as rays read them: copied, boxed, sorted. Called by the tracer when its world changes. */
#include "bvh/shape.h"

#include <math.h>

/* ---- packing -------------------------------------------------------------------------------------- */

static void pack_segment(const dpl_segment *segment, dpl_packed_shape *packed) {
    double x = segment->to[0] - segment->from[0], y = segment->to[1] - segment->from[1];
    double length = hypot(x, y);
    packed->center[0] = segment->from[0] + 0.5 * x;
    packed->center[1] = segment->from[1] + 0.5 * y;
    packed->axis[0] = length > 0.0 ? x / length : 1.0;
    packed->axis[1] = length > 0.0 ? y / length : 0.0;
    packed->half[0] = 0.5 * length;
    packed->half[1] = 0.5 * segment->width;
}

static void pack_box(const dpl_box *box, dpl_packed_shape *packed) {
    memcpy(packed->center, box->center, sizeof packed->center);
    memcpy(packed->half, box->half, sizeof packed->half);
    packed->axis[0] = cos(box->angle);
    packed->axis[1] = sin(box->angle);
}

/* All of a shape but where a polygon's points are. */
static dpl_packed_shape pack(const dpl_shape *shape, int32_t object) {
    dpl_packed_shape packed = {.kind = shape->kind, .object = object};
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        memcpy(packed.center, shape->disc.center, sizeof packed.center);
        packed.half[0] = packed.half[1] = shape->disc.radius;
        break;
    case DPL_SHAPE_BOX:
        pack_box(&shape->box, &packed);
        break;
    case DPL_SHAPE_SEGMENT:
        pack_segment(&shape->segment, &packed);
        break;
    case DPL_SHAPE_POLYGON:
        packed.point_count = shape->polygon.count;
        break;
    }
    return packed;
}

/* In the order of the leaves, if there are any. */
static void pack_all(dpl_shapes *set, const dpl_shape *shapes, int32_t count) {
    const int32_t *objects = set->bvh.objects.data;
    dpl_packed_shape *packed = set->packed.data;
    double(*points)[2] = set->points.data;
    int32_t next_point = 0;
    for (int32_t slot = 0; slot < count; slot++) {
        int32_t i = set->has_tree ? objects[slot] : slot;
        packed[slot] = pack(&shapes[i], i);
        if (packed[slot].point_count == 0)
            continue;
        packed[slot].first_point = next_point;
        next_point += packed[slot].point_count;
        memcpy(points[packed[slot].first_point], shapes[i].polygon.points,
               (size_t)packed[slot].point_count * sizeof points[0]);
    }
}

/* ---- boxes around shapes -------------------------------------------------------------------------- */

static void add_corner(dpl_bounds *bounds, double x, double y) {
    const float point[3] = {(float)x, (float)y, 0.0f};
    dpl_bounds_add_point(bounds, point);
}

/* Half the width and height of the box around a shape that has a centre. */
static void reach_of(const dpl_packed_shape *shape, double reach[2]) {
    double c = fabs(shape->axis[0]), s = fabs(shape->axis[1]), a = shape->half[0], b = shape->half[1];
    switch (shape->kind) {
    case DPL_SHAPE_BOX:
        reach[0] = a * c + b * s;
        reach[1] = a * s + b * c;
        break;
    case DPL_SHAPE_SEGMENT:
        reach[0] = a * c + b;
        reach[1] = a * s + b;
        break;
    default:
        reach[0] = reach[1] = a;
    }
}

static dpl_bounds measure(const dpl_shape *shape) {
    dpl_bounds bounds = dpl_bounds_empty();
    if (shape->kind == DPL_SHAPE_POLYGON) {
        for (int32_t i = 0; i < shape->polygon.count; i++)
            add_corner(&bounds, shape->polygon.points[i][0], shape->polygon.points[i][1]);
    } else {
        dpl_packed_shape packed = pack(shape, 0);
        double reach[2];
        reach_of(&packed, reach);
        add_corner(&bounds, packed.center[0] - reach[0], packed.center[1] - reach[1]);
        add_corner(&bounds, packed.center[0] + reach[0], packed.center[1] + reach[1]);
    }
    dpl_bounds_pad(&bounds, 2);
    return bounds;
}

/* ---- the set -------------------------------------------------------------------------------------- */

static dpl_status reserve(dpl_context *context, dpl_shapes *set, const dpl_shape *shapes, int32_t count) {
    size_t points = 0;
    for (int32_t i = 0; i < count; i++)
        points += shapes[i].kind == DPL_SHAPE_POLYGON ? (size_t)shapes[i].polygon.count : 0;
    if (points > INT32_MAX)
        return dpl_fail(context, DPL_ERROR_SIZE, "the polygons have %zu corners together", points);
    DPL_TRY(dpl_buffer_reserve(context, &set->points, points, 2 * sizeof(double)));
    DPL_TRY(dpl_buffer_reserve(context, &set->packed, (size_t)count, sizeof(dpl_packed_shape)));
    return dpl_buffer_reserve(context, &set->bounds, (size_t)count, sizeof(dpl_bounds));
}

dpl_status dpl_shapes_set(dpl_context *context, dpl_shapes *set, const dpl_shape *shapes, int32_t count,
                          bool tree) {
    set->count = 0;
    set->has_tree = tree;
    DPL_TRY(reserve(context, set, shapes, count));
    dpl_bounds *bounds = set->bounds.data;
    for (int32_t i = 0; i < count; i++)
        bounds[i] = measure(&shapes[i]);
    if (tree)
        DPL_TRY(dpl_bvh_update(context, &set->bvh, 2, bounds, count));
    pack_all(set, shapes, count);
    set->count = count;
    return DPL_OK;
}

void dpl_shapes_free(dpl_context *context, dpl_shapes *set) {
    dpl_buffer_free(context, &set->points);
    dpl_buffer_free(context, &set->packed);
    dpl_buffer_free(context, &set->bounds);
    dpl_bvh_free(context, &set->bvh);
    *set = (dpl_shapes){0};
}
