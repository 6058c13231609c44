/* Runs cases by turns. Processor time throughout, summed over threads: what others do on the machine does not
 * count, though what they do to its caches does. */
#include "measure.h"

#include "../interrupt.h"
#include "../progress.h"
#include "../report.h"

#include "bench/common/clock.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A sample takes at least about this long. */
#define SAMPLE_MS 2.0
#define RUNS_MAX 10000

static dpl_status run_rays(dpl_complexity_worlds *worlds, const dpl_complexity_case *c, int64_t counts[2]) {
    dpl_tracer_stats stats;
    dpl_tracer *tracer = c->world;
    dpl_tracer_reset_stats(tracer);
    dpl_status status = dpl_tracer_trace(tracer, worlds->rays, c->rays, worlds->hits);
    dpl_tracer_read_stats(tracer, &stats);
    counts[DPL_COMPLEXITY_WORK] = stats.object_tests;
    counts[DPL_COMPLEXITY_STEPS] = stats.node_visits;
    return status;
}

static dpl_status run_flood(const dpl_complexity_case *c, int64_t counts[2]) {
    dpl_flood_stats stats;
    dpl_flood *flood = c->world;
    dpl_status status = dpl_flood_solve(flood);
    dpl_flood_read_stats(flood, &stats);
    counts[DPL_COMPLEXITY_WORK] = stats.visits;
    counts[DPL_COMPLEXITY_STEPS] = stats.pushes;
    return status;
}

/* Naive tracing tests each object for each ray and a flood visits each cell, neither more nor less. */
static bool is_exact(const dpl_complexity_case *c) {
    const double work = (double)c->counts[DPL_COMPLEXITY_WORK];
    if (c->method == DPL_COMPLEXITY_NAIVE)
        return work == (double)c->size * c->rays && c->counts[DPL_COMPLEXITY_STEPS] == 0;
    return c->method == DPL_COMPLEXITY_BVH || work == dpl_complexity_items(c);
}

static int report_counts(const dpl_complexity_case *c, const int64_t counts[2], const char *what) {
    return dpl_report_failure("%s, size %d, %d rays: %s (%" PRId64 ", %" PRId64 ")",
                              dpl_complexity_method_name(c->method), (int)c->size, (int)c->rays, what,
                              counts[DPL_COMPLEXITY_WORK], counts[DPL_COMPLEXITY_STEPS]);
}

static int run_once(dpl_complexity_worlds *worlds, dpl_complexity_case *c) {
    int64_t counts[DPL_COMPLEXITY_COUNTS];
    dpl_status status =
        c->method == DPL_COMPLEXITY_FLOOD ? run_flood(c, counts) : run_rays(worlds, c, counts);
    if (status != DPL_OK)
        return dpl_report_status(worlds->context, status);
    if (c->counted && memcmp(counts, c->counts, sizeof counts) != 0)
        return report_counts(c, counts, "the counts of two runs differ");
    memcpy(c->counts, counts, sizeof counts);
    c->counted = true;
    return is_exact(c) ? DPL_EXIT_DONE : report_counts(c, counts, "the counts are not what they must be");
}

/* The first run warms caches up; the second tells how many make a sample. */
static int prepare(dpl_complexity_worlds *worlds, dpl_complexity_case *c) {
    int status = run_once(worlds, c);
    dpl_bench_time start = dpl_bench_now();
    if (status == DPL_EXIT_DONE)
        status = run_once(worlds, c);
    double ms = dpl_bench_since(start).cpu_ms;
    c->runs = ms * RUNS_MAX > SAMPLE_MS ? (int32_t)(SAMPLE_MS / ms) + 1 : RUNS_MAX;
    return status;
}

static int sample(dpl_complexity_worlds *worlds, dpl_complexity_case *c, int32_t round, double *wall_ms) {
    int status = DPL_EXIT_DONE;
    dpl_bench_time start = dpl_bench_now();
    for (int32_t i = 0; i < c->runs && status == DPL_EXIT_DONE; i++)
        status = run_once(worlds, c);
    dpl_bench_time time = dpl_bench_since(start);
    c->cpu_ms[round] = time.cpu_ms / c->runs;
    *wall_ms = time.wall_ms / c->runs;
    return status;
}

/* How long a sample takes, roughly, for the bar. */
static double weight(const dpl_complexity_case *c) {
    double ms = c->method == DPL_COMPLEXITY_NAIVE ? 3e-6 * c->size * c->rays
                : c->method == DPL_COMPLEXITY_BVH ? 3e-4 * c->rays
                                                  : 6e-6 * dpl_complexity_items(c);
    return ms > SAMPLE_MS ? ms : SAMPLE_MS;
}

static int run_all(dpl_complexity_worlds *worlds, dpl_progress *bar, double *wall) {
    const int32_t rounds = worlds->plan->rounds;
    double total = 0, done = 0;
    for (int32_t i = 0; i < worlds->case_count; i++)
        total += (rounds + 1) * weight(&worlds->cases[i]);
    for (int32_t round = -1; round < rounds; round++)
        for (int32_t i = 0; i < worlds->case_count; i++) {
            dpl_complexity_case *c = &worlds->cases[i];
            int status = dpl_interrupt_status();
            if (status == DPL_EXIT_DONE)
                status = round < 0 ? prepare(worlds, c) : sample(worlds, c, round, &wall[i * rounds + round]);
            if (status != DPL_EXIT_DONE)
                return status;
            done += weight(c);
            dpl_progress_update(bar, done / total);
        }
    return DPL_EXIT_DONE;
}

static void summarise(dpl_complexity_worlds *worlds, double *wall) {
    const int32_t rounds = worlds->plan->rounds;
    for (int32_t i = 0; i < worlds->case_count; i++) {
        double sorted[DPL_COMPLEXITY_ROUNDS_MAX];
        dpl_complexity_case *c = &worlds->cases[i];
        memcpy(sorted, c->cpu_ms, sizeof sorted);
        c->cpu = dpl_bench_summarise(sorted, rounds);
        c->wall = dpl_bench_summarise(&wall[i * rounds], rounds);
    }
}

int dpl_complexity_measure(dpl_complexity_worlds *worlds) {
    dpl_progress bar;
    double *wall = malloc((size_t)(worlds->case_count * worlds->plan->rounds) * sizeof *wall);
    if (!wall)
        return dpl_report_status(NULL, DPL_ERROR_MEMORY);
    dpl_progress_begin(&bar);
    int status = run_all(worlds, &bar, wall);
    dpl_progress_end(&bar);
    if (status == DPL_EXIT_DONE)
        summarise(worlds, wall);
    free(wall);
    return status;
}
