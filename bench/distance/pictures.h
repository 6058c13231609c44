/* Pictures of walls that the distance transform is timed on. Used by main.c. */
#ifndef DPL_BENCH_DISTANCE_PICTURES_H
#define DPL_BENCH_DISTANCE_PICTURES_H

#include "../../image/error.h"

#include <dapple/dapple.h>

typedef struct dpl_bench_walls {
    const char *name; /* without spaces */
    const char *about;
    /* opacity[size][size]: 255 or 0. */
    bool (*draw)(int32_t size, uint8_t *opacity, dpl_error *error);
} dpl_bench_walls;

/* From dense to sparse; `count` receives how many. */
const dpl_bench_walls *dpl_bench_walls_all(int32_t *count);

#endif
