/* Pass B: in the wedge between two neighbouring rays of level S nothing depends on what is outside it. T is
 * extended from level S to the top, and R merged back down to level S. */
#include "holographic/holographic.h"

typedef struct wedge {
    dpl_hrc_worker worker;
    int32_t cone; /* of level S */
} wedge;

/* Rays or cones of level n per one of level S. */
static int32_t fan(const wedge *w, int32_t level) {
    return 1 << (level - w->worker.quadrant->axis->strip_level);
}

static dpl_hrc_rows segments_of(const wedge *w, int32_t level, int32_t p) {
    const dpl_hrc_quadrant *q = w->worker.quadrant;
    if (p >= dpl_hrc_columns(q->axis, level))
        return (dpl_hrc_rows){0};
    if (level == q->axis->strip_level)
        return (dpl_hrc_rows){dpl_hrc_row(q->segments, w->cone) + (size_t)p * q->segment_bytes,
                              q->segments.step};
    return dpl_hrc_segment_rows(&w->worker, q->axis->wedge_segments[level], p * (fan(w, level) + 1));
}

static dpl_hrc_rows radiance_of(const wedge *w, int32_t level, int32_t p) {
    const dpl_hrc_quadrant *q = w->worker.quadrant;
    if (p >= dpl_hrc_columns(q->axis, level))
        return (dpl_hrc_rows){0};
    if (level == q->axis->strip_level)
        return (dpl_hrc_rows){dpl_hrc_row(q->radiance, w->cone) + (size_t)p * q->radiance_bytes,
                              q->radiance.step};
    return dpl_hrc_radiance_rows(&w->worker, q->axis->wedge_radiance[level & 1], p * fan(w, level));
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

void dpl_hrc_wedge_task(int32_t begin, int32_t end, int32_t worker, void *quadrant) {
    const dpl_hrc_quadrant *q = quadrant;
    wedge w = {.worker = dpl_hrc_worker_of(q, worker)};
    for (w.cone = begin; w.cone < end; w.cone++) {
        for (int32_t level = q->axis->strip_level; level < q->axis->levels - 1; level++)
            extend(&w, level);
        for (int32_t level = q->axis->levels - 1; level >= q->axis->strip_level; level--)
            merge(&w, level);
    }
}
