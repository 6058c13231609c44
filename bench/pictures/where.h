/* Where a picture's error sits: beside lamps, or where light changes fast. Called by main.c. */
#ifndef DPL_BENCH_WHERE_H
#define DPL_BENCH_WHERE_H

#include "../../image/picture.h"

#include <stdint.h>

/* A pixel is near a lamp when an opaque pixel that shines is at most this many columns and rows away. */
#define DPL_BENCH_NEAR 8

/* It is on an edge when its truth differs from a free neighbour's by more than this part of its own. */
#define DPL_BENCH_STEEP 0.05f

/* Parts of the free pixels, and of the squared error over them. */
typedef struct dpl_bench_share {
    double pixels;
    double error;
} dpl_bench_share;

typedef struct dpl_bench_where {
    dpl_bench_share lamps;
    dpl_bench_share edges;     /* of those not near a lamp */
    dpl_bench_share elsewhere; /* neither */
} dpl_bench_where;

/* `opaque` has a byte per pixel, as dpl_field_read_opaque() writes it. False when out of memory. */
bool dpl_bench_find_error(const dpl_picture *test, const dpl_picture *truth, const uint8_t *opaque,
                          dpl_bench_where *where);

#endif
