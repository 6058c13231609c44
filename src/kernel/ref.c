/* The scalar reference of every kernel: read this to know what a kernel computes. */
#include "kernel/kernel.h"

#include "kernel/cover_ref.h"
#include "kernel/depth_ref.h"
#include "kernel/disc_ref.h"
#include "kernel/distance_ref.h"
#include "kernel/exponential.h"
#include "kernel/half.h"
#include "kernel/light_ref.h"
#include "kernel/loops.h"
#include "kernel/march.h"
#include "kernel/ray_words_ref.h"

#include <math.h>
#include <stdbool.h>

/* ---- march ---------------------------------------------------------------------------------------- */

typedef struct ray {
    float x, y;   /* start [px] */
    float dx, dy; /* unit direction */
    float inverse_x, inverse_y;
    float length;           /* [px] */
    int32_t step_x, step_y; /* -1 or 1 */
    int32_t side_x, side_y; /* which edge of a pixel it leaves by: 0 or 1 */
} ray;

static float inverse_or_never(float d) {
    return d != 0.0f ? 1.0f / d : NEVER;
}

static ray ray_between(float x0, float y0, float x1, float y1) {
    ray r = {.x = x0, .y = y0};
    float dx = x1 - x0, dy = y1 - y0;
    r.length = sqrtf(dx * dx + dy * dy);
    float scale = inverse_or_never(r.length);
    r.dx = dx * scale;
    r.dy = dy * scale;
    r.inverse_x = inverse_or_never(r.dx);
    r.inverse_y = inverse_or_never(r.dy);
    r.step_x = r.dx < 0.0f ? -1 : 1;
    r.step_y = r.dy < 0.0f ? -1 : 1;
    r.side_x = r.dx < 0.0f ? 0 : 1;
    r.side_y = r.dy < 0.0f ? 0 : 1;
    return r;
}

/* Along one axis: where a ray enters [0, size]. */
static float enter_axis(float start, float direction, float inverse, float size) {
    if (start < 0.0f)
        return direction > 0.0f ? -start * inverse : NEVER;
    if (start > size)
        return direction < 0.0f ? (size - start) * inverse : NEVER;
    return 0.0f;
}

static float enter_picture(const ray *r, const dpl_grid *grid) {
    float x = enter_axis(r->x, r->dx, r->inverse_x, (float)grid->width);
    float y = enter_axis(r->y, r->dy, r->inverse_y, (float)grid->height);
    return x > y ? x : y;
}

static int32_t floor_to_int(float v) {
    int32_t i = (int32_t)v;
    return (float)i > v ? i - 1 : i;
}

static int32_t clamp_int(int32_t v, int32_t low, int32_t high) {
    return v < low ? low : v > high ? high : v;
}

/* Adds what a stretch of `length` in one pixel of a medium gives and takes. */
static void cross_medium(const dpl_grid *grid, int32_t cell, float length, float radiance[3],
                         float passed[3]) {
    for (int c = 0; c < 3; c++) {
        float through = dpl_exp_negative(grid->extinction[cell][c] * length);
        radiance[c] += passed[c] * (grid->emission[cell][c] * (1.0f - through));
        passed[c] *= through;
    }
}

static void hit_opaque(const dpl_grid *grid, int32_t cell, float radiance[3], float passed[3]) {
    for (int c = 0; c < 3; c++) {
        radiance[c] += passed[c] * grid->emission[cell][c];
        passed[c] = 0.0f;
    }
}

/* Puts the ray where it enters the picture: how far along that is and the pixel. False when it misses. */
static bool find_entry(const dpl_grid *grid, const ray *r, float *t, int32_t *x, int32_t *y) {
    *t = enter_picture(r, grid);
    if (!(*t < r->length))
        return false;
    /* The entry point may round to just outside. */
    float entry_x = r->x + *t * r->dx, entry_y = r->y + *t * r->dy;
    if (*t > 0.0f &&
        (entry_x < -ENTRY_SLACK || entry_y < -ENTRY_SLACK || entry_x > (float)grid->width + ENTRY_SLACK ||
         entry_y > (float)grid->height + ENTRY_SLACK))
        return false; /* passes by a corner */
    *x = floor_to_int(entry_x);
    *y = floor_to_int(entry_y);
    if (*t > 0.0f) {
        *x = clamp_int(*x, 0, grid->width - 1);
        *y = clamp_int(*y, 0, grid->height - 1);
    }
    return true;
}

