/* The scalar reference of the row kernels: one value after the other, operation for operation what
 * rows_vector.c does in lanes. */
#include "kernel/half.h"
#include "kernel/hints.h"
#include "kernel/rows_table.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* How elements are stored, and how many planes of t there are: constants in every table. */
typedef struct layout {
    bool half;
    int passes;
} layout;

/* <r, t> at one place. Grey: t[0] stands for all channels. */
typedef struct interval {
    float r[3];
    float t[3];
} interval;

static DPL_ALWAYS_INLINE float get(const void *row, ptrdiff_t at, layout l) {
    return l.half ? dpl_float_from_half(((const uint16_t *)row)[at]) : ((const float *)row)[at];
}

static DPL_ALWAYS_INLINE void put(void *row, ptrdiff_t at, float value, layout l) {
    if (l.half)
        ((uint16_t *)row)[at] = dpl_half_from_float(value);
    else
        ((float *)row)[at] = value;
}

static DPL_ALWAYS_INLINE ptrdiff_t clamp_shifted(const dpl_row_shape *shape, int32_t y, int32_t shift) {
    ptrdiff_t at = (ptrdiff_t)y + shift, last = dpl_row_padded(shape->length) + DPL_ROW_PAD - 1;
    return at < -DPL_ROW_PAD ? -DPL_ROW_PAD : at > last ? last : at;
}

static DPL_ALWAYS_INLINE int t_of(int channel, layout l) {
    return l.passes == 1 ? 0 : channel;
}

static DPL_ALWAYS_INLINE interval load_interval(const dpl_row_shape *shape, const void *row, ptrdiff_t at,
                                                layout l) {
    interval v = {{0}, {0}};
    for (int c = 0; c < 3; c++)
        v.r[c] = get(row, at + (ptrdiff_t)c * shape->stride, l);
    for (int c = 0; c < l.passes; c++)
        v.t[c] = get(row, at + (ptrdiff_t)(3 + c) * shape->stride, l);
    return v;
}

static DPL_ALWAYS_INLINE void store_interval(const dpl_row_shape *shape, void *row, ptrdiff_t at, interval v,
                                             layout l) {
    for (int c = 0; c < 3; c++)
        put(row, at + (ptrdiff_t)c * shape->stride, v.r[c], l);
    for (int c = 0; c < l.passes; c++)
        put(row, at + (ptrdiff_t)(3 + c) * shape->stride, v.t[c], l);
}

static DPL_ALWAYS_INLINE interval compose(interval a, interval b, layout l) {
    for (int c = 0; c < 3; c++)
        a.r[c] = a.r[c] + a.t[t_of(c, l)] * b.r[c];
    for (int c = 0; c < l.passes; c++)
        a.t[c] = a.t[c] * b.t[c];
    return a;
}

static DPL_ALWAYS_INLINE interval mean_of(interval a, interval b, layout l) {
    for (int c = 0; c < 3; c++)
        a.r[c] = (a.r[c] + b.r[c]) * 0.5f;
    for (int c = 0; c < l.passes; c++)
        a.t[c] = (a.t[c] + b.t[c]) * 0.5f;
    return a;
}

static DPL_ALWAYS_INLINE interval parts_of(interval bent, interval straight, layout l) {
    for (int c = 0; c < 3; c++)
        bent.r[c] = bent.r[c] * DPL_BENT_PART + straight.r[c] * DPL_STRAIGHT_PART;
    for (int c = 0; c < l.passes; c++)
        bent.t[c] = bent.t[c] * DPL_BENT_PART + straight.t[c] * DPL_STRAIGHT_PART;
    return bent;
}

/* Behind the end of `planes` planes there is what the pad holds. */
static DPL_ALWAYS_INLINE void seal(const dpl_row_shape *shape, void *row, int planes, layout l) {
    int32_t padded = dpl_row_padded(shape->length);
    for (int p = 0; p < planes; p++)
        for (int32_t y = shape->length; y < padded; y++) {
            ptrdiff_t plane = (ptrdiff_t)p * shape->stride;
            put(row, plane + y, get(row, plane + padded, l), l);
        }
}

