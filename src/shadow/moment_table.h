/* Summed-area tables of packed moments in 32-bit integers: the mean over any box in a fixed number of reads,
 * exact where sums of floats would drown. A polar map is a table of one row. Memory is the caller's.
 *
 * Source: Peters et al. 2017, JCGT 6(1): integers that wrap around still give right differences, as long as
 * what lies between the two ends fits. */
#ifndef DPL_SHADOW_MOMENT_TABLE_H
#define DPL_SHADOW_MOMENT_TABLE_H

#include <stddef.h>
#include <stdint.h>

typedef struct dpl_moment_table {
    int32_t width; /* [texel] */
    int32_t height;
    /* Texels of the largest box that is asked for, ends included that are read only in part. */
    int64_t most_texels;
    /* (height + 1) rows of width + 1: sums of all texels above and to the left. */
    uint32_t (*sums)[4];
} dpl_moment_table;

/* Entries that dpl_moment_table::sums needs. */
static inline size_t dpl_moment_table_entries(int32_t width, int32_t height) {
    return ((size_t)width + 1) * ((size_t)height + 1);
}

/* The steps that packed moments are rounded down to. Means of a table need more bias than this. */
static inline double dpl_moment_table_step(const dpl_moment_table *table) {
    return (double)table->most_texels / 4294967295.0;
}

/* Adds up one row from the packed moments of its texels, each within 0 .. 1; rows from 0 on, in order. */
void dpl_moment_table_add_row(const dpl_moment_table *table, int32_t y, const double (*packed)[4]);

/* Mean moments (unpacked, no bias added) over the box from (x0, y0) to (x1, y1) in texels, fractions of
 * texels by area; 0 <= x0 < x1 <= width, the same for y. */
void dpl_moment_table_mean(const dpl_moment_table *table, double x0, double y0, double x1, double y1,
                           double b[4]);

/* The same for a table of one row. */
void dpl_moment_table_row_mean(const dpl_moment_table *table, double x0, double x1, double b[4]);

#endif
