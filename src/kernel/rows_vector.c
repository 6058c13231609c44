/* The row kernels in vectors, compiled once per instruction set with DPL_ROWS_TABLE naming the tables. Every
 * function does in lanes what rows_ref.c does one by one, operation for operation: read that file first.
 * test/kernel/ holds the two to the same bits. */
#include "kernel/rows_table.h"
#include "kernel/simd.h"

#include <stddef.h>

/* The constants of a table reach every loop, and the loops over channels go away. */
#define INLINE static inline __attribute__((always_inline))

typedef struct layout {
    bool half;
    int passes;
} layout;

typedef struct interval {
    vfloat r[3];
    vfloat t[3];
} interval;

INLINE vfloat get(const void *row, ptrdiff_t at, layout l) {
    return l.half ? load_half((const uint16_t *)row + at) : load_some((const float *)row + at, LANES);
}

/* Light is never negative and never not-a-number. */
INLINE void put(void *row, ptrdiff_t at, vfloat value, layout l) {
    if (l.half)
        store_half_light((uint16_t *)row + at, value);
    else
        store_some((float *)row + at, value, LANES);
}

INLINE void put_one(void *row, ptrdiff_t at, float value, layout l) {
    if (l.half)
        ((uint16_t *)row)[at] = dpl_half_from_float(value);
    else
        ((float *)row)[at] = value;
}

/* Where a shifted vector is read: vectors that lie outside altogether read the pad. */
INLINE ptrdiff_t clamp_shifted(int32_t padded, int32_t y, int32_t shift) {
    int32_t at = y + shift, last = padded + DPL_ROW_PAD - LANES;
    at = at < -DPL_ROW_PAD ? -DPL_ROW_PAD : at;
    return at > last ? last : at;
}

INLINE int t_of(int channel, layout l) {
    return l.passes == 1 ? 0 : channel;
}

INLINE interval load_interval(const void *row, ptrdiff_t stride, ptrdiff_t at, layout l) {
    interval v = {0};
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++)
        v.r[c] = get(row, at + c * stride, l);
#pragma GCC unroll 3
    for (int c = 0; c < l.passes; c++)
        v.t[c] = get(row, at + (3 + c) * stride, l);
    return v;
}

INLINE void store_interval(void *row, ptrdiff_t stride, ptrdiff_t at, const interval *v, layout l) {
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++)
        put(row, at + c * stride, v->r[c], l);
#pragma GCC unroll 3
    for (int c = 0; c < l.passes; c++)
        put(row, at + (3 + c) * stride, v->t[c], l);
}

INLINE interval compose(const interval *a, const interval *b, layout l) {
    interval v = {0};
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++)
        v.r[c] = a->r[c] + a->t[t_of(c, l)] * b->r[c];
#pragma GCC unroll 3
    for (int c = 0; c < l.passes; c++)
        v.t[c] = a->t[c] * b->t[c];
    return v;
}

INLINE interval mean_of(const interval *a, const interval *b, layout l) {
    interval v = {0};
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++)
        v.r[c] = (a->r[c] + b->r[c]) * 0.5f;
#pragma GCC unroll 3
    for (int c = 0; c < l.passes; c++)
        v.t[c] = (a->t[c] + b->t[c]) * 0.5f;
    return v;
}

INLINE interval parts_of(const interval *bent, const interval *straight, layout l) {
    interval v = {0};
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++)
        v.r[c] = bent->r[c] * DPL_BENT_PART + straight->r[c] * DPL_STRAIGHT_PART;
#pragma GCC unroll 3
    for (int c = 0; c < l.passes; c++)
        v.t[c] = bent->t[c] * DPL_BENT_PART + straight->t[c] * DPL_STRAIGHT_PART;
    return v;
}

