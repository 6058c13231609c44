/* Light of blocks, brought back to pixels: bilinear between the centres of blocks, where walls are left out.
 * Called by resolution.c.
 *
 * An opaque block has no light of its own. Where it is the rim of a wall, seen from one side, it is given
 * what the blocks before it lead one to expect there: near a lamp light rises steeply, and without that its
 * rim would be dark. Where it is a thin wall, with free blocks on both sides, it must not bring them
 * together: it hardly counts, and the few pixels beside the wall that it holds are mended by mend.c. */
#include "holographic/resolution.h"

#include <math.h>

/* What a thin wall counts: enough to divide by where there is nothing else. */
#define SHUT_WEIGHT 1e-6f

/* ---- blocks --------------------------------------------------------------------------------------- */

/* Bit i: the neighbour in direction i is free. */
static uint32_t free_around(const dpl_hrc_resolution *r, int32_t x, int32_t y) {
    uint32_t bits = 0;
    for (int32_t i = 0; i < DPL_AROUND; i++)
        bits |= (uint32_t)dpl_hrc_is_free(r, x + dpl_hrc_around[i][0], y + dpl_hrc_around[i][1]) << i;
    return bits;
}

/* Do free neighbours see different sides of the block: one opposite to another, or a wall between them? */
static bool is_between(uint32_t open) {
    uint32_t begins = open & ~(open << 1 | open >> (DPL_AROUND - 1)); /* of runs around the ring */
    return (open & open >> 4) != 0 || (begins & (begins - 1)) != 0;
}

/* What light would be one block on behind `near`, having been `far` one before; not wildly different. */
static float extrapolate(float near, float far) {
    float low = fminf(0.5f * near, 2.0f * near), high = fmaxf(0.5f * near, 2.0f * near);
    return fminf(fmaxf(2.0f * near - far, low), high);
}

/* The mean over free neighbours of what they lead to expect here; of those beside twice as much. */
static void expect(const dpl_hrc_resolution *r, int32_t target, int32_t x, int32_t y, uint32_t open,
                   float rgb[3]) {
    float weights = 0.0f;
    for (int32_t i = 0; i < DPL_AROUND; i++) {
        if (!(open >> i & 1))
            continue;
        int32_t x1 = x + dpl_hrc_around[i][0], y1 = y + dpl_hrc_around[i][1], x2 = x1 + dpl_hrc_around[i][0],
                y2 = y1 + dpl_hrc_around[i][1];
        const float *near = dpl_hrc_light(r, target, x1, y1);
        const float *far = dpl_hrc_is_free(r, x2, y2) ? dpl_hrc_light(r, target, x2, y2) : near;
        float weight = i % 2 == 0 ? 2.0f : 1.0f;
        weights += weight;
        for (int c = 0; c < 3; c++)
            rgb[c] += weight * extrapolate(near[c], far[c]);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] /= weights;
}

/* In the midst of walls: what these show. */
static void mean_around(const dpl_hrc_resolution *r, int32_t target, int32_t x, int32_t y, float rgb[3]) {
    float count = 0.0f;
    for (int32_t v = y - 1; v <= y + 1; v++)
        for (int32_t u = x - 1; u <= x + 1; u++)
            if (u >= 0 && v >= 0 && u < r->field.width && v < r->field.height) {
                count += 1.0f;
                for (int c = 0; c < 3; c++)
                    rgb[c] += dpl_hrc_light(r, target, u, v)[c];
            }
    for (int c = 0; c < 3; c++)
        rgb[c] /= count;
}

/* Corners of a free block where both sides are opaque and what lies between them is not. */
static uint8_t corners_of(const dpl_hrc_resolution *r, int32_t x, int32_t y) {
    uint32_t bits = 0;
    for (int32_t i = 1; i < DPL_AROUND; i += 2) {
        int32_t u = x + dpl_hrc_around[i][0], v = y + dpl_hrc_around[i][1];
        bits |= (uint32_t)(dpl_hrc_is_free(r, u, v) && !dpl_hrc_is_free(r, u, y) && !dpl_hrc_is_free(r, x, v))
                << i;
    }
    return (uint8_t)bits;
}

