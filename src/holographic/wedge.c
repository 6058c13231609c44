/* Pass B: in the wedge between two neighbouring rays of level S nothing depends on what is outside it. T is
 * extended from level S to the top, and R merged back down to level S.
 *
 * Nor does anything in the wedge between two rays of a higher level, which needs less memory. Where a wedge
 * of level S is too large for the nearest caches, it is cut into the two of the next level, one after the
 * other, and so on until one fits: that is solved level by level. The ray that two wedges share is extended
 * in both. */
#include "holographic/holographic.h"

typedef struct wedge {
    dpl_hrc_worker worker;
    int32_t root; /* level of the two rays, S or above */
    int32_t cone; /* between them, of that level */
} wedge;

/* Rays or cones of level n per one of the root's. */
static int32_t fan(const wedge *w, int32_t level) {
    return 1 << (level - w->root);
}

/* Rows of a level above S begin with the wedge's own; those of the root are one half of what the wedge that
 * it was cut from has. */
static int32_t row_of(const wedge *w, int32_t level, int32_t p, int32_t rows) {
    return p * rows + (level == w->root ? w->cone & 1 : 0);
}

static dpl_hrc_rows segments_of(const wedge *w, int32_t level, int32_t p) {
    const dpl_hrc_quadrant *q = w->worker.quadrant;
    if (p >= dpl_hrc_columns(q->axis, level))
        return (dpl_hrc_rows){0};
    if (level == q->axis->strip_level)
        return (dpl_hrc_rows){dpl_hrc_row(q->segments, w->cone) + (size_t)p * q->segment_bytes,
                              q->segments.step};
    return dpl_hrc_segment_rows(&w->worker, q->axis->wedge_segments[level],
                                row_of(w, level, p, dpl_hrc_wedge_rays(q->axis, level)));
}

static dpl_hrc_rows radiance_of(const wedge *w, int32_t level, int32_t p) {
    const dpl_hrc_quadrant *q = w->worker.quadrant;
    if (p >= dpl_hrc_columns(q->axis, level))
        return (dpl_hrc_rows){0};
    if (level == q->axis->strip_level)
        return (dpl_hrc_rows){dpl_hrc_row(q->radiance, w->cone) + (size_t)p * q->radiance_bytes,
                              q->radiance.step};
    return dpl_hrc_radiance_rows(&w->worker, q->axis->wedge_radiance[level],
                                 row_of(w, level, p, dpl_hrc_wedge_rays(q->axis, level) - 1));
}

static void extend(const wedge *w, int32_t level) {
    for (int32_t p = 1; p < dpl_hrc_columns(w->worker.quadrant->axis, level + 1); p++)
        dpl_hrc_extend(&w->worker, level, w->cone * fan(w, level), fan(w, level),
                       segments_of(w, level, 2 * p), segments_of(w, level, 2 * p + 1),
                       segments_of(w, level + 1, p));
}

/* A row of R that is compared with the kept one before it replaces it. */
static dpl_hrc_rows room_of(const wedge *w) {
    return dpl_hrc_radiance_rows(&w->worker, w->worker.quadrant->axis->beyond, 2);
}

static void merge(const wedge *w, int32_t level) {
    const dpl_hrc_quadrant *q = w->worker.quadrant;
    bool compares = q->partial && level == q->axis->strip_level;
    for (int32_t p = 1; p < dpl_hrc_columns(q->axis, level); p++) {
        dpl_hrc_rows segments = segments_of(w, level, p), near = {0};
        if (p % 2 == 0) {
            segments = segments_of(w, level + 1, p / 2);
            segments.step *= 2;
            near = radiance_of(w, level + 1, p / 2);
        }
        dpl_hrc_rows out = compares ? room_of(w) : radiance_of(w, level, p);
        dpl_hrc_merge(&w->worker, &q->lens, level, w->cone * fan(w, level), fan(w, level), segments, near,
                      radiance_of(w, level + 1, p / 2 + 1), out);
        if (compares)
            dpl_hrc_store_radiance(q, w->cone, p, out.first);
    }
}

static void solve(wedge w) {
    const dpl_hrc_axis *axis = w.worker.quadrant->axis;
    if (w.root < axis->wedge_level) {
        extend(&w, w.root);
        solve((wedge){w.worker, w.root + 1, 2 * w.cone});
        solve((wedge){w.worker, w.root + 1, 2 * w.cone + 1});
        merge(&w, w.root);
        return;
    }
    for (int32_t level = w.root; level < axis->levels - 1; level++)
        extend(&w, level);
    for (int32_t level = axis->levels - 1; level >= w.root; level--)
        merge(&w, level);
}

void dpl_hrc_wedge_task(int32_t begin, int32_t end, int32_t worker, void *quadrant) {
    const dpl_hrc_quadrant *q = quadrant;
    for (int32_t cone = begin; cone < end; cone++)
        solve((wedge){dpl_hrc_worker_of(q, worker), q->axis->strip_level, cone});
}
