/* Sets of probes as bits: one row of bits per row of probes, for each slot or ray of a level. Used by the
 * survey of ray skipping, which decides for 64 probes at once. */
#ifndef DPL_CASCADE_MASK_H
#define DPL_CASCADE_MASK_H

#include "kernel/bits.h"

#include <stddef.h>
#include <stdint.h>

#define DPL_MASK_BITS 64

/* Shape [index][row][word]; bit i of word w is probe 64 w + i. Bits behind the last probe are 0. */
typedef struct dpl_mask {
    uint64_t *bits;
    int32_t rows;
    int32_t words;  /* of a row */
    int32_t probes; /* of a row */
} dpl_mask;

static inline int32_t dpl_mask_words(int32_t probes) {
    return (probes + DPL_MASK_BITS - 1) / DPL_MASK_BITS;
}

static inline uint64_t *dpl_mask_row(const dpl_mask *mask, int32_t index, int32_t row) {
    return mask->bits + ((size_t)index * (size_t)mask->rows + (size_t)row) * (size_t)mask->words;
}

/* Bits first .. last-1 of the word that begins at probe `base`. */
static inline uint64_t dpl_mask_range(int32_t base, int32_t first, int32_t last) {
    int32_t low = first - base, high = last - base;
    if (low >= DPL_MASK_BITS || high <= 0 || low >= high)
        return 0;
    uint64_t bits = low > 0 ? ~(uint64_t)0 << low : ~(uint64_t)0;
    return high < DPL_MASK_BITS ? bits & (((uint64_t)1 << high) - 1) : bits;
}

/* Sets bits first .. last-1 of a row. */
static inline void dpl_mask_fill(uint64_t *row, int32_t first, int32_t last) {
    for (int32_t w = first / DPL_MASK_BITS; w * DPL_MASK_BITS < last; w++)
        row[w] |= dpl_mask_range(w * DPL_MASK_BITS, first, last);
}

/* One past the highest bit that is set. */
static inline int32_t dpl_mask_end(uint64_t bits) {
    for (int shift = 1; shift < DPL_MASK_BITS; shift *= 2)
        bits |= bits >> shift;
    return dpl_bit_count(bits);
}

/* All probes that a word of a row has. */
static inline uint64_t dpl_mask_all(const dpl_mask *mask, int32_t word) {
    return dpl_mask_range(word * DPL_MASK_BITS, 0, mask->probes);
}

#endif
