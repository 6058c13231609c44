/* What changes from frame to frame: scenes of a family with something that moves in them. Used by measure.c
 * and main.c. */
#ifndef DPL_BENCH_SITUATION_H
#define DPL_BENCH_SITUATION_H

#include "../../scenes/scene.h"

#include <dapple/field.h>

/* What is done to the field between two frames. */
typedef enum dpl_bench_change {
    DPL_BENCH_NOTHING, /* not even drawn again */
    DPL_BENCH_REDRAW,  /* drawn again as it was */
    DPL_BENCH_COLOUR,  /* the lamp changes its colour */
    DPL_BENCH_LAMP,    /* the lamp moves, some pixels per frame */
    DPL_BENCH_WALL     /* a wall does */
} dpl_bench_change;

typedef struct dpl_bench_situation {
    const char *name;
    const char *family; /* the scene around it, number 0 of seed 1 */
    bool closed;        /* in a closed room, a sixth of the picture wide */
    dpl_bench_change change;
} dpl_bench_situation;

/* All of them; `count` receives how many. */
const dpl_bench_situation *dpl_bench_situations(int32_t *count);

/* Makes the scene, without what moves; free with dpl_scene_free(). */
bool dpl_bench_situation_scene(const dpl_bench_situation *s, int32_t size, dpl_scene *scene,
                               dpl_error *error);

/* Draws frame number `frame`. */
bool dpl_bench_situation_draw(const dpl_bench_situation *s, const dpl_scene *scene, dpl_context *context,
                              int32_t frame, dpl_field *field, dpl_error *error);

#endif
