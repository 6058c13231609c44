/* From the sums of the quadrants to the caller's pictures. */
#include "holographic/holographic.h"

/* A quadrant is a quarter of all directions. */
static const dpl_hrc_mix mean_mix = {{{[DPL_GROUP_MEAN] = 0.25f}, {[DPL_GROUP_MEAN] = 0.25f}}};

/* Axis 0 goes along x, axis 1 along y. */
static const dpl_hrc_mix cosine_mix = {{{[DPL_GROUP_FORWARD] = 0.25f, [DPL_GROUP_BACKWARD] = -0.25f},
                                        {[DPL_GROUP_BELOW] = -0.25f, [DPL_GROUP_ABOVE] = 0.25f}}};
static const dpl_hrc_mix sine_mix = {{{[DPL_GROUP_BELOW] = -0.25f, [DPL_GROUP_ABOVE] = 0.25f},
                                      {[DPL_GROUP_FORWARD] = 0.25f, [DPL_GROUP_BACKWARD] = -0.25f}}};

/* Opaque pixels show what they send out, which has no direction. */
static void show_walls(const dpl_hrc_frame *f, int32_t y, bool is_mean, float *const planes[3]) {
    const uint8_t *kind = (const uint8_t *)f->field->kind.data + dpl_field_cell(f->field, 0, y);
    for (int32_t x = 0; x < f->field->width; x++) {
        if (kind[x] != DPL_PIXEL_OPAQUE)
            continue;
        float rgb[3] = {0.0f, 0.0f, 0.0f};
        if (is_mean)
            dpl_hrc_show_opaque(f, x, y, rgb);
        for (int c = 0; c < 3; c++)
            planes[c][x] = rgb[c];
    }
}

static void write_target(const dpl_hrc_frame *f, int32_t worker, const dpl_hrc_mix *mix,
                         const dpl_output *output, int32_t first, int32_t count) {
    dpl_hrc_band band = dpl_hrc_mix_rows(f, worker, mix, first, count);
    bool is_mean = mix == &mean_mix;
    if (is_mean)
        dpl_hrc_light_near(f, &band, count);
    for (int32_t y = first; y < first + count; y++) {
        float *planes[3];
        dpl_hrc_filter_row(f, &band, y, planes);
        if (is_mean)
            dpl_hrc_filter_rims(f, &band, y);
        show_walls(f, y, is_mean, planes);
        const float *const rows[3] = {planes[0], planes[1], planes[2]};
        dpl_solver_write_row(f->field, output, y, rows, false);
    }
}

void dpl_hrc_finish_task(int32_t begin, int32_t end, int32_t worker, void *frame) {
    const dpl_hrc_frame *f = frame;
    int32_t margin = f->field->margin, last = f->field->height - margin;
    for (int32_t item = begin; item < end; item++) {
        int32_t y = margin + item * DPL_HRC_BAND, left = last - y,
                count = left < DPL_HRC_BAND ? left : DPL_HRC_BAND;
        write_target(f, worker, &mean_mix, &f->targets->mean, y, count);
        if (!f->targets->cosine.data)
            continue;
        write_target(f, worker, &cosine_mix, &f->targets->cosine, y, count);
        write_target(f, worker, &sine_mix, &f->targets->sine, y, count);
    }
}
