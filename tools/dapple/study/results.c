/* Memory and statistics of a whole study. Called by study.c. */
#include "results.h"

#include <stdlib.h>
#include <string.h>

dpl_status dpl_study_results_create(const dpl_study_plan *plan, dpl_study_results *results) {
    results->plan = plan;
    results->records = calloc((size_t)dpl_study_scene_count(plan), sizeof *results->records);
    bool good = results->records != NULL;
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        results->seeds[p] = calloc((size_t)plan->seeds, sizeof *results->seeds[p]);
        good = good && results->seeds[p];
    }
    return good ? DPL_OK : DPL_ERROR_MEMORY;
}

dpl_status dpl_study_results_finish(dpl_study_results *results) {
    const dpl_study_plan *plan = results->plan;
    dpl_status status = DPL_OK;
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        const dpl_study_profile profile = (dpl_study_profile)p;
        for (int32_t s = 0; s < plan->seeds && status == DPL_OK; s++)
            status = dpl_study_statistics_of(results->records + s * plan->scenes, plan->scenes, profile,
                                             &results->seeds[p][s]);
        if (status == DPL_OK)
            status = dpl_study_statistics_of(results->records, dpl_study_scene_count(plan), profile,
                                             &results->pooled[p]);
    }
    return status;
}

void dpl_study_results_destroy(dpl_study_results *results) {
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        free(results->seeds[p]);
    free(results->records);
    memset(results, 0, sizeof *results);
}
