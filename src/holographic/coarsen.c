/* The world as blocks of 2x2 or 4x4 pixels. A block is opaque, a medium or empty, never half of a wall: a
 * medium that stands for half a wall leaks, and media are dear. Called by resolution.c.
 *
 * Of a block of which some pixels are opaque:
 *   solid       11 of 16 are: opaque, with their mean emission; a rim of lamps and walls that are larger
 *               than blocks is thereby as often outside as inside
 *   thin        no row (or no column) lets a ray through, and the block is not the rim of a solid one that
 *               stands behind; or no neighbour is solid at all: opaque, or light would leak; it emits as
 *               much as rays through its rows and columns see on average, or a lamp of 2x2 pixels would
 *               shine as one of the block's size
 *   otherwise   the rim of something larger: what is left of it */
#include "holographic/resolution.h"

#include "kernel/exponential.h"

#include <float.h>

enum { MOST = 4 }; /* pixels along a side of a block */

/* The pixels of one block, as their cells in the field. At the right and lower edge of the world the last
 * pixels are repeated until the block is full. */
typedef struct pixels {
    const dpl_field *field;
    int32_t scale;
    size_t cell[MOST][MOST];
} pixels;

static int32_t within(int32_t index, int32_t size) {
    return index < size ? index : size - 1;
}

static pixels pixels_of(const dpl_hrc_resampling *task, int32_t x, int32_t y) {
    const dpl_field *field = task->field;
    pixels p = {.field = field, .scale = task->resolution->scale};
    for (int32_t j = 0; j < p.scale; j++)
        for (int32_t i = 0; i < p.scale; i++)
            p.cell[j][i] = dpl_field_cell(field, within(x * p.scale + i, field->width),
                                          within(y * p.scale + j, field->height));
    return p;
}

/* ---- survey --------------------------------------------------------------------------------------- */

static uint8_t survey(const pixels *p) {
    const uint8_t *kind = p->field->kind.data;
    int32_t opaque = 0, stopped_rows = 0, all = p->scale * p->scale;
    uint32_t stopped_columns = 0, media = 0;
    for (int32_t j = 0; j < p->scale; j++) {
        uint32_t stops = 0;
        for (int32_t i = 0; i < p->scale; i++) {
            uint8_t is = kind[p->cell[j][i]];
            opaque += is == DPL_PIXEL_OPAQUE;
            stops |= (uint32_t)(is == DPL_PIXEL_OPAQUE) << i;
            media |= is == DPL_PIXEL_MEDIUM;
        }
        stopped_rows += stops != 0;
        stopped_columns |= stops;
    }
    uint32_t block = opaque > 0 ? DPL_BLOCK_OPAQUE : 0;
    block |= 16 * opaque >= 11 * all ? DPL_BLOCK_SOLID : 0;
    block |= stopped_rows == p->scale ? DPL_BLOCK_STOPS_X : 0;
    block |= stopped_columns == (1u << p->scale) - 1 ? DPL_BLOCK_STOPS_Y : 0;
    block |= opaque < all ? DPL_BLOCK_FREE : 0;
    block |= media ? DPL_BLOCK_MEDIUM : 0;
    return (uint8_t)block;
}

/* Which blocks of a row have pixels that are not empty. Most have none. */
static void mark_occupied(const dpl_hrc_resampling *task, int32_t y, uint8_t *blocks) {
    const dpl_field *field = task->field;
    int32_t scale = task->resolution->scale, width = task->resolution->field.width;
    memset(blocks, 0, (size_t)width);
    for (int32_t j = y * scale; j < (y + 1) * scale && j < field->height; j++) {
        const uint8_t *kind = (const uint8_t *)field->kind.data + dpl_field_cell(field, 0, j);
        int32_t whole = field->width / scale;
        if (scale == 2)
            for (int32_t x = 0; x < whole; x++)
                blocks[x] |= kind[2 * x] | kind[2 * x + 1];
        else
            for (int32_t x = 0; x < whole; x++)
                blocks[x] |= kind[4 * x] | kind[4 * x + 1] | kind[4 * x + 2] | kind[4 * x + 3];
        for (int32_t x = whole * scale; x < field->width; x++)
            blocks[whole] |= kind[x];
    }
}

