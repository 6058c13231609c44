/* A study step by step: journal, scenes, statistics, files. */
#include "study.h"

#include "../interrupt.h"
#include "../paths.h"
#include "../report.h"
#include "claims.h"
#include "csv.h"
#include "journal.h"
#include "plots.h"
#include "report_html.h"
#include "scene_run.h"
#include "times.h"

#include <stdio.h>

/* Everything that is open or in memory during a study. */
typedef struct study_job {
    const dpl_study_plan *plan;
    dpl_study_journal journal;
    dpl_study_results results;
    dpl_study_stage stage;
    int32_t done; /* scenes that are in the journal */
    dpl_isa isa;
} study_job;

static int open_journal(study_job *job) {
    dpl_error error;
    if (!dpl_path_make_folder(job->plan->folder, &error))
        return dpl_report_failure("%s", error.text);
    dpl_status status = dpl_study_results_create(job->plan, &job->results);
    if (status != DPL_OK)
        return dpl_report_status(NULL, status);
    if (!dpl_study_journal_open(job->plan, &job->journal, job->results.records, &job->done, &error))
        return dpl_report_failure("%s", error.text);
    return DPL_EXIT_DONE;
}

static int open_stage(study_job *job) {
    dpl_status status = dpl_study_stage_create(job->plan, &job->stage);
    if (status != DPL_OK)
        return dpl_report_status(job->stage.context, status);
    job->isa = dpl_context_isa(job->stage.context);
    return DPL_EXIT_DONE;
}

static int run_next_scene(study_job *job) {
    dpl_error error;
    const dpl_study_plan *plan = job->plan;
    dpl_study_scene_record *record = &job->results.records[job->done];
    int status = dpl_study_scene_run(&job->stage, plan->first_seed + (uint64_t)(job->done / plan->scenes),
                                     job->done % plan->scenes, record);
    if (status != DPL_EXIT_DONE)
        return status;
    if (!dpl_study_journal_append(&job->journal, record, &error)) {
        dpl_progress_end(&job->stage.pace.bar);
        return dpl_report_failure("%s", error.text);
    }
    job->done++;
    return DPL_EXIT_DONE;
}

/* What is in the journal stays: the same command goes on behind it. */
static void report_interrupt(const study_job *job) {
    (void)dpl_report_failure("%s: stopped after %d of %d scenes; the same command goes on from there",
                             job->plan->folder, (int)job->done, (int)dpl_study_scene_count(job->plan));
}

static int run_scenes(study_job *job) {
    const int32_t scenes = dpl_study_scene_count(job->plan);
    int status = DPL_EXIT_DONE;
    dpl_study_pace_begin(&job->stage.pace, job->plan, scenes - job->done);
    while (job->done < scenes && status == DPL_EXIT_DONE) {
        status = dpl_interrupt_status();
        if (status == DPL_EXIT_DONE)
            status = run_next_scene(job);
    }
    dpl_progress_end(&job->stage.pace.bar);
    return status;
}

/* Frees threads and pictures before other programs are started. */
static int close_stage(study_job *job) {
    dpl_study_stage_destroy(&job->stage);
    dpl_status status = dpl_study_results_finish(&job->results);
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(NULL, status);
}

static int write_files(study_job *job) {
    dpl_error error, note;
    const dpl_study_results *results = &job->results;
    if (!dpl_study_write_tables(results, &error) || !dpl_study_write_plot_script(results, &error) ||
        !dpl_study_write_times(results, job->isa, &error))
        return dpl_report_failure("%s", error.text);
    bool plots = dpl_study_draw_plots(results, &note);
    if (dpl_interrupt_status())
        return dpl_interrupt_status();
    if (!dpl_study_write_report(results, plots, &error))
        return dpl_report_failure("%s", error.text);
    if (!plots)
        dpl_report_note("%s: the report has no plots", note.text);
    return DPL_EXIT_DONE;
}

static int print_closing(study_job *job) {
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        int counts[DPL_STUDY_VERDICTS];
        dpl_study_count_verdicts(&job->results, (dpl_study_profile)p, counts);
        printf("%-9s  reproduced %d, partly %d, not %d\n", dpl_study_profile_name((dpl_study_profile)p),
               counts[DPL_STUDY_REPRODUCED], counts[DPL_STUDY_PARTLY], counts[DPL_STUDY_NOT]);
    }
    printf("%s/report.html\n", job->plan->folder);
    return DPL_EXIT_DONE;
}

int dpl_study_run(const dpl_study_plan *plan) {
    static int (*const steps[])(study_job *) = {
        open_journal, open_stage, run_scenes, close_stage, write_files, print_closing,
    };
    study_job job = {.plan = plan};
    int status = DPL_EXIT_DONE;
    dpl_interrupt_catch();
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++) {
        status = dpl_interrupt_status();
        if (status == DPL_EXIT_DONE)
            status = steps[i](&job);
    }
    if (status != DPL_EXIT_DONE && status == dpl_interrupt_status() && job.journal.open)
        report_interrupt(&job);
    dpl_study_stage_destroy(&job.stage);
    dpl_study_journal_close(&job.journal);
    dpl_study_results_destroy(&job.results);
    return status;
}
