/* Fits the boxes of a hierarchy around its objects, bottom up, and says what a ray will have to do. Called by
 * build.c, and by whoever moves objects. */
#include "bvh/bvh.h"

/* A refitted tree whose cost has grown by more than this factor is built again. */
#define WORST_REFIT 1.5

static dpl_bounds child_bounds(const dpl_bvh *bvh, const dpl_bounds *bounds, int32_t child) {
    if (child < 0)
        return bounds[((const int32_t *)bvh->objects.data)[~child]];
    const dpl_bvh_node *node = &((const dpl_bvh_node *)bvh->nodes.data)[child];
    dpl_bounds sum;
    for (int axis = 0; axis < 3; axis++) {
        const float *low = node->planes[axis][0], *high = node->planes[axis][1];
        sum.low[axis] = low[0] < low[1] ? low[0] : low[1];
        sum.high[axis] = high[0] > high[1] ? high[0] : high[1];
    }
    return sum;
}

static void set_child(dpl_bvh_node *node, int32_t which, const dpl_bounds *bounds) {
    for (int axis = 0; axis < 3; axis++) {
        node->planes[axis][0][which] = bounds->low[axis];
        node->planes[axis][1][which] = bounds->high[axis];
    }
}

void dpl_bvh_refit(dpl_bvh *bvh, const dpl_bounds *bounds) {
    dpl_bvh_node *nodes = bvh->nodes.data;
    double area_sum = 0.0;
    float area = 0.0f;
    /* Parents come before their children, so backwards every child is done first. The root is last. */
    for (int32_t i = bvh->node_count - 1; i >= 0; i--) {
        dpl_bounds left = child_bounds(bvh, bounds, nodes[i].child[0]), right = dpl_bounds_empty();
        if (bvh->object_count > 1)
            right = child_bounds(bvh, bounds, nodes[i].child[1]);
        set_child(&nodes[i], 0, &left);
        set_child(&nodes[i], 1, &right);
        dpl_bounds_add(&left, &right);
        area = dpl_bounds_half_area(&left, bvh->axes);
        area_sum += (double)area;
    }
    bvh->cost = area > 0.0f ? area_sum / (double)area : (double)bvh->node_count;
}

dpl_status dpl_bvh_update(dpl_context *context, dpl_bvh *bvh, int32_t axes, const dpl_bounds *bounds,
                          int32_t count) {
    if (count > 0 && bvh->object_count == count && bvh->axes == axes) {
        dpl_bvh_refit(bvh, bounds);
        if (bvh->cost <= WORST_REFIT * bvh->cost_at_build) {
            bvh->refits++;
            return DPL_OK;
        }
    }
    return dpl_bvh_build(context, bvh, axes, bounds, count);
}

void dpl_bvh_free(dpl_context *context, dpl_bvh *bvh) {
    dpl_buffer_free(context, &bvh->nodes);
    dpl_buffer_free(context, &bvh->objects);
    dpl_buffer_free(context, &bvh->scratch);
    *bvh = (dpl_bvh){0};
}
