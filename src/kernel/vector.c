/* The kernels of one instruction set. Compiled once for each (see src/CMakeLists.txt), with DPL_VECTOR_TABLE
 * naming the table and DPL_VECTOR_ISA its bit. Every march here does in lanes what ref.c does in sequence,
 * operation for operation: read that file first. test/kernel/ holds the two to the same bits. */
#include "kernel/kernel.h"

#include "kernel/loops.h"
#include "kernel/simd.h"
#include "kernel/vector_cover.h"
#include "kernel/vector_distance.h"
#include "kernel/vector_light.h"
#include "kernel/vector_march.h"
#include "kernel/vector_probes.h"
#include "kernel/vector_ray_words.h"
#include "kernel/vector_sweep.h"
#if !defined(DPL_WITHOUT_SOLID_SHADOWS)
#include "kernel/vector_depth.h"
#include "kernel/vector_disc.h"
#endif

extern const dpl_row_kernels DPL_ROWS_TABLE[DPL_ROWS_STORAGES][DPL_ROWS_COLOURS]; /* rows_vector.c */
extern const dpl_kernels DPL_VECTOR_TABLE;

/* ---- range ---------------------------------------------------------------------------------------- */

static bool all_within(int32_t count, const float *values, float highest) {
    vint good = all_int(-1);
    for (int32_t i = 0; i < count; i += LANES) {
        /* lanes behind the end are 0, which is within */
        vfloat v = load_some(values + i, count - i < LANES ? count - i : LANES);
        good &= (v >= 0.0f) & (v <= highest);
    }
    return !any(~good);
}

/* ---- half precision ------------------------------------------------------------------------------- */

static void half_from_float(int32_t count, uint16_t *out, const float *in) {
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES)
        store_half(out + i, load_some(in + i, LANES));
    for (; i < count; i++)
        out[i] = dpl_half_from_float(in[i]);
}

static void float_from_half(int32_t count, float *out, const uint16_t *in) {
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES)
        store_some(out + i, load_half(in + i), LANES);
    for (; i < count; i++)
        out[i] = dpl_float_from_half(in[i]);
}

/* ---- bytes ---------------------------------------------------------------------------------------- */

static void tonemap(int32_t count, uint8_t *out, const float *mean) {
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        vfloat v = load_some(mean + i, LANES);
        vfloat base = 1.0f + 6.28318531f * select_float(v > 0.0f, v, all_float(0.0f));
        v = 1.0f - 1.0f / (base * base * square_root(base));
        store_bytes(out + i, to_int(v * 255.0f + 0.5f));
    }
    for (; i < count; i++)
        out[i] = tonemap_one(mean[i]);
}

static void bytes_from_linear(int32_t count, uint8_t *out, const float *in) {
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        vfloat v = load_some(in + i, LANES);
        v = select_float(v > 0.0f, v, all_float(0.0f));
        v = select_float(v < 1.0f, v, all_float(1.0f));
        store_bytes(out + i, to_int(v * 255.0f + 0.5f));
    }
    for (; i < count; i++)
        out[i] = byte_from_linear(in[i]);
}

/* ---- sRGB ----------------------------------------------------------------------------------------- */

static void srgb_from_linear(int32_t count, uint8_t *out, const float *in, const dpl_srgb_steps *steps) {
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        vfloat v = load_some(in + i, LANES), lowest = all_float(SRGB_LOWEST), one = all_float(1.0f);
        v = select_float(v > lowest, v, lowest); /* also for not-a-number */
        v = select_float(v < one, v, one);
        vint step = ((vint)v - SRGB_LOWEST_BITS) >> SRGB_STEP_SHIFT;
        vfloat next = gather(all_int(-1), steps->next, step, lowest);
        vint code = to_int(gather(all_int(-1), steps->code, step, lowest));
        store_bytes(out + i, code - (v >= next)); /* a mask is -1 where it holds */
    }
    for (; i < count; i++)
        out[i] = dpl_srgb_encode(steps, in[i]);
}

/* ---- holographic: in and out ----------------------------------------------------------------------- */

