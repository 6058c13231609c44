/* Shadow rays of a light in vectors: its horizon, and the maps of its rays drawn and looked up. In lanes what
 * light_ref.c does in sequence, operation for operation. Included by vector.c alone. */
#ifndef DPL_KERNEL_VECTOR_LIGHT_H
#define DPL_KERNEL_VECTOR_LIGHT_H

#include "kernel/kernel.h"
#include "kernel/sight.h"
#include "kernel/simd.h"

/* ---- rays of a light ------------------------------------------------------------------------------- */

static inline vfloat bin_of_direction(vfloat dx, vfloat dy, float bins) {
    vfloat ax = magnitude(dx), ay = magnitude(dy);
    vint flat = ax > ay;
    vfloat x = select_float(flat, ay, ax) / select_float(flat, ax, ay), u = x * x;
    vfloat angle = x * (ATAN_0 + u * (ATAN_1 + u * (ATAN_2 + u * (ATAN_3 + u * (ATAN_4 + u * ATAN_5)))));
    angle = select_float(flat, angle, SIGHT_HALF_PI - angle);
    angle = select_float(dx < 0.0f, SIGHT_PI - angle, angle);
    angle = select_float(dy < 0.0f, -angle, angle);
    return angle * (bins / (2.0f * SIGHT_PI)) + 2.0f * bins;
}

static void look_round(const dpl_horizon_table *table, int32_t count, uint8_t *class, float dx, float dy) {
    float ay = dy < 0.0f ? -dy : dy, side_y = dy > 0.0f ? 1.5f : 3.5f, scale = 0.25f * (float)table->count;
    for (int32_t i = 0; i < count; i += LANES) {
        vfloat x = dx + to_float(lane_numbers() + i), square = x * x + dy * dy;
        vint flat = magnitude(x) >= ay;
        vfloat below = select_float(flat, select_float(x == 0.0f, all_float(1.0f), x), all_float(dy));
        vfloat ratio = select_float(flat, all_float(dy), -x) / below * 0.5f;
        vfloat side = select_float(x > 0.0f, all_float(0.5f), all_float(2.5f));
        side = select_float(flat, side, all_float(side_y));
        vint bin = 3 * (to_int((side + ratio) * scale) & (table->count - 1)), all = all_int(-1);
        vfloat lit = gather(all, table->bins[0], bin, x), from = gather(all, table->bins[0] + 1, bin, x);
        vfloat to = gather(all, table->bins[0] + 2, bin, x);
        vint dark = (square > from) & (square <= to); /* a mask is -1 where it holds */
        vint classes = ~(square <= lit) & (2 + dark);
        uint8_t bytes[LANES];
        store_bytes(bytes, classes);
        memcpy(class + i, bytes, (size_t)(count - i < LANES ? count - i : LANES));
    }
}

static inline vfloat arc_sine(vfloat x) {
    vfloat a = magnitude(x), square = select_float(1.0f - a > 0.0f, 1.0f - a, all_float(0.0f));
    vfloat cosine = square_root(square) * (ACOS_0 + a * (ACOS_1 + a * (ACOS_2 + a * ACOS_3)));
    return select_float(x < 0.0f, cosine - SIGHT_HALF_PI, SIGHT_HALF_PI - cosine);
}

/* One pixel, LANES rays at once. */
static inline void draw_pixel(const dpl_ray_map *map, int32_t first, int32_t number, float x, float y) {
    float bins = (float)map->bins, per_angle = bins / (2.0f * SIGHT_PI), square = x * x + y * y;
    vfloat inverse = 1.0f / square_root(all_float(square));
    vfloat direction = bin_of_direction(all_float(x), all_float(y), bins) + 0.5f;
    for (int32_t k = first; k < first + number; k += LANES) {
        int32_t some = first + number - k < LANES ? first + number - k : LANES;
        vfloat p = load_some(map->offsets + k, some) * map->radius, rest = square - p * p;
        vfloat along = square_root(select_float(rest > LEAST_ALONG, rest, all_float(LEAST_ALONG)));
        vfloat across = magnitude(along * x + p * y) + magnitude(along * y - p * x);
        vfloat half = HALF_SIDE * across / (square * along) * per_angle;
        vfloat middle = direction - arc_sine(p * inverse) * per_angle;
        vint begin = to_int(middle - half), end = to_int(middle + half);
        for (int32_t i = 0; i < some; i++)
            draw_stretch(map->reach + (size_t)(k + i) * (size_t)map->bins, map->bins - 1, begin[i], end[i],
                         square);
    }
}

static void draw_rays(const dpl_ray_map *map, int32_t first, int32_t number, int32_t count, const float *x,
                      float y) {
    for (int32_t i = 0; i < count; i++)
        draw_pixel(map, first, number, x[i], y);
}

static inline vfloat see_some(const dpl_ray_map *map, vfloat dx, vfloat dy) {
    float bins = (float)map->bins, per_angle = bins / (2.0f * SIGHT_PI);
    vfloat square = dx * dx + dy * dy, sine = map->radius / square_root(square);
    vfloat middle = bin_of_direction(dx, dy, bins), seen = {0}, all = {0};
    const float *left = map->reach, *right = left + (size_t)(map->rays - 1) * (size_t)map->bins;
    vint mask = all_int(map->bins - 1), lanes = all_int(-1);
    for (int32_t k = 0; k < map->rays / 2; k++, left += map->bins, right -= map->bins) {
        vfloat z = map->offsets[k] * sine, u = z * z;
        vfloat turn = z * (ASIN_0 + u * (ASIN_1 + u * (ASIN_2 + u * ASIN_3))) * per_angle;
        vfloat weight = SLANT_0 + u * (SLANT_1 + u * (SLANT_2 + u * SLANT_3));
        vfloat one = gather(lanes, left, to_int(middle - turn) & mask, all);
        vfloat other = gather(lanes, right, to_int(middle + turn) & mask, all);
        seen += (vfloat)((vint)weight & (square <= one)) + (vfloat)((vint)weight & (square <= other));
        all += weight;
    }
    return seen / (2.0f * all);
}

static void see_rays(const dpl_ray_map *map, int32_t count, float *visible, const float *dx,
                     const float *dy) {
    for (int32_t i = 0; i < count; i += LANES) {
        int32_t some = count - i < LANES ? count - i : LANES;
        vint given = lane_numbers() < some; /* others look from somewhere outside the disc */
        vfloat x = select_float(given, load_some(dx + i, some), all_float(2.0f * map->radius));
        store_some(visible + i, see_some(map, x, load_some(dy + i, some)), some);
    }
}

#endif
