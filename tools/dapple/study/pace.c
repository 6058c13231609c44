/* Steps to a share of the whole. */
#include "pace.h"

#include "../interrupt.h"
#include "plan.h"

/* The truth of a scene takes about as long as this many solves. */
#define TRUTH_STEPS 8

static int32_t solves_per_scene(void) {
    int32_t solves = 0;
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        solves += DPL_STUDY_MODES * (dpl_study_has_dropped((dpl_study_profile)p) ? 2 : 1);
    return solves;
}

void dpl_study_pace_begin(dpl_study_pace *pace, int32_t scenes) {
    pace->steps = (int64_t)scenes * (solves_per_scene() + TRUTH_STEPS);
    pace->done = 0;
    pace->step = 1;
    dpl_progress_begin(&pace->bar);
}

void dpl_study_pace_solve(dpl_study_pace *pace) {
    pace->step = 1;
}

void dpl_study_pace_truth(dpl_study_pace *pace) {
    pace->step = TRUTH_STEPS;
}

void dpl_study_pace_next(dpl_study_pace *pace) {
    pace->done += pace->step;
}

int dpl_study_pace_hook(double done, void *user) {
    dpl_study_pace *pace = user;
    if (pace->steps > 0)
        dpl_progress_update(&pace->bar, ((double)pace->done + done * pace->step) / (double)pace->steps);
    return dpl_interrupt_status() == 0;
}
