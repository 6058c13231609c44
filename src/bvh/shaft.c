/* The walk of a shaft, see shaft.h. */
#include "bvh/shaft.h"

/* Directions nearer to 0 than this are widened across it: their inverses stay finite. */
#define NEARLY_NONE 1e-12f

/* Roundings on the way: boxes are left a little later and entered a little earlier. */
#define LATER 1.000001f
#define EARLIER 0.999999f

/* A shaft as boxes want it. Along an axis a box is met where t >= (plane[first] - from_first) * to_first, and
 * (plane[1 - first] - from_second) * to_second is where the shaft has left it; or, where the shaft goes both
 * ways, from where on it is wide enough to reach the box from the other side. */
typedef struct prepared {
    float from_first[3];
    float from_second[3];
    float to_first[3];
    float to_second[3];
    int32_t first[3];
    bool both_ways[3];
    float far;
} prepared;

static prepared prepare(const dpl_shaft *shaft) {
    prepared p = {.far = shaft->far};
    for (int axis = 0; axis < 3; axis++) {
        float least = shaft->least[axis], most = shaft->most[axis];
        p.both_ways[axis] = least <= NEARLY_NONE && most >= -NEARLY_NONE;
        if (p.both_ways[axis]) {
            least = least < -NEARLY_NONE ? least : -NEARLY_NONE;
            most = most > NEARLY_NONE ? most : NEARLY_NONE;
        }
        bool forward = least > 0.0f;
        p.first[axis] = forward ? 0 : 1;
        p.from_first[axis] = forward ? shaft->high[axis] : shaft->low[axis];
        p.from_second[axis] = forward ? shaft->low[axis] : shaft->high[axis];
        p.to_first[axis] = EARLIER / (forward ? most : least);
        p.to_second[axis] = (p.both_ways[axis] ? EARLIER : LATER) / (forward ? least : most);
    }
    return p;
}

/* Bit i: the shaft meets the box of child i. */
static uint32_t meets(const dpl_bvh_node *node, const prepared *p) {
    dpl_four in = dpl_four_all(0.0f), out = dpl_four_all(p->far);
    for (int axis = 0; axis < 3; axis++) {
        dpl_four first = dpl_four_load(node->planes[axis][p->first[axis]]);
        dpl_four second = dpl_four_load(node->planes[axis][1 - p->first[axis]]);
        first = dpl_four_multiply(dpl_four_subtract(first, dpl_four_all(p->from_first[axis])),
                                  dpl_four_all(p->to_first[axis]));
        second = dpl_four_multiply(dpl_four_subtract(second, dpl_four_all(p->from_second[axis])),
                                   dpl_four_all(p->to_second[axis]));
        in = dpl_four_most(first, in);
        if (p->both_ways[axis])
            in = dpl_four_most(second, in);
        else
            out = dpl_four_least(second, out);
    }
    return dpl_four_ordered(in, out);
}

void dpl_shaft_walk(const dpl_triangles *set, const dpl_shaft *shaft, dpl_shaft_visit *visit, void *visitor,
                    dpl_walk_counts *counts) {
    int32_t stack[DPL_BVH_MAX_DEPTH * (DPL_BVH_CHILDREN - 1) + 2], height = 0;
    int32_t slots[DPL_SHAFT_BATCH], count = 0;
    const dpl_bvh_node *nodes = dpl_bvh_nodes(&set->bvh);
    prepared p = prepare(shaft);
    bool ended = false;
    if (set->bvh.node_count > 0)
        stack[height++] = 0;
    while (height > 0 && !ended) {
        const dpl_bvh_node *node = &nodes[stack[--height]];
        uint32_t met = meets(node, &p);
        counts->node_visits++;
        for (int i = 0; i < DPL_BVH_CHILDREN; i++) {
            if (!(met >> i & 1))
                continue;
            if (node->child[i] < 0)
                slots[count++] = ~node->child[i];
            else
                stack[height++] = node->child[i];
        }
        if (count > DPL_SHAFT_BATCH - DPL_BVH_CHILDREN) {
            counts->object_tests += count;
            ended = visit(visitor, slots, count);
            count = 0;
        }
    }
    if (count > 0 && !ended) {
        counts->object_tests += count;
        (void)visit(visitor, slots, count);
    }
}
