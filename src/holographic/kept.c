/* A frame made from the last one: which strips of a quadrant the kept T, R and sums are no longer good for.
 * Called by holographic.c between the passes, which leave the others out. docs/algorithms/reuse.md has the
 * argument. */
#include "holographic/holographic.h"

/* Columns beside a strip whose pixels it may read, and more: T reaches one further, what is in the way of
 * level 0 begins one before. */
#define BESIDE 2

static int32_t most_strips(const dpl_hrc_axis *axis) {
    return dpl_hrc_columns(axis, axis->strip_level) + 1;
}

/* ---- flags ---------------------------------------------------------------------------------------- */

/* Of an axis: world, gather, radiance, columns. */
static size_t axis_flag_bytes(const dpl_hrc_axis *axis) {
    size_t cones = (size_t)1 << axis->strip_level;
    return (2 + cones) * (size_t)most_strips(axis) + (size_t)axis->width;
}

size_t dpl_hrc_flag_bytes(const dpl_hrc_layout *layout) {
    return axis_flag_bytes(&layout->axes[0]) + axis_flag_bytes(&layout->axes[1]);
}

dpl_hrc_flags dpl_hrc_flags_of(const dpl_hrc *hrc, int axis_index) {
    const dpl_hrc_layout *l = &hrc->layout;
    const dpl_hrc_axis *axis = &l->axes[axis_index];
    int32_t strips = most_strips(axis);
    uint8_t *first = (uint8_t *)hrc->arena.data + l->flags + (axis_index ? axis_flag_bytes(&l->axes[0]) : 0);
    return (dpl_hrc_flags){.world = first,
                           .gather = first + strips,
                           .radiance = first + 2 * strips,
                           .columns = first + axis_flag_bytes(axis) - axis->width,
                           .strips = strips};
}

void dpl_hrc_start_frame(dpl_hrc *hrc) {
    memset((char *)hrc->arena.data + hrc->layout.flags, 0, dpl_hrc_flag_bytes(&hrc->layout));
}

/* ---- the world, R, sums --------------------------------------------------------------------------- */

/* Columns first .. behind-1 of a quadrant, which may lie outside, as a box of the world. */
static dpl_reuse_box box_of(const dpl_hrc_quadrant *q, int32_t first, int32_t behind) {
    const dpl_hrc_axis *axis = q->axis;
    bool is_along_x = axis == &q->hrc->layout.axes[0];
    int32_t from = q->mirrored ? axis->width - behind : first,
            to = q->mirrored ? axis->width - first : behind;
    if (is_along_x)
        return (dpl_reuse_box){from, 0, to, axis->shape.length};
    return (dpl_reuse_box){0, from, axis->shape.length, to};
}

void dpl_hrc_find_changed_world(dpl_hrc_quadrant *q) {
    int32_t wide = 1 << q->axis->strip_level, strips = most_strips(q->axis);
    memset(q->flags.radiance, 0, (size_t)strips << q->axis->strip_level);
    for (int32_t p = 0; p < strips; p++)
        q->flags.world[p] =
            dpl_reuse_touches(&q->hrc->solver.reuse, box_of(q, p * wide - BESIDE, (p + 1) * wide + BESIDE));
}

void dpl_hrc_store_radiance(const dpl_hrc_quadrant *q, int32_t cone, int32_t p, const char *row) {
    size_t pad = DPL_ROW_PAD * q->hrc->layout.element;
    char *kept = dpl_hrc_row(q->radiance, cone) + (size_t)p * q->radiance_bytes;
    if (memcmp(kept - pad, row - pad, q->radiance_bytes) == 0)
        return;
    memcpy(kept - pad, row - pad, q->radiance_bytes);
    q->flags.radiance[cone * q->flags.strips + p] = 1;
}

/* Has R of level S changed where strip p begins? */
static bool radiance_changed(const dpl_hrc_quadrant *q, int32_t p) {
    for (int32_t cone = 0; cone < 1 << q->axis->strip_level; cone++)
        if (q->flags.radiance[cone * q->flags.strips + p])
            return true;
    return false;
}

/* A strip is made from its pixels and R at both of its ends; its sums also from the columns where its right
 * neighbour begins, which are made from that one's pixels and R. */
void dpl_hrc_find_gathers(dpl_hrc_quadrant *q) {
    int32_t strips = most_strips(q->axis);
    bool right = false;
    for (int32_t p = strips - 2; p >= 0; p--) {
        bool own = q->flags.world[p] || radiance_changed(q, p) || radiance_changed(q, p + 1);
        q->flags.gather[p] = own || right;
        right = own;
    }
}

/* ---- sums of an axis ------------------------------------------------------------------------------ */

/* As if the second quadrant had added its own to those of the first. */
void dpl_hrc_add_ways_task(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const dpl_hrc_ways *t = task;
    const dpl_hrc *hrc = t->hrc;
    const dpl_hrc_axis *axis = &hrc->layout.axes[t->axis];
    const dpl_kernels *kernels = hrc->solver.context->kernels;
    size_t floats = 3 * (size_t)axis->shape.stride, way = (size_t)axis->width * floats;
    const float *ways = (const float *)(const void *)((char *)hrc->arena.data + axis->ways);
    float *sums = (float *)(void *)((char *)hrc->arena.data + axis->sums);
    const uint8_t *columns = dpl_hrc_flags_of(hrc, t->axis).columns;
    for (int32_t x = begin; x < end; x++)
        for (size_t plane = 0; plane < 3 && columns[x]; plane++) {
            size_t at = (size_t)x * floats + plane * (size_t)axis->shape.stride + DPL_ROW_PAD;
            kernels->add_scaled(axis->shape.length, sums + at, ways + at, 1.0f, false);
            kernels->add_scaled(axis->shape.length, sums + at, ways + way + at, 1.0f, true);
        }
}
