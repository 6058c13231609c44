/* Bits of opaque pixels, and rays through them, see solid.h. */
#include "shadow/solid.h"

#include "job/jobs.h"

#include <math.h>

/* ---- bits ----------------------------------------------------------------------------------------- */

typedef struct bit_task {
    dpl_solid *solid;
    const uint8_t *kind;
} bit_task;

static void fill_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const bit_task *t = task;
    int32_t words = t->solid->row_words, width = t->solid->width;
    for (int32_t y = begin; y < end; y++) {
        uint64_t *row = (uint64_t *)t->solid->rows.data + (size_t)y * (size_t)words;
        const uint8_t *kind = t->kind + (size_t)y * (size_t)width;
        memset(row, 0, (size_t)words * sizeof *row);
        for (int32_t x = 0; x < width; x++)
            row[x >> 6] |= (uint64_t)(kind[x] == DPL_PIXEL_OPAQUE) << (x & 63);
    }
}

/* 64 columns at a time, from the finished rows. */
static void fill_columns(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const bit_task *t = task;
    int32_t words = t->solid->column_words, width = t->solid->width;
    uint64_t *columns = t->solid->columns.data;
    const uint64_t *rows = t->solid->rows.data;
    for (int32_t block = begin; block < end; block++) {
        int32_t last = width - block * 64 < 64 ? width - block * 64 : 64;
        uint64_t *first = columns + (size_t)block * 64 * (size_t)words;
        memset(first, 0, (size_t)last * (size_t)words * sizeof *first);
        for (int32_t y = 0; y < t->solid->height; y++) {
            uint64_t bits = rows[(size_t)y * (size_t)t->solid->row_words + (size_t)block];
            for (int32_t x = 0; bits; x++, bits >>= 1)
                first[(size_t)x * (size_t)words + (size_t)(y >> 6)] |= (bits & 1) << (y & 63);
        }
    }
}

/* Is there a bit in each byte? One bit per byte, in order. */
static uint64_t bytes_in_use(uint64_t word) {
    uint64_t bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (uint64_t)((word >> 8 * i & 0xff) != 0) << i;
    return bits;
}

/* Blocks of 8 lines, 8 pixels of each, from `count` lines of `words` words. */
static void fill_blocks(const uint64_t *lines, int32_t count, int32_t words, uint64_t *blocks,
                        int32_t block_words) {
    memset(blocks, 0, (size_t)((count + 7) / 8) * (size_t)block_words * sizeof *blocks);
    for (int32_t i = 0; i < count; i++) {
        const uint64_t *line = lines + (size_t)i * (size_t)words;
        uint64_t *block = blocks + (size_t)(i / 8) * (size_t)block_words;
        for (int32_t k = 0; k < words; k++)
            block[k / 8] |= bytes_in_use(line[k]) << k % 8 * 8;
    }
}

static dpl_status fill_all_blocks(dpl_solid *solid, dpl_context *context) {
    size_t rows = ((size_t)solid->height + 7) / 8, columns = ((size_t)solid->width + 7) / 8;
    solid->block_row_words = solid->row_words / 8 + 2;
    solid->block_column_words = solid->column_words / 8 + 2;
    DPL_TRY(dpl_buffer_reserve(context, &solid->block_rows, rows * (size_t)solid->block_row_words,
                               sizeof(uint64_t)));
    DPL_TRY(dpl_buffer_reserve(context, &solid->block_columns, columns * (size_t)solid->block_column_words,
                               sizeof(uint64_t)));
    fill_blocks(solid->rows.data, solid->height, solid->row_words, solid->block_rows.data,
                solid->block_row_words);
    fill_blocks(solid->columns.data, solid->width, solid->column_words, solid->block_columns.data,
                solid->block_column_words);
    return DPL_OK;
}

dpl_status dpl_solid_fill_bits(dpl_solid *solid, const dpl_field *field) {
    dpl_context *context = field->context;
    size_t row_words = (size_t)field->width / 64 + 2, column_words = (size_t)field->height / 64 + 2;
    DPL_TRY(dpl_buffer_reserve(context, &solid->rows, (size_t)field->height * row_words, sizeof(uint64_t)));
    DPL_TRY(
        dpl_buffer_reserve(context, &solid->columns, (size_t)field->width * column_words, sizeof(uint64_t)));
    solid->width = field->width;
    solid->height = field->height;
    solid->row_words = (int32_t)row_words;
    solid->column_words = (int32_t)column_words;
    bit_task task = {solid, field->kind.data};
    DPL_TRY(dpl_jobs_run(context, fill_rows, field->height, 32, &task));
    DPL_TRY(dpl_jobs_run(context, fill_columns, (field->width + 63) / 64, 1, &task));
    return fill_all_blocks(solid, context);
}

