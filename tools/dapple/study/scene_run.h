/* Runs one scene: the truth once, then every mode of both profiles. Called by study.c. */
#ifndef DPL_STUDY_SCENE_RUN_H
#define DPL_STUDY_SCENE_RUN_H

#include "record.h"
#include "stage.h"

/* Runs scene `index` of `seed` and fills the record. Returns an exit status (report.h): what failed has been
 * reported, and after a signal it is that of the signal. */
int dpl_study_scene_run(dpl_study_stage *stage, uint64_t seed, int32_t index, dpl_study_scene_record *record);

#endif
