/* Opaque pixels as lines of bits along one of both axes: u counts lines, v pixels in a line. Read by the
 * exact method for one receiver (exact.c) and for many (exact_lines.c). */
#ifndef DPL_SHADOW_LINES_H
#define DPL_SHADOW_LINES_H

#include "shadow/solid.h"

typedef struct dpl_lines {
    const uint64_t *bits;
    const uint64_t *blocks; /* of 8 lines, 8 pixels of each */
    int32_t words, block_words;
    int32_t u_size, v_size;
} dpl_lines;

/* Columns, with u = x; or, turned, rows with u = y. */
static inline dpl_lines dpl_lines_of(const dpl_solid *solid, bool turned) {
    if (turned)
        return (dpl_lines){solid->rows.data,       solid->block_rows.data, solid->row_words,
                           solid->block_row_words, solid->height,          solid->width};
    return (dpl_lines){solid->columns.data, solid->block_columns.data,
                       solid->column_words, solid->block_column_words,
                       solid->width,        solid->height};
}

/* Pixel numbers between two places of a line; false when they are outside the picture. */
static inline bool dpl_lines_between(const dpl_lines *l, double low, double high, int32_t *first,
                                     int32_t *last) {
    if (!(high >= 0.0 && low < l->v_size))
        return false;
    *first = low > 0.0 ? (int32_t)low : 0;
    *last = high < l->v_size ? (int32_t)high : l->v_size - 1;
    return true;
}

/* Opaque pixels among 64 of a line from `base` on, none beyond `last`. */
static inline uint64_t dpl_lines_window(const dpl_lines *l, int32_t line, int32_t base, int32_t last) {
    uint64_t bits = dpl_solid_window(l->bits + (size_t)line * (size_t)l->words, base);
    return last - base < 63 ? bits & (((uint64_t)2 << (last - base)) - 1) : bits;
}

/* The same for blocks, which count pixels by eights. */
static inline uint64_t dpl_lines_blocks(const dpl_lines *l, int32_t block, int32_t base, int32_t last) {
    uint64_t bits = dpl_solid_window(l->blocks + (size_t)block * (size_t)l->block_words, base);
    return last - base < 63 ? bits & (((uint64_t)2 << (last - base)) - 1) : bits;
}

/* Takes the lowest run of ones away: its first bit, and the one behind its last. */
static inline uint64_t dpl_lines_take_run(uint64_t bits, int32_t *begin, int32_t *end) {
    *begin = dpl_lowest_bit(bits);
    uint64_t clear = ~bits & ~(uint64_t)0 << *begin;
    *end = clear ? dpl_lowest_bit(clear) : 64;
    return *end < 64 ? bits & ~(uint64_t)0 << *end : 0;
}

#endif