/* Copies the pad over what vectors wrote behind the end. */
INLINE void seal(const dpl_row_shape *shape, void *row, int planes, layout l) {
    int32_t padded = dpl_row_padded(shape->length);
    for (int p = 0; p < planes && shape->length < padded; p++)
        for (int32_t y = shape->length; y < padded; y++) {
            ptrdiff_t plane = (ptrdiff_t)p * shape->stride;
            if (l.half)
                ((uint16_t *)row)[plane + y] = ((uint16_t *)row)[plane + padded];
            else
                ((float *)row)[plane + y] = ((float *)row)[plane + padded];
        }
}

/* ---- masks ---------------------------------------------------------------------------------------- */

INLINE const uint64_t *mask_of(const dpl_row_shape *shape, const void *row, layout l) {
    return dpl_row_mask(shape, (void *)(uintptr_t)row, l.half ? 2 : 4);
}

/* Word `index` of a mask, none beyond its ends. */
INLINE uint64_t word_at(const uint64_t *mask, int32_t words, int32_t index) {
    return index < 0 || index >= words ? 0 : mask[index];
}

/* 64 bits of a mask from bit `first` on, which may be anywhere. */
INLINE uint64_t bits_from(const uint64_t *mask, int32_t words, int32_t first) {
    int32_t word = first >> 6, bit = first & 63;
    uint64_t low = word_at(mask, words, word) >> bit;
    return bit ? low | word_at(mask, words, word + 1) << (64 - bit) : low;
}

/* Word `word` of a mask that is shifted by values: what a block reads lies in one block or in two. */
INLINE uint64_t shifted_word(const dpl_row_shape *shape, const void *row, int32_t shift, int32_t word,
                             layout l) {
    const uint64_t *mask = mask_of(shape, row, l);
    int32_t blocks = shift >> 4, first = 64 * word + blocks;
    uint64_t bits = bits_from(mask, shape->words, first);
    return shift & (DPL_ROW_BLOCK - 1) ? bits | bits_from(mask, shape->words, first + 1) : bits;
}

/* Words of a mask that stand for blocks; those behind them are room, and 0. */
INLINE int32_t words_of(const dpl_row_shape *shape) {
    return (dpl_row_padded(shape->length) / DPL_ROW_BLOCK + 63) / 64;
}

/* The bits of a word that stand for blocks. */
INLINE uint64_t valid_bits(const dpl_row_shape *shape, int32_t word) {
    int32_t left = dpl_row_padded(shape->length) / DPL_ROW_BLOCK - 64 * word;
    return left >= 64 ? ~(uint64_t)0 : left <= 0 ? 0 : ((uint64_t)1 << left) - 1;
}

/* Sets a word of the mask, and empties the blocks that were not empty before and now are. */
INLINE void set_word(const dpl_row_shape *shape, void *row, int32_t word, uint64_t bits, layout l) {
    uint64_t *mask = dpl_row_mask(shape, row, l.half ? 2 : 4);
    uint64_t emptied = mask[word] & ~bits;
    mask[word] = bits;
    while (emptied) {
        ptrdiff_t at = (64 * word + __builtin_ctzll(emptied)) * DPL_ROW_BLOCK;
        emptied &= emptied - 1;
        for (int32_t y = 0; y < DPL_ROW_BLOCK; y += LANES)
            for (int p = 0; p < 3 + l.passes; p++)
                put(row, at + y + p * (ptrdiff_t)shape->stride, all_float(p < 3 ? 0.0f : 1.0f), l);
    }
}

/* Runs the statement that follows for every vector `y` of the blocks whose bits are set. */
#define FOR_VECTORS(y, word, bits)                                                                           \
    for (uint64_t left_ = (bits); left_; left_ &= left_ - 1)                                                 \
        for (int32_t first_ = (64 * (word) + __builtin_ctzll(left_)) * DPL_ROW_BLOCK, y = first_;            \
             y < first_ + DPL_ROW_BLOCK; y += LANES)

/* ---- trace ---------------------------------------------------------------------------------------- */

