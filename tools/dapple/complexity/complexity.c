/* A run step by step. Files are written when all is measured: a run that was stopped leaves none. */
#include "complexity.h"

#include "../interrupt.h"
#include "../paths.h"
#include "../report.h"
#include "figure.h"
#include "measure.h"
#include "page.h"
#include "tables.h"

#include <stdio.h>

/* Everything that is in memory during a run. */
typedef struct complexity_job {
    const dpl_complexity_plan *plan;
    dpl_complexity_worlds worlds;
    dpl_complexity_results results;
} complexity_job;

static int make_folder(complexity_job *job) {
    dpl_error error;
    return dpl_path_make_folder(job->plan->folder, &error) ? DPL_EXIT_DONE
                                                           : dpl_report_failure("%s", error.text);
}

static int make_worlds(complexity_job *job) {
    dpl_status status = dpl_complexity_worlds_create(job->plan, &job->worlds);
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->worlds.context, status);
}

static int measure(complexity_job *job) {
    job->results.machine = dpl_bench_machine_read();
    return dpl_complexity_measure(&job->worlds);
}

static int write_files(complexity_job *job) {
    dpl_error error, note;
    dpl_complexity_results *results = &job->results;
    results->worlds = &job->worlds;
    dpl_complexity_find_all(&job->worlds, &results->findings);
    if (!dpl_complexity_write_tables(results, &error) || !dpl_complexity_write_figure_script(results, &error))
        return dpl_report_failure("%s", error.text);
    bool figure = job->plan->plot && dpl_complexity_draw_figure(results, &note);
    if (!dpl_complexity_write_page(results, figure, &error))
        return dpl_report_failure("%s", error.text);
    if (job->plan->plot && !figure)
        dpl_report_note("%s: the page has no figure", note.text);
    return DPL_EXIT_DONE;
}

static void print_finding(const dpl_complexity_finding *f) {
    char over[64], interval[64];
    if (f->to > f->from)
        snprintf(over, sizeof over, "%.0f to %.0f %s", f->from, f->to, f->of);
    else
        snprintf(over, sizeof over, "%.0f %s", f->from, f->of);
    snprintf(interval, sizeof interval, "(%.3f .. %.3f)", f->low, f->high);
    printf("%-26s %-24s %9.3f %-20s %-16s %s\n", f->what, over, f->value, interval, f->unit,
           dpl_complexity_verdict_name(f->verdict));
}

static int print_closing(complexity_job *job) {
    for (int32_t i = 0; i < job->results.findings.count; i++)
        print_finding(&job->results.findings.list[i]);
    printf("%s/complexity.html\n", job->plan->folder);
    return DPL_EXIT_DONE;
}

int dpl_complexity_run(const dpl_complexity_plan *plan) {
    static int (*const steps[])(complexity_job *) = {make_folder, make_worlds, measure, write_files,
                                                     print_closing};
    complexity_job job = {.plan = plan};
    int status = DPL_EXIT_DONE;
    dpl_interrupt_catch();
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++)
        status = steps[i](&job);
    if (status != DPL_EXIT_DONE && status == dpl_interrupt_status())
        (void)dpl_report_failure("%s: stopped; nothing was written", plan->folder);
    dpl_complexity_worlds_destroy(&job.worlds);
    return status;
}
