/* From depths to what shadows ask of a map: moments of any box, and nearest and farthest depth of any square.
 * Called by solid_shadow.c. */
#include "shadow/moments.h"
#include "shadow/solid_shadow.h"

#include <math.h>

/* ---- memory --------------------------------------------------------------------------------------- */

static int32_t level_size(int32_t size, int32_t level) {
    return (size + (1 << level) - 1) >> level;
}

static size_t count_ranges(int32_t size) {
    size_t count = 0;
    for (int32_t level = 0; level_size(size, level) > 1; level++)
        count += (size_t)level_size(size, level) * (size_t)level_size(size, level);
    return count + 1;
}

static dpl_status reserve(dpl_solid_shadow *shadow) {
    int32_t size = shadow->desc.map_resolution;
    size_t maps = (size_t)shadow->map_count, entries = dpl_moment_table_entries(size, size);
    dpl_context *context = shadow->context;
    DPL_TRY(dpl_buffer_reserve(context, &shadow->sums, maps * entries, 4 * sizeof(uint32_t)));
    DPL_TRY(dpl_buffer_reserve(context, &shadow->ranges, maps * count_ranges(size), sizeof(dpl_solid_range)));
    DPL_TRY(dpl_buffer_reserve(context, &shadow->rows, (size_t)size, 4 * sizeof(double)));
    return dpl_buffer_reserve(context, &shadow->corners, (size_t)shadow->mesh->facts.triangles,
                              dpl_solid_seen_bytes());
}

/* Gives a map its share of the memory. */
static void lay_out(dpl_solid_shadow *shadow, int32_t i) {
    dpl_solid_map *map = &shadow->maps[i];
    int32_t size = shadow->desc.map_resolution;
    dpl_solid_range *ranges = (dpl_solid_range *)shadow->ranges.data + (size_t)i * count_ranges(size);
    uint32_t(*sums)[4] = shadow->sums.data;
    map->size = size;
    map->table = (dpl_moment_table){.width = size,
                                    .height = size,
                                    .most_texels = (int64_t)(size / 8) * (size / 8),
                                    .sums = sums + (size_t)i * dpl_moment_table_entries(size, size)};
    for (map->levels = 0;; map->levels++) {
        int32_t side = level_size(size, map->levels);
        map->ranges[map->levels] = ranges;
        ranges += (size_t)side * (size_t)side;
        if (side == 1)
            break;
    }
    map->levels++;
}

/* ---- building ------------------------------------------------------------------------------------- */

static dpl_solid_range both(dpl_solid_range a, dpl_solid_range b) {
    return (dpl_solid_range){a.near < b.near ? a.near : b.near, a.far > b.far ? a.far : b.far};
}

static void build_level(const dpl_solid_map *map, int32_t level) {
    int32_t side = level_size(map->size, level), below = level_size(map->size, level - 1);
    const dpl_solid_range *from = map->ranges[level - 1];
    for (int32_t y = 0; y < side; y++)
        for (int32_t x = 0; x < side; x++) {
            int32_t x1 = 2 * x + 1 < below ? 2 * x + 1 : 2 * x, y1 = 2 * y + 1 < below ? 2 * y + 1 : 2 * y;
            const dpl_solid_range *upper = from + (size_t)(2 * y) * (size_t)below;
            const dpl_solid_range *lower = from + (size_t)y1 * (size_t)below;
            map->ranges[level][(size_t)y * (size_t)side + (size_t)x] =
                both(both(upper[2 * x], upper[x1]), both(lower[2 * x], lower[x1]));
        }
}

static void build_moments(dpl_solid_shadow *shadow, const dpl_solid_map *map) {
    double(*row)[4] = shadow->rows.data;
    double scale = 2.0 / ((double)map->frame.far - (double)map->frame.near);
    for (int32_t y = 0; y < map->size; y++) {
        const dpl_solid_range *depths = map->ranges[0] + (size_t)y * (size_t)map->size;
        for (int32_t x = 0; x < map->size; x++) {
            double b[4], depth = fmin((double)depths[x].near, (double)map->frame.far);
            dpl_moments_of((depth - (double)map->frame.near) * scale - 1.0, b);
            dpl_moments_pack(b, row[x]);
        }
        dpl_moment_table_add_row(&map->table, y, (const double(*)[4])row);
    }
}

/* The map as classification reads it. */
static void fill_view(const dpl_solid_shadow *shadow, dpl_solid_map *map) {
    const dpl_solid_frame *frame = &map->frame;
    bool spot = shadow->light.kind == DPL_SOLID_LIGHT_SPOT;
    map->view = (dpl_depth_view){.parallel = frame->parallel,
                                 .scale = frame->scale,
                                 .near = frame->near,
                                 .steepest = (frame->far - frame->near) / 8.0f,
                                 .cone_cosine = spot ? shadow->cone_cosine : -1.0f,
                                 .light = frame->parallel ? shadow->sun_spread : shadow->light.radius,
                                 .size = map->size,
                                 .ranges = &map->ranges[0]->near};
    memcpy(map->view.eye, frame->eye, sizeof frame->eye);
    memcpy(map->view.axis, frame->axis, sizeof frame->axis);
    for (int32_t level = 0; level < map->levels; level++) {
        map->view.first[level] = (int32_t)(map->ranges[level] - map->ranges[0]);
        map->view.side[level] = level_size(map->size, level);
    }
}

dpl_status dpl_solid_maps_build(dpl_solid_shadow *shadow) {
    dpl_solid_frame frames[DPL_SOLID_MAX_FRAMES];
    shadow->map_count =
        dpl_solid_frames(&shadow->light, &shadow->mesh->facts, shadow->desc.map_resolution, frames);
    DPL_TRY(reserve(shadow));
    for (int32_t i = 0; i < shadow->map_count; i++) {
        dpl_solid_map *map = &shadow->maps[i];
        lay_out(shadow, i);
        map->frame = frames[i];
        DPL_TRY(dpl_solid_rasterise(shadow, map));
        for (int32_t level = 1; level < map->levels; level++)
            build_level(map, level);
        /* Depths of moments are counted from what is really nearest. */
        float nearest = map->ranges[map->levels - 1]->near;
        if (nearest < map->frame.far)
            map->frame.near = nearest;
        build_moments(shadow, map);
        fill_view(shadow, map);
    }
    return DPL_OK;
}
