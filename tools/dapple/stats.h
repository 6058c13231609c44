/* What a render did, as JSON: the file behind `render --stats`. */
#ifndef DPL_TOOL_STATS_H
#define DPL_TOOL_STATS_H

#include "image/error.h"

#include <dapple/solver.h>
#include <stdint.h>

typedef struct dpl_render_stats {
    const char *solver;
    const char *merge; /* NULL: the solver has none; so are the next two */
    const char *storage;
    const char *resolution;
    const char *skip;
    const char *isa;
    const char *shadow; /* method of the lights' shadows, NULL: there were none */
    int32_t lights;     /* that were added */
    int32_t width;
    int32_t height;
    int32_t threads;
    double read_ms;  /* the scene file */
    double field_ms; /* rasterising, and the distance field */
    double solve_ms;
    double lights_ms; /* the lights and their shadows */
    double write_ms;
    double total_ms; /* from the first to the last, with what lies between */
    dpl_solver_stats counts;
} dpl_render_stats;

/* The whole document as malloc'ed text, or NULL with the error set. */
char *dpl_render_stats_text(const dpl_render_stats *stats, dpl_error *error);

#endif
