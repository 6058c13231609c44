/* Summed-area tables of packed moments, see moment_table.h. */
#include "shadow/moment_table.h"

#include "shadow/moments.h"

#include <string.h>

/* The largest sum that a box may have. */
#define FULL 4294967295.0

void dpl_moment_table_add_row(const dpl_moment_table *table, int32_t y, const double (*packed)[4]) {
    size_t stride = (size_t)table->width + 1;
    uint32_t(*above)[4] = table->sums + (size_t)y * stride, (*row)[4] = above + stride;
    double scale = FULL / (double)table->most_texels;
    uint32_t sum[4] = {0, 0, 0, 0};
    if (y == 0)
        memset(above, 0, stride * sizeof *above);
    memset(row[0], 0, sizeof row[0]);
    for (int32_t x = 0; x < table->width; x++)
        for (int i = 0; i < 4; i++) {
            double v = packed[x][i];
            sum[i] += (uint32_t)((v > 0.0 ? v < 1.0 ? v : 1.0 : 0.0) * scale);
            row[x + 1][i] = above[x + 1][i] + sum[i];
        }
}

/* The four grid lines that the two ends of an interval lie between, and how far in each end is. */
typedef struct ends {
    int32_t line[4];
    double low;
    double high;
} ends;

static ends ends_of(double from, double to, int32_t size) {
    int32_t low = (int32_t)from, high = (int32_t)to;
    ends e;
    low = low < size - 1 ? low : size - 1;
    high = high < size - 1 ? high : size - 1;
    e.line[0] = low;
    e.line[1] = low + 1;
    e.line[2] = high;
    e.line[3] = high + 1;
    e.low = from - low;
    e.high = to - high;
    return e;
}

/* Sums up to each of the four columns between two rows: in integers, relative to the first column. */
static void sums_between(const uint32_t (*top)[4], const uint32_t (*bottom)[4], const ends *x, int channel,
                         double sums[4]) {
    uint32_t first = bottom[x->line[0]][channel] - top[x->line[0]][channel];
    for (int k = 0; k < 4; k++)
        sums[k] = (uint32_t)(bottom[x->line[k]][channel] - top[x->line[k]][channel] - first);
}

/* From the sums up to four grid lines to what lies between the two ends. */
static double between(const double sums[4], const ends *e) {
    return sums[2] + e->high * (sums[3] - sums[2]) - (sums[0] + e->low * (sums[1] - sums[0]));
}

void dpl_moment_table_mean(const dpl_moment_table *table, double x0, double y0, double x1, double y1,
                           double b[4]) {
    size_t stride = (size_t)table->width + 1;
    ends in_x = ends_of(x0, x1, table->width), in_y = ends_of(y0, y1, table->height);
    double scale = (double)table->most_texels / (FULL * (x1 - x0) * (y1 - y0));
    const uint32_t(*top)[4] = (const uint32_t(*)[4])table->sums + (size_t)in_y.line[0] * stride;
    double packed[4];
    for (int i = 0; i < 4; i++) {
        double rows[4], columns[4];
        for (int k = 0; k < 4; k++) {
            const uint32_t(*bottom)[4] = (const uint32_t(*)[4])table->sums + (size_t)in_y.line[k] * stride;
            sums_between(top, bottom, &in_x, i, columns);
            rows[k] = between(columns, &in_x);
        }
        packed[i] = between(rows, &in_y) * scale;
    }
    dpl_moments_unpack(packed, b);
}
