/* Sizes and places of everything that the holographic solver holds, computed once per size. */
#include "holographic/holographic.h"

/* Hands out places one behind the other, each at the start of a cache line. */
typedef struct ground {
    size_t used;
    bool too_much;
} ground;

static size_t take(ground *g, size_t count, size_t bytes) {
    size_t at = g->used;
    if (bytes != 0 && count > (SIZE_MAX / 2 - at) / bytes)
        g->too_much = true;
    else
        g->used = (at + count * bytes + 63) / 64 * 64;
    return at;
}

static int32_t levels_for(int32_t width) {
    int32_t levels = 0;
    while (1 << levels < width)
        levels++;
    return levels;
}

static size_t mask_bytes(const dpl_hrc_axis *axis) {
    return (size_t)axis->shape.words * sizeof(uint64_t);
}

static size_t segment_bytes(const dpl_hrc_layout *layout, const dpl_hrc_axis *axis) {
    return mask_bytes(axis) + (size_t)layout->planes * (size_t)axis->shape.stride * layout->element;
}

static size_t radiance_bytes(const dpl_hrc_layout *layout, const dpl_hrc_axis *axis) {
    return 3 * (size_t)axis->shape.stride * layout->element;
}

static void size_axis(const dpl_hrc_layout *layout, dpl_hrc_axis *axis, int32_t width, int32_t length) {
    axis->width = width;
    axis->shape.length = length;
    axis->shape.stride = dpl_row_padded(length) + 2 * DPL_ROW_PAD;
    axis->shape.words = (dpl_row_padded(length) / DPL_ROW_BLOCK + 511) / 512 * 8;
    axis->levels = levels_for(width);
    axis->strip_level = DPL_HRC_STRIP_LEVEL;
    /* Two columns of each level below S, which have 2^S cones together, and two of level S. */
    if (((size_t)4 << axis->strip_level) * radiance_bytes(layout, axis) > layout->strip_bytes)
        axis->strip_level--;
    if (axis->levels < axis->strip_level)
        axis->strip_level = axis->levels;
}

static void place_world(dpl_hrc_layout *layout, dpl_hrc_axis *axis, ground *g) {
    size_t row = segment_bytes(layout, axis);
    for (size_t chord = 0; chord < DPL_CHORDS; chord++)
        axis->set[chord] = layout->media ? chord * row : 0;
    axis->column_bytes = layout->media ? DPL_CHORDS * row : row;
    axis->world = take(g, (size_t)axis->width, axis->column_bytes);
    axis->outside = take(g, 1, axis->column_bytes);
    axis->sums = take(g, (size_t)axis->width * dpl_hrc_sums_planes(layout),
                      (size_t)axis->shape.stride * sizeof(float));
    axis->faces_bytes = layout->faces ? DPL_FACES * radiance_bytes(layout, axis) : 0;
    axis->faces = take(g, (size_t)axis->width + 1, axis->faces_bytes);
    axis->ways = take(g, layout->keeps ? 2 * (size_t)axis->width * dpl_hrc_sums_planes(layout) : 0,
                      (size_t)axis->shape.stride * sizeof(float));
}

/* T and R of level S: for one quadrant at a time, or for both of the axis. */
static void place_strips(const dpl_hrc_layout *layout, dpl_hrc_axis *axis, ground *g) {
    size_t cones = (size_t)1 << axis->strip_level, columns = (size_t)dpl_hrc_columns(axis, axis->strip_level);
    size_t quadrants = layout->keeps ? 2 : 1;
    axis->segments = take(g, quadrants * (cones + 1) * columns, segment_bytes(layout, axis));
    axis->radiance = take(g, quadrants * cones * columns, radiance_bytes(layout, axis));
}

/* Kinds of radiance that a level keeps, where direction matters; see gather.c. */
static size_t groups_of(int32_t level) {
    return level == 0 ? 4 : level == 1 ? 3 : 1;
}

/* The scratch that a worker needs in a strip. */
static void place_strip(const dpl_hrc_layout *layout, dpl_hrc_axis *axis, ground *g) {
    size_t segment = segment_bytes(layout, axis), radiance = radiance_bytes(layout, axis);
    for (int32_t n = DPL_HRC_TRACED_LEVEL; n < axis->strip_level; n++)
        axis->strip[n] = take(g, (size_t)((1 << n) + 1) << (axis->strip_level - n), segment);
    for (int32_t n = 0; n == 0 || n < axis->strip_level; n++)
        for (int parity = 0; parity < 2; parity++)
            axis->column[n][parity] = take(g, groups_of(n) << n, radiance);
    axis->traced = take(g, DPL_HRC_TRACED_ROWS, segment);
    axis->beyond = take(g, 3, radiance);
}

