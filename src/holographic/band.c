/* A few rows of the world out of the sums of both axes, and the filter that follows: a cross that does not
 * reach into walls (equation 21 of the paper: rows that are decoupled from level 1 on would show as a
 * checkerboard). Called by finish.c and faces.c. */
#include "holographic/holographic.h"

static const float *sums_of(const dpl_hrc *hrc, int axis_index, int32_t column, int group, int channel) {
    const dpl_hrc_axis *axis = &hrc->layout.axes[axis_index];
    size_t plane = (size_t)column * dpl_hrc_sums_planes(&hrc->layout) + (size_t)(3 * group + channel);
    return (const float *)(const void *)((char *)hrc->arena.data + axis->sums) +
           plane * (size_t)axis->shape.stride + DPL_ROW_PAD;
}

/* What one term of a mix adds to rows first .. behind-1 of one channel. */
typedef struct term {
    int axis;
    int group;
    float weight;
    bool add; /* to what is there, instead of replacing it */
} term;

static void add_term(const dpl_hrc_frame *f, const dpl_hrc_band *band, int32_t first, int32_t behind,
                     int channel, const term *t) {
    const dpl_kernels *kernels = f->hrc->solver.context->kernels;
    int32_t width = f->field->width, row = first - band->first + 1;
    if (t->axis == 0)
        kernels->transpose(width, behind - first, dpl_hrc_band_row(band, DPL_PLANE_ROOM, row), band->stride,
                           sums_of(f->hrc, 0, 0, t->group, channel) + first,
                           dpl_hrc_sums_planes(&f->hrc->layout) *
                               (size_t)f->hrc->layout.axes[0].shape.stride);
    for (int32_t y = first; y < behind; y++, row++)
        kernels->add_scaled(width, dpl_hrc_band_row(band, channel, row),
                            t->axis == 0 ? dpl_hrc_band_row(band, DPL_PLANE_ROOM, row)
                                         : sums_of(f->hrc, 1, y, t->group, channel),
                            t->weight, t->add);
}

/* Which pixels of a row are free: 1, else 0. Left and right of it, and above and below the world, there are
 * walls, with values that can be multiplied. */
static void mark_free(const dpl_hrc_frame *f, const dpl_hrc_band *band, int32_t y) {
    int32_t width = f->field->width, row = y - band->first + 1;
    bool inside = y >= 0 && y < f->field->height;
    for (int32_t plane = 0; plane <= DPL_PLANE_FREE; plane++) {
        float *values = dpl_hrc_band_row(band, plane, row);
        values[-1] = values[width] = 0.0f;
        if (!inside)
            memset(values, 0, (size_t)width * sizeof *values);
    }
    float *is_free = dpl_hrc_band_row(band, DPL_PLANE_FREE, row);
    const uint8_t *kind =
        (const uint8_t *)f->field->kind.data + (inside ? dpl_field_cell(f->field, 0, y) : 0);
    for (int32_t x = 0; inside && x < width; x++)
        is_free[x] = kind[x] == DPL_PIXEL_OPAQUE ? 0.0f : 1.0f;
}

dpl_hrc_band dpl_hrc_mix_rows(const dpl_hrc_frame *frame, int32_t worker, const dpl_hrc_mix *mix,
                              int32_t first, int32_t count) {
    const dpl_hrc_layout *l = &frame->hrc->layout;
    char *scratch = (char *)frame->hrc->arena.data + l->scratch + (size_t)worker * l->scratch_bytes;
    dpl_hrc_band band = {(float *)(void *)(scratch + l->axes[1].band), (size_t)l->axes[1].shape.stride,
                         first};
    int32_t top = first > 0 ? first - 1 : 0,
            behind = first + count < frame->field->height ? first + count + 1 : frame->field->height;
    for (int32_t y = first - 1; y <= first + count; y++)
        mark_free(frame, &band, y);
    for (int channel = 0; channel < 3; channel++) {
        bool add = false;
        for (int axis = 0; axis < 2; axis++)
            for (int group = 0; group < DPL_GROUPS; group++) {
                term t = {axis, group, mix->weights[axis][group], add};
                if (t.weight == 0.0f)
                    continue;
                add_term(frame, &band, top, behind, channel, &t);
                add = true;
            }
    }
    return band;
}

void dpl_hrc_filter_row(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t y, float *planes[3]) {
    int32_t row = y - band->first + 1;
    const float *is_free[3] = {dpl_hrc_band_row(band, DPL_PLANE_FREE, row - 1),
                               dpl_hrc_band_row(band, DPL_PLANE_FREE, row),
                               dpl_hrc_band_row(band, DPL_PLANE_FREE, row + 1)};
    for (int32_t c = 0; c < 3; c++) {
        const float *values[3] = {dpl_hrc_band_row(band, c, row - 1), dpl_hrc_band_row(band, c, row),
                                  dpl_hrc_band_row(band, c, row + 1)};
        planes[c] = dpl_hrc_band_row(band, DPL_PLANE_FILTERED, c);
        frame->hrc->solver.context->kernels->filter_cross(frame->field->width, planes[c], values, is_free);
    }
}
