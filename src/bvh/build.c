/* Sorts boxes into a hierarchy: top down, each range split where the surface-area heuristic over bins says a
 * ray will have least to do, down to single objects. Called by triangle.c and shape.c.
 *
 * One thread, and no choice depends on memory addresses: the same boxes give the same tree.
 *
 * Source: MacDonald and Booth 1990, "Heuristics for ray tracing using space subdivision"; bins: Wald 2007,
 * "On fast construction of SAH-based bounding volume hierarchies". */
#include "bvh/bvh.h"

#include <math.h>

#define BINS 16

/* Ranges of at most this many objects are cut exactly, so that nodes become full. */
#define SMALL 16

/* An object while ranges are sorted: its box and its number travel together. */
typedef struct reference {
    float low[3];
    int32_t object;
    float high[3];
    int32_t unused;
} reference;

typedef struct builder {
    int32_t axes;
    reference *references;
    dpl_bvh_pair *pairs;
    int32_t pair_count;
} builder;

typedef struct bin {
    dpl_bounds bounds;
    int32_t count;
} bin;

/* How a centre becomes a bin along one axis. */
typedef struct ruler {
    float low;
    float scale; /* 0: all centres are the same */
} ruler;

/* The best place to cut a range. */
typedef struct cut {
    float cost;
    int32_t axis; /* -1: nowhere */
    int32_t bin;  /* first bin of the right side */
    ruler along;
} cut;

/* Twice the centre: halving it changes nothing. */
static inline float centre(const reference *r, int32_t axis) {
    return r->low[axis] + r->high[axis];
}

static inline int32_t bin_of(const ruler *along, float at) {
    int32_t index = (int32_t)((at - along->low) * along->scale);
    return index < BINS ? index : BINS - 1;
}

static void measure(const builder *b, int32_t begin, int32_t end, ruler rulers[3]) {
    dpl_bounds centres = dpl_bounds_empty();
    for (int32_t i = begin; i < end; i++) {
        const reference *r = &b->references[i];
        const float point[3] = {centre(r, 0), centre(r, 1), centre(r, 2)};
        dpl_bounds_add_point(&centres, point);
    }
    for (int32_t axis = 0; axis < b->axes; axis++) {
        float extent = centres.high[axis] - centres.low[axis];
        float scale = extent > 0.0f ? (float)BINS * 0.9999f / extent : 0.0f;
        rulers[axis] = (ruler){centres.low[axis], scale < 3e38f ? scale : 0.0f};
    }
}

static void fill_bins(const builder *b, int32_t begin, int32_t end, int32_t axis, const ruler *along,
                      bin bin_list[BINS]) {
    for (int32_t k = 0; k < BINS; k++)
        bin_list[k] = (bin){dpl_bounds_empty(), 0};
    for (int32_t i = begin; i < end; i++) {
        const reference *r = &b->references[i];
        bin *into = &bin_list[bin_of(along, centre(r, axis))];
        for (int32_t k = 0; k < 3; k++) {
            into->bounds.low[k] = r->low[k] < into->bounds.low[k] ? r->low[k] : into->bounds.low[k];
            into->bounds.high[k] = r->high[k] > into->bounds.high[k] ? r->high[k] : into->bounds.high[k];
        }
        into->count++;
    }
}

/* Expected work on both sides of every boundary between bins; keeps the least. */
static void judge(const bin bin_list[BINS], int32_t axes, int32_t axis, const ruler *along, cut *best) {
    float right_cost[BINS];
    int32_t count = 0;
    dpl_bounds bounds = dpl_bounds_empty();
    for (int32_t k = BINS - 1; k > 0; k--) {
        dpl_bounds_add(&bounds, &bin_list[k].bounds);
        count += bin_list[k].count;
        right_cost[k] = count > 0 ? (float)count * dpl_bounds_half_area(&bounds, axes) : -1.0f;
    }
    bounds = dpl_bounds_empty();
    count = 0;
    for (int32_t k = 1; k < BINS; k++) {
        dpl_bounds_add(&bounds, &bin_list[k - 1].bounds);
        count += bin_list[k - 1].count;
        if (count == 0 || right_cost[k] < 0.0f)
            continue;
        float cost = (float)count * dpl_bounds_half_area(&bounds, axes) + right_cost[k];
        if (best->axis < 0 || cost < best->cost)
            *best = (cut){cost, axis, k, *along};
    }
}

static cut find_cut(const builder *b, int32_t begin, int32_t end) {
    ruler rulers[3];
    bin bin_list[BINS];
    cut best = {0.0f, -1, 0, {0.0f, 0.0f}};
    measure(b, begin, end, rulers);
    for (int32_t axis = 0; axis < b->axes; axis++) {
        if (rulers[axis].scale == 0.0f)
            continue;
        fill_bins(b, begin, end, axis, &rulers[axis], bin_list);
        judge(bin_list, b->axes, axis, &rulers[axis], &best);
    }
    return best;
}

/* Moves what lies left of the cut to the front; returns where the right side begins. */
static int32_t partition(const builder *b, int32_t begin, int32_t end, const cut *at) {
    int32_t left = begin, right = end;
    while (left < right) {
        reference *r = &b->references[left];
        if (bin_of(&at->along, centre(r, at->axis)) < at->bin) {
            left++;
        } else {
            reference swapped = *r;
            *r = b->references[--right];
            b->references[right] = swapped;
        }
    }
    return left;
}

/* ---- small ranges --------------------------------------------------------------------------------- */