void dpl_hrc_survey_task(int32_t begin, int32_t end, int32_t worker, void *resampling) {
    const dpl_hrc_resampling *task = resampling;
    dpl_hrc_resolution *r = task->resolution;
    (void)worker;
    for (int32_t y = begin; y < end; y++) {
        uint8_t *blocks = (uint8_t *)r->memory[DPL_MEMORY_BLOCKS].data + dpl_field_cell(&r->field, 0, y);
        mark_occupied(task, y, blocks);
        for (int32_t x = 0; x < r->field.width; x++) {
            if (blocks[x]) {
                pixels p = pixels_of(task, x, y);
                blocks[x] = survey(&p);
            } else
                blocks[x] = DPL_BLOCK_FREE;
        }
    }
}

/* ---- opaque blocks -------------------------------------------------------------------------------- */

/* The mean of a plane over the block's opaque pixels. */
static void mean_of_opaque(const pixels *p, const dpl_buffer *plane, float mean[4]) {
    const uint8_t *kind = p->field->kind.data;
    const float(*values)[4] = (const float(*)[4])plane->data;
    float count = 0.0f;
    memset(mean, 0, 4 * sizeof *mean);
    for (int32_t j = 0; j < p->scale; j++)
        for (int32_t i = 0; i < p->scale; i++)
            if (kind[p->cell[j][i]] == DPL_PIXEL_OPAQUE) {
                count += 1.0f;
                for (int c = 0; c < 3; c++)
                    mean[c] += values[p->cell[j][i]][c];
            }
    for (int c = 0; c < 3; c++)
        mean[c] /= count;
}

/* Pixel k of line `line`, which runs along x for the first lines, then along y; from either end. */
static size_t on_line(const pixels *p, int32_t line, int32_t k, bool backwards) {
    int32_t at = backwards ? p->scale - 1 - k : k;
    return line < p->scale ? p->cell[line][at] : p->cell[at][line - p->scale];
}

/* What rays along the block's rows and columns see of its opaque pixels, on average. */
static void seen_of_opaque(const pixels *p, float mean[4]) {
    const uint8_t *kind = p->field->kind.data;
    const float(*emission)[4] = (const float(*)[4])p->field->emission.data;
    memset(mean, 0, 4 * sizeof *mean);
    for (int32_t line = 0; line < 2 * p->scale; line++)
        for (int backwards = 0; backwards < 2; backwards++) {
            int32_t k = 0;
            while (k < p->scale && kind[on_line(p, line, k, backwards)] != DPL_PIXEL_OPAQUE)
                k++;
            for (int c = 0; c < 3 && k < p->scale; c++)
                mean[c] += emission[on_line(p, line, k, backwards)][c];
        }
    for (int c = 0; c < 3; c++)
        mean[c] /= (float)(4 * p->scale);
}

static bool is_solid(const dpl_hrc_resolution *r, int32_t x, int32_t y) {
    const uint8_t *blocks = r->memory[DPL_MEMORY_BLOCKS].data;
    return x >= 0 && y >= 0 && x < r->field.width && y < r->field.height &&
           blocks[dpl_field_cell(&r->field, x, y)] & DPL_BLOCK_SOLID;
}

/* Of a block that is in part opaque, but not solid. */
static bool is_thin(const dpl_hrc_resolution *r, uint8_t block, int32_t x, int32_t y) {
    bool beside = is_solid(r, x - 1, y) || is_solid(r, x + 1, y);
    bool beyond = is_solid(r, x, y - 1) || is_solid(r, x, y + 1);
    return (!beside && !beyond) || (block & DPL_BLOCK_STOPS_X && !beside) ||
           (block & DPL_BLOCK_STOPS_Y && !beyond);
}

/* ---- media ---------------------------------------------------------------------------------------- */

/* Light and transmittance of the block's rows and columns, on average, in one channel. Opaque pixels count as
 * empty. */
static void cross(const pixels *p, int channel, float *light, float *transmittance) {
    const uint8_t *kind = p->field->kind.data;
    const float(*emission)[4] = (const float(*)[4])p->field->emission.data;
    const float(*extinction)[4] = (const float(*)[4])p->field->extinction.data;
    *light = *transmittance = 0.0f;
    for (int32_t line = 0; line < 2 * p->scale; line++)
        for (int backwards = 0; backwards < 2; backwards++) {
            float passed = 1.0f;
            for (int32_t k = 0; k < p->scale; k++) {
                size_t cell = on_line(p, line, k, backwards);
                if (kind[cell] != DPL_PIXEL_MEDIUM)
                    continue;
                float through = dpl_exp_negative(extinction[cell][channel]);
                *light += passed * (emission[cell][channel] * (1.0f - through));
                passed *= through;
            }
            *transmittance += passed;
        }
    *light /= (float)(4 * p->scale);
    *transmittance /= (float)(4 * p->scale);
}

