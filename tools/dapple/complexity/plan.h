/* What `dapple complexity` is to measure. Filled by cmd_complexity.c, read by the rest of this folder. */
#ifndef DPL_COMPLEXITY_PLAN_H
#define DPL_COMPLEXITY_PLAN_H

#include <stdbool.h>
#include <stdint.h>

#define DPL_COMPLEXITY_LARGEST_MAX 1000000
#define DPL_COMPLEXITY_SIDE_MIN 64
#define DPL_COMPLEXITY_SIDE_MAX 4096

/* Most samples of one case. */
#define DPL_COMPLEXITY_ROUNDS_MAX 25

typedef struct dpl_complexity_plan {
    const char *folder;
    int32_t largest; /* objects */
    int32_t side;    /* of the largest flood-fill world [cell] */
    int32_t rounds;
    int32_t threads;
    uint64_t seed;
    bool plot;
} dpl_complexity_plan;

#endif
