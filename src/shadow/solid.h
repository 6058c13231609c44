/* The world as shadows see it: which pixels are opaque, as bits, and how far it is to the nearest opaque
 * pixel's square. Media are not solid. Made from a field, kept until the field is drawn into again; read by
 * every method of this room but the reference. */
#ifndef DPL_SHADOW_SOLID_H
#define DPL_SHADOW_SOLID_H

#include "field/field.h"

typedef struct dpl_solid {
    int32_t width; /* [px] */
    int32_t height;
    /* Bits of row y begin at word y * row_words, the leftmost pixel lowest; the same for columns. A line has
     * at least 64 zero bits behind its end. */
    int32_t row_words;
    int32_t column_words;
    dpl_buffer rows;    /* uint64_t */
    dpl_buffer columns; /* uint64_t */
    /* The same for blocks of 8 x 8 pixels: a bit is set where any of them is opaque. */
    int32_t block_row_words;
    int32_t block_column_words;
    dpl_buffer block_rows;
    dpl_buffer block_columns;
    /* float per pixel [px]: from its centre to the nearest opaque square; in opaque pixels minus the distance
     * to the nearest square that is not (outside the picture none is), or -1/2 when `has_inside` is false. */
    dpl_buffer distance;
    dpl_buffer scratch;
    uint64_t revision; /* of the field that this was made from; 0: of none */
    bool has_inside;
} dpl_solid;

/* Brings everything up to date with the field. `inside`: opaque pixels get their true distances too. */
DPL_MUST_CHECK dpl_status dpl_solid_update(dpl_solid *solid, const dpl_field *field, bool inside);

/* Fills in bits and blocks alone, for those that read no distances, whatever the revision. */
DPL_MUST_CHECK dpl_status dpl_solid_fill_bits(dpl_solid *solid, const dpl_field *field);

void dpl_solid_free(dpl_context *context, dpl_solid *solid);

/* solid_distance.c: fills `distance`. Bits are up to date. */
DPL_MUST_CHECK dpl_status dpl_solid_measure(dpl_solid *solid, const dpl_field *field, bool inside);

static inline bool dpl_solid_contains(const dpl_solid *solid, int32_t x, int32_t y) {
    const uint64_t *rows = solid->rows.data;
    size_t word = (size_t)y * (size_t)solid->row_words + (size_t)(x >> 6);
    return x >= 0 && y >= 0 && x < solid->width && y < solid->height && (rows[word] >> (x & 63) & 1);
}

/* 64 pixels of a line from pixel `first` (0 .. length) on, the first one lowest. */
static inline uint64_t dpl_solid_window(const uint64_t *line, int32_t first) {
    const uint64_t *word = line + (first >> 6);
    int shift = first & 63;
    return shift ? word[0] >> shift | word[1] << (64 - shift) : word[0];
}

/* Number of the lowest bit that is set; `bits` is not 0. By a product that moves a different pattern to the
 * top for each bit (Leiserson, Prokop and Randall 1998). */
static inline int32_t dpl_lowest_bit(uint64_t bits) {
    static const uint8_t number[64] = {
        0,  1,  2,  53, 3,  7,  54, 27, 4,  38, 41, 8,  34, 55, 48, 28, 62, 5,  39, 46, 44, 42,
        22, 9,  24, 35, 59, 56, 49, 18, 29, 11, 63, 52, 6,  26, 37, 40, 33, 47, 61, 45, 43, 21,
        23, 58, 17, 10, 51, 25, 36, 32, 60, 20, 57, 16, 50, 31, 19, 15, 30, 14, 13, 12,
    };
    return number[(bits & (~bits + 1)) * 0x022fdd63cc95386dULL >> 58];
}

/* Opaque pixels of a word of row y that have a free side towards some point of a disc: a ray from it meets
 * one of them before any other. */
uint64_t dpl_solid_exposed(const dpl_solid *solid, int32_t y, int32_t word, const double position[2],
                           double radius);

/* Where a ray with a unit direction meets the first opaque pixel [px along the ray]: 0 when it starts in one,
 * INFINITY when it meets none before `limit`. */
double dpl_solid_first_hit(const dpl_solid *solid, double x, double y, double dx, double dy, double limit);

#endif
