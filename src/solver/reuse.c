/* Compares a field with the one of the last frame, row by row, and notes where they differ. Called by
 * src/api/solver.c, and by methods that solve parts of the world. */
#include "solver/reuse.h"

/* ---- planes --------------------------------------------------------------------------------------- */

static const size_t pixel_bytes[DPL_KEPT_PLANES] = {
    [DPL_KEPT_KIND] = 1,
    [DPL_KEPT_EMISSION] = 4 * sizeof(float),
    [DPL_KEPT_EXTINCTION] = 4 * sizeof(float),
    [DPL_KEPT_ALBEDO] = 4 * sizeof(float),
    [DPL_KEPT_SURFACE] = 4 * sizeof(float),
    [DPL_KEPT_CLEARANCE] = sizeof(float),
};

static const char *plane_of(const dpl_field *field, dpl_kept_plane plane) {
    const dpl_buffer *const buffers[DPL_KEPT_PLANES] = {
        [DPL_KEPT_KIND] = &field->kind,
        [DPL_KEPT_EMISSION] = &field->emission,
        [DPL_KEPT_EXTINCTION] = &field->extinction,
        [DPL_KEPT_ALBEDO] = &field->albedo,
        [DPL_KEPT_SURFACE] = &field->surface,
        [DPL_KEPT_CLEARANCE] = &field->clearance,
    };
    return buffers[plane]->data;
}

static int32_t tiles_along(int32_t pixels) {
    return (pixels + DPL_REUSE_TILE - 1) / DPL_REUSE_TILE;
}

/* Marks the tiles in which two rows differ. */
static void mark_row(uint8_t *tiles, const char *kept, const char *row, size_t bytes, size_t tile_bytes) {
    for (size_t at = 0; at < bytes; at += tile_bytes, tiles++) {
        size_t count = bytes - at < tile_bytes ? bytes - at : tile_bytes;
        *tiles |= memcmp(kept + at, row + at, count) != 0;
    }
}

/* Brings the copy of a plane up to date and marks where it was not. Returns whether it was. */
static bool keep_rows(dpl_reuse *reuse, const dpl_field *field, dpl_kept_plane plane) {
    size_t bytes = (size_t)field->width * pixel_bytes[plane], tiles_x = (size_t)tiles_along(field->width);
    const char *row = plane_of(field, plane);
    char *kept = reuse->planes[plane].data;
    bool same = true;
    for (int32_t y = 0; y < field->height; y++, row += bytes, kept += bytes) {
        if (memcmp(kept, row, bytes) == 0)
            continue;
        uint8_t *tiles = (uint8_t *)reuse->tiles.data + (size_t)(y / DPL_REUSE_TILE) * tiles_x;
        mark_row(tiles, kept, row, bytes, DPL_REUSE_TILE * pixel_bytes[plane]);
        memcpy(kept, row, bytes);
        same = false;
    }
    return same;
}

/* The same, whatever was kept before: a plane that has come or gone makes all of it new. */
static dpl_status keep_plane(dpl_reuse *reuse, const dpl_field *field, dpl_kept_plane plane, bool *same) {
    const char *data = plane_of(field, plane);
    bool was_there = reuse->there[plane];
    reuse->there[plane] = data != NULL;
    if (was_there && data && reuse->partial) {
        *same &= keep_rows(reuse, field, plane);
        return DPL_OK;
    }
    if (was_there || data)
        *same = reuse->partial = false;
    if (!data)
        return DPL_OK;
    size_t pixels = dpl_field_pixels(field);
    DPL_TRY(dpl_buffer_reserve(field->context, &reuse->planes[plane], pixels, pixel_bytes[plane]));
    memcpy(reuse->planes[plane].data, data, pixels * pixel_bytes[plane]);
    return DPL_OK;
}

