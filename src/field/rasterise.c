/* Shapes to pixels: a shape owns a pixel iff the pixel's centre lies inside it, boundary included. Called by
 * src/api/field.c with shapes that have been checked.
 *
 * Every shape says, for a row of pixel centres, which spans of x it covers; painting a span is the same for
 * all. */
#include "field/field.h"

#include <stdlib.h>

/* A closed range of x on one row [px]. */
typedef struct span {
    double from;
    double to;
} span;

/* The rows that a shape can touch, and room for the spans of one row. */
typedef struct raster {
    dpl_field *field;
    span *spans;
    double *crossings;
} raster;

/* ---- spans of each kind of shape, on the row of centres at height y ------------------------------- */

static int disc_spans(const dpl_disc *disc, double y, span *spans) {
    double dy = y - disc->center[1], rest = disc->radius * disc->radius - dy * dy;
    if (rest < 0.0)
        return 0;
    double half = sqrt(rest);
    spans[0] = (span){disc->center[0] - half, disc->center[0] + half};
    return 1;
}

/* Narrows a span to where low <= a + b x <= high. False when nothing is left. */
static bool clip_span(span *s, double a, double b, double low, double high) {
    if (b == 0.0)
        return a >= low && a <= high;
    double first = (low - a) / b, second = (high - a) / b;
    s->from = fmax(s->from, fmin(first, second));
    s->to = fmin(s->to, fmax(first, second));
    return s->from <= s->to;
}

/* Points whose coordinates along two axes through `center` are within `half`. */
static int slab_spans(const double center[2], const double axis[2], const double half[2], double y,
                      span *spans) {
    double dy = y - center[1];
    spans[0] = (span){-HUGE_VAL, HUGE_VAL};
    /* u = dx ax + dy ay, v = -dx ay + dy ax, with dx = x - center x */
    if (!clip_span(&spans[0], dy * axis[1], axis[0], -half[0], half[0]) ||
        !clip_span(&spans[0], dy * axis[0], -axis[1], -half[1], half[1]))
        return 0;
    spans[0].from += center[0];
    spans[0].to += center[0];
    return 1;
}

static int box_spans(const dpl_box *box, double y, span *spans) {
    const double axis[2] = {cos(box->angle), sin(box->angle)};
    return slab_spans(box->center, axis, box->half, y, spans);
}

/* A thick line: its rectangle and a disc at each end. */
static int segment_spans(const dpl_segment *segment, double y, span *spans) {
    double dx = segment->to[0] - segment->from[0], dy = segment->to[1] - segment->from[1];
    double length = hypot(dx, dy), radius = 0.5 * segment->width;
    dpl_disc ends[2] = {{{segment->from[0], segment->from[1]}, radius},
                        {{segment->to[0], segment->to[1]}, radius}};
    int count = disc_spans(&ends[0], y, spans);
    count += disc_spans(&ends[1], y, spans + count);
    if (length > 0.0) {
        const double center[2] = {segment->from[0] + 0.5 * dx, segment->from[1] + 0.5 * dy};
        const double axis[2] = {dx / length, dy / length}, half[2] = {0.5 * length, radius};
        count += slab_spans(center, axis, half, y, spans + count);
    }
    return count;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Even-odd: between the first and second crossing, the third and fourth ... An edge counts where it crosses
 * the row from above (included) to below. Corners and level edges on the row itself belong to the boundary.
 */
static int polygon_spans(const dpl_polygon *polygon, double y, span *spans, double *crossings) {
    int count = 0, crossing_count = 0;
    for (int32_t i = 0; i < polygon->count; i++) {
        const double *a = polygon->points[i], *b = polygon->points[(i + 1) % polygon->count];
        if (a[1] == y)
            spans[count++] = a[1] == b[1] ? (span){fmin(a[0], b[0]), fmax(a[0], b[0])} : (span){a[0], a[0]};
        if ((a[1] <= y) != (b[1] <= y))
            crossings[crossing_count++] = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    }
    qsort(crossings, (size_t)crossing_count, sizeof *crossings, compare_numbers);
    for (int i = 0; i + 1 < crossing_count; i += 2)
        spans[count++] = (span){crossings[i], crossings[i + 1]};
    return count;
}

static int shape_spans(const raster *r, const dpl_shape *shape, double y) {
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        return disc_spans(&shape->disc, y, r->spans);
    case DPL_SHAPE_BOX:
        return box_spans(&shape->box, y, r->spans);
    case DPL_SHAPE_SEGMENT:
        return segment_spans(&shape->segment, y, r->spans);
    case DPL_SHAPE_POLYGON:
        return polygon_spans(&shape->polygon, y, r->spans, r->crossings);
    }
    return 0;
}

