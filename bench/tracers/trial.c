/* Runs trials by turns and keeps their times. Called by main.c. */
#include "trial.h"

#include "../common/clock.h"
#include "../common/progress.h"

#include <stdlib.h>
#include <string.h>

dpl_bench_trial *dpl_bench_trials_add(dpl_bench_trials *list, dpl_error *error) {
    if (list->count == list->capacity) {
        int32_t capacity = list->capacity ? 2 * list->capacity : 64;
        dpl_bench_trial *trials = realloc(list->trials, (size_t)capacity * sizeof *trials);
        if (!trials) {
            dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
            return NULL;
        }
        list->trials = trials;
        list->capacity = capacity;
    }
    dpl_bench_trial *trial = &list->trials[list->count++];
    memset(trial, 0, sizeof *trial);
    return trial;
}

void dpl_bench_trials_free(dpl_bench_trials *list) {
    free(list->trials);
    *list = (dpl_bench_trials){0};
}

static bool run_one(dpl_bench_trial *trial, int32_t round, dpl_error *error) {
    dpl_bench_time start = dpl_bench_now();
    if (!trial->run(trial, error))
        return false;
    if (round >= 0)
        trial->ns[round] = dpl_bench_since(start).cpu_ms * 1e6 / (double)trial->rays;
    trial->runs++;
    return true;
}

bool dpl_bench_trials_run(dpl_bench_trials *list, int32_t rounds, dpl_error *error) {
    for (int32_t round = -1; round < rounds; round++)
        for (int32_t i = 0; i < list->count; i++) {
            dpl_bench_trial *trial = &list->trials[i];
            dpl_bench_progress("round %d of %d: %s %s, %d objects, %s", (int)round + 1, (int)rounds,
                               trial->part, trial->set, (int)trial->objects, trial->method);
            if (!run_one(trial, round, error))
                return false;
        }
    for (int32_t i = 0; i < list->count; i++) {
        double sorted[DPL_BENCH_MAX_ROUNDS];
        memcpy(sorted, list->trials[i].ns, sizeof sorted);
        list->trials[i].summary = dpl_bench_summarise(sorted, rounds);
    }
    dpl_bench_progress_end();
    return true;
}

bool dpl_bench_trial_count(dpl_bench_trial *trial, dpl_tracer *tracer, dpl_error *error) {
    dpl_tracer_stats stats;
    dpl_tracer_read_stats(tracer, &stats);
    dpl_tracer_reset_stats(tracer);
    double tests = (double)stats.object_tests / (double)trial->rays;
    double visits = (double)stats.node_visits / (double)trial->rays;
    bool same = tests == trial->tests_per_ray && visits == trial->visits_per_ray;
    trial->tests_per_ray = tests;
    trial->visits_per_ray = visits;
    return trial->runs == 0 || same ||
           dpl_error_set(error, "%s, %d objects, %s: the counters of two runs differ", trial->set,
                         (int)trial->objects, trial->method);
}

bool dpl_bench_good(dpl_status status, const dpl_context *context, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    const char *message = dpl_context_message(context);
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}