static dpl_status keep_sky(dpl_reuse *reuse, const dpl_field *field, bool *same) {
    size_t bytes = (size_t)field->sky_count * sizeof(float[3]);
    if (reuse->sky_count == field->sky_count && memcmp(reuse->sky.data, field->sky.data, bytes) == 0)
        return DPL_OK;
    *same = reuse->partial = false;
    reuse->sky_count = 0;
    DPL_TRY(dpl_buffer_reserve(field->context, &reuse->sky, bytes, 1));
    memcpy(reuse->sky.data, field->sky.data, bytes);
    reuse->sky_count = field->sky_count;
    return DPL_OK;
}

/* ---- the frame ------------------------------------------------------------------------------------ */

/* Room for pictures and tiles of this field; a size that is new makes all of it new. */
static dpl_status fit(dpl_reuse *reuse, const dpl_field *field, bool directional) {
    size_t tiles = (size_t)tiles_along(field->width) * (size_t)tiles_along(field->height);
    size_t pixels = (size_t)dpl_field_picture_width(field) * (size_t)dpl_field_picture_height(field);
    reuse->partial &=
        reuse->width == field->width && reuse->height == field->height && reuse->margin == field->margin;
    for (int i = 0; i < (directional ? DPL_REUSE_PICTURES : 1); i++)
        DPL_TRY(dpl_buffer_reserve(field->context, &reuse->pictures[i], pixels, sizeof(float[3])));
    DPL_TRY(dpl_buffer_reserve(field->context, &reuse->tiles, tiles, 1));
    memset(reuse->tiles.data, 0, tiles);
    reuse->width = field->width;
    reuse->height = field->height;
    reuse->margin = field->margin;
    return DPL_OK;
}

dpl_status dpl_reuse_look(dpl_reuse *reuse, const dpl_field *field, bool bounces, bool directional,
                          bool *same) {
    bool unchanged = reuse->solved && (reuse->directional || !directional);
    reuse->partial = reuse->solved;
    reuse->solved = false;
    *same = false;
    DPL_TRY(fit(reuse, field, directional));
    unchanged &= reuse->partial;
    DPL_TRY(keep_sky(reuse, field, &unchanged));
    if (!reuse->partial || reuse->revision != field->revision)
        for (int plane = 0; plane < DPL_KEPT_CLEARANCE; plane++)
            if (plane != DPL_KEPT_ALBEDO || bounces)
                DPL_TRY(keep_plane(reuse, field, (dpl_kept_plane)plane, &unchanged));
    reuse->revision = field->revision;
    reuse->directional = unchanged ? reuse->directional : directional;
    *same = reuse->solved = unchanged;
    return DPL_OK;
}

void dpl_reuse_finish(dpl_reuse *reuse) {
    reuse->solved = true;
}

void dpl_reuse_forget(dpl_reuse *reuse) {
    reuse->solved = false;
}

/* ---- boxes ---------------------------------------------------------------------------------------- */

static int32_t least(int32_t a, int32_t b) {
    return a < b ? a : b;
}

static int32_t most(int32_t a, int32_t b) {
    return a > b ? a : b;
}

static int64_t area_of(const dpl_reuse_box *box) {
    return (int64_t)(box->x1 - box->x0) * (box->y1 - box->y0);
}

static dpl_reuse_box join(const dpl_reuse_box *a, const dpl_reuse_box *b) {
    return (dpl_reuse_box){least(a->x0, b->x0), least(a->y0, b->y0), most(a->x1, b->x1), most(a->y1, b->y1)};
}

/* How much is in the join of two boxes that is in neither. */
static int64_t waste_of(const dpl_reuse_box *a, const dpl_reuse_box *b) {
    dpl_reuse_box both = join(a, b);
    return area_of(&both) - area_of(a) - area_of(b);
}

/* Adds a box to the list. Boxes that fill their join go together; where the list is full, the new one goes
 * together with the one where that adds least. */