/* A pixel and what its face reflects. */
INLINE interval with_face(interval pixel, const void *face, ptrdiff_t stride, ptrdiff_t at, layout l) {
    if (face) {
#pragma GCC unroll 3
        for (int c = 0; c < 3; c++)
            pixel.r[c] = pixel.r[c] + get(face, at + c * stride, l);
    }
    return pixel;
}

INLINE interval cross(const interval *before, const interval *pixel, bool full, layout l) {
    interval v = compose(before, pixel, l);
    return full ? compose(&v, pixel, l) : v;
}

/* One vector of a segment. */
INLINE interval trace_vector(int32_t padded, ptrdiff_t stride, int32_t y, const dpl_tap *taps,
                             int32_t tap_count, bool two_ways, layout l) {
    interval v, other;
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++) {
        v.r[c] = other.r[c] = all_float(0.0f);
        v.t[c] = other.t[c] = all_float(1.0f);
    }
    for (int32_t i = 0; i < tap_count; i++) {
        const dpl_tap *tap = &taps[i];
        bool full = tap->kind == DPL_TAP_FULL;
        ptrdiff_t at = clamp_shifted(padded, y, tap->shift);
        interval plain = load_interval(tap->row, stride, at, l),
                 pixel = with_face(plain, tap->face, stride, at, l);
        v = cross(&v, &pixel, full, l);
        if (!two_ways)
            continue;
        if (tap->kind == DPL_TAP_CORNER) {
            at = clamp_shifted(padded, y, tap->other_shift);
            plain = load_interval(tap->other_row, stride, at, l);
        }
        pixel = with_face(plain, tap->other_face, stride, at, l);
        other = cross(&other, &pixel, full, l);
    }
    return two_ways ? mean_of(&v, &other, l) : v;
}

INLINE uint64_t tap_word(const dpl_row_shape *shape, const dpl_tap *tap, bool two_ways, int32_t word,
                         layout l) {
    uint64_t bits = shifted_word(shape, tap->row, tap->shift, word, l);
    return two_ways && tap->kind == DPL_TAP_CORNER
               ? bits | shifted_word(shape, tap->other_row, tap->other_shift, word, l)
               : bits;
}

INLINE void trace_ways(const dpl_row_shape *shape, void *out, const dpl_tap *taps, int32_t tap_count,
                       bool two_ways, bool part, layout l) {
    int32_t padded = dpl_row_padded(shape->length), words = words_of(shape);
    ptrdiff_t stride = shape->stride;
    for (int32_t word = 0; word < words; word++) {
        uint64_t bits = part ? mask_of(shape, out, l)[word] : 0;
        for (int32_t i = 0; i < tap_count; i++)
            bits |= tap_word(shape, &taps[i], two_ways, word, l);
        bits &= valid_bits(shape, word);
        FOR_VECTORS(y, word, bits) {
            interval v = trace_vector(padded, stride, y, taps, tap_count, two_ways, l);
            if (part) {
                interval before = load_interval(out, stride, y, l);
                v = parts_of(&before, &v, l);
            }
            store_interval(out, stride, y, &v, l);
        }
        set_word(shape, out, word, bits, l);
    }
    seal(shape, out, 3 + l.passes, l);
}

INLINE void trace(const dpl_row_shape *shape, void *out, const dpl_tap *taps, int32_t tap_count,
                  dpl_trace_into into, layout l) {
    if (into == DPL_TRACE_TWO_WAYS)
        trace_ways(shape, out, taps, tap_count, true, false, l);
    else
        trace_ways(shape, out, taps, tap_count, false, into == DPL_TRACE_A_PART, l);
}

/* ---- fork ----------------------------------------------------------------------------------------- */