/* The opaque pixel that the ray ends at, or -1. Adds what media on the way give and take. */
static int32_t march_ray(const dpl_grid *grid, const ray *r, float radiance[3], float passed[3]) {
    float t;
    int32_t x, y;
    if (!find_entry(grid, r, &t, &x, &y))
        return -1;
    while (x >= 0 && y >= 0 && x < grid->width && y < grid->height) {
        int32_t cell = y * grid->width + x;
        float clearance = grid->clearance[cell];
        if (clearance >= JUMP_FROM) {
            t += clearance - TWO_HALF_DIAGONALS;
            if (t >= r->length)
                return -1;
            x = floor_to_int(r->x + t * r->dx);
            y = floor_to_int(r->y + t * r->dy);
            continue;
        }
        if (clearance < 0.0f)
            return cell;
        float edge_x = ((float)(x + r->side_x) - r->x) * r->inverse_x;
        float edge_y = ((float)(y + r->side_y) - r->y) * r->inverse_y;
        float leave = edge_x < edge_y ? edge_x : edge_y;
        if (clearance == 0.0f) {
            float until = leave < r->length ? leave : r->length;
            if (until > t)
                cross_medium(grid, cell, until - t, radiance, passed);
        }
        if (leave >= r->length)
            return -1;
        t = leave;
        if (edge_x <= edge_y) /* an exact corner looks at the neighbour in x first */
            x += r->step_x;
        else
            y += r->step_y;
    }
    return -1;
}

static void march(const dpl_grid *grid, const dpl_segments *segments, const dpl_intervals *intervals) {
    for (int32_t i = 0; i < segments->count; i++) {
        ray r = ray_between(segments->x0[i], segments->y0[i], segments->x1[i], segments->y1[i]);
        float radiance[3] = {0.0f, 0.0f, 0.0f}, passed[3] = {1.0f, 1.0f, 1.0f};
        int32_t cell = march_ray(grid, &r, radiance, passed);
        if (cell >= 0)
            hit_opaque(grid, cell, radiance, passed);
        for (int c = 0; c < 3; c++) {
            intervals->radiance[c][i] = radiance[c];
            intervals->transmittance[c][i] = passed[c];
        }
    }
}

static void march_to_cell(const dpl_grid *grid, const dpl_segments *segments, int32_t *cell) {
    for (int32_t i = 0; i < segments->count; i++) {
        ray r = ray_between(segments->x0[i], segments->y0[i], segments->x1[i], segments->y1[i]);
        float radiance[3] = {0.0f, 0.0f, 0.0f}, passed[3] = {1.0f, 1.0f, 1.0f};
        cell[i] = march_ray(grid, &r, radiance, passed);
    }
}

/* ---- sweep ---------------------------------------------------------------------------------------- */

static float clamp_float(float v, float high) {
    return v < 0.0f ? 0.0f : v > high ? high : v;
}

/* Radius of a disc around a point that holds nothing. Outside the picture nothing is, and what is inside is
 * at least as far as the picture's edge, and as what is near the closest point of it. */
static float free_radius(const dpl_clearances *d, float x, float y) {
    float near_x = clamp_float(x, (float)d->width), near_y = clamp_float(y, (float)d->height);
    int32_t column = clamp_int((int32_t)near_x, 0, d->width - 1);
    int32_t row = clamp_int((int32_t)near_y, 0, d->height - 1);
    float off_x = near_x - ((float)column + 0.5f), off_y = near_y - ((float)row + 0.5f);
    float out_x = x - near_x, out_y = y - near_y;
    float inside = d->plane[(row * d->width + column) * d->stride] - sqrtf(off_x * off_x + off_y * off_y);
    float outside = sqrtf(out_x * out_x + out_y * out_y);
    return ((inside > outside ? inside : outside) - d->spare) * SWEEP_SHRINK;
}

/* A disc of radius r around the axis covers the strip up to where the corner of its cross-section leaves the
 * disc: (w + g h)^2 + h^2 = r^2, for half width w here and slope g. */