/* ---- trace ---------------------------------------------------------------------------------------- */

static DPL_ALWAYS_INLINE interval load_pixel(const dpl_row_shape *shape, const void *row, const void *face,
                                             ptrdiff_t at, layout l) {
    interval v = load_interval(shape, row, at, l);
    for (int c = 0; face && c < 3; c++)
        v.r[c] = v.r[c] + get(face, at + (ptrdiff_t)c * shape->stride, l);
    return v;
}

/* One tap further, on the first way or on the other. */
static DPL_ALWAYS_INLINE interval cross(const dpl_row_shape *shape, const dpl_tap *tap, bool other,
                                        interval before, int32_t y, layout l) {
    bool beside = other && tap->kind == DPL_TAP_CORNER;
    interval pixel =
        load_pixel(shape, beside ? tap->other_row : tap->row, other ? tap->other_face : tap->face,
                   clamp_shifted(shape, y, beside ? tap->other_shift : tap->shift), l);
    before = compose(before, pixel, l);
    return tap->kind == DPL_TAP_FULL ? compose(before, pixel, l) : before;
}

static DPL_ALWAYS_INLINE void trace(const dpl_row_shape *shape, void *out, const dpl_tap *taps,
                                    int32_t tap_count, dpl_trace_into into, layout l) {
    for (int32_t y = 0; y < shape->length; y++) {
        interval v = {{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}}, other = v;
        for (int32_t i = 0; i < tap_count; i++) {
            v = cross(shape, &taps[i], false, v, y, l);
            if (into == DPL_TRACE_TWO_WAYS)
                other = cross(shape, &taps[i], true, other, y, l);
        }
        if (into == DPL_TRACE_TWO_WAYS)
            v = mean_of(v, other, l);
        if (into == DPL_TRACE_A_PART)
            v = parts_of(load_interval(shape, out, y, l), v, l);
        store_interval(shape, out, y, v, l);
    }
    seal(shape, out, 3 + l.passes, l);
}

/* ---- fork ----------------------------------------------------------------------------------------- */

static DPL_ALWAYS_INLINE void fork_ways(const dpl_row_shape *shape, void *out, void *straight,
                                        const dpl_fork *from, layout l) {
    for (int32_t y = 0; y < shape->length; y++) {
        ptrdiff_t at = clamp_shifted(shape, y, from->shift);
        interval start = load_pixel(shape, from->start.row, from->start.face, y, l),
                 ahead = load_pixel(shape, from->ahead.row, from->ahead.face, y, l),
                 aside = load_pixel(shape, from->aside.row, from->aside.face, at, l),
                 end = load_interval(shape, from->end.row, at, l),
                 lit_end = load_pixel(shape, from->end.row, from->end.face, at, l),
                 corner = load_interval(shape, from->end_corner, at, l);
        interval v = {{0}, {0}}, passed = v;
        for (int c = 0; c < 3; c++) {
            int t = t_of(c, l);
            float nearer = DPL_FORK_AHEAD * ahead.t[t], low = nearer * corner.t[t],
                  high = DPL_FORK_ASIDE * aside.t[t];
            float light = (DPL_FORK_AHEAD * ahead.r[c] + DPL_FORK_ASIDE * aside.r[c]) +
                          (low * end.r[c] + high * lit_end.r[c]);
            v.r[c] = start.r[c] + start.t[t] * light;
            v.t[t] = start.t[t] * ((low + high) * end.t[t]);
            passed.t[t] = 1.0f - start.t[t] * (nearer - low);
        }
        store_interval(shape, out, y, v, l);
        store_interval(shape, straight, y, passed, l);
    }
    seal(shape, out, 3 + l.passes, l);
    seal(shape, straight, 3 + l.passes, l);
}

/* ---- extend --------------------------------------------------------------------------------------- */

