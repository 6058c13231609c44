/* From the sums of the quadrants to the picture: a quarter of each axis' sum, filtered by a cross that does
 * not reach into walls (equation 21 of the paper: rows that are decoupled from level 1 on would show as a
 * checkerboard), written in the caller's format. */
#include "holographic/holographic.h"

/* A band of rows as planes of floats: three channels, then which pixels are free, each with a row more above
 * and below. */
typedef struct band {
    float *values;
    size_t stride;
} band;

static float *row_of(const band *b, int32_t channel, int32_t row) {
    return b->values + ((size_t)channel * (DPL_HRC_BAND + 2) + (size_t)row) * b->stride + DPL_ROW_PAD;
}

static const float *sums_of(const dpl_hrc *hrc, int axis_index, int32_t column, int channel) {
    const dpl_hrc_axis *axis = &hrc->layout.axes[axis_index];
    return (const float *)(const void *)((char *)hrc->arena.data + axis->sums) +
           ((size_t)column * 3 + (size_t)channel) * (size_t)axis->shape.stride + DPL_ROW_PAD;
}

/* Rows first .. behind-1 of the world, which stand at `row` and on in the band. */
static void sum_quadrants(const dpl_hrc_frame *f, const band *b, int32_t row, int32_t first, int32_t behind) {
    const dpl_kernels *kernels = f->hrc->solver.context->kernels;
    int32_t width = f->field->width;
    for (int c = 0; c < 3; c++) {
        kernels->transpose(width, behind - first, row_of(b, c, row), b->stride,
                           sums_of(f->hrc, 0, 0, c) + first, 3 * (size_t)f->hrc->layout.axes[0].shape.stride);
        for (int32_t y = first; y < behind; y++)
            kernels->quarter_sum(width, row_of(b, c, row + y - first), sums_of(f->hrc, 1, y, c));
    }
}

/* Which pixels of a row are free: 1, else 0. Left and right of it, and above and below the world, there are
 * walls, with values that can be multiplied. */
static void mark_free(const dpl_hrc_frame *f, const band *b, int32_t row, int32_t y) {
    int32_t width = f->field->width;
    bool inside = y >= 0 && y < f->field->height;
    for (int32_t c = 0; c < 4; c++) {
        float *plane = row_of(b, c, row);
        plane[-1] = plane[width] = 0.0f;
        if (!inside)
            memset(plane, 0, (size_t)width * sizeof *plane);
    }
    float *is_free = row_of(b, 3, row);
    const uint8_t *kind =
        (const uint8_t *)f->field->kind.data + (inside ? dpl_field_cell(f->field, 0, y) : 0);
    for (int32_t x = 0; inside && x < width; x++)
        is_free[x] = kind[x] == DPL_PIXEL_OPAQUE ? 0.0f : 1.0f;
}

static void filter_row(const dpl_hrc_frame *f, const band *b, int32_t row, int32_t y) {
    float *filtered[3];
    const float *is_free[3] = {row_of(b, 3, row - 1), row_of(b, 3, row), row_of(b, 3, row + 1)};
    for (int32_t c = 0; c < 3; c++) {
        const float *values[3] = {row_of(b, c, row - 1), row_of(b, c, row), row_of(b, c, row + 1)};
        filtered[c] = b->values + (size_t)(4 * (DPL_HRC_BAND + 2) + c) * b->stride + DPL_ROW_PAD;
        f->hrc->solver.context->kernels->filter_cross(f->field->width, filtered[c], values, is_free);
    }
    const float *const planes[3] = {filtered[0], filtered[1], filtered[2]};
    dpl_solver_write_row(f->field, f->output, y, planes, true);
}

void dpl_hrc_finish_task(int32_t begin, int32_t end, int32_t worker, void *frame) {
    const dpl_hrc_frame *f = frame;
    const dpl_hrc_layout *l = &f->hrc->layout;
    int32_t height = f->field->height, last = height - f->field->margin;
    band b = {(float *)(void *)((char *)f->hrc->arena.data + l->scratch + (size_t)worker * l->scratch_bytes +
                                l->axes[1].band),
              (size_t)l->axes[1].shape.stride};
    for (int32_t item = begin; item < end; item++) {
        int32_t y = f->field->margin + item * DPL_HRC_BAND,
                behind = y + DPL_HRC_BAND < last ? y + DPL_HRC_BAND : last;
        int32_t first = y > 0 ? y - 1 : 0, after = behind < height ? behind + 1 : height;
        sum_quadrants(f, &b, first - y + 1, first, after);
        for (int32_t at = y - 1; at <= behind; at++)
            mark_free(f, &b, at - y + 1, at);
        for (int32_t at = y; at < behind; at++)
            filter_row(f, &b, at - y + 1, at);
    }
}
