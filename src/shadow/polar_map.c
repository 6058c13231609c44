/* Makes and reads a polar map, see polar_map.h. */
#include "shadow/polar_map.h"

#include "shadow/moments.h"
#include "shadow/polar.h"

#include "job/jobs.h"

typedef struct tracing {
    const dpl_polar_map *map;
    const dpl_solid *solid;
    const double *position;
} tracing;

static void trace(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const tracing *t = task;
    float *distances = t->map->distances.data;
    for (int32_t i = begin; i < end; i++) {
        double dx, dy;
        dpl_polar_direction((i + 0.5) * 4.0 / t->map->texels, &dx, &dy);
        double hit = dpl_solid_first_hit(t->solid, t->position[0], t->position[1], dx, dy, t->map->reach);
        distances[i] = distances[i + t->map->texels] = (float)fmin(hit, t->map->reach);
    }
}

static int32_t levels_of(int32_t texels) {
    int32_t levels = 1;
    while (1 << levels <= texels)
        levels++;
    return levels;
}

/* Beyond the end of the second round a level has no full span: what is there is never asked for. */
static void fill_nearest(dpl_polar_map *map) {
    int32_t total = 2 * map->texels;
    float *level = map->nearest.data;
    memcpy(level, map->distances.data, (size_t)total * sizeof *level);
    for (int32_t k = 1; k < levels_of(map->texels); k++, level += total)
        for (int32_t i = 0, span = 1 << (k - 1); i < total; i++)
            level[total + i] = fminf(level[i], level[i + span < total ? i + span : total - 1]);
}

static dpl_status fill_moments(dpl_polar_map *map, dpl_context *context) {
    int32_t total = 2 * map->texels;
    const float *distances = map->distances.data;
    size_t entries = dpl_moment_table_entries(total, 1), packed_bytes = (size_t)total * 4 * sizeof(double);
    DPL_TRY(dpl_buffer_reserve(context, &map->table_sums, 1, packed_bytes + entries * 4 * sizeof(uint32_t)));
    double(*packed)[4] = map->table_sums.data;
    map->table = (dpl_moment_table){total, 1, map->texels, (uint32_t(*)[4])(void *)(packed + total)};
    for (int32_t i = 0; i < total; i++) {
        double b[4];
        dpl_moments_of(dpl_polar_depth(map, (double)distances[i]), b);
        dpl_moments_pack(b, packed[i]);
    }
    dpl_moment_table_add_row(&map->table, 0, (const double(*)[4])packed);
    return DPL_OK;
}

static dpl_status fill_warps(dpl_polar_map *map, dpl_context *context) {
    int32_t total = 2 * map->texels;
    const float *distances = map->distances.data;
    DPL_TRY(dpl_buffer_reserve(context, &map->warped_sums, (size_t)total + 1, 4 * sizeof(double)));
    double(*sums)[4] = map->warped_sums.data;
    memset(sums[0], 0, sizeof sums[0]);
    for (int32_t i = 0; i < total; i++) {
        double warped[4];
        dpl_moments_warp(dpl_polar_depth(map, (double)distances[i]), DPL_POLAR_SHARPNESS, warped);
        for (int k = 0; k < 4; k++)
            sums[i + 1][k] = sums[i][k] + warped[k];
    }
    return DPL_OK;
}

dpl_status dpl_polar_map_make(dpl_polar_map *map, dpl_context *context, const dpl_solid *solid,
                              const double position[2], int32_t texels, bool with_warps) {
    size_t total = 2 * (size_t)texels;
    double x = fmax(fabs(position[0]), fabs(position[0] - solid->width));
    double y = fmax(fabs(position[1]), fabs(position[1] - solid->height));
    DPL_TRY(dpl_buffer_reserve(context, &map->distances, total, sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(context, &map->nearest, total * (size_t)levels_of(texels), sizeof(float)));
    map->texels = texels;
    map->reach = sqrt(x * x + y * y) + 1.0;
    tracing t = {map, solid, position};
    DPL_TRY(dpl_jobs_run(context, trace, texels, 64, &t));
    fill_nearest(map);
    DPL_TRY(fill_moments(map, context));
    return with_warps ? fill_warps(map, context) : DPL_OK;
}

void dpl_polar_map_free(dpl_context *context, dpl_polar_map *map) {
    dpl_buffer_free(context, &map->distances);
    dpl_buffer_free(context, &map->nearest);
    dpl_buffer_free(context, &map->warped_sums);
    dpl_buffer_free(context, &map->table_sums);
}

/* ---- reading -------------------------------------------------------------------------------------- */

dpl_polar_window dpl_polar_window_around(const dpl_polar_map *map, double dx, double dy, double half) {
    double c = cos(half), s = sin(half), scale = 0.25 * map->texels;
    double from = scale * dpl_polar_from_direction(dx * c + dy * s, dy * c - dx * s);
    double to = scale * dpl_polar_from_direction(dx * c - dy * s, dy * c + dx * s);
    if (to < from)
        to += map->texels;
    if (to - from < 1.0) {
        double middle = 0.5 * (from + to);
        from = middle - 0.5;
        to = middle + 0.5;
    }
    if (from < 0.0) {
        from += map->texels;
        to += map->texels;
    }
    return (dpl_polar_window){fmin(from, map->texels * (1.0 - 1e-12)), fmin(to, 2.0 * map->texels)};
}

double dpl_polar_nearest(const dpl_polar_map *map, dpl_polar_window window) {
    int32_t first = (int32_t)window.from, last = (int32_t)ceil(window.to) - 1, level = 0;
    int32_t count = last - first + 1 < map->texels ? last - first + 1 : map->texels;
    while (2 << level <= count)
        level++;
    const float *least = (const float *)map->nearest.data + (size_t)level * 2 * (size_t)map->texels;
    return (double)fminf(least[first], least[first + count - (1 << level)]);
}

void dpl_polar_moments(const dpl_polar_map *map, dpl_polar_window window, double b[4]) {
    dpl_moment_table_row_mean(&map->table, window.from, window.to, b);
    dpl_moments_add_bias(b, DPL_MOMENTS_BIAS_SUMS, DPL_MOMENTS_TARGET_FLOAT);
}

void dpl_polar_warped(const dpl_polar_map *map, dpl_polar_window window, double warped[4]) {
    const double(*sums)[4] = map->warped_sums.data;
    double ends[2] = {window.from, window.to}, at[2][4];
    for (int e = 0; e < 2; e++) {
        int32_t i = (int32_t)ends[e] < 2 * map->texels - 1 ? (int32_t)ends[e] : 2 * map->texels - 1;
        for (int k = 0; k < 4; k++)
            at[e][k] = sums[i][k] + (ends[e] - i) * (sums[i + 1][k] - sums[i][k]);
    }
    for (int k = 0; k < 4; k++)
        warped[k] = (at[1][k] - at[0][k]) / (window.to - window.from);
}