/* Where wedges begin that are solved whole: their segments and their light must fit into a cache. */
static int32_t find_wedge_level(const dpl_hrc_layout *layout, const dpl_hrc_axis *axis) {
    int32_t level = axis->strip_level;
    for (; level < axis->levels - 1; level++) {
        size_t rows = 0, cones = 2 * (size_t)dpl_hrc_columns(axis, level);
        for (int32_t n = level + 1; n < axis->levels; n++)
            rows += (((size_t)1 << (n - level)) + 1) * (size_t)dpl_hrc_columns(axis, n);
        if (rows * segment_bytes(layout, axis) + cones * radiance_bytes(layout, axis) <= layout->wedge_bytes)
            break;
    }
    return level;
}

/* The scratch that a worker needs in a wedge. In one that is solved whole R is kept of two levels, odd and
 * even. */
static void place_wedge(const dpl_hrc_layout *layout, dpl_hrc_axis *axis, ground *g) {
    axis->wedge_level = find_wedge_level(layout, axis);
    size_t most[2] = {0, 0};
    for (int32_t n = axis->strip_level + 1; n < axis->levels; n++) {
        size_t rays = (size_t)dpl_hrc_wedge_rays(axis, n), columns = (size_t)dpl_hrc_columns(axis, n);
        size_t cones = (rays - 1) * columns;
        axis->wedge_segments[n] = take(g, rays * columns, segment_bytes(layout, axis));
        if (n <= axis->wedge_level)
            axis->wedge_radiance[n] = take(g, cones, radiance_bytes(layout, axis));
        else
            most[n & 1] = cones > most[n & 1] ? cones : most[n & 1];
    }
    const size_t two[2] = {take(g, most[0], radiance_bytes(layout, axis)),
                           take(g, most[1], radiance_bytes(layout, axis))};
    for (int32_t n = axis->wedge_level + 1; n < axis->levels; n++)
        axis->wedge_radiance[n] = two[n & 1];
}

/* What one quadrant at a time works in. The pads of T are written once: axes of different shapes must not
 * share memory. */
static void place_work(const dpl_hrc_layout *layout, dpl_hrc_axis *axis, ground *arena, ground *scratch) {
    place_strips(layout, axis, arena);
    place_strip(layout, axis, scratch);
    place_wedge(layout, axis, scratch);
    axis->band = take(scratch, DPL_HRC_BAND_PLANES, (size_t)axis->shape.stride * sizeof(float));
}

static void share_work(dpl_hrc_axis *axis, const dpl_hrc_axis *other) {
    dpl_hrc_axis own = *axis;
    *axis = *other;
    axis->world = own.world;
    axis->outside = own.outside;
    axis->sums = own.sums;
    axis->faces = own.faces;
    axis->ways = own.ways;
}

bool dpl_hrc_arrange(dpl_hrc_layout *layout, int32_t width, int32_t height) {
    layout->element = layout->half ? 2 : 4;
    layout->planes = layout->rgb ? 6 : 4;
    size_axis(layout, &layout->axes[0], width, height);
    size_axis(layout, &layout->axes[1], height, width);
    layout->streams = sizeof(float[3]) * (size_t)width > DPL_HRC_CACHED_BYTES / (size_t)height;
    layout->levels =
        layout->axes[0].levels > layout->axes[1].levels ? layout->axes[0].levels : layout->axes[1].levels;
    if (layout->levels < 2)
        layout->levels = 2; /* lenses are told of these */
    ground arena = {0}, scratch = {0};
    for (int a = 0; a < 2; a++)
        place_world(layout, &layout->axes[a], &arena);
    place_work(layout, &layout->axes[0], &arena, &scratch);
    if (width != height)
        place_work(layout, &layout->axes[1], &arena, &scratch);
    else
        share_work(&layout->axes[1], &layout->axes[0]);
    if (width == height && layout->keeps)
        place_strips(layout, &layout->axes[1], &arena);
    layout->occupied = take(&arena, (size_t)dpl_row_padded(height) / DPL_ROW_BLOCK, (size_t)width);
    layout->sets = take(&arena, dpl_hrc_set_bytes(layout), 1);
    layout->sights = take(&arena, dpl_hrc_sight_bytes(), 1);
    layout->weights = take(&arena, (size_t)2 << layout->levels, sizeof(float));
    layout->sky = take(&arena, (size_t)8 << layout->levels, sizeof(float[3]));
    layout->lenses = take(&arena, (size_t)4 * DPL_HRC_TABLES, sizeof(dpl_hrc_lens_table));
    layout->flags = take(&arena, layout->keeps ? dpl_hrc_flag_bytes(layout) : 0, 1);
    layout->scratch_bytes = scratch.used;
    layout->scratch = take(&arena, (size_t)layout->workers, scratch.used);
    layout->total = arena.used;
    return !arena.too_much && !scratch.too_much;
}