/* What an opaque block counts, and its light. Returns its mend. */
static uint8_t weigh_opaque(const dpl_hrc_resampling *task, int32_t x, int32_t y) {
    const dpl_hrc_resolution *r = task->resolution;
    uint32_t open = free_around(r, x, y);
    bool shut = !open || is_between(open) || !dpl_hrc_is_open(task, x, y);
    float weight = shut ? SHUT_WEIGHT : 1.0f;
    dpl_hrc_plane_row(r, 3 * r->target_count, y)[x] = weight;
    for (int32_t target = 0; target < r->target_count; target++) {
        float rgb[3] = {0.0f, 0.0f, 0.0f};
        if (open)
            expect(r, target, x, y, open, rgb);
        else
            mean_around(r, target, x, y, rgb);
        for (int32_t c = 0; c < 3; c++)
            dpl_hrc_plane_row(r, target * 3 + c, y)[x] = weight * rgb[c];
    }
    return shut ? DPL_MEND_SHUT : 0;
}

/* Light of a row as it is, and weight 1. */
static void copy_light(const dpl_hrc_resolution *r, int32_t y) {
    float *weight = dpl_hrc_plane_row(r, 3 * r->target_count, y);
    for (int32_t x = 0; x < r->field.width; x++)
        weight[x] = 1.0f;
    for (int32_t target = 0; target < r->target_count; target++) {
        const float *light = dpl_hrc_light(r, target, 0, y);
        float *red = dpl_hrc_plane_row(r, target * 3, y), *green = dpl_hrc_plane_row(r, target * 3 + 1, y),
              *blue = dpl_hrc_plane_row(r, target * 3 + 2, y);
        for (int32_t x = 0; x < r->field.width; x++) {
            red[x] = light[3 * x];
            green[x] = light[3 * x + 1];
            blue[x] = light[3 * x + 2];
        }
    }
}

static void weigh_row(const dpl_hrc_resampling *task, int32_t y) {
    const dpl_hrc_resolution *r = task->resolution;
    int32_t width = r->field.width;
    size_t row = dpl_field_cell(&r->field, 0, y);
    const uint8_t *kind = (const uint8_t *)r->field.kind.data + row;
    const uint8_t *above = y > 0 ? kind - width : kind,
                  *below = y + 1 < r->field.height ? kind + width : kind;
    uint8_t *mends = (uint8_t *)r->memory[DPL_MEMORY_MENDS].data + row;
    /* Blocks that are not near walls, most of them, have none: those that need a look are found first. */
    for (int32_t x = 0; x < width; x++)
        mends[x] =
            (kind[x] == DPL_PIXEL_OPAQUE) | (above[x] == DPL_PIXEL_OPAQUE) | (below[x] == DPL_PIXEL_OPAQUE);
    const uint8_t *end = mends + width;
    for (uint8_t *mend = memchr(mends, 1, (size_t)width); mend;) {
        int32_t x = (int32_t)(mend - mends);
        *mend = kind[x] == DPL_PIXEL_OPAQUE ? weigh_opaque(task, x, y) : corners_of(r, x, y);
        mend = memchr(mend + 1, 1, (size_t)(end - mend - 1));
    }
}

void dpl_hrc_weigh_task(int32_t begin, int32_t end, int32_t worker, void *resampling) {
    const dpl_hrc_resampling *task = resampling;
    const dpl_hrc_resolution *r = task->resolution;
    int32_t width = r->field.width;
    (void)worker;
    for (int32_t y = begin; y < end; y++) {
        copy_light(r, y);
        weigh_row(task, y);
        for (int32_t plane = 0; plane < dpl_hrc_plane_count(r); plane++) {
            float *row = dpl_hrc_plane_row(r, plane, y);
            row[-1] = row[0];
            row[width] = row[width - 1];
        }
    }
}

