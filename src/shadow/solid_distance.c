/* Exact signed distance from pixel centres to the edges of opaque pixels. Not to their centres, as the
 * clearance plane of a field has it: a shadow begins at the edge of a square. Called by dpl_solid_update().
 *
 * Lengths are in half pixels and whole numbers. Per column: the gap to the nearest occupied square above or
 * below. Per row: a square's nearest point beside the own column lies on one of the width + 1 grid lines, so
 * the distance is the lower envelope of a parabola per grid line (Felzenszwalb and Huttenlocher 2012). */
#include "shadow/solid.h"

#include "job/jobs.h"

#include <math.h>

/* Columns handled together, so that tasks do not share cache lines. */
#define COLUMN_BLOCK 64

typedef struct transform {
    const dpl_solid *solid;
    const uint8_t *kind;
    bool inside; /* distance to what is not opaque, stored with a minus in what is */
    int32_t nowhere;
    int32_t *gaps; /* per pixel: half pixels to the nearest occupied square of its column, 0 in one */
    double *rows;  /* scratch of the row pass: per worker 3 * (width + 2) */
    float *distance;
} transform;

static bool is_occupied(const transform *t, size_t cell) {
    return (t->kind[cell] == DPL_PIXEL_OPAQUE) != t->inside;
}

/* Downwards if `step` is 1: a row below an occupied one is a gap of 1 away, the next 3. */
static void sweep_row(const transform *t, size_t cell, int32_t count, int32_t *run) {
    for (int32_t i = 0; i < count; i++, cell++) {
        int32_t next = run[i] == 0 ? 1 : run[i] + 2;
        run[i] = is_occupied(t, cell) ? 0 : next < t->nowhere ? next : t->nowhere;
    }
}

static void column_pass(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const transform *t = task;
    int32_t width = t->solid->width, height = t->solid->height, run[COLUMN_BLOCK];
    int32_t border = t->inside ? 0 : t->nowhere; /* outside the picture nothing is opaque */
    for (int32_t block = begin; block < end; block++) {
        int32_t x = block * COLUMN_BLOCK, count = width - x < COLUMN_BLOCK ? width - x : COLUMN_BLOCK;
        for (int32_t i = 0; i < count; i++)
            run[i] = border;
        for (int32_t y = 0; y < height; y++) {
            size_t cell = (size_t)y * (size_t)width + (size_t)x;
            sweep_row(t, cell, count, run);
            memcpy(t->gaps + cell, run, (size_t)count * sizeof *run);
        }
        for (int32_t i = 0; i < count; i++)
            run[i] = border;
        for (int32_t y = height - 1; y >= 0; y--) {
            size_t cell = (size_t)y * (size_t)width + (size_t)x;
            sweep_row(t, cell, count, run);
            for (int32_t i = 0; i < count; i++)
                if (run[i] < t->gaps[cell + (size_t)i])
                    t->gaps[cell + (size_t)i] = run[i];
        }
    }
}

/* Squared gaps on the grid lines of a row: of the nearer of the columns to both sides. */
static void line_heights(const transform *t, const int32_t *gap, double *height) {
    int32_t width = t->solid->width;
    double border = t->inside ? 0.0 : t->nowhere;
    for (int32_t j = 0; j <= width; j++) {
        double left = j > 0 ? gap[j - 1] : border, right = j < width ? gap[j] : border;
        double least = left < right ? left : right;
        height[j] = least * least;
    }
}

/* The lower envelope of parabolas at 2 j with heights: `owner[k]` is lowest from `start[k]` on. */
static int32_t lower_envelope(int32_t count, const double *height, double *owner, double *start) {
    int32_t top = 0;
    owner[0] = 0.0;
    start[0] = -INFINITY;
    for (int32_t u = 1; u < count; u++) {
        double own = height[u] + 4.0 * (double)u * u, meet;
        for (;; top--) {
            double i = owner[top];
            meet = (own - (height[(int32_t)i] + 4.0 * i * i)) / (4.0 * (u - i));
            if (top == 0 || meet > start[top])
                break;
        }
        top++;
        owner[top] = u;
        start[top] = meet;
    }
    return top;
}

static void measure_row(const transform *t, size_t row, double *height, double *owner, double *start) {
    int32_t width = t->solid->width;
    const int32_t *gap = t->gaps + row;
    line_heights(t, gap, height);
    int32_t top = lower_envelope(width + 1, height, owner, start);
    for (int32_t x = width - 1; x >= 0; x--) {
        size_t cell = row + (size_t)x;
        double centre = 2.0 * x + 1.0;
        while (top > 0 && start[top] > centre)
            top--;
        if (is_occupied(t, cell)) {
            if (!t->inside)
                t->distance[cell] = -0.5f;
            continue;
        }
        double aside = centre - 2.0 * owner[top];
        double square = aside * aside + height[(int32_t)owner[top]];
        double straight = (double)gap[x] * gap[x];
        double distance = 0.5 * sqrt(square < straight ? square : straight);
        t->distance[cell] = (float)(t->inside ? -distance : distance);
    }
}

static void row_pass(int32_t begin, int32_t end, int32_t worker, void *task) {
    const transform *t = task;
    size_t width = (size_t)t->solid->width;
    double *height = t->rows + (size_t)worker * 3 * (width + 2);
    for (int32_t y = begin; y < end; y++)
        measure_row(t, (size_t)y * width, height, height + width + 2, height + 2 * (width + 2));
}

dpl_status dpl_solid_measure(dpl_solid *solid, const dpl_field *field, bool inside) {
    dpl_context *context = field->context;
    size_t pixels = dpl_field_pixels(field), workers = (size_t)dpl_jobs_worker_count(context->jobs);
    size_t rows = workers * 3 * ((size_t)field->width + 2);
    DPL_TRY(dpl_buffer_reserve(context, &solid->distance, pixels, sizeof(float)));
    DPL_TRY(
        dpl_buffer_reserve(context, &solid->scratch, rows * sizeof(double) + pixels * sizeof(int32_t), 1));
    transform t = {
        .solid = solid,
        .kind = field->kind.data,
        .nowhere = 2 * (field->width + field->height),
        .rows = solid->scratch.data,
        .gaps = (int32_t *)(void *)((double *)solid->scratch.data + rows),
        .distance = solid->distance.data,
    };
    for (int pass = 0; pass < (inside ? 2 : 1); pass++) {
        t.inside = pass == 1;
        DPL_TRY(dpl_jobs_run(context, column_pass, (field->width + COLUMN_BLOCK - 1) / COLUMN_BLOCK, 1, &t));
        DPL_TRY(dpl_jobs_run(context, row_pass, field->height, 8, &t));
    }
    return DPL_OK;
}
