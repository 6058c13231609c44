/* The scenes that frames are timed on, as fields of any size. Used by bench_speed and
 * bench_gate. */
#ifndef DPL_BENCH_WORLD_H
#define DPL_BENCH_WORLD_H

#include "../../image/error.h"

#include <dapple/dapple.h>

/* From much that is empty to nothing that is. */
typedef enum dpl_bench_world {
    DPL_BENCH_FEW,   /* ARC with few lights */
    DPL_BENCH_MANY,  /* ARC with fifty lights */
    DPL_BENCH_NOISE, /* a wall or lamp in every block of pixels: nothing can be left out */
    DPL_BENCH_MIST,  /* the same in a medium that fills the picture: the dearest there is */
    DPL_BENCH_WORLDS
} dpl_bench_world;

/* A name without commas, and a line about it. */
const char *dpl_bench_world_name(dpl_bench_world world);
const char *dpl_bench_world_about(dpl_bench_world world);

/* Makes the field, size x size pixels. */
bool dpl_bench_world_make(dpl_bench_world world, int32_t size, dpl_context *context, dpl_field **field,
                          dpl_error *error);

#endif