/* ---- handles -------------------------------------------------------------------------------------- */

dpl_hrc_quadrant dpl_hrc_quadrant_of(dpl_hrc *hrc, int32_t index) {
    const dpl_hrc_layout *l = &hrc->layout;
    const dpl_hrc_axis *axis = &l->axes[index / 2];
    bool mirrored = index % 2 == 1;
    char *arena = hrc->arena.data;
    size_t pad = DPL_ROW_PAD * l->element, head = mask_bytes(axis) + pad,
           last = mirrored ? (size_t)axis->width - 1 : 0;
    size_t sums_step = dpl_hrc_sums_planes(l) * (size_t)axis->shape.stride;
    const float *weights = (const float *)(const void *)(arena + l->weights);
    const float(*sky)[3] =
        (const float(*)[3])(const void *)(arena + l->sky) + ((size_t)index * 2 << l->levels);
    size_t segment = segment_bytes(l, axis), radiance = radiance_bytes(l, axis);
    size_t columns = (size_t)dpl_hrc_columns(axis, axis->strip_level), cones = (size_t)1 << axis->strip_level;
    size_t second = l->keeps && mirrored; /* of two places */
    size_t sums =
        l->keeps ? axis->ways + second * (size_t)axis->width * sums_step * sizeof(float) : axis->sums;
    return (dpl_hrc_quadrant){
        .hrc = hrc,
        .axis = axis,
        .mirrored = mirrored,
        .world = arena + axis->world + last * axis->column_bytes + head,
        .world_step = mirrored ? -(ptrdiff_t)axis->column_bytes : (ptrdiff_t)axis->column_bytes,
        .outside = arena + axis->outside + head,
        .sums = (float *)(void *)(arena + sums) + last * sums_step + DPL_ROW_PAD,
        .sums_step = mirrored ? -(ptrdiff_t)sums_step : (ptrdiff_t)sums_step,
        .faces = hrc->faces_lit ? arena + axis->faces + last * axis->faces_bytes + pad : NULL,
        .faces_step = mirrored ? -(ptrdiff_t)axis->faces_bytes : (ptrdiff_t)axis->faces_bytes,
        .lens = {weights, weights, sky},
        .tables =
            (const dpl_hrc_lens_table *)(const void *)(arena + l->lenses) + (size_t)index * DPL_HRC_TABLES,
        .segments = {arena + axis->segments + second * (cones + 1) * columns * segment + head,
                     columns * segment},
        .radiance = {arena + axis->radiance + second * cones * columns * radiance + pad, columns * radiance},
        .segment_bytes = segment,
        .radiance_bytes = radiance,
        .partial = hrc->partial,
        .flags = dpl_hrc_flags_of(hrc, index / 2),
    };
}

dpl_hrc_worker dpl_hrc_worker_of(const dpl_hrc_quadrant *quadrant, int32_t index) {
    const dpl_hrc_layout *l = &quadrant->hrc->layout;
    return (dpl_hrc_worker){.quadrant = quadrant,
                            .scratch = (char *)quadrant->hrc->arena.data + l->scratch +
                                       (size_t)index * l->scratch_bytes};
}

void dpl_hrc_worker_count(const dpl_hrc_worker *worker, int32_t index) {
    for (int32_t n = 0; n <= DPL_HRC_BETWEEN_LEVEL; n++)
        worker->quadrant->hrc->counters[n][index].rays += worker->traced[n];
}

static dpl_hrc_rows rows_at(const dpl_hrc_worker *worker, size_t offset, int32_t index, size_t bytes) {
    size_t pad = DPL_ROW_PAD * worker->quadrant->hrc->layout.element;
    return (dpl_hrc_rows){worker->scratch + offset + (size_t)index * bytes + pad, bytes};
}

dpl_hrc_rows dpl_hrc_segment_rows(const dpl_hrc_worker *worker, size_t offset, int32_t index) {
    return rows_at(worker, offset + mask_bytes(worker->quadrant->axis), index,
                   worker->quadrant->segment_bytes);
}

dpl_hrc_rows dpl_hrc_radiance_rows(const dpl_hrc_worker *worker, size_t offset, int32_t index) {
    return rows_at(worker, offset, index, worker->quadrant->radiance_bytes);
}
