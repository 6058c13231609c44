/* T of a strip of columns: traced through pixels up to level 2, then extended; on level 3 by both. Pass A of
 * the solver keeps level S alone; gather.c builds the levels below again, which costs less than to fetch them
 * from memory. */
#include "holographic/holographic.h"

/* ---- tracing -------------------------------------------------------------------------------------- */

/* Through which side a segment comes into a pixel; behind a corner across, and on its other way along. */
typedef enum entry { ALONG, ACROSS, BEHIND_CORNER } entry;

/* A pixel on the way of a segment, relative to its start. A corner lies between (x, y-1), entered along, and
 * (x-1, y), entered across, on the other way. */
typedef struct pixel_step {
    int8_t x;
    int8_t y;
    uint8_t kind;  /* dpl_tap_kind */
    uint8_t entry; /* not of corners */
    uint8_t chord; /* dpl_hrc_chord: how long it is there */
} pixel_step;

enum { MOST_STEPS = 15 };

typedef struct stencil {
    int32_t count;
    dpl_trace_into into;
    pixel_step steps[MOST_STEPS];
} stencil;

#define HALF(x, y, entry, chord)                                                                             \
    { x, y, DPL_TAP_HALF, entry, DPL_CHORD_##chord }
#define FULL(x, y, entry, chord)                                                                             \
    { x, y, DPL_TAP_FULL, entry, DPL_CHORD_##chord }
#define CORNER(x, y)                                                                                         \
    { x, y, DPL_TAP_CORNER, ALONG, DPL_CHORD_POINT }

/* Segments from a pixel's centre to another's, by level, from 1 on, and by how far they go across, halved:
 * exact traversal, cells in order. Those that go up are the mirror images. */
static const stencil stencils[DPL_HRC_TRACED_LEVEL][3] = {
    {{3,
      DPL_TRACE_ONE_WAY,
      {HALF(0, 0, ALONG, STRAIGHT), FULL(1, 0, ALONG, STRAIGHT), HALF(2, 0, ALONG, STRAIGHT)}},
     {5,
      DPL_TRACE_TWO_WAYS,
      {HALF(0, 0, ALONG, DIAGONAL), CORNER(1, 1), FULL(1, 1, BEHIND_CORNER, DIAGONAL), CORNER(2, 2),
       HALF(2, 2, BEHIND_CORNER, DIAGONAL)}}},
    {{5,
      DPL_TRACE_ONE_WAY,
      {HALF(0, 0, ALONG, STRAIGHT), FULL(1, 0, ALONG, STRAIGHT), FULL(2, 0, ALONG, STRAIGHT),
       FULL(3, 0, ALONG, STRAIGHT), HALF(4, 0, ALONG, STRAIGHT)}},
     {7,
      DPL_TRACE_ONE_WAY,
      {HALF(0, 0, ALONG, HALF), HALF(1, 0, ALONG, HALF), HALF(1, 1, ACROSS, HALF), FULL(2, 1, ALONG, HALF),
       HALF(3, 1, ALONG, HALF), HALF(3, 2, ACROSS, HALF), HALF(4, 2, ALONG, HALF)}},
     {9,
      DPL_TRACE_TWO_WAYS,
      {HALF(0, 0, ALONG, DIAGONAL), CORNER(1, 1), FULL(1, 1, BEHIND_CORNER, DIAGONAL), CORNER(2, 2),
       FULL(2, 2, BEHIND_CORNER, DIAGONAL), CORNER(3, 3), FULL(3, 3, BEHIND_CORNER, DIAGONAL), CORNER(4, 4),
       HALF(4, 4, BEHIND_CORNER, DIAGONAL)}}},
};

/* The diagonal of level 1 as pixels before its column see it: by the pixel aside, which counts where it is
 * opaque. */
static const stencil aside_stencil = {5,
                                      DPL_TRACE_TWO_WAYS,
                                      {HALF(0, 0, ALONG, DIAGONAL), HALF(0, 1, ACROSS, POINT),
                                       FULL(1, 1, ALONG, DIAGONAL), CORNER(2, 2),
                                       HALF(2, 2, BEHIND_CORNER, DIAGONAL)}};

/* Rays of level 3 in between, by how far they go across: 2 and 6. There are no chords of their slopes:
 * those of the next slopes on either side make up their length, to 0.1 and 1.3 %. */
static const stencil between_stencils[2] = {
    {11,
     DPL_TRACE_A_PART,
     {HALF(0, 0, ALONG, STRAIGHT), FULL(1, 0, ALONG, STRAIGHT), HALF(2, 0, ALONG, HALF),
      HALF(2, 1, ACROSS, HALF), FULL(3, 1, ALONG, STRAIGHT), FULL(4, 1, ALONG, STRAIGHT),
      FULL(5, 1, ALONG, STRAIGHT), HALF(6, 1, ALONG, HALF), HALF(6, 2, ACROSS, HALF),
      FULL(7, 2, ALONG, STRAIGHT), HALF(8, 2, ALONG, STRAIGHT)}},
    {15,
     DPL_TRACE_A_PART,
     {HALF(0, 0, ALONG, HALF), HALF(1, 0, ALONG, HALF), HALF(1, 1, ACROSS, DIAGONAL),
      HALF(2, 1, ALONG, DIAGONAL), HALF(2, 2, ACROSS, DIAGONAL), HALF(3, 2, ALONG, HALF),
      HALF(3, 3, ACROSS, HALF), FULL(4, 3, ALONG, DIAGONAL), HALF(5, 3, ALONG, HALF),
      HALF(5, 4, ACROSS, HALF), HALF(6, 4, ALONG, DIAGONAL), HALF(6, 5, ACROSS, DIAGONAL),
      HALF(7, 5, ALONG, DIAGONAL), HALF(7, 6, ACROSS, HALF), HALF(8, 6, ALONG, HALF)}},
};

static const char *world_row(const dpl_hrc_quadrant *q, int32_t x, dpl_hrc_chord chord) {
    const char *column = x < q->axis->width ? q->world + q->world_step * x : q->outside;
    return column + q->axis->set[chord];
}

/* What column x reflects towards a segment that comes in along the axis, or across it with or against its
 * rows (sign 1 or -1). */
static const char *face_row(const dpl_hrc_quadrant *q, int32_t x, entry way, int32_t sign) {
    if (!q->faces || x >= q->axis->width)
        return NULL;
    dpl_hrc_face along = q->mirrored ? DPL_FACE_FORWARD : DPL_FACE_BACKWARD;
    dpl_hrc_face across = sign > 0 ? DPL_FACE_BELOW : DPL_FACE_ABOVE;
    return q->faces + q->faces_step * x + (size_t)(way == ALONG ? along : across) * q->radiance_bytes;
}

/* Field by field: a struct that is put together and then copied waits for its own stores, which took a tenth
 * of a frame. */
static void fill_tap(dpl_tap *tap, const dpl_hrc_quadrant *q, const pixel_step *step, int32_t x,
                     int32_t sign) {
    x += step->x;
    if (step->kind == DPL_TAP_CORNER) {
        tap->kind = DPL_TAP_CORNER;
        tap->row = world_row(q, x, DPL_CHORD_POINT);
        tap->face = face_row(q, x, ALONG, sign);
        tap->shift = sign * (step->y - 1);
        tap->other_row = world_row(q, x - 1, DPL_CHORD_POINT);
        tap->other_face = face_row(q, x - 1, ACROSS, sign);
        tap->other_shift = sign * step->y;
        return;
    }
    /* Without media a pixel lets through all or nothing, once as twice. */
    bool twice = step->kind == DPL_TAP_FULL && q->hrc->layout.media;
    tap->kind = twice ? DPL_TAP_FULL : DPL_TAP_HALF;
    tap->row = world_row(q, x, (dpl_hrc_chord)step->chord);
    tap->face = face_row(q, x, (entry)step->entry, sign);
    tap->shift = sign * step->y;
    tap->other_row = NULL;
    tap->other_face = face_row(q, x, step->entry == ACROSS ? ACROSS : ALONG, sign);
    tap->other_shift = 0;
}

static void trace(dpl_hrc_worker *worker, const stencil *s, int32_t level, int32_t x, int32_t sign,
                  char *out) {
    const dpl_hrc_quadrant *q = worker->quadrant;
    dpl_tap taps[MOST_STEPS];
    for (int32_t i = 0; i < s->count; i++)
        fill_tap(&taps[i], q, &s->steps[i], x, sign);
    q->hrc->rows->trace(&q->axis->shape, out, taps, s->count, s->into);
    worker->traced[level] += q->axis->shape.length;
}

void dpl_hrc_trace(dpl_hrc_worker *worker, int32_t level, int32_t x, int32_t ray, char *out) {
    int32_t across = 2 * ray - (1 << level), sign = across < 0 ? -1 : 1;
    trace(worker, &stencils[level - 1][sign * across / 2], level, x, sign, out);
}

/* Adds to every other ray of level 3, which is the mean of two broken ways, the straight one. */
static void trace_between(dpl_hrc_worker *worker, int32_t x, dpl_hrc_rows out) {
    for (int32_t ray = 1; ray < 1 << DPL_HRC_BETWEEN_LEVEL; ray += 2) {
        int32_t across = 2 * ray - (1 << DPL_HRC_BETWEEN_LEVEL), sign = across < 0 ? -1 : 1;
        trace(worker, &between_stencils[sign * across / 4], DPL_HRC_BETWEEN_LEVEL, x, sign,
              dpl_hrc_row(out, ray));
    }
}

void dpl_hrc_trace_aside(dpl_hrc_worker *worker, int32_t x, int32_t ray, char *out) {
    trace(worker, &aside_stencil, 1, x, 2 * ray - 1, out);
}

void dpl_hrc_fork(dpl_hrc_worker *worker, int32_t x, int32_t ray, dpl_hrc_rows out) {
    const dpl_hrc_quadrant *q = worker->quadrant;
    int32_t sign = 2 * ray - 1;
    const dpl_fork from = {
        .start = {world_row(q, x, DPL_CHORD_DIAGONAL), face_row(q, x, ALONG, sign)},
        .ahead = {world_row(q, x + 1, DPL_CHORD_POINT), face_row(q, x + 1, ALONG, sign)},
        .aside = {world_row(q, x, DPL_CHORD_POINT), face_row(q, x, ACROSS, sign)},
        .end = {world_row(q, x + 1, DPL_CHORD_DIAGONAL), face_row(q, x + 1, ALONG, sign)},
        .end_corner = world_row(q, x + 1, DPL_CHORD_POINT),
        .shift = sign,
    };
    q->hrc->rows->fork(&q->axis->shape, dpl_hrc_row(out, ray), dpl_hrc_row(out, 2 + ray), &from);
    worker->traced[0] += q->axis->shape.length;
}

void dpl_hrc_trace_step(dpl_hrc_worker *worker, int32_t x, char *out) {
    const dpl_hrc_quadrant *q = worker->quadrant;
    dpl_tap taps[2] = {{.kind = DPL_TAP_HALF, .row = world_row(q, x, DPL_CHORD_STRAIGHT)},
                       {.kind = DPL_TAP_HALF,
                        .row = world_row(q, x + 1, DPL_CHORD_STRAIGHT),
                        .face = face_row(q, x + 1, ALONG, 1)}};
    q->hrc->rows->trace(&q->axis->shape, out, taps, 2, DPL_TRACE_ONE_WAY);
    worker->traced[0] += q->axis->shape.length;
}

/* ---- building ------------------------------------------------------------------------------------- */

dpl_hrc_rows dpl_hrc_strip_rows(const dpl_hrc_worker *worker, int32_t level, int32_t p) {
    const dpl_hrc_axis *axis = worker->quadrant->axis;
    if (p >= dpl_hrc_columns(axis, level))
        return (dpl_hrc_rows){0};
    int32_t slot = p & ((1 << (axis->strip_level - level)) - 1);
    return dpl_hrc_segment_rows(worker, axis->strip[level], slot * ((1 << level) + 1));
}

/* T(level, p) from all below it; children first, while they are in the nearest cache. Column 0 of a level is
 * never asked for. */
static void build(dpl_hrc_worker *worker, int32_t level, int32_t p) {
    dpl_hrc_rows out = dpl_hrc_strip_rows(worker, level, p);
    if (!out.first)
        return;
    if (level == DPL_HRC_TRACED_LEVEL) {
        for (int32_t k = 0; p > 0 && k <= 1 << level; k++)
            dpl_hrc_trace(worker, level, p << level, k, dpl_hrc_row(out, k));
        return;
    }
    build(worker, level - 1, 2 * p);
    build(worker, level - 1, 2 * p + 1);
    if (p > 0)
        dpl_hrc_extend(worker, level - 1, 0, 1 << (level - 1), dpl_hrc_strip_rows(worker, level - 1, 2 * p),
                       dpl_hrc_strip_rows(worker, level - 1, 2 * p + 1), out);
    if (p > 0 && level == DPL_HRC_BETWEEN_LEVEL)
        trace_between(worker, p << level, out);
}

void dpl_hrc_build_strip(dpl_hrc_worker *worker, int32_t p) {
    int32_t top = worker->quadrant->axis->strip_level - 1;
    if (top < DPL_HRC_TRACED_LEVEL)
        return;
    build(worker, top, 2 * p);
    build(worker, top, 2 * p + 1);
}

void dpl_hrc_strip_task(int32_t begin, int32_t end, int32_t worker, void *quadrant) {
    const dpl_hrc_quadrant *q = quadrant;
    dpl_hrc_worker w = dpl_hrc_worker_of(q, worker);
    int32_t level = q->axis->strip_level - 1;
    for (int32_t p = begin + 1; p < end + 1; p++) {
        if (q->partial && !q->flags.world[p])
            continue;
        dpl_hrc_build_strip(&w, p);
        dpl_hrc_rows out = {q->segments.first + (size_t)p * q->segment_bytes, q->segments.step};
        dpl_hrc_extend(&w, level, 0, 1 << level, dpl_hrc_strip_rows(&w, level, 2 * p),
                       dpl_hrc_strip_rows(&w, level, 2 * p + 1), out);
    }
    dpl_hrc_worker_count(&w, worker);
}
