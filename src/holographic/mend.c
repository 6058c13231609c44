/* Pixels beside thin walls, where interpolating between blocks would bring both sides of the wall together:
 * their light is that of the blocks that they reach through free pixels. They are few. Called by refine.c. */
#include "holographic/resolution.h"

const int32_t dpl_hrc_around[DPL_AROUND][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                               {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

/* How far it is from a pixel to the centre of the next block to a side, through free pixels; 0 where there is
 * no way or no light [px]. */
static float way_out(const dpl_hrc_resampling *task, int32_t x, int32_t y, const int32_t side[2]) {
    const dpl_hrc_resolution *r = task->resolution;
    const dpl_field *field = task->field;
    if (!dpl_hrc_is_free(r, x / r->scale + side[0], y / r->scale + side[1]))
        return 0.0f;
    int32_t along = side[0] ? x % r->scale : y % r->scale;
    int32_t left = side[0] + side[1] > 0 ? r->scale - 1 - along : along; /* pixels of its own block */
    for (int32_t step = 1; step <= left + r->scale / 2; step++) {
        int32_t u = x + step * side[0], v = y + step * side[1];
        if (u < field->width && v < field->height && dpl_field_is_opaque(field, u, v))
            return 0.0f;
    }
    return (float)left + 0.5f * (float)(r->scale + 1);
}

static bool has_way_out(const dpl_hrc_resampling *task, int32_t x, int32_t y) {
    for (int32_t i = 0; i < DPL_AROUND; i += 2)
        if (way_out(task, x, y, dpl_hrc_around[i]) > 0.0f)
            return true;
    return false;
}

bool dpl_hrc_is_open(const dpl_hrc_resampling *task, int32_t block_x, int32_t block_y) {
    int32_t scale = task->resolution->scale;
    for (int32_t y = block_y * scale; y < (block_y + 1) * scale && y < task->field->height; y++)
        for (int32_t x = block_x * scale; x < (block_x + 1) * scale && x < task->field->width; x++)
            if (!dpl_field_is_opaque(task->field, x, y) && !has_way_out(task, x, y))
                return false;
    return true;
}

/* A search through free pixels, nearest first. */
enum { MOST_PIXELS = 64 };

typedef struct search {
    int32_t count;
    int32_t pixels[MOST_PIXELS][2];
    float walls[3]; /* emission of the opaque pixels that it has run into */
    float wall_count;
} search;

static void visit(const dpl_field *field, search *s, int32_t x, int32_t y) {
    if (x < 0 || y < 0 || x >= field->width || y >= field->height || s->count == MOST_PIXELS)
        return;
    if (dpl_field_is_opaque(field, x, y)) {
        s->wall_count += 1.0f;
        for (int c = 0; c < 3; c++)
            s->walls[c] += ((const float(*)[4])field->emission.data)[dpl_field_cell(field, x, y)][c];
        return;
    }
    for (int32_t i = 0; i < s->count; i++)
        if (s->pixels[i][0] == x && s->pixels[i][1] == y)
            return;
    s->pixels[s->count][0] = x;
    s->pixels[s->count++][1] = y;
}

/* A free pixel from which no way leads straight to light: that of the nearest free block round corners; where
 * there is none, what the walls around show. */
static void mend_in_nook(const dpl_hrc_resampling *task, int32_t x, int32_t y, float *const out[]) {
    const dpl_hrc_resolution *r = task->resolution;
    search s = {.count = 1, .pixels = {{x, y}}};
    for (int32_t at = 0; at < s.count; at++) {
        int32_t u = s.pixels[at][0], v = s.pixels[at][1];
        if (dpl_hrc_is_free(r, u / r->scale, v / r->scale)) {
            for (int32_t plane = 0; plane < 3 * r->target_count; plane++)
                out[plane][x] = dpl_hrc_plane_row(r, plane, v / r->scale)[u / r->scale];
            return;
        }
        for (int32_t i = 0; i < DPL_AROUND; i += 2)
            visit(task->field, &s, u + dpl_hrc_around[i][0], v + dpl_hrc_around[i][1]);
    }
    for (int32_t plane = 0; plane < 3 * r->target_count; plane++)
        out[plane][x] = plane < 3 && s.wall_count > 0.0f ? s.walls[plane] / s.wall_count : 0.0f;
}

/* A free pixel of a thin wall's block. */
static void mend_beside_wall(const dpl_hrc_resampling *task, int32_t x, int32_t y, float *const out[]) {
    const dpl_hrc_resolution *r = task->resolution;
    float weights[DPL_AROUND], sum = 0.0f;
    for (int32_t i = 0; i < DPL_AROUND; i += 2) {
        float way = way_out(task, x, y, dpl_hrc_around[i]);
        weights[i] = way > 0.0f ? 1.0f / way : 0.0f;
        sum += weights[i];
    }
    if (sum <= 0.0f) {
        mend_in_nook(task, x, y, out);
        return;
    }
    for (int32_t plane = 0; plane < 3 * r->target_count; plane++) {
        float light = 0.0f;
        for (int32_t i = 0; i < DPL_AROUND; i += 2)
            if (weights[i] > 0.0f)
                light +=
                    weights[i] *
                    dpl_hrc_plane_row(
                        r, plane, y / r->scale + dpl_hrc_around[i][1])[x / r->scale + dpl_hrc_around[i][0]];
        out[plane][x] = light / sum;
    }
}

/* A pixel of a free block, in a corner. */
static void mend_corner(const dpl_hrc_resolution *r, uint8_t mend, int32_t x, int32_t y, float *const out[]) {
    int32_t half = r->scale / 2, right = x % r->scale >= half ? 1 : -1, down = y % r->scale >= half ? 1 : -1;
    for (int32_t i = 1; i < DPL_AROUND; i += 2)
        if (mend >> i & 1 && dpl_hrc_around[i][0] == right && dpl_hrc_around[i][1] == down)
            for (int32_t plane = 0; plane < 3 * r->target_count; plane++)
                out[plane][x] = dpl_hrc_plane_row(r, plane, y / r->scale)[x / r->scale];
}

void dpl_hrc_mend_row(const dpl_hrc_resampling *task, int32_t y, float *const out[]) {
    const dpl_hrc_resolution *r = task->resolution;
    const uint8_t *mends =
        (const uint8_t *)r->memory[DPL_MEMORY_MENDS].data + dpl_field_cell(&r->field, 0, y / r->scale);
    for (int32_t block = 0; block < r->field.width; block++) {
        if (!mends[block])
            continue;
        for (int32_t x = block * r->scale; x < (block + 1) * r->scale && x < task->field->width; x++)
            if (mends[block] != DPL_MEND_SHUT)
                mend_corner(r, mends[block], x, y, out);
            else if (!dpl_field_is_opaque(task->field, x, y))
                mend_beside_wall(task, x, y, out);
    }
}