/* Four pixels become four planes in registers, where there is SSE2. */
static void opaque_planes(int32_t count, float *planes, size_t stride, const uint8_t *kind,
                          const float (*emission)[4]) {
    int32_t i = 0;
#if defined(__SSE2__)
    const __m128 most = _mm_set1_ps(DPL_RADIANCE_MAX), one = _mm_set1_ps(1.0f);
    const __m128i zero = _mm_setzero_si128();
    for (; i + 4 <= count; i += 4) {
        int32_t four_kinds;
        memcpy(&four_kinds, kind + i, sizeof four_kinds);
        __m128i kinds = _mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(four_kinds), zero), zero);
        __m128 solid = _mm_and_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(kinds, _mm_set1_epi32(2))), one);
        __m128 p[4];
        for (int k = 0; k < 4; k++)
            p[k] = _mm_loadu_ps(emission[i + k]);
        _MM_TRANSPOSE4_PS(p[0], p[1], p[2], p[3]);
        for (size_t c = 0; c < 3; c++)
            _mm_storeu_ps(planes + c * stride + i, _mm_mul_ps(_mm_min_ps(p[c], most), solid));
        _mm_storeu_ps(planes + 3 * stride + i, _mm_sub_ps(one, solid));
    }
#endif
    for (; i < count; i++)
        opaque_pixel(planes + i, stride, kind[i], emission[i]);
}

/* ---- transpose ------------------------------------------------------------------------------------ */

typedef float four_floats __attribute__((vector_size(16)));
typedef uint16_t four_halves __attribute__((vector_size(8)));

/* Tiles of 4 x 4 in registers; what is left at the right and at the bottom goes one by one. */
#define TRANSPOSE(name, plain, element, four)                                                                \
    static void name(int32_t rows, int32_t columns, element *out, size_t out_step, const element *in,        \
                     size_t in_step) {                                                                       \
        int32_t down = rows / 4 * 4, along = columns / 4 * 4;                                                \
        for (int32_t first = 0; first < down; first += TRANSPOSE_TILE)                                       \
            for (int32_t x = 0; x < along; x += 4)                                                           \
                for (int32_t y = first; y < down && y < first + TRANSPOSE_TILE; y += 4) {                    \
                    four v[4];                                                                               \
                    for (int i = 0; i < 4; i++)                                                              \
                        memcpy(&v[i], in + (size_t)(y + i) * in_step + x, sizeof v[i]);                      \
                    four a = __builtin_shufflevector(v[0], v[1], 0, 4, 1, 5),                                \
                         b = __builtin_shufflevector(v[0], v[1], 2, 6, 3, 7),                                \
                         c = __builtin_shufflevector(v[2], v[3], 0, 4, 1, 5),                                \
                         d = __builtin_shufflevector(v[2], v[3], 2, 6, 3, 7);                                \
                    v[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);                                        \
                    v[1] = __builtin_shufflevector(a, c, 2, 3, 6, 7);                                        \
                    v[2] = __builtin_shufflevector(b, d, 0, 1, 4, 5);                                        \
                    v[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);                                        \
                    for (int i = 0; i < 4; i++)                                                              \
                        memcpy(out + (size_t)(x + i) * out_step + y, &v[i], sizeof v[i]);                    \
                }                                                                                            \
        plain(down, columns - along, out + (size_t)along * out_step, out_step, in + along, in_step);         \
        plain(rows - down, columns, out + down, out_step, in + (size_t)down * in_step, in_step);             \
    }

TRANSPOSE(transpose, transpose_plain, float, four_floats)
TRANSPOSE(transpose_halves, transpose_halves_plain, uint16_t, four_halves)

/* ---- pixels --------------------------------------------------------------------------------------- */

enum { TOGETHER = LANES == 16 ? 16 : 4 }; /* pixels; what is left over goes one by one */

#if LANES == 16

