/* Pass C: R of a strip, from level S down to pixels, depth first and from right to left: a column of R is
 * used up while it is in the nearest cache, and two columns a level are enough. What level 0 receives is
 * added to the sums. */
#include "holographic/holographic.h"

enum { ODD, EVEN };

/* Where direction matters, a level keeps more than the mean radiance of its cones: level 1 also the same
 * weighed by the cosine along the axis and across it, level 0 that along, and across either way. Each is
 * merged through its own lens, from one of those of the level above. */
typedef struct kept {
    int table; /* of the lens, or -1 for the plain one */
    int above;
} kept;

enum { MOST_KEPT = 4 };

static const kept kept_at[2][MOST_KEPT] = {
    {{-1, 0}, {DPL_TABLE_ALONG, 1}, {DPL_TABLE_BELOW, 2}, {DPL_TABLE_ABOVE, 2}},
    {{-1, 0}, {DPL_TABLE_ALONG, 0}, {DPL_TABLE_ACROSS, 0}, {-1, 0}},
};

static int kept_count(const dpl_hrc_quadrant *q, int32_t level) {
    return !q->hrc->layout.directional || level > 1 ? 1 : level == 1 ? 3 : 4;
}

/* The rows of a column that hold its kept radiance number `which`; none stay none. */
static dpl_hrc_rows kept_rows(dpl_hrc_rows column, int32_t level, int which) {
    if (column.first)
        column.first += ((size_t)which << level) * column.step;
    return column;
}

typedef struct gathering {
    dpl_hrc_worker worker;
    /* R of the even column that was done last, per level: the right neighbour of the next odd one. */
    dpl_hrc_rows last_even[DPL_HRC_STRIP_LEVEL + 1];
    bool edge; /* only the leftmost column of each level is wanted, and nothing is received */
} gathering;

/* T(level, p), every ray of an odd column; on level 0 forks. */
static dpl_hrc_rows odd_segments(gathering *g, int32_t level, int32_t p) {
    if (level >= DPL_HRC_TRACED_LEVEL)
        return dpl_hrc_strip_rows(&g->worker, level, p);
    dpl_hrc_rows rows = dpl_hrc_segment_rows(&g->worker, g->worker.quadrant->axis->traced, 0);
    for (int32_t k = 0; k <= 1 << level; k++)
        if (level > 0)
            dpl_hrc_trace(&g->worker, level, p << level, k, dpl_hrc_row(rows, k));
        else
            dpl_hrc_fork(&g->worker, p, k, rows);
    return rows;
}

/* T(level, p), every other ray. */
static dpl_hrc_rows even_segments(gathering *g, int32_t level, int32_t p) {
    const dpl_hrc_quadrant *q = g->worker.quadrant;
    dpl_hrc_rows rows;
    if (level == q->axis->strip_level && level > DPL_HRC_TRACED_LEVEL)
        rows = (dpl_hrc_rows){q->segments.first + (size_t)p * q->segment_bytes, q->segments.step};
    else if (level >= DPL_HRC_TRACED_LEVEL)
        rows = dpl_hrc_strip_rows(&g->worker, level, p);
    else {
        rows = dpl_hrc_segment_rows(&g->worker, q->axis->traced, 0);
        for (int32_t k = 0; k < 2; k++)
            dpl_hrc_trace_aside(&g->worker, 2 * p, k, dpl_hrc_row(rows, 2 * k));
    }
    rows.step *= 2;
    return rows;
}

static dpl_hrc_rows column_of(const gathering *g, int32_t level, int parity) {
    return dpl_hrc_radiance_rows(&g->worker, g->worker.quadrant->axis->column[level][parity], 0);
}

/* Merges everything that a level keeps of one column. */
static void merge(gathering *g, int32_t level, dpl_hrc_rows segments, dpl_hrc_rows near, dpl_hrc_rows far,
                  dpl_hrc_rows out) {
    const dpl_hrc_quadrant *q = g->worker.quadrant;
    for (int i = 0; i < kept_count(q, level); i++) {
        kept k = level > 1 ? (kept){-1, 0} : kept_at[level][i];
        dpl_hrc_lens lens = q->lens;
        if (k.table >= 0) {
            const dpl_hrc_lens_table *t = &q->tables[k.table];
            lens = (dpl_hrc_lens){t->emitted, t->passed, t->sky};
        }
        dpl_hrc_merge(&g->worker, &lens, level, 0, 1 << level, segments, kept_rows(near, level + 1, k.above),
                      kept_rows(far, level + 1, k.above), kept_rows(out, level, i));
    }
}

/* The weight of what the step's pixels emit, which fills a whole quadrant, in kept radiance `which`. */
static float emitted_by_step(const dpl_hrc_quadrant *q, int which) {
    int table = kept_at[0][which].table;
    const float *emitted = table < 0 ? q->lens.emitted : q->tables[table].emitted;
    return emitted[dpl_hrc_cone(1, 0)] + emitted[dpl_hrc_cone(1, 1)];
}

/* What arrives at column x of level 0 is light of the pixels before it: pixel x-1 looks from x on, without
 * which quadrants would share the rays at 45 degrees. What lies between the two centres is in the way. */
