/* The exact Euclidean distance transform, in integers: Meijster, Roerdink, Hesselink 2000. First, per column,
 * the distance to the nearest occupied pixel in that column; then, per row, the lower envelope of the
 * parabolas that those distances put up. Called by solvers before they march and by
 * dpl_field_read_distance(). */
#include "field/field.h"
#include "job/jobs.h"

/* Columns handled together: a cache line of runs, so that tasks do not share lines. */
#define COLUMN_BLOCK 64

typedef struct transform {
    dpl_field *field;
    const uint8_t *kind;
    int32_t *runs;    /* the clearance plane's memory while it still holds column distances */
    float *clearance; /* the same memory once a row is finished */
    int32_t *scratch; /* of the row pass: 3 rows per worker */
    int32_t nowhere;  /* stands for "no occupied pixel in this column": further than any pixel */
} transform;

static void column_pass(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const transform *t = task;
    const dpl_kernels *kernels = t->field->context->kernels;
    int32_t width = t->field->width, height = t->field->height;
    int32_t above[COLUMN_BLOCK];
    for (int32_t i = 0; i < COLUMN_BLOCK; i++)
        above[i] = t->nowhere;
    for (int32_t block = begin; block < end; block++) {
        int32_t x = block * COLUMN_BLOCK, count = width - x < COLUMN_BLOCK ? width - x : COLUMN_BLOCK;
        const int32_t *before = above;
        for (int32_t y = 0; y < height; y++) {
            size_t cell = (size_t)y * (size_t)width + (size_t)x;
            kernels->distance_down(count, t->runs + cell, t->kind + cell, before);
            before = t->runs + cell;
        }
        for (int32_t y = height - 2; y >= 0; y--) {
            size_t cell = (size_t)y * (size_t)width + (size_t)x;
            kernels->distance_up(count, t->runs + cell, t->runs + cell + width);
        }
    }
}

/* Squared distance at x to the nearest occupied pixel of column i, whose column distance is run. */
static int32_t parabola(int32_t x, int32_t i, int32_t run) {
    return (x - i) * (x - i) + run * run;
}

/* The lower envelope of one row: `owner[k]` is the column whose parabola is lowest from `start[k]` on. */
static int32_t lower_envelope(int32_t width, const int32_t *run, int32_t *owner, int32_t *start) {
    int32_t top = 0;
    owner[0] = start[0] = 0;
    for (int32_t u = 1; u < width; u++) {
        while (top >= 0 &&
               parabola(start[top], owner[top], run[owner[top]]) > parabola(start[top], u, run[u]))
            top--;
        if (top < 0) {
            top = 0;
            owner[0] = u;
            continue;
        }
        int32_t i = owner[top];
        int32_t meet = 1 + (u * u - i * i + run[u] * run[u] - run[i] * run[i]) / (2 * (u - i));
        if (meet < width) {
            top++;
            owner[top] = u;
            start[top] = meet;
        }
    }
    return top;
}

static float clearance_of(uint8_t kind, int32_t squared) {
    return kind == DPL_PIXEL_EMPTY ? sqrtf((float)squared) : kind == DPL_PIXEL_OPAQUE ? -1.0f : 0.0f;
}

static void row_pass(int32_t begin, int32_t end, int32_t worker, void *task) {
    const transform *t = task;
    int32_t width = t->field->width;
    int32_t *run = t->scratch + (size_t)worker * 3 * (size_t)width;
    int32_t *owner = run + width, *start = owner + width;
    for (int32_t y = begin; y < end; y++) {
        size_t row = (size_t)y * (size_t)width;
        for (int32_t x = 0; x < width; x++)
            run[x] = t->runs[row + (size_t)x] < t->nowhere ? t->runs[row + (size_t)x] : t->nowhere;
        int32_t top = lower_envelope(width, run, owner, start);
        for (int32_t x = width - 1; x >= 0; x--) {
            t->clearance[row + (size_t)x] =
                clearance_of(t->kind[row + (size_t)x], parabola(x, owner[top], run[owner[top]]));
            if (x == start[top])
                top--;
        }
    }
}

dpl_status dpl_field_measure(dpl_field *field) {
    if (field->measured)
        return DPL_OK;
    dpl_context *context = field->context;
    size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    DPL_TRY(dpl_buffer_reserve(context, &field->clearance, dpl_field_pixels(field), sizeof(float)));
    DPL_TRY(
        dpl_buffer_reserve(context, &field->scratch, workers * 3 * (size_t)field->width, sizeof(int32_t)));
    transform t = {
        .field = field,
        .kind = field->kind.data,
        .runs = field->clearance.data,
        .clearance = field->clearance.data,
        .scratch = field->scratch.data,
        .nowhere = field->width + field->height,
    };
    int32_t blocks = (field->width + COLUMN_BLOCK - 1) / COLUMN_BLOCK;
    DPL_TRY(dpl_jobs_run(context, column_pass, blocks, 1, &t));
    DPL_TRY(dpl_jobs_run(context, row_pass, field->height, 8, &t));
    field->measured = true;
    return DPL_OK;
}
