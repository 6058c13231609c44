/* Everything that was found out: the records of all scenes and their statistics. What CSV files, plots and
 * the report are made from. */
#ifndef DPL_STUDY_RESULTS_H
#define DPL_STUDY_RESULTS_H

#include "statistics.h"

/* Zero-initialise. */
typedef struct dpl_study_results {
    const dpl_study_plan *plan;
    dpl_study_scene_record *records;                 /* seed by seed, scene by scene */
    dpl_study_statistics *seeds[DPL_STUDY_PROFILES]; /* one each per seed */
    dpl_study_statistics pooled[DPL_STUDY_PROFILES]; /* all scenes of all seeds */
} dpl_study_results;

/* Makes room for all records. DPL_ERROR_MEMORY. */
dpl_status dpl_study_results_create(const dpl_study_plan *plan, dpl_study_results *results);

/* Fills the statistics from the records. DPL_ERROR_MEMORY. */
dpl_status dpl_study_results_finish(dpl_study_results *results);

void dpl_study_results_destroy(dpl_study_results *results);

#endif
