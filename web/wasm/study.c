/* Holds the records of a study and runs its scenes. */
#include "study.h"

#include "host.h"

#include "tools/dapple/study/scene_run.h"
#include "tools/dapple/study/statistics.h"

#include <stdlib.h>
#include <string.h>

typedef struct dpl_web_study {
    dpl_study_plan plan;
    dpl_study_stage stage;
    int32_t done; /* scenes that were run */
    dpl_study_scene_record records[DPL_STUDY_SCENES_MAX];
} dpl_web_study;

static int32_t fail(const char *text) {
    dpl_web_report(text);
    return 0;
}

void dpl_web_study_close(dpl_web_session *session) {
    if (session->study)
        dpl_study_stage_destroy(&session->study->stage);
    free(session->study);
    session->study = NULL;
}

static bool arguments_are_good(int32_t size, int32_t scenes, int32_t truth) {
    return size >= DPL_STUDY_SIZE_MIN && size <= DPL_STUDY_SIZE_MAX && scenes >= 1 &&
           scenes <= DPL_STUDY_SCENES_MAX && truth >= 1 && truth <= DPL_STUDY_TRUTH_MAX;
}

int32_t dpl_web_study_open(dpl_web_session *session, uint64_t seed, int32_t size, int32_t scenes,
                           int32_t truth) {
    dpl_web_study_close(session);
    if (!arguments_are_good(size, scenes, truth))
        return fail(
            "a study has 1 to 50 scenes of 64 to 4096 pixels a side and a truth of 1 to 16384 pixels");
    dpl_web_study *study = calloc(1, sizeof *study);
    if (!study)
        return fail("out of memory");
    session->study = study;
    study->plan = (dpl_study_plan){.first_seed = seed,
                                   .seeds = 1,
                                   .size = size,
                                   .scenes = scenes,
                                   .truth = truth,
                                   .threads = dpl_context_thread_count(session->context),
                                   .tasks = dpl_web_crew_hooks(&session->crew)};
    dpl_status status = dpl_study_stage_create(&study->plan, &study->stage);
    if (status == DPL_OK) {
        dpl_study_pace_begin(&study->stage.pace, &study->plan, scenes);
        return 1;
    }
    dpl_web_study_close(session);
    return fail(dpl_status_text(status));
}

int32_t dpl_web_study_next(dpl_web_session *session) {
    dpl_web_study *study = session->study;
    if (!study || study->done >= study->plan.scenes)
        return fail("there is no such scene");
    if (dpl_study_scene_run(&study->stage, study->plan.first_seed, study->done,
                            &study->records[study->done]) != 0)
        return 0; /* reported, or cancelled */
    study->done++;
    return 1;
}

static bool hand_over(const char *where, const dpl_study_record_field *field, void *value, void *user) {
    double number = 0;
    (void)user;
    switch (field->kind) {
    case DPL_STUDY_INT32:
        number = *(const int32_t *)value;
        break;
    case DPL_STUDY_INT64:
        number = (double)*(const int64_t *)value;
        break;
    case DPL_STUDY_UINT64:
        number = (double)*(const uint64_t *)value;
        break;
    case DPL_STUDY_DOUBLE:
        number = *(const double *)value;
        break;
    }
    dpl_web_number(where, field->name, number);
    return true;
}

void dpl_web_study_read(dpl_web_session *session) {
    dpl_web_study *study = session->study;
    if (study && study->done > 0)
        (void)dpl_study_record_each(&study->records[study->done - 1], hand_over, NULL);
}

int32_t dpl_web_study_correlate(dpl_web_session *session, int32_t profile, int32_t signal, int32_t quality,
                                double values[5]) {
    const dpl_web_study *study = session->study;
    dpl_study_statistics statistics;
    if (!study || study->done == 0 || profile < 0 || profile >= DPL_STUDY_PROFILES || signal < 0 ||
        signal >= DPL_STUDY_SIGNALS || quality < 0 || quality >= DPL_STUDY_QUALITIES)
        return fail("there is no such correlation");
    dpl_status status =
        dpl_study_statistics_of(study->records, study->done, (dpl_study_profile)profile, &statistics);
    if (status != DPL_OK)
        return fail(dpl_status_text(status));
    const dpl_correlation *found = &statistics.correlations[signal][quality];
    const double numbers[5] = {found->r, found->low, found->high, found->p, found->count};
    memcpy(values, numbers, sizeof numbers);
    return 1;
}

const char *dpl_web_study_signal(int32_t signal) {
    return signal >= 0 && signal < DPL_STUDY_SIGNALS ? dpl_study_signal_name((dpl_study_signal)signal) : NULL;
}
