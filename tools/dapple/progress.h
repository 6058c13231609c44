/* A progress bar on standard error, when that is a terminal; nothing otherwise. Used by render. */
#ifndef DPL_TOOL_PROGRESS_H
#define DPL_TOOL_PROGRESS_H

#include <stdbool.h>

typedef struct dpl_progress {
    bool terminal;
    bool drawn;      /* there is a bar to wipe */
    double start_ms; /* when the work began */
    double next_ms;  /* not drawn again before */
} dpl_progress;

/* Starts the clock. The bar appears once the work has taken long enough to be worth one. */
void dpl_progress_begin(dpl_progress *progress);

/* Draws, at most ten times a second. `done` is 0 .. 1. */
void dpl_progress_update(dpl_progress *progress, double done);

/* Wipes the bar. */
void dpl_progress_end(dpl_progress *progress);

#endif