/* Is every pixel of the block the same medium? */
static bool is_uniform(const pixels *p) {
    const uint8_t *kind = p->field->kind.data;
    const float(*emission)[4] = (const float(*)[4])p->field->emission.data;
    const float(*extinction)[4] = (const float(*)[4])p->field->extinction.data;
    size_t first = p->cell[0][0];
    for (int32_t j = 0; j < p->scale; j++)
        for (int32_t i = 0; i < p->scale; i++)
            for (int c = 0; c < 3; c++) {
                size_t cell = p->cell[j][i];
                if (kind[cell] != DPL_PIXEL_MEDIUM || emission[cell][c] != emission[first][c] ||
                    extinction[cell][c] != extinction[first][c])
                    return false;
            }
    return true;
}

/* A medium through which as much passes, and which shines as much. */
static void make_medium(const pixels *p, float emission[4], float extinction[4]) {
    const float(*emissions)[4] = (const float(*)[4])p->field->emission.data;
    const float(*extinctions)[4] = (const float(*)[4])p->field->extinction.data;
    bool uniform = is_uniform(p);
    size_t first = p->cell[0][0];
    for (int c = 0; c < 3; c++) {
        float light, transmittance;
        if (uniform) {
            emission[c] = emissions[first][c];
            extinction[c] = fminf(extinctions[first][c] * (float)p->scale, DPL_EXTINCTION_MAX);
            continue;
        }
        cross(p, c, &light, &transmittance);
        extinction[c] = transmittance >= FLT_MIN ? -logf(fminf(transmittance, 1.0f)) : DPL_EXTINCTION_MAX;
        emission[c] = transmittance < 1.0f ? light / (1.0f - transmittance) : 0.0f;
    }
    emission[3] = extinction[3] = 0.0f;
}

/* ---- blocks --------------------------------------------------------------------------------------- */

/* Fills in a block that is not empty; its planes are clear. */
static void coarsen(const dpl_hrc_resampling *task, uint8_t block, int32_t x, int32_t y) {
    dpl_hrc_resolution *r = task->resolution;
    size_t cell = dpl_field_cell(&r->field, x, y);
    uint8_t *kind = (uint8_t *)r->field.kind.data + cell;
    float *emission = ((float(*)[4])r->field.emission.data)[cell];
    pixels p = pixels_of(task, x, y);
    bool solid = block & DPL_BLOCK_SOLID,
         thin = !solid && block & DPL_BLOCK_OPAQUE && is_thin(r, block, x, y);
    if (solid || thin) {
        *kind = DPL_PIXEL_OPAQUE;
        if (thin)
            seen_of_opaque(&p, emission);
        else
            mean_of_opaque(&p, &task->field->emission, emission);
        if (r->field.albedo.data)
            mean_of_opaque(&p, &task->field->albedo, ((float(*)[4])r->field.albedo.data)[cell]);
    } else if (block & DPL_BLOCK_MEDIUM) {
        *kind = DPL_PIXEL_MEDIUM;
        make_medium(&p, emission, ((float(*)[4])r->field.extinction.data)[cell]);
    }
}

static void clear_row(const dpl_field *field, int32_t y) {
    size_t row = dpl_field_cell(field, 0, y), width = (size_t)field->width;
    memset((uint8_t *)field->kind.data + row, DPL_PIXEL_EMPTY, width);
    memset((float(*)[4])field->emission.data + row, 0, width * sizeof(float[4]));
    if (field->albedo.data)
        memset((float(*)[4])field->albedo.data + row, 0, width * sizeof(float[4]));
}

void dpl_hrc_coarsen_task(int32_t begin, int32_t end, int32_t worker, void *resampling) {
    const dpl_hrc_resampling *task = resampling;
    const dpl_hrc_resolution *r = task->resolution;
    (void)worker;
    for (int32_t y = begin; y < end; y++) {
        const uint8_t *blocks =
            (const uint8_t *)r->memory[DPL_MEMORY_BLOCKS].data + dpl_field_cell(&r->field, 0, y);
        clear_row(&r->field, y);
        for (int32_t x = 0; x < r->field.width; x++)
            if (blocks[x] != DPL_BLOCK_FREE)
                coarsen(task, blocks[x], x, y);
    }
}