static float sweep_strip(const dpl_clearances *d, const ray *axis, float width0, float width1) {
    float slope = (width1 - width0) * inverse_or_never(axis->length), steep = 1.0f + slope * slope;
    float scale = 1.0f / steep, t = 0.0f;
    for (int i = 0; i < SWEEP_DISCS; i++) {
        float width = width0 + slope * t;
        float radius = free_radius(d, axis->x + t * axis->dx, axis->y + t * axis->dy);
        if (!(radius > width))
            break;
        float advance = (sqrtf(radius * radius * steep - width * width) - slope * width) * scale;
        if (!(advance >= SWEEP_LEAST))
            break;
        t += advance;
        if (t >= axis->length)
            return 1.0f;
    }
    return t * inverse_or_never(axis->length) * SWEEP_SHRINK;
}

static void sweep(const dpl_clearances *distances, const dpl_strips *strips, float *share) {
    const dpl_segments *s = &strips->axis;
    for (int32_t i = 0; i < s->count; i++) {
        ray axis = ray_between(s->x0[i], s->y0[i], s->x1[i], s->y1[i]);
        share[i] = sweep_strip(distances, &axis, strips->width0[i], strips->width1[i]);
    }
}

/* ---- march through a distance field of shapes ----------------------------------------------------- */

/* What is at a point, read without interpolation; far from everything outside the picture. */
static const float *surface_at(const dpl_grid *grid, float x, float y) {
    static const float nothing[4] = {SURFACE_OUTSIDE, 0.0f, 0.0f, 0.0f};
    if (!(x > -1.0f && y > -1.0f && x < (float)grid->width && y < (float)grid->height))
        return nothing;
    return grid->surface[(size_t)(int32_t)y * (size_t)grid->width + (size_t)(int32_t)x];
}

/* What the ray hits, or NULL. */
static const float *surface_hit(const dpl_grid *grid, const ray *r) {
    float t = 0.0f;
    for (int i = 0; i < SURFACE_STEPS; i++) {
        float x = r->x + r->dx * t, y = r->y + r->dy * t;
        if (x < 0.0f || y < 0.0f || x >= (float)grid->width || y >= (float)grid->height)
            return NULL;
        float distance = surface_at(grid, x, y)[0];
        t += fabsf(distance);
        if (t >= r->length)
            return NULL;
        if (t > SURFACE_LEAST_TRAVEL && distance < SURFACE_HIT)
            return surface_at(grid, r->x + r->dx * t, r->y + r->dy * t);
    }
    return NULL;
}

static void march_surface(const dpl_grid *grid, const dpl_segments *segments,
                          const dpl_intervals *intervals) {
    for (int32_t i = 0; i < segments->count; i++) {
        ray r = ray_between(segments->x0[i], segments->y0[i], segments->x1[i], segments->y1[i]);
        const float *start = surface_at(grid, r.x, r.y);
        const float *hit = start[0] <= 0.0f ? start : surface_hit(grid, &r);
        for (int c = 0; c < 3; c++) {
            intervals->radiance[c][i] = hit ? hit[1 + c] : 0.0f;
            intervals->transmittance[c][i] = hit ? 0.0f : 1.0f;
        }
    }
}

/* ---- range ---------------------------------------------------------------------------------------- */

static bool all_within(int32_t count, const float *values, float highest) {
    for (int32_t i = 0; i < count; i++)
        if (!(values[i] >= 0.0f && values[i] <= highest))
            return false;
    return true;
}

/* ---- holographic: in and out ----------------------------------------------------------------------- */

static void opaque_planes(int32_t count, float *planes, size_t stride, const uint8_t *kind,
                          const float (*emission)[4]) {
    for (int32_t i = 0; i < count; i++)
        opaque_pixel(planes + i, stride, kind[i], emission[i]);
}

/* ---- half precision ------------------------------------------------------------------------------- */

static void half_from_float(int32_t count, uint16_t *out, const float *in) {
    for (int32_t i = 0; i < count; i++)
        out[i] = dpl_half_from_float(in[i]);
}

static void float_from_half(int32_t count, float *out, const uint16_t *in) {
    for (int32_t i = 0; i < count; i++)
        out[i] = dpl_float_from_half(in[i]);
}

/* ---- probes --------------------------------------------------------------------------------------- */