static void receive(gathering *g, int32_t x, dpl_hrc_rows radiance) {
    const dpl_hrc_quadrant *q = g->worker.quadrant;
    if (g->edge)
        return;
    char *step = NULL;
    if (q->hrc->layout.media) {
        step = dpl_hrc_segment_rows(&g->worker, q->axis->traced, 0).first;
        dpl_hrc_trace_step(&g->worker, x - 1, step);
    }
    const dpl_hrc_group groups[MOST_KEPT] = {DPL_GROUP_MEAN,
                                             q->mirrored ? DPL_GROUP_BACKWARD : DPL_GROUP_FORWARD,
                                             DPL_GROUP_BELOW, DPL_GROUP_ABOVE};
    if (q->hrc->layout.keeps)
        q->flags.columns[q->mirrored ? q->axis->width - x : x - 1] = 1;
    dpl_row_shape shape = q->axis->shape; /* of sums */
    shape.streams = q->hrc->layout.streams;
    for (int i = 0; i < kept_count(q, 0); i++) {
        float *sum =
            q->sums + q->sums_step * (x - 1) + 3 * (ptrdiff_t)q->axis->shape.stride * (ptrdiff_t)groups[i];
        q->hrc->rows->collect(&shape, sum, step, emitted_by_step(q, i), dpl_hrc_row(radiance, i),
                              !q->hrc->layout.keeps && q->mirrored && groups[i] != DPL_GROUP_BACKWARD);
    }
}

/* Everything below R(level, p) = here, with R(level, p+1) = right. Column 0 is never asked for. */
static void descend(gathering *g, int32_t level, int32_t p, dpl_hrc_rows here, dpl_hrc_rows right) {
    if (level == 0) {
        if (p > 0)
            receive(g, p, here);
        return;
    }
    int32_t below = level - 1;
    dpl_hrc_rows odd = {0}, none = {0};
    if (2 * p + 1 < dpl_hrc_columns(g->worker.quadrant->axis, below)) {
        odd = column_of(g, below, ODD);
        merge(g, below, odd_segments(g, below, 2 * p + 1), none, right, odd);
        if (!g->edge)
            descend(g, below, 2 * p + 1, odd, g->last_even[below]);
    }
    if (p > 0) {
        dpl_hrc_rows even = column_of(g, below, EVEN);
        merge(g, below, even_segments(g, level, p), here, right, even);
        g->last_even[below] = even;
        descend(g, below, 2 * p, even, odd);
    } else if (!g->edge)
        descend(g, below, 0, none, odd);
}

/* R(S, p), or nothing where that is outside. */
static dpl_hrc_rows top_column(const gathering *g, int32_t p) {
    const dpl_hrc_quadrant *q = g->worker.quadrant;
    if (p >= dpl_hrc_columns(q->axis, q->axis->strip_level))
        return (dpl_hrc_rows){0};
    return (dpl_hrc_rows){q->radiance.first + (size_t)p * q->radiance_bytes, q->radiance.step};
}

static void gather_strip(gathering *g, int32_t p) {
    dpl_hrc_build_strip(&g->worker, p);
    descend(g, g->worker.quadrant->axis->strip_level, p, top_column(g, p), top_column(g, p + 1));
}

/* What pixels of the last column see is the sky alone. */
static void receive_sky(gathering *g) {
    const dpl_hrc_quadrant *q = g->worker.quadrant;
    dpl_hrc_rows column = column_of(g, 0, ODD);
    for (int i = 0; i < kept_count(q, 0); i++) {
        int table = kept_at[0][i].table;
        const float(*sky)[3] = table < 0 ? q->lens.sky : q->tables[table].sky;
        q->hrc->rows->fill(&q->axis->shape, dpl_hrc_row(column, i), sky[dpl_hrc_cone(0, 0)]);
    }
    receive(g, q->axis->width, column);
}

int32_t dpl_hrc_gather_items(const dpl_hrc_quadrant *quadrant) {
    int32_t strips = dpl_hrc_columns(quadrant->axis, quadrant->axis->strip_level);
    int32_t workers = quadrant->hrc->layout.workers;
    return workers < strips ? workers : strips;
}

/* The columns of strip p that its left neighbour asks for. The run that the strip belongs to counts what is
 * traced: once for any thread count. */
static void gather_edge(gathering *g, int32_t p) {
    int64_t traced[DPL_HRC_BETWEEN_LEVEL + 1];
    memcpy(traced, g->worker.traced, sizeof traced);
    g->edge = true;
    gather_strip(g, p);
    g->edge = false;
    memcpy(g->worker.traced, traced, sizeof traced);
}

/* Strips first .. behind-1, from the last on; those whose sums are still good are left out. */
static void gather_run(gathering *g, int32_t first, int32_t behind, int32_t strips) {
    const dpl_hrc_quadrant *q = g->worker.quadrant;
    bool has_edge = false; /* of the strip to the right */
    for (int32_t p = behind - 1; p >= first; p--) {
        bool is_good = q->partial && !q->flags.gather[p];
        if (!is_good && !has_edge && p + 1 < strips)
            gather_edge(g, p + 1);
        if (!is_good && p + 1 == strips)
            receive_sky(g);
        if (!is_good)
            gather_strip(g, p);
        has_edge = !is_good;
    }
}

void dpl_hrc_gather_task(int32_t begin, int32_t end, int32_t worker, void *quadrant) {
    const dpl_hrc_quadrant *q = quadrant;
    int32_t strips = dpl_hrc_columns(q->axis, q->axis->strip_level), items = dpl_hrc_gather_items(q);
    for (int32_t item = begin; item < end; item++) {
        gathering g = {.worker = dpl_hrc_worker_of(q, worker)};
        gather_run(&g, (int32_t)((int64_t)strips * item / items),
                   (int32_t)((int64_t)strips * (item + 1) / items), strips);
        dpl_hrc_worker_count(&g.worker, worker);
    }
}