/* One vector of a fork: <r, t> into `v`, and the t of what does not go straight on. */
INLINE void fork_vector(const dpl_fork *from, ptrdiff_t stride, ptrdiff_t y, ptrdiff_t at, interval *v,
                        interval *passed, layout l) {
    interval start = load_interval(from->start.row, stride, y, l),
             ahead = load_interval(from->ahead.row, stride, y, l),
             aside = load_interval(from->aside.row, stride, at, l),
             end = load_interval(from->end.row, stride, at, l),
             lit_end = with_face(end, from->end.face, stride, at, l);
    start = with_face(start, from->start.face, stride, y, l);
    ahead = with_face(ahead, from->ahead.face, stride, y, l);
    aside = with_face(aside, from->aside.face, stride, at, l);
    vfloat nearer[3], low[3], high[3];
#pragma GCC unroll 3
    for (int c = 0; c < l.passes; c++) {
        nearer[c] = DPL_FORK_AHEAD * ahead.t[c];
        low[c] = nearer[c] * get(from->end_corner, at + (3 + c) * stride, l);
        high[c] = DPL_FORK_ASIDE * aside.t[c];
        v->t[c] = start.t[c] * ((low[c] + high[c]) * end.t[c]);
        passed->t[c] = 1.0f - start.t[c] * (nearer[c] - low[c]);
    }
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++) {
        int t = t_of(c, l);
        vfloat light = (DPL_FORK_AHEAD * ahead.r[c] + DPL_FORK_ASIDE * aside.r[c]) +
                       (low[t] * end.r[c] + high[t] * lit_end.r[c]);
        v->r[c] = start.r[c] + start.t[t] * light;
        passed->r[c] = all_float(0.0f);
    }
}

INLINE void fork_ways(const dpl_row_shape *shape, void *out, void *straight, const dpl_fork *from, layout l) {
    int32_t padded = dpl_row_padded(shape->length), words = words_of(shape);
    ptrdiff_t stride = shape->stride;
    for (int32_t word = 0; word < words; word++) {
        uint64_t bits = mask_of(shape, from->start.row, l)[word] | mask_of(shape, from->ahead.row, l)[word] |
                        shifted_word(shape, from->aside.row, from->shift, word, l) |
                        shifted_word(shape, from->end.row, from->shift, word, l) |
                        shifted_word(shape, from->end_corner, from->shift, word, l);
        bits &= valid_bits(shape, word);
        FOR_VECTORS(y, word, bits) {
            interval v, passed;
            fork_vector(from, stride, y, clamp_shifted(padded, y, from->shift), &v, &passed, l);
            store_interval(out, stride, y, &v, l);
            store_interval(straight, stride, y, &passed, l);
        }
        set_word(shape, out, word, bits, l);
        set_word(shape, straight, word, bits, l);
    }
    seal(shape, out, 3 + l.passes, l);
    seal(shape, straight, 3 + l.passes, l);
}

/* ---- extend --------------------------------------------------------------------------------------- */

INLINE void extend_pair(const dpl_row_shape *shape, void *even, void *odd, const void *const near[2],
                        const void *const far[2], int32_t shift, layout l) {
    int32_t padded = dpl_row_padded(shape->length), words = words_of(shape);
    ptrdiff_t stride = shape->stride;
    for (int32_t word = 0; word < words; word++) {
        uint64_t valid = valid_bits(shape, word), near0_bits = mask_of(shape, near[0], l)[word];
        uint64_t even_bits = (near0_bits | shifted_word(shape, far[0], shift, word, l)) & valid;
        uint64_t odd_bits =
            (near0_bits | mask_of(shape, near[1], l)[word] | shifted_word(shape, far[1], shift, word, l) |
             shifted_word(shape, far[0], shift + 2, word, l)) &
            valid;
        FOR_VECTORS(y, word, even_bits | odd_bits) {
            ptrdiff_t at = clamp_shifted(padded, y, shift), beyond = clamp_shifted(padded, y, shift + 2);
            interval near0 = load_interval(near[0], stride, y, l),
                     far0 = load_interval(far[0], stride, at, l);
            interval v = compose(&near0, &far0, l);
            store_interval(even, stride, y, &v, l);
            interval far1 = load_interval(far[1], stride, at, l);
            interval low = compose(&near0, &far1, l);
            interval near1 = load_interval(near[1], stride, y, l),
                     far_high = load_interval(far[0], stride, beyond, l);
            interval high = compose(&near1, &far_high, l);
            v = mean_of(&low, &high, l);
            store_interval(odd, stride, y, &v, l);
        }
        set_word(shape, even, word, even_bits, l);
        set_word(shape, odd, word, odd_bits, l);
    }
    seal(shape, even, 3 + l.passes, l);
    seal(shape, odd, 3 + l.passes, l);
}