/* One vector of pixels, of three: which value of two planes each lane takes, and then which of the third. */
static inline void weave(float *to, const float *const from[3], bool streams) {
    __m512 red = _mm512_loadu_ps(from[0]), green = _mm512_loadu_ps(from[1]), blue = _mm512_loadu_ps(from[2]);
    for (int32_t v = 0; v < 3; v++) {
        vint place = lane_numbers() + LANES * v, pixel = place / 3, channel = place % 3;
        vint first = pixel + (LANES & (channel == 1)), second = lane_numbers();
        second = select_int(channel == 2, LANES + pixel, second);
        __m512 two = _mm512_permutex2var_ps(red, (__m512i)first, green);
        vfloat some = (vfloat)_mm512_permutex2var_ps(two, (__m512i)second, blue);
        if (streams)
            stream(to + LANES * v, some);
        else
            store_some(to + LANES * v, some, LANES);
    }
}

#else

static inline void weave(float *to, const float *const from[3], bool streams) {
    four_floats red, green, blue;
    memcpy(&red, from[0], sizeof red);
    memcpy(&green, from[1], sizeof green);
    memcpy(&blue, from[2], sizeof blue);
    four_floats low = __builtin_shufflevector(red, green, 0, 4, 1, 5),
                high = __builtin_shufflevector(red, green, 2, 6, 3, 7);
    four_floats next = __builtin_shufflevector(green, blue, 1, 5, 2, 6);
    four_floats v[3] = {__builtin_shufflevector(low, blue, 0, 1, 4, 2),
                        __builtin_shufflevector(next, high, 0, 1, 4, 5),
                        __builtin_shufflevector(high, blue, 6, 2, 3, 7)};
    if (streams)
        stream_fours(to, v, 3);
    else
        memcpy(to, v, sizeof v);
}

#endif

/* Those pixels of which vectors can be made; returns how many. */
static inline int32_t interleave_vectors(int32_t count, float (*rgb)[3], const float *const planes[3],
                                         bool streams) {
    int32_t i = 0;
    for (; i + TOGETHER <= count; i += TOGETHER) {
        const float *const from[3] = {planes[0] + i, planes[1] + i, planes[2] + i};
        weave(rgb[i], from, streams);
    }
    return i;
}

static void interleave(int32_t count, float (*rgb)[3], const float *const planes[3], bool streams) {
    int32_t i = 0;
    if (streams && CAN_STREAM) { /* from the first pixel on that begins where vectors do */
        while (i < count && (uintptr_t)rgb[i] % (4 * TOGETHER) != 0)
            i++;
        interleave_plain(i, rgb, planes, false);
        const float *const from[3] = {planes[0] + i, planes[1] + i, planes[2] + i};
        i += interleave_vectors(count - i, rgb + i, from, true);
        stream_done();
    } else
        i = interleave_vectors(count, rgb, planes, false);
    const float *const rest[3] = {planes[0] + i, planes[1] + i, planes[2] + i};
    interleave_plain(count - i, rgb + i, rest, false);
}

const dpl_kernels DPL_VECTOR_TABLE = {
    .isa = DPL_VECTOR_ISA,
    .march = march,
    .march_to_cell = march_to_cell,
    .aim = aim,
    .list_hits = list_hits,
    .sweep = sweep,
    .march_surface = march_surface,
    .aim_row = aim_row,
    .merge = merge,
    .merge_hits = merge_hits,
    .spread = spread,
    .distance_down = distance_down,
    .distance_up = distance_up,
    .distance_along = distance_along,
    .tonemap = tonemap,
    .all_within = all_within,
    .half_from_float = half_from_float,
    .float_from_half = float_from_half,
    .bytes_from_linear = bytes_from_linear,
    .srgb_from_linear = srgb_from_linear,
    .opaque_planes = opaque_planes,
    .transpose = transpose,
    .transpose_halves = transpose_halves,
    .interleave = interleave,
    .add_scaled = add_scaled,
    .filter_cross = filter_cross,
    .look_round = look_round,
    .draw_rays = draw_rays,
    .see_rays = see_rays,
    .face_disc = face_disc,
    .cover_runs = cover_runs,
    .share_seen = share_seen,
#if !defined(DPL_WITHOUT_SOLID_SHADOWS)
    .cover = cover,
    .classify = classify,
#endif
    .rows = DPL_ROWS_TABLE,
};
