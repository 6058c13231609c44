/* Turns a tree of pairs into one with four children to a node: half as many steps on the way down, and boxes
 * that can be tested side by side. Called by build.c.
 *
 * Source: Dammertz, Hanika, Keller 2008, "Shallow bounding volume hierarchies for fast SIMD ray tracing of
 * incoherent rays". */
#include "bvh/bvh.h"

/* The child that a ray is most likely to enter and that should be opened; -1 if there is none. What fits into
 * a node of its own is left to it: opened, it would become several that are half empty. */
static int32_t widest(const dpl_bvh *bvh, const int32_t *children, int32_t count) {
    const dpl_bvh_pair *pairs = bvh->pairs.data;
    int32_t best = -1;
    float best_area = -1.0f;
    for (int32_t i = 0; i < count; i++) {
        if (children[i] < 0 || pairs[children[i]].count <= DPL_BVH_CHILDREN)
            continue;
        float area = dpl_bounds_half_area(&pairs[children[i]].bounds, bvh->axes);
        if (area > best_area) {
            best = i;
            best_area = area;
        }
    }
    return best;
}

/* Writes all objects below a child; returns how many. Only for what fits into a node. */
static int32_t list_objects(const dpl_bvh *bvh, int32_t child, int32_t *objects) {
    const dpl_bvh_pair *pairs = bvh->pairs.data;
    if (child < 0) {
        *objects = child;
        return 1;
    }
    int32_t count = list_objects(bvh, pairs[child].child[0], objects);
    return count + list_objects(bvh, pairs[child].child[1], objects + count);
}

/* Where a small child's objects all find room in the node, they need none of their own. */
static int32_t take_in_small(const dpl_bvh *bvh, int32_t *children, int32_t count) {
    const dpl_bvh_pair *pairs = bvh->pairs.data;
    for (int32_t i = 0; i < count; i++) {
        if (children[i] < 0 || count - 1 + pairs[children[i]].count > DPL_BVH_CHILDREN)
            continue;
        int32_t objects[DPL_BVH_CHILDREN], taken = list_objects(bvh, children[i], objects);
        children[i] = objects[0];
        for (int32_t k = 1; k < taken; k++)
            children[count++] = objects[k];
    }
    return count;
}

/* Returns the node made of a pair. No deeper than the tree of pairs. */
static int32_t collapse(dpl_bvh *bvh, int32_t pair, int32_t depth) {
    const dpl_bvh_pair *pairs = bvh->pairs.data;
    dpl_bvh_node *nodes = dpl_bvh_nodes(bvh);
    int32_t children[DPL_BVH_CHILDREN] = {pairs[pair].child[0], pairs[pair].child[1]};
    int32_t count = 2, open;
    while (count < DPL_BVH_CHILDREN && (open = widest(bvh, children, count)) >= 0) {
        const int32_t *opened = pairs[children[open]].child;
        children[open] = opened[0];
        children[count++] = opened[1];
    }
    count = take_in_small(bvh, children, count);
    int32_t index = bvh->node_count++;
    bvh->depth = depth + 1 > bvh->depth ? depth + 1 : bvh->depth;
    nodes[index] = (dpl_bvh_node){.child_count = count};
    for (int32_t i = 0; i < count; i++)
        nodes[index].child[i] = children[i] < 0 ? children[i] : collapse(bvh, children[i], depth + 1);
    return index;
}

void dpl_bvh_collapse(dpl_bvh *bvh) {
    dpl_bvh_node *nodes = dpl_bvh_nodes(bvh);
    bvh->node_count = bvh->depth = 0;
    if (bvh->object_count > 1) {
        (void)collapse(bvh, 0, 0);
    } else if (bvh->object_count == 1) {
        nodes[0] = (dpl_bvh_node){.child = {~0}, .child_count = 1};
        bvh->node_count = bvh->depth = 1;
    }
}
