/* Fits the boxes of a hierarchy around its objects, bottom up, and says what a ray will have to do. Called by
 * build.c, and by whoever moves objects. */
#include "bvh/bvh.h"

/* A refitted tree whose cost has grown by more than this factor is built again. */
#define WORST_REFIT 1.5

static dpl_bounds node_bounds(const dpl_bvh_node *node) {
    dpl_bounds sum = dpl_bounds_empty();
    for (int32_t i = 0; i < node->child_count; i++) {
        dpl_bounds child;
        for (int axis = 0; axis < 3; axis++) {
            child.low[axis] = node->planes[axis][0][i];
            child.high[axis] = node->planes[axis][1][i];
        }
        dpl_bounds_add(&sum, &child);
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
    const int32_t *objects = bvh->objects.data;
    dpl_bvh_node *nodes = dpl_bvh_nodes(bvh);
    double area_sum = 0.0;
    float area = 0.0f;
    /* Parents come before their children, so backwards every child is done first. The root is last. */
    for (int32_t index = bvh->node_count - 1; index >= 0; index--) {
        dpl_bvh_node *node = &nodes[index];
        for (int32_t i = 0; i < DPL_BVH_CHILDREN; i++) {
            dpl_bounds child = dpl_bounds_empty();
            if (i < node->child_count)
                child = node->child[i] < 0 ? bounds[objects[~node->child[i]]]
                                           : node_bounds(&nodes[node->child[i]]);
            set_child(node, i, &child);
        }
        dpl_bounds all = node_bounds(node);
        area = dpl_bounds_half_area(&all, bvh->axes);
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
    dpl_buffer_free(context, &bvh->pairs);
    *bvh = (dpl_bvh){0};
}