/* ---- up to date ----------------------------------------------------------------------------------- */

dpl_status dpl_solid_update(dpl_solid *solid, const dpl_field *field, bool inside) {
    if (solid->revision == field->revision && (solid->has_inside || !inside))
        return DPL_OK;
    solid->revision = 0;
    DPL_TRY(dpl_solid_fill_bits(solid, field));
    DPL_TRY(dpl_solid_measure(solid, field, inside));
    solid->has_inside = inside;
    solid->revision = field->revision;
    return DPL_OK;
}

void dpl_solid_free(dpl_context *context, dpl_solid *solid) {
    dpl_buffer_free(context, &solid->rows);
    dpl_buffer_free(context, &solid->columns);
    dpl_buffer_free(context, &solid->block_rows);
    dpl_buffer_free(context, &solid->block_columns);
    dpl_buffer_free(context, &solid->distance);
    dpl_buffer_free(context, &solid->scratch);
}

/* ---- sides towards a light ------------------------------------------------------------------------- */

uint64_t dpl_solid_exposed(const dpl_solid *solid, int32_t y, int32_t word, const double position[2],
                           double radius) {
    const uint64_t *row = (const uint64_t *)solid->rows.data + (size_t)y * (size_t)solid->row_words + word;
    uint64_t own = row[0], exposed = 0;
    double left = word * 64.0;
    if (!own)
        return 0;
    if (position[1] - radius < y)
        exposed |= y > 0 ? ~row[-solid->row_words] : ~(uint64_t)0;
    if (position[1] + radius > y + 1)
        exposed |= y + 1 < solid->height ? ~row[solid->row_words] : ~(uint64_t)0;
    if (position[0] - radius < left + 64.0)
        exposed |= ~(own << 1 | (word > 0 ? row[-1] >> 63 : 0));
    if (position[0] + radius > left)
        exposed |= ~(own >> 1 | row[1] << 63);
    return own & exposed;
}

/* ---- rays ----------------------------------------------------------------------------------------- */

/* A distance from here on is worth a jump, and how far a point may be from its pixel's centre. */
#define JUMP_FROM 2.0
#define HALF_DIAGONAL 0.7072

static double enter_axis(double start, double direction, double size) {
    if (start < 0.0)
        return direction > 0.0 ? -start / direction : INFINITY;
    if (start > size)
        return direction < 0.0 ? (size - start) / direction : INFINITY;
    return 0.0;
}

static int32_t clamp_pixel(double v, int32_t size) {
    double pixel = floor(v);
    return pixel < 0.0 ? 0 : pixel > size - 1 ? size - 1 : (int32_t)pixel;
}

/* Along one axis: the distance to the edge by which pixel `p` is left. */
static double leave_axis(double start, double direction, int32_t p) {
    if (direction == 0.0)
        return INFINITY;
    return ((direction > 0.0 ? p + 1 : p) - start) / direction;
}

double dpl_solid_first_hit(const dpl_solid *solid, double x, double y, double dx, double dy, double limit) {
    const float *distance = solid->distance.data;
    double t = fmax(enter_axis(x, dx, solid->width), enter_axis(y, dy, solid->height));
    if (!(t < limit))
        return INFINITY;
    int32_t px = clamp_pixel(x + t * dx, solid->width), py = clamp_pixel(y + t * dy, solid->height);
    if (t > 0.0 && (fabs(x + t * dx - px - 0.5) > 1.0 || fabs(y + t * dy - py - 0.5) > 1.0))
        return INFINITY; /* passes by a corner of the picture */
    while (px >= 0 && py >= 0 && px < solid->width && py < solid->height && t < limit) {
        double clear = (double)distance[(size_t)py * (size_t)solid->width + (size_t)px];
        if (clear <= 0.0)
            return t;
        if (clear >= JUMP_FROM) {
            t += clear - HALF_DIAGONAL;
            px = (int32_t)floor(x + t * dx);
            py = (int32_t)floor(y + t * dy);
            continue;
        }
        double by_x = leave_axis(x, dx, px), by_y = leave_axis(y, dy, py);
        t = fmax(t, fmin(by_x, by_y));
        if (by_x < by_y)
            px += dx > 0.0 ? 1 : -1;
        else
            py += dy > 0.0 ? 1 : -1;
    }
    return INFINITY;
}
