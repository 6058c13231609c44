/* Makes and frees what a study works with. */
#include "stage.h"

#include <stdlib.h>
#include <string.h>

static dpl_status create_solvers(dpl_study_stage *stage, dpl_study_profile profile) {
    dpl_status status = DPL_OK;
    int runs = dpl_study_has_dropped(profile) ? 2 : 1;
    for (int m = 0; m < DPL_STUDY_MODES; m++)
        for (int drop = 0; drop < runs && status == DPL_OK; drop++) {
            dpl_solver_desc desc = dpl_study_solver(stage->plan, profile, (dpl_skip_mode)m, drop != 0);
            desc.progress = dpl_study_pace_hook;
            desc.progress_user = &stage->pace;
            status = dpl_solver_create(stage->context, &desc, &stage->solvers[profile][m][drop]);
        }
    return status;
}

static dpl_status create_profile(dpl_study_stage *stage, dpl_study_profile profile) {
    dpl_field_desc desc = dpl_study_field(stage->plan, profile);
    dpl_status status = dpl_field_create(stage->context, &desc, &stage->fields[profile]);
    return status == DPL_OK ? create_solvers(stage, profile) : status;
}

static dpl_status allocate_pictures(dpl_study_stage *stage) {
    size_t pixels = (size_t)stage->plan->size * (size_t)stage->plan->size;
    size_t sampled = (size_t)stage->plan->truth;
    stage->off = malloc(pixels * 3 * sizeof *stage->off);
    stage->test = malloc(pixels * 3 * sizeof *stage->test);
    stage->dropped = malloc(pixels * 3 * sizeof *stage->dropped);
    stage->off_display = malloc(pixels * 3);
    stage->test_display = malloc(pixels * 3);
    stage->opaque = malloc(pixels);
    stage->sampled = malloc(sampled * sizeof *stage->sampled);
    stage->sampled_display = malloc(sampled * 3);
    bool good = stage->off && stage->test && stage->dropped && stage->off_display && stage->test_display &&
                stage->opaque && stage->sampled && stage->sampled_display;
    return good ? DPL_OK : DPL_ERROR_MEMORY;
}

dpl_status dpl_study_stage_create(const dpl_study_plan *plan, dpl_study_stage *stage) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = plan->threads;
    desc.tasks = plan->tasks;
    stage->plan = plan;
    dpl_status status = dpl_context_create(&desc, &stage->context);
    if (status == DPL_OK)
        status = allocate_pictures(stage);
    for (int p = 0; p < DPL_STUDY_PROFILES && status == DPL_OK; p++)
        status = create_profile(stage, (dpl_study_profile)p);
    if (status == DPL_OK)
        status =
            dpl_study_truth_create(stage->context, plan, dpl_study_pace_hook, &stage->pace, &stage->truth);
    return status;
}

void dpl_study_stage_destroy(dpl_study_stage *stage) {
    dpl_study_truth_destroy(&stage->truth);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        for (int m = 0; m < DPL_STUDY_MODES; m++)
            for (int drop = 0; drop < 2; drop++)
                dpl_solver_destroy(stage->solvers[p][m][drop]);
        dpl_field_destroy(stage->fields[p]);
    }
    free(stage->off);
    free(stage->test);
    free(stage->dropped);
    free(stage->off_display);
    free(stage->test_display);
    free(stage->opaque);
    free(stage->sampled);
    free(stage->sampled_display);
    dpl_context_destroy(stage->context);
    memset(stage, 0, sizeof *stage);
}