/* Stable, for a few. */
static void sort_along(const builder *b, int32_t begin, int32_t end, int32_t axis) {
    for (int32_t i = begin + 1; i < end; i++) {
        reference r = b->references[i];
        int32_t at = i;
        for (; at > begin && centre(&b->references[at - 1], axis) > centre(&r, axis); at--)
            b->references[at] = b->references[at - 1];
        b->references[at] = r;
    }
}

static void add_reference(dpl_bounds *bounds, const reference *r) {
    dpl_bounds_add_point(bounds, r->low);
    dpl_bounds_add_point(bounds, r->high);
}

/* Least cost of cutting a sorted range so that full nodes lie left and the rest right; and where. */
static float sweep(const builder *b, int32_t begin, int32_t end, int32_t *middle) {
    float right_area[SMALL + 1], best = INFINITY;
    dpl_bounds bounds = dpl_bounds_empty();
    for (int32_t i = end - 1; i > begin; i--) {
        add_reference(&bounds, &b->references[i]);
        right_area[i - begin] = dpl_bounds_half_area(&bounds, b->axes);
    }
    bounds = dpl_bounds_empty();
    for (int32_t i = begin; i < end - 1; i++) {
        int32_t left = i + 1 - begin, right = end - i - 1;
        add_reference(&bounds, &b->references[i]);
        if (left % DPL_BVH_CHILDREN != 0)
            continue;
        float cost = dpl_bounds_half_area(&bounds, b->axes) * (float)left + right_area[left] * (float)right;
        if (cost < best) {
            best = cost;
            *middle = i + 1;
        }
    }
    return best;
}

/* Cuts a small range so that the nodes that hold its objects become full. */
static int32_t split_small(const builder *b, int32_t begin, int32_t end) {
    int32_t best_axis = 0, best_middle = begin + DPL_BVH_CHILDREN, middle = best_middle;
    float best = INFINITY;
    for (int32_t axis = 0; axis < b->axes; axis++) {
        sort_along(b, begin, end, axis);
        float cost = sweep(b, begin, end, &middle);
        if (cost < best) {
            best = cost;
            best_axis = axis;
            best_middle = middle;
        }
    }
    if (best_axis != b->axes - 1)
        sort_along(b, begin, end, best_axis);
    return best_middle;
}

/* ---- the tree of pairs ---------------------------------------------------------------------------- */

/* Returns where the right side begins. */
static int32_t split(const builder *b, int32_t begin, int32_t end, int32_t depth) {
    int32_t count = end - begin;
    if (count <= DPL_BVH_CHILDREN)
        return begin + count / 2; /* one node, however it is cut */
    if (count <= SMALL)
        return split_small(b, begin, end);
    if (depth < DPL_BVH_SAH_DEPTH) {
        cut at = find_cut(b, begin, end);
        if (at.axis >= 0)
            return partition(b, begin, end, &at);
    }
    return begin + count / 2;
}

static void add_child(const builder *b, int32_t child, dpl_bounds *bounds) {
    if (child >= 0) {
        dpl_bounds_add(bounds, &b->pairs[child].bounds);
        return;
    }
    dpl_bounds_add_point(bounds, b->references[~child].low);
    dpl_bounds_add_point(bounds, b->references[~child].high);
}

/* Returns what a parent stores for the range: a pair, or ~slot. No deeper than DPL_BVH_MAX_DEPTH. */
static int32_t build_range(builder *b, int32_t begin, int32_t end, int32_t depth) {
    if (end - begin == 1)
        return ~begin;
    int32_t index = b->pair_count++;
    int32_t middle = split(b, begin, end, depth);
    int32_t left = build_range(b, begin, middle, depth + 1);
    int32_t right = build_range(b, middle, end, depth + 1);
    dpl_bvh_pair *pair = &b->pairs[index];
    *pair = (dpl_bvh_pair){dpl_bounds_empty(), {left, right}, end - begin};
    add_child(b, left, &pair->bounds);
    add_child(b, right, &pair->bounds);
    return index;
}

/* There are fewer nodes than objects; one more leaves room to align them. */
static dpl_status reserve(dpl_context *context, dpl_bvh *bvh, int32_t count) {
    size_t objects = (size_t)count;
    DPL_TRY(dpl_buffer_reserve(context, &bvh->nodes, objects + 1, sizeof(dpl_bvh_node)));
    DPL_TRY(dpl_buffer_reserve(context, &bvh->objects, objects, sizeof(int32_t)));
    DPL_TRY(dpl_buffer_reserve(context, &bvh->pairs, objects, sizeof(dpl_bvh_pair)));
    return dpl_buffer_reserve(context, &bvh->scratch, objects, sizeof(reference));
}

dpl_status dpl_bvh_build(dpl_context *context, dpl_bvh *bvh, int32_t axes, const dpl_bounds *bounds,
                         int32_t count) {
    bvh->object_count = bvh->node_count = bvh->depth = 0;
    bvh->axes = axes;
    DPL_TRY(reserve(context, bvh, count));
    builder b = {axes, bvh->scratch.data, bvh->pairs.data, 0};
    for (int32_t i = 0; i < count; i++) {
        b.references[i].object = i;
        memcpy(b.references[i].low, bounds[i].low, sizeof bounds[i].low);
        memcpy(b.references[i].high, bounds[i].high, sizeof bounds[i].high);
    }
    if (count > 1)
        (void)build_range(&b, 0, count, 0);
    int32_t *objects = bvh->objects.data;
    for (int32_t i = 0; i < count; i++)
        objects[i] = b.references[i].object;
    bvh->object_count = count;
    dpl_bvh_collapse(bvh);
    dpl_bvh_refit(bvh, bounds);
    bvh->cost_at_build = bvh->cost;
    bvh->builds++;
    return DPL_OK;
}