/* ---- painting ------------------------------------------------------------------------------------- */

/* First pixel whose centre is at `v` or beyond, last whose centre is at `v` or before; kept in [0, size). */
static int32_t first_pixel(double v, int32_t size) {
    double i = ceil(v - 0.5);
    return i <= 0.0 ? 0 : i >= (double)size ? size : (int32_t)i;
}

static int32_t last_pixel(double v, int32_t size) {
    double i = floor(v - 0.5);
    return i < 0.0 ? -1 : i >= (double)size ? size - 1 : (int32_t)i;
}

/* Lowest and highest y of a shape [px]. */
static span shape_rows(const dpl_shape *shape) {
    span rows = {HUGE_VAL, -HUGE_VAL};
    double reach;
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        return (span){shape->disc.center[1] - shape->disc.radius, shape->disc.center[1] + shape->disc.radius};
    case DPL_SHAPE_BOX:
        reach = hypot(shape->box.half[0], shape->box.half[1]);
        return (span){shape->box.center[1] - reach, shape->box.center[1] + reach};
    case DPL_SHAPE_SEGMENT:
        reach = 0.5 * shape->segment.width;
        return (span){fmin(shape->segment.from[1], shape->segment.to[1]) - reach,
                      fmax(shape->segment.from[1], shape->segment.to[1]) + reach};
    case DPL_SHAPE_POLYGON:
        for (int32_t i = 0; i < shape->polygon.count; i++) {
            rows.from = fmin(rows.from, shape->polygon.points[i][1]);
            rows.to = fmax(rows.to, shape->polygon.points[i][1]);
        }
        return rows;
    }
    return rows;
}

static void draw_shape(const raster *r, const dpl_shape *shape) {
    dpl_field *field = r->field;
    span rows = shape_rows(shape);
    const int32_t margin =
        field->margin; /* shapes count from the picture's corner, x and y from the world's */
    int32_t last_row = last_pixel(rows.to + margin, field->height);
    for (int32_t y = first_pixel(rows.from + margin, field->height); y <= last_row; y++) {
        int count = shape_spans(r, shape, y - margin + 0.5);
        for (int i = 0; i < count; i++) {
            int32_t last = last_pixel(r->spans[i].to + margin, field->width);
            for (int32_t x = first_pixel(r->spans[i].from + margin, field->width); x <= last; x++)
                dpl_field_put(field, dpl_field_cell(field, x, y), &shape->material);
        }
    }
}

dpl_status dpl_field_rasterise(dpl_field *field, const dpl_shape *shapes, int32_t count) {
    int32_t most_points = 3;
    bool media = false, albedo = false;
    for (int32_t i = 0; i < count; i++) {
        if (shapes[i].kind == DPL_SHAPE_POLYGON && shapes[i].polygon.count > most_points)
            most_points = shapes[i].polygon.count;
        media |= dpl_material_kind(&shapes[i].material) == DPL_PIXEL_MEDIUM;
        albedo |= dpl_material_has_albedo(&shapes[i].material);
    }
    if (media)
        DPL_TRY(dpl_field_hold_media(field));
    if (albedo)
        DPL_TRY(dpl_field_hold_albedo(field));
    /* A row of an n-cornered polygon has at most n crossings, and n boundary spans beside n/2 inner ones. */
    size_t points = (size_t)most_points;
    DPL_TRY(dpl_buffer_reserve(field->context, &field->scratch, points, 2 * sizeof(span) + sizeof(double)));
    raster r = {.field = field, .spans = field->scratch.data};
    r.crossings = (double *)(r.spans + 2 * points);
    for (int32_t i = 0; i < count; i++)
        draw_shape(&r, &shapes[i]);
    dpl_field_touch(field);
    return DPL_OK;
}