static void add_box(dpl_reuse *reuse, dpl_reuse_box box) {
    for (;;) {
        int32_t best = -1;
        for (int32_t i = 0; i < reuse->box_count; i++)
            if (best < 0 || waste_of(&reuse->boxes[i], &box) < waste_of(&reuse->boxes[best], &box))
                best = i;
        bool full = reuse->box_count == DPL_REUSE_BOXES;
        if (best < 0 || (!full && waste_of(&reuse->boxes[best], &box) > 0))
            break;
        /* The join is larger: it may go together with others now. */
        box = join(&reuse->boxes[best], &box);
        reuse->boxes[best] = reuse->boxes[--reuse->box_count];
    }
    reuse->boxes[reuse->box_count++] = box;
}

bool dpl_reuse_touches(const dpl_reuse *reuse, dpl_reuse_box box) {
    int32_t columns = tiles_along(reuse->width);
    const uint8_t *tiles = reuse->tiles.data;
    for (int32_t y = most(box.y0, 0) / DPL_REUSE_TILE; y < tiles_along(least(box.y1, reuse->height)); y++)
        for (int32_t x = most(box.x0, 0) / DPL_REUSE_TILE; x < tiles_along(least(box.x1, reuse->width)); x++)
            if (tiles[(size_t)y * (size_t)columns + (size_t)x])
                return true;
    return false;
}

/* Runs of marked tiles become boxes. */
static void gather_boxes(dpl_reuse *reuse) {
    int32_t columns = tiles_along(reuse->width), rows = tiles_along(reuse->height);
    const uint8_t *tiles = reuse->tiles.data;
    reuse->box_count = 0;
    for (int32_t y = 0; y < rows; y++, tiles += columns)
        for (int32_t x = 0; x < columns; x++) {
            int32_t first = x;
            while (x < columns && tiles[x])
                x++;
            if (x > first)
                add_box(reuse, (dpl_reuse_box){first * DPL_REUSE_TILE, y * DPL_REUSE_TILE,
                                               least(x * DPL_REUSE_TILE, reuse->width),
                                               least((y + 1) * DPL_REUSE_TILE, reuse->height)});
        }
}

/* Where more than this part of the world has changed, a frame is solved as fast from scratch: some rays come
 * near most of it. */
#define MOST_CHANGED 0.25

static bool is_worthwhile(const dpl_reuse *reuse) {
    double changed = 0.0;
    for (int32_t i = 0; i < reuse->box_count; i++)
        changed += (double)area_of(&reuse->boxes[i]);
    return changed <= MOST_CHANGED * reuse->width * reuse->height;
}

dpl_status dpl_reuse_find_boxes(dpl_reuse *reuse, const dpl_field *field) {
    bool same = true;
    DPL_TRY(keep_plane(reuse, field, DPL_KEPT_CLEARANCE, &same));
    gather_boxes(reuse);
    reuse->partial &= is_worthwhile(reuse);
    return DPL_OK;
}

/* ---- memory --------------------------------------------------------------------------------------- */

size_t dpl_reuse_bytes(const dpl_reuse *reuse) {
    size_t bytes = reuse->sky.bytes + reuse->tiles.bytes;
    for (int i = 0; i < DPL_KEPT_PLANES; i++)
        bytes += reuse->planes[i].bytes;
    for (int i = 0; i < DPL_REUSE_PICTURES; i++)
        bytes += reuse->pictures[i].bytes;
    return bytes;
}

void dpl_reuse_free(dpl_reuse *reuse, dpl_context *context) {
    dpl_buffer_free(context, &reuse->sky);
    dpl_buffer_free(context, &reuse->tiles);
    for (int i = 0; i < DPL_KEPT_PLANES; i++)
        dpl_buffer_free(context, &reuse->planes[i]);
    for (int i = 0; i < DPL_REUSE_PICTURES; i++)
        dpl_buffer_free(context, &reuse->pictures[i]);
}