INLINE void extend_one(const dpl_row_shape *shape, void *even, const void *near, const void *far,
                       int32_t shift, layout l) {
    int32_t padded = dpl_row_padded(shape->length), words = words_of(shape);
    ptrdiff_t stride = shape->stride;
    for (int32_t word = 0; word < words; word++) {
        uint64_t bits = (mask_of(shape, near, l)[word] | shifted_word(shape, far, shift, word, l)) &
                        valid_bits(shape, word);
        FOR_VECTORS(y, word, bits) {
            interval near0 = load_interval(near, stride, y, l),
                     far0 = load_interval(far, stride, clamp_shifted(padded, y, shift), l);
            interval v = compose(&near0, &far0, l);
            store_interval(even, stride, y, &v, l);
        }
        set_word(shape, even, word, bits, l);
    }
    seal(shape, even, 3 + l.passes, l);
}

INLINE void extend(const dpl_row_shape *shape, void *even, void *odd, const void *const near[2],
                   const void *const far[2], int32_t shift, layout l) {
    if (odd)
        extend_pair(shape, even, odd, near, far, shift, l);
    else
        extend_one(shape, even, near[0], far[0], shift, l);
}

/* ---- merge ---------------------------------------------------------------------------------------- */

INLINE void fill_pads(const dpl_row_shape *shape, void *out, const float sky[3], layout l) {
    int32_t padded = dpl_row_padded(shape->length);
    for (int c = 0; c < 3; c++) {
        ptrdiff_t plane = (ptrdiff_t)c * shape->stride;
        vfloat fill = all_float(sky[c]);
        for (int32_t y = 0; y < DPL_ROW_PAD; y += LANES) {
            put(out, plane - DPL_ROW_PAD + y, fill, l);
            put(out, plane + padded + y, fill, l);
        }
        for (int32_t y = shape->length; y < padded; y++)
            put_one(out, plane + y, sky[c], l);
    }
}

/* What else than the segment's end gives R. */
typedef enum second_source { NONE, NEAR, STRAIGHT } second_source;

/* What a ray brings in one channel. Through nothing, r = 0 and t = 1 change no bit and are left out. */
INLINE vfloat ray_light(const dpl_merge_ray *ray, bool clear, vfloat t, vfloat straight, ptrdiff_t plane,
                        int32_t y, ptrdiff_t at, second_source second, layout l) {
    vfloat beyond = get(ray->far, plane + at, l);
    if (!clear)
        beyond = t * beyond;
    if (second == NEAR)
        beyond = beyond + get(ray->near, plane + y, l);
    if (second == STRAIGHT && !clear)
        beyond = beyond + (1.0f - straight) * get(ray->far, plane + y, l);
    if (clear)
        return ray->passed * beyond;
    return ray->emitted * get(ray->segment, plane + y, l) + ray->passed * beyond;
}

