/* Everything that scenes are run with, made once for a study: context, fields, solvers, pictures. Used by
 * scene_run.c and study.c. */
#ifndef DPL_STUDY_STAGE_H
#define DPL_STUDY_STAGE_H

#include "pace.h"
#include "plan.h"
#include "truth.h"

/* Zero-initialise. */
typedef struct dpl_study_stage {
    const dpl_study_plan *plan;
    dpl_context *context;
    dpl_field *fields[DPL_STUDY_PROFILES];
    dpl_solver *solvers[DPL_STUDY_PROFILES][DPL_STUDY_MODES][2]; /* [1]: without dead rays, or NULL */
    dpl_study_truth truth;
    dpl_study_pace pace;
    float *off;           /* picture with nothing skipped, shape [size][size][3] */
    float *test;          /* picture of the mode at hand */
    float *dropped;       /* the same without dead rays */
    uint8_t *off_display; /* after the tone map, shape [size][size][3] */
    uint8_t *test_display;
    uint8_t *opaque;          /* of the pixel world, shape [size][size] */
    float (*sampled)[3];      /* a picture's values at the pixels of the truth */
    uint8_t *sampled_display; /* the same after the tone map */
} dpl_study_stage;

/* Makes it all. Destroy it whatever comes back; the context, where there is one, says what was wrong. */
dpl_status dpl_study_stage_create(const dpl_study_plan *plan, dpl_study_stage *stage);

void dpl_study_stage_destroy(dpl_study_stage *stage);

#endif
