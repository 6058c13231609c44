/* The two steps that the holographic solver is made of, for one column: segments of twice the length, and
 * radiance merged from the level above. Called by strip.c, wedge.c and gather.c. */
#include "holographic/holographic.h"

void dpl_hrc_extend(const dpl_hrc_worker *worker, int32_t level, int32_t first, int32_t count,
                    dpl_hrc_rows near, dpl_hrc_rows far, dpl_hrc_rows out) {
    const dpl_hrc_quadrant *q = worker->quadrant;
    const dpl_row_kernels *rows = q->hrc->rows;
    bool outside = !far.first;
    if (outside)
        far = near;
    for (int32_t k = 0; k < count; k++) {
        const void *const nears[2] = {dpl_hrc_row(near, k), dpl_hrc_row(near, k + 1)};
        const void *const fars[2] = {dpl_hrc_row(far, k), dpl_hrc_row(far, k + 1)};
        int32_t shift = outside ? DPL_ROW_OUTSIDE : 2 * (first + k) - (1 << level);
        rows->extend(&q->axis->shape, dpl_hrc_row(out, 2 * k), dpl_hrc_row(out, 2 * k + 1), nears, fars,
                     shift);
    }
    const void *const nears[2] = {dpl_hrc_row(near, count), NULL};
    const void *const fars[2] = {dpl_hrc_row(far, count), NULL};
    int32_t shift = outside ? DPL_ROW_OUTSIDE : 2 * (first + count) - (1 << level);
    rows->extend(&q->axis->shape, dpl_hrc_row(out, 2 * count), NULL, nears, fars, shift);
}

/* A row that is sky wherever it is read. */
static const void *sky_row(const dpl_hrc_worker *worker, int32_t slot, const float sky[3]) {
    const dpl_hrc_quadrant *q = worker->quadrant;
    char *row = dpl_hrc_radiance_rows(worker, q->axis->beyond, slot).first;
    q->hrc->rows->fill_pads(&q->axis->shape, row, sky);
    return row;
}

void dpl_hrc_merge(const dpl_hrc_worker *worker, const dpl_hrc_lens *lens, int32_t level, int32_t first,
                   int32_t count, dpl_hrc_rows segments, dpl_hrc_rows near, dpl_hrc_rows far,
                   dpl_hrc_rows out) {
    const dpl_hrc_quadrant *q = worker->quadrant;
    float part = near.first ? 0.5f : 1.0f;
    int32_t reach = near.first ? 2 : 1;
    dpl_row_shape shape = q->axis->shape; /* R of level S is read a pass later, unless it is compared */
    shape.streams = q->hrc->layout.streams && level == q->axis->strip_level && !q->partial;
    /* Nothing passes beside what is outside; there, a row of sky is sky in its pads alone. */
    bool forks = level == 0 && !near.first && far.first;
    for (int32_t i = 0; i < count; i++) {
        dpl_merge_ray rays[2];
        for (int32_t s = 0; s < 2; s++) {
            int32_t above = 2 * i + s, cone = dpl_hrc_cone(level + 1, 2 * first + above);
            rays[s] = (dpl_merge_ray){
                .segment = dpl_hrc_row(segments, i + s),
                .far = far.first ? dpl_hrc_row(far, above) : sky_row(worker, s, lens->sky[cone]),
                .near = near.first ? dpl_hrc_row(near, above) : NULL,
                .straight = forks ? dpl_hrc_row(segments, 2 + s) : NULL,
                .shift = far.first ? reach * (2 * (first + i + s) - (1 << level)) : DPL_ROW_OUTSIDE,
                .emitted = part * lens->emitted[cone],
                .passed = part * lens->passed[cone],
            };
        }
        q->hrc->rows->merge(&shape, dpl_hrc_row(out, i), rays, lens->sky[dpl_hrc_cone(level, first + i)]);
    }
}