/* ---- interpolation -------------------------------------------------------------------------------- */

/* Centres of blocks to pixels, four for each: the first two lie before the first centre, the last behind the
 * last. */
static void stretch_fourfold(int32_t blocks, float *out, const float *in) {
    for (int32_t m = 0; m <= blocks; m++) {
        float step = in[m] - in[m - 1];
        out[4 * m - 2] = in[m - 1] + step * 0.125f;
        out[4 * m - 1] = in[m - 1] + step * 0.375f;
        out[4 * m] = in[m - 1] + step * 0.625f;
        out[4 * m + 1] = in[m - 1] + step * 0.875f;
    }
}

/* Pixels of a row that lies `share` of the way from one row of blocks to another. `mixed` is scratch. */
static void interpolate_plane(const dpl_hrc_resolution *r, const float *from, const float *to, float share,
                              float *mixed, float *out) {
    int32_t blocks = r->field.width;
    if (r->scale == 2) {
        r->field.context->kernels->spread(2 * blocks, out, from - 1, to - 1, share);
        return;
    }
    for (int32_t x = -1; x <= blocks; x++)
        mixed[x] = from[x] + (to[x] - from[x]) * share;
    stretch_fourfold(blocks, out, mixed);
}

static void interpolate_row(const dpl_hrc_resolution *r, int32_t y, int32_t width, float *mixed,
                            float *const out[]) {
    int32_t last = r->field.height - 1, half = r->scale / 2, planes = dpl_hrc_plane_count(r);
    int32_t above = (y + half) / r->scale - 1, below = above + 1;
    float share = ((float)((y + half) % r->scale) + 0.5f) / (float)r->scale;
    above = above < 0 ? 0 : above;
    below = below > last ? last : below;
    for (int32_t plane = 0; plane < planes; plane++)
        interpolate_plane(r, dpl_hrc_plane_row(r, plane, above), dpl_hrc_plane_row(r, plane, below), share,
                          mixed, out[plane]);
    float *weight = out[planes - 1];
    for (int32_t x = 0; x < width; x++)
        weight[x] = 1.0f / weight[x];
    for (int32_t plane = 0; plane < planes - 1; plane++)
        for (int32_t x = 0; x < width; x++)
            out[plane][x] *= weight[x];
}

/* ---- rows ----------------------------------------------------------------------------------------- */

/* Of a row of pixels, with what `stretch_fourfold` writes outside. */
static size_t row_floats(const dpl_hrc_resolution *r) {
    return (size_t)r->scale * ((size_t)r->field.width + 1);
}

size_t dpl_hrc_refine_floats(const dpl_hrc_resolution *r) {
    return (size_t)dpl_hrc_plane_count(r) * row_floats(r) + (size_t)dpl_hrc_plane_stride(r);
}

void dpl_hrc_refine_task(int32_t begin, int32_t end, int32_t worker, void *resampling) {
    const dpl_hrc_resampling *task = resampling;
    const dpl_hrc_resolution *r = task->resolution;
    float *out[DPL_HRC_TARGETS * 3 + 1], *floats = r->memory[DPL_MEMORY_ROWS].data;
    int32_t planes = dpl_hrc_plane_count(r), margin = task->field->margin;
    floats += (size_t)worker * dpl_hrc_refine_floats(r);
    for (int32_t plane = 0; plane < planes; plane++)
        out[plane] = floats + (size_t)plane * row_floats(r) + r->scale / 2;
    float *mixed = floats + (size_t)planes * row_floats(r) + 1;
    for (int32_t y = begin + margin; y < end + margin; y++) {
        interpolate_row(r, y, task->field->width, mixed, out);
        dpl_hrc_mend_row(task, y, out);
        dpl_hrc_write_targets(task, y, out);
    }
}