INLINE void merge_vector(void *out, const dpl_merge_ray *low, const dpl_merge_ray *high, int32_t padded,
                         ptrdiff_t stride, int32_t y, bool clear, second_source second, bool streams,
                         layout l) {
    ptrdiff_t at_low = clamp_shifted(padded, y, low->shift), at_high = clamp_shifted(padded, y, high->shift);
    vfloat t_low = {0}, t_high = {0}, straight_low = {0}, straight_high = {0};
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++) {
        if (c < l.passes && !clear) {
            t_low = get(low->segment, (3 + c) * stride + y, l);
            t_high = get(high->segment, (3 + c) * stride + y, l);
        }
        if (c < l.passes && !clear && second == STRAIGHT) {
            straight_low = get(low->straight, (3 + c) * stride + y, l);
            straight_high = get(high->straight, (3 + c) * stride + y, l);
        }
        vfloat light = ray_light(low, clear, t_low, straight_low, c * stride, y, at_low, second, l) +
                       ray_light(high, clear, t_high, straight_high, c * stride, y, at_high, second, l);
        if (streams)
            stream((float *)out + c * stride + y, light);
        else
            put(out, c * stride + y, light, l);
    }
}

INLINE void merge_rays(const dpl_row_shape *shape, void *out, const dpl_merge_ray rays[2],
                       second_source second, bool streams, layout l) {
    int32_t padded = dpl_row_padded(shape->length), words = words_of(shape);
    ptrdiff_t stride = shape->stride;
    const dpl_merge_ray low = rays[0], high = rays[1];
    const uint64_t *low_mask = mask_of(shape, low.segment, l), *high_mask = mask_of(shape, high.segment, l);
    for (int32_t word = 0; word < words; word++) {
        uint64_t valid = valid_bits(shape, word), bits = low_mask[word] | high_mask[word];
        if (second == STRAIGHT)
            bits |= mask_of(shape, low.straight, l)[word] | mask_of(shape, high.straight, l)[word];
        bits &= valid;
        FOR_VECTORS(y, word, bits) {
            merge_vector(out, &low, &high, padded, stride, y, false, second, streams, l);
        }
        FOR_VECTORS(y, word, valid & ~bits) {
            merge_vector(out, &low, &high, padded, stride, y, true, second, streams, l);
        }
    }
}

INLINE void merge(const dpl_row_shape *shape, void *out, const dpl_merge_ray rays[2], const float sky[3],
                  layout l) {
    bool streams = !l.half && shape->streams && can_stream(out);
    if (rays[0].straight)
        merge_rays(shape, out, rays, STRAIGHT, false, l);
    else if (rays[0].near && streams)
        merge_rays(shape, out, rays, NEAR, true, l);
    else if (rays[0].near)
        merge_rays(shape, out, rays, NEAR, false, l);
    else if (streams)
        merge_rays(shape, out, rays, NONE, true, l);
    else
        merge_rays(shape, out, rays, NONE, false, l);
    if (streams)
        stream_done();
    fill_pads(shape, out, sky, l);
}

INLINE void fill(const dpl_row_shape *shape, void *out, const float light[3], layout l) {
    for (int c = 0; c < 3; c++)
        for (int32_t y = 0; y < shape->length; y += LANES)
            put(out, (ptrdiff_t)c * shape->stride + y, all_float(light[c]), l);
    fill_pads(shape, out, light, l);
}

/* ---- collect --------------------------------------------------------------------------------------- */

INLINE void collect(const dpl_row_shape *shape, float *sum, const void *segment, float emitted,
                    const void *radiance, bool add, layout l) {
    bool streams = shape->streams && !add && can_stream(sum);
    for (int c = 0; c < 3; c++) {
        ptrdiff_t plane = (ptrdiff_t)c * shape->stride, t = (ptrdiff_t)(3 + t_of(c, l)) * shape->stride;
        for (int32_t y = 0; y < shape->length; y += LANES) {
            vfloat light = get(radiance, plane + y, l);
            if (segment)
                light = emitted * get(segment, plane + y, l) + get(segment, t + y, l) * light;
            if (add)
                light = load_some(sum + plane + y, LANES) + light;
            if (streams)
                stream(sum + plane + y, light);
            else
                store_some(sum + plane + y, light, LANES);
        }
    }
    if (streams)
        stream_done();
}

DPL_ROW_TABLES(DPL_ROWS_TABLE)