static float interpolate(const float *row, const float *next_row, float between, int32_t i) {
    int32_t left = i / 2 + i % 2;
    float a = row[left] + (next_row[left] - row[left]) * between;
    float b = row[left + 1] + (next_row[left + 1] - row[left + 1]) * between;
    return a + (b - a) * (i % 2 ? 0.25f : 0.75f);
}

static void spread(int32_t count, float *out, const float *row, const float *next_row, float between) {
    for (int32_t i = 0; i < count; i++)
        out[i] = interpolate(row, next_row, between, i);
}

static float seen_by(const dpl_parents *parents, int c, int32_t i) {
    const float *row = parents->row + c * parents->plane;
    switch (parents->seen) {
    case DPL_PARENTS_FOUR:
        return interpolate(row, parents->next_row + c * parents->plane, parents->between, i);
    case DPL_PARENT_LEFT:
        return row[i / 2 + i % 2];
    case DPL_PARENT_NEAREST:
        return row[i / 2 + 1];
    default:
        return row[0];
    }
}

static void merge(const dpl_probe_sums *sums, const dpl_parents *parents, const dpl_intervals *intervals) {
    for (int c = 0; c < 3; c++)
        for (int32_t i = 0; i < sums->count; i++)
            sums->sum[c][i] +=
                sums->weight[i % 2] *
                (intervals->radiance[c][i] + intervals->transmittance[c][i] * seen_by(parents, c, i));
}

static void merge_hits(const dpl_probe_sums *sums, const dpl_parents *parents, const uint64_t *hits) {
    for (int c = 0; c < 3; c++)
        for (int32_t i = 0; i < sums->count; i++) {
            bool hit = hits[i / 64] >> i % 64 & 1;
            sums->sum[c][i] += sums->weight[i % 2] * (hit ? 0.0f : seen_by(parents, c, i));
        }
}

/* ---- bytes ---------------------------------------------------------------------------------------- */

static void tonemap(int32_t count, uint8_t *out, const float *mean) {
    for (int32_t i = 0; i < count; i++)
        out[i] = tonemap_one(mean[i]);
}

static void bytes_from_linear(int32_t count, uint8_t *out, const float *in) {
    for (int32_t i = 0; i < count; i++)
        out[i] = byte_from_linear(in[i]);
}

/* ---- sRGB ----------------------------------------------------------------------------------------- */

static void srgb_from_linear(int32_t count, uint8_t *out, const float *in, const dpl_srgb_steps *steps) {
    for (int32_t i = 0; i < count; i++)
        out[i] = dpl_srgb_encode(steps, in[i]);
}

extern const dpl_row_kernels dpl_rows_ref[DPL_ROWS_STORAGES][DPL_ROWS_COLOURS];

const dpl_kernels dpl_kernels_ref = {
    .isa = DPL_ISA_SCALAR,
    .march = march,
    .march_to_cell = march_to_cell,
    .aim = dpl_aim_ref,
    .list_hits = dpl_list_hits_ref,
    .sweep = sweep,
    .march_surface = march_surface,
    .aim_row = aim_row,
    .merge = merge,
    .merge_hits = merge_hits,
    .spread = spread,
    .distance_down = distance_down,
    .distance_up = distance_up,
    .distance_along = dpl_distance_along_ref,
    .tonemap = tonemap,
    .all_within = all_within,
    .half_from_float = half_from_float,
    .float_from_half = float_from_half,
    .bytes_from_linear = bytes_from_linear,
    .srgb_from_linear = srgb_from_linear,
    .opaque_planes = opaque_planes,
    .transpose = transpose_plain,
    .transpose_halves = transpose_halves_plain,
    .interleave = interleave_plain,
    .add_scaled = add_scaled,
    .filter_cross = filter_cross,
    .look_round = dpl_look_round_ref,
    .draw_rays = dpl_draw_rays_ref,
    .see_rays = dpl_see_rays_ref,
    .face_disc = dpl_face_disc_ref,
    .cover_runs = dpl_cover_runs_ref,
    .share_seen = dpl_share_seen_ref,
#if !defined(DPL_WITHOUT_SOLID_SHADOWS)
    .cover = dpl_cover_ref,
    .classify = dpl_classify_ref,
#endif
    .rows = dpl_rows_ref,
};