static DPL_ALWAYS_INLINE void extend(const dpl_row_shape *shape, void *even, void *odd,
                                     const void *const near[2], const void *const far[2], int32_t shift,
                                     layout l) {
    for (int32_t y = 0; y < shape->length; y++) {
        ptrdiff_t at = clamp_shifted(shape, y, shift);
        interval near0 = load_interval(shape, near[0], y, l), far0 = load_interval(shape, far[0], at, l);
        store_interval(shape, even, y, compose(near0, far0, l), l);
        if (!odd)
            continue;
        ptrdiff_t beyond = clamp_shifted(shape, y, shift + 2);
        interval low = compose(near0, load_interval(shape, far[1], at, l), l),
                 high =
                     compose(load_interval(shape, near[1], y, l), load_interval(shape, far[0], beyond, l), l);
        store_interval(shape, odd, y, mean_of(low, high, l), l);
    }
    seal(shape, even, 3 + l.passes, l);
    if (odd)
        seal(shape, odd, 3 + l.passes, l);
}

/* ---- merge ---------------------------------------------------------------------------------------- */

static DPL_ALWAYS_INLINE void fill_pads(const dpl_row_shape *shape, void *out, const float sky[3], layout l) {
    for (int c = 0; c < 3; c++) {
        ptrdiff_t plane = (ptrdiff_t)c * shape->stride;
        for (int32_t y = -DPL_ROW_PAD; y < 0; y++)
            put(out, plane + y, sky[c], l);
        for (int32_t y = shape->length; y < dpl_row_padded(shape->length) + DPL_ROW_PAD; y++)
            put(out, plane + y, sky[c], l);
    }
}

/* What one ray brings in one channel. */
static DPL_ALWAYS_INLINE float ray_light(const dpl_row_shape *shape, const dpl_merge_ray *ray, int32_t y,
                                         int channel, layout l) {
    ptrdiff_t plane = (ptrdiff_t)channel * shape->stride;
    float r = get(ray->segment, plane + y, l),
          t = get(ray->segment, (ptrdiff_t)(3 + t_of(channel, l)) * shape->stride + y, l),
          beyond = t * get(ray->far, plane + clamp_shifted(shape, y, ray->shift), l);
    if (ray->near)
        beyond = beyond + get(ray->near, plane + y, l);
    if (ray->straight)
        beyond =
            beyond + (1.0f - get(ray->straight, (ptrdiff_t)(3 + t_of(channel, l)) * shape->stride + y, l)) *
                         get(ray->far, plane + y, l);
    return ray->emitted * r + ray->passed * beyond;
}

static DPL_ALWAYS_INLINE void merge(const dpl_row_shape *shape, void *out, const dpl_merge_ray rays[2],
                                    const float sky[3], layout l) {
    for (int c = 0; c < 3; c++)
        for (int32_t y = 0; y < shape->length; y++)
            put(out, (ptrdiff_t)c * shape->stride + y,
                ray_light(shape, &rays[0], y, c, l) + ray_light(shape, &rays[1], y, c, l), l);
    fill_pads(shape, out, sky, l);
}

static DPL_ALWAYS_INLINE void fill(const dpl_row_shape *shape, void *out, const float light[3], layout l) {
    fill_pads(shape, out, light, l);
    for (int c = 0; c < 3; c++)
        for (int32_t y = 0; y < shape->length; y++)
            put(out, (ptrdiff_t)c * shape->stride + y, light[c], l);
}

/* ---- collect --------------------------------------------------------------------------------------- */

static DPL_ALWAYS_INLINE void collect(const dpl_row_shape *shape, float *sum, const void *segment,
                                      float emitted, const void *radiance, bool add, layout l) {
    for (int c = 0; c < 3; c++) {
        ptrdiff_t plane = (ptrdiff_t)c * shape->stride;
        for (int32_t y = 0; y < shape->length; y++) {
            float light = get(radiance, plane + y, l);
            if (segment)
                light = emitted * get(segment, plane + y, l) +
                        get(segment, (ptrdiff_t)(3 + t_of(c, l)) * shape->stride + y, l) * light;
            sum[plane + y] = add ? sum[plane + y] + light : light;
        }
    }
}

DPL_ROW_TABLES(dpl_rows_ref)
