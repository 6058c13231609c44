/* The exact Euclidean distance transform, in integers: Meijster, Roerdink, Hesselink 2000. First, per column,
 * the distance to the nearest occupied pixel in that column; then, per row, the least of what its columns'
 * distances make at each pixel. Both are kernels. Called by solvers before they march and by
 * dpl_field_read_distance(). */
#include "field/field.h"
#include "job/jobs.h"

/* Columns handled together: a cache line of runs, so that tasks do not share lines. */
#define COLUMN_BLOCK 64

/* Rows handled together: the first is dearer, for those below are helped by the one above. */
#define ROW_BAND 32

typedef struct transform {
    dpl_field *field;
    const uint8_t *kind;
    int32_t *runs;    /* the clearance plane's memory while it still holds column distances */
    float *clearance; /* the same memory once a row is finished */
    char *scratch;    /* of the row pass, per worker */
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

static void row_pass(int32_t begin, int32_t end, int32_t worker, void *task) {
    const transform *t = task;
    int32_t width = t->field->width, height = t->field->height;
    for (int32_t band = begin; band < end; band++) {
        int32_t y = band * ROW_BAND;
        size_t row = (size_t)y * (size_t)width;
        const dpl_distance_rows rows = {
            .width = width,
            .height = height - y < ROW_BAND ? height - y : ROW_BAND,
            .nowhere = t->nowhere,
            .kind = t->kind + row,
            .runs = t->runs + row,
            .clearance = t->clearance + row,
        };
        t->field->context->kernels->distance_along(&rows,
                                                   t->scratch + (size_t)worker * dpl_distance_scratch(width));
    }
}

dpl_status dpl_field_measure(dpl_field *field) {
    if (field->measured)
        return DPL_OK;
    dpl_context *context = field->context;
    size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    DPL_TRY(dpl_buffer_reserve(context, &field->clearance, dpl_field_pixels(field), sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(context, &field->scratch, workers, dpl_distance_scratch(field->width)));
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
    int32_t bands = (field->height + ROW_BAND - 1) / ROW_BAND;
    DPL_TRY(dpl_jobs_run(context, row_pass, bands, 1, &t));
    field->measured = true;
    return DPL_OK;
}
