/* Steps to a share of the whole. */
#include "pace.h"

#include "../interrupt.h"

/* A solve takes time by the area of a scene, the truth by its pixels and the length of their rays: so many
 * solves for each pixel of the truth and of the side, as timed at the default arguments. */
#define TRUTH_STEPS 5

static int32_t solves_per_scene(void) {
    int32_t solves = 0;
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        solves += DPL_STUDY_MODES * (dpl_study_has_dropped((dpl_study_profile)p) ? 2 : 1);
    return solves;
}

void dpl_study_pace_begin(dpl_study_pace *pace, const dpl_study_plan *plan, int32_t scenes) {
    pace->truth = 1 + TRUTH_STEPS * plan->truth / plan->size;
    pace->steps = (int64_t)scenes * (solves_per_scene() + pace->truth);
    pace->done = 0;
    pace->step = 1;
    dpl_progress_begin(&pace->bar);
}

void dpl_study_pace_solve(dpl_study_pace *pace) {
    pace->step = 1;
}

void dpl_study_pace_truth(dpl_study_pace *pace) {
    pace->step = pace->truth;
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
