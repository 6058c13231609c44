/* Shadow rays of a light, the scalar reference: its horizon, and the maps of its rays drawn and looked up. */
#include "kernel/light_ref.h"

#include "kernel/sight.h"

#include <math.h>

/* Angle of a direction in bins, 0 .. bins, plus one turn so that it stays positive. */
static float bin_of_direction(float dx, float dy, float bins) {
    float ax = fabsf(dx), ay = fabsf(dy);
    float x = (ax > ay ? ay : ax) / (ax > ay ? ax : ay), u = x * x;
    float angle = x * (ATAN_0 + u * (ATAN_1 + u * (ATAN_2 + u * (ATAN_3 + u * (ATAN_4 + u * ATAN_5)))));
    angle = ax > ay ? angle : SIGHT_HALF_PI - angle;
    angle = dx < 0.0f ? SIGHT_PI - angle : angle;
    angle = dy < 0.0f ? -angle : angle;
    return angle * (bins / (2.0f * SIGHT_PI)) + 2.0f * bins;
}

void dpl_look_round_ref(const dpl_horizon_table *table, int32_t count, uint8_t *class, float dx, float dy) {
    for (int32_t i = 0; i < count; i++) {
        float x = dx + (float)i, ax = fabsf(x), ay = fabsf(dy), square = x * x + dy * dy;
        float x_or_one = x == 0.0f ? 1.0f : x; /* at the light itself: any direction */
        float ratio = (ax >= ay ? dy : -x) / (ax >= ay ? x_or_one : dy) * 0.5f;
        float side = ax >= ay ? x > 0.0f ? 0.5f : 2.5f : dy > 0.0f ? 1.5f : 3.5f;
        int32_t bin = (int32_t)((side + ratio) * (0.25f * (float)table->count)) & (table->count - 1);
        const float *limit = table->bins[bin];
        int32_t dark = square > limit[1] && square <= limit[2] ? 1 : 2;
        class[i] = (uint8_t)(square <= limit[0] ? 0 : dark);
    }
}

/* The arc sine, within 6.8e-5. */
static float arc_sine(float x) {
    float a = fabsf(x), square = 1.0f - a > 0.0f ? 1.0f - a : 0.0f;
    float cosine = sqrtf(square) * (ACOS_0 + a * (ACOS_1 + a * (ACOS_2 + a * ACOS_3)));
    return x < 0.0f ? cosine - SIGHT_HALF_PI : SIGHT_HALF_PI - cosine;
}

/* Ray k meets the pixel as long as its centre is nearer to the ray than half the pixel's width across it. */
void dpl_draw_rays_ref(const dpl_ray_map *map, int32_t first, int32_t rays, int32_t count, const float *x,
                       float y) {
    float bins = (float)map->bins, per_angle = bins / (2.0f * SIGHT_PI);
    for (int32_t i = 0; i < count; i++) {
        float square = x[i] * x[i] + y * y, inverse = 1.0f / sqrtf(square);
        float direction = bin_of_direction(x[i], y, bins) + 0.5f;
        for (int32_t k = first; k < first + rays; k++) {
            float p = map->offsets[k] * map->radius, rest = square - p * p;
            float along = sqrtf(rest > LEAST_ALONG ? rest : LEAST_ALONG);
            float across = fabsf(along * x[i] + p * y) + fabsf(along * y - p * x[i]);
            float half = HALF_SIDE * across / (square * along) * per_angle;
            float middle = direction - arc_sine(p * inverse) * per_angle;
            int32_t begin = (int32_t)(middle - half), end = (int32_t)(middle + half);
            draw_stretch(map->reach + (size_t)k * (size_t)map->bins, map->bins - 1, begin, end, square);
        }
    }
}

static float see_one(const dpl_ray_map *map, float dx, float dy) {
    float bins = (float)map->bins, per_angle = bins / (2.0f * SIGHT_PI);
    float square = dx * dx + dy * dy, sine = map->radius / sqrtf(square);
    float middle = bin_of_direction(dx, dy, bins), seen = 0.0f, all = 0.0f;
    const float *left = map->reach, *right = left + (size_t)(map->rays - 1) * (size_t)map->bins;
    for (int32_t k = 0; k < map->rays / 2; k++, left += map->bins, right -= map->bins) {
        float z = map->offsets[k] * sine, u = z * z;
        float turn = z * (ASIN_0 + u * (ASIN_1 + u * (ASIN_2 + u * ASIN_3))) * per_angle;
        float weight = SLANT_0 + u * (SLANT_1 + u * (SLANT_2 + u * SLANT_3));
        int32_t mask = map->bins - 1;
        float one = square <= left[(int32_t)(middle - turn) & mask] ? weight : 0.0f;
        float other = square <= right[(int32_t)(middle + turn) & mask] ? weight : 0.0f;
        seen += one + other; /* when all are seen, rounded like twice the sum below: exactly 1 */
        all += weight;
    }
    return seen / (2.0f * all);
}

void dpl_see_rays_ref(const dpl_ray_map *map, int32_t count, float *visible, const float *dx,
                      const float *dy) {
    for (int32_t i = 0; i < count; i++)
        visible[i] = see_one(map, dx[i], dy[i]);
}
