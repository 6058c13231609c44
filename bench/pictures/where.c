/* Sorts pixels and sums up squared errors. Called by main.c. */
#include "where.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float *rgb_of(const dpl_picture *picture, int32_t x, int32_t y) {
    return picture->data + ((size_t)y * (size_t)picture->width + (size_t)x) * 3;
}

static float sum_of(const float *rgb) {
    return rgb[0] + rgb[1] + rgb[2];
}

static int32_t at_least(int32_t value, int32_t low) {
    return value < low ? low : value;
}

static int32_t at_most(int32_t value, int32_t high) {
    return value > high ? high : value;
}

/* An opaque pixel shows its emission. */
static void mark_lamps(const dpl_picture *truth, const uint8_t *opaque, uint8_t *is_near) {
    int32_t width = truth->width, height = truth->height;
    for (int32_t y = 0; y < height; y++)
        for (int32_t x = 0; x < width; x++) {
            if (!opaque[y * width + x] || !(sum_of(rgb_of(truth, x, y)) > 0))
                continue;
            int32_t first = at_least(x - DPL_BENCH_NEAR, 0), last = at_most(x + DPL_BENCH_NEAR, width - 1);
            for (int32_t row = at_least(y - DPL_BENCH_NEAR, 0);
                 row <= at_most(y + DPL_BENCH_NEAR, height - 1); row++)
                memset(is_near + row * width + first, 1, (size_t)(last - first + 1));
        }
}

static bool is_steep(const dpl_picture *truth, const uint8_t *opaque, int32_t x, int32_t y) {
    static const int32_t steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    float own = sum_of(rgb_of(truth, x, y));
    for (int i = 0; i < 4; i++) {
        int32_t u = x + steps[i][0], v = y + steps[i][1];
        if (u < 0 || v < 0 || u >= truth->width || v >= truth->height || opaque[v * truth->width + u])
            continue;
        if (fabsf(sum_of(rgb_of(truth, u, v)) - own) > DPL_BENCH_STEEP * own)
            return true;
    }
    return false;
}

static double squared_error(const float *test, const float *truth) {
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += ((double)test[c] - (double)truth[c]) * ((double)test[c] - (double)truth[c]);
    return sum;
}

bool dpl_bench_find_error(const dpl_picture *test, const dpl_picture *truth, const uint8_t *opaque,
                          dpl_bench_where *where) {
    uint8_t *is_near = calloc((size_t)truth->width * (size_t)truth->height, 1);
    dpl_bench_share all = {0, 0};
    *where = (dpl_bench_where){0};
    if (!is_near)
        return false;
    mark_lamps(truth, opaque, is_near);
    for (int32_t y = 0; y < truth->height; y++)
        for (int32_t x = 0; x < truth->width; x++) {
            int32_t at = y * truth->width + x;
            if (opaque[at])
                continue;
            dpl_bench_share *share = is_near[at]                     ? &where->lamps
                                     : is_steep(truth, opaque, x, y) ? &where->edges
                                                                     : &where->elsewhere;
            double error = squared_error(rgb_of(test, x, y), rgb_of(truth, x, y));
            share->pixels += 1, all.pixels += 1;
            share->error += error, all.error += error;
        }
    free(is_near);
    dpl_bench_share *const shares[3] = {&where->lamps, &where->edges, &where->elsewhere};
    for (int i = 0; i < 3; i++) {
        shares[i]->pixels /= all.pixels > 0 ? all.pixels : 1;
        shares[i]->error /= all.error > 0 ? all.error : 1;
    }
    return true;
}
