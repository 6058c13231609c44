/* How far a study has come: a bar over everything that is left to do, and the wish to stop. Handed to every
 * solver as its progress hook. Used by stage.c, scene_run.c and study.c. */
#ifndef DPL_STUDY_PACE_H
#define DPL_STUDY_PACE_H

#include "../progress.h"
#include "plan.h"

#include <stdint.h>

/* Zero-initialise. One step is one solve; the truth of a scene counts as several. */
typedef struct dpl_study_pace {
    dpl_progress bar;
    int64_t steps; /* of all scenes that are left */
    int64_t done;  /* steps behind us */
    int32_t step;  /* how many the work at hand counts as */
    int32_t truth; /* how many the truth of a scene counts as */
} dpl_study_pace;

/* Begins a run over `scenes` scenes of the plan. */
void dpl_study_pace_begin(dpl_study_pace *pace, const dpl_study_plan *plan, int32_t scenes);

/* The next work is a solve, or the truth. */
void dpl_study_pace_solve(dpl_study_pace *pace);
void dpl_study_pace_truth(dpl_study_pace *pace);

/* The work at hand is done. */
void dpl_study_pace_next(dpl_study_pace *pace);

/* A dpl_progress_function: 0 once a signal has come. */
int dpl_study_pace_hook(double done, void *pace);

#endif
