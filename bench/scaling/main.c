/* bench_scaling: time and memory of cascades against the size of the picture. Run by hand as
 * docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "report.h"

#include <stdio.h>
#include <stdlib.h>

static const char program[] = "bench_scaling";

static const char help[] =
    "Usage: bench_scaling [OPTIONS]\n"
    "\n"
    "Times frames of cascades, one scene at sizes that double, for two merges and several numbers of "
    "threads.\n"
    "Writes scaling.csv, scaling.md and scaling.png (by gnuplot). The cases take turns frame by frame, so\n"
    "all of them are in memory at once: 1.2 GiB for the defaults.\n"
    "\n"
    "  --family NAME     of the scene, as `dapple scenes` lists them (default arc)\n"
    "  --seed N          of the scene (default 1)\n"
    "  --scene N         number in its family, from 0 (default 25)\n"
    "  --smallest N      size to begin with [px] (default 256)\n"
    "  --largest N       size to end with [px] (default 2048)\n"
    "  --threads N       from 1 thread to N, doubling (default 2; the plot shows 1 and 2)\n"
    "  --frames N        measured at each size (default 5)\n"
    "  --no-plot         leave the plot out\n"
    "  --plot-only       draw the plot from the scaling.csv that is there, measure nothing\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

static const dpl_merge merges[] = {DPL_MERGE_BILINEAR, DPL_MERGE_BILINEAR_FIX};
enum { MERGE_COUNT = sizeof merges / sizeof merges[0] };

/* 15 sizes from 1 to DPL_MAX_SIZE, 7 thread counts from 1 to DPL_MAX_THREADS. */
#define MAX_CASES (MERGE_COUNT * 15 * 7)

typedef struct settings {
    dpl_bench_subject subject;
    const char *family;
    const char *out; /* NULL: by machine */
    int32_t smallest;
    int32_t largest;
    int32_t threads;
    bool no_plot;
    bool plot_only;
} settings;

static int read_settings(int argc, char **argv, settings *s) {
    dpl_bench_subject *subject = &s->subject;
    const dpl_bench_option options[] = {
        {"family", DPL_BENCH_TEXT, &s->family, 0, 0},
        {"seed", DPL_BENCH_SEED, &subject->seed, 0, 0},
        {"scene", DPL_BENCH_INTEGER, &subject->scene, 0, 1000},
        {"smallest", DPL_BENCH_INTEGER, &s->smallest, 16, DPL_MAX_SIZE},
        {"largest", DPL_BENCH_INTEGER, &s->largest, 16, DPL_MAX_SIZE},
        {"threads", DPL_BENCH_INTEGER, &s->threads, 1, DPL_MAX_THREADS},
        {"frames", DPL_BENCH_INTEGER, &subject->frames, 1, 1000},
        {"no-plot", DPL_BENCH_FLAG, &s->no_plot, 0, 0},
        {"plot-only", DPL_BENCH_FLAG, &s->plot_only, 0, 0},
        {"out", DPL_BENCH_TEXT, &s->out, 0, 0},
    };
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    subject->family = dpl_scene_family_find(s->family);
    if (!subject->family)
        return dpl_bench_usage(program, "there is no family '%s'", s->family);
    if (subject->scene >= subject->family->count)
        return dpl_bench_usage(program, "family '%s' has scenes 0 to %d, but no %d", s->family,
                               (int)subject->family->count - 1, (int)subject->scene);
    if (s->largest < s->smallest)
        return dpl_bench_usage(program, "--largest is below --smallest");
    return DPL_BENCH_GO;
}

/* All cases in the order of the report. Returns how many. */
static int32_t list_cases(const settings *s, dpl_bench_case cases[MAX_CASES]) {
    int32_t count = 0;
    for (int32_t m = 0; m < MERGE_COUNT; m++)
        for (int32_t threads = 1; threads <= s->threads; threads *= 2)
            for (int32_t size = s->smallest; size <= s->largest; size *= 2)
                cases[count++] = (dpl_bench_case){merges[m], threads, size};
    return count;
}

static bool run_frames(dpl_bench_rig *rigs, int32_t count, int32_t frames, dpl_error *error) {
    for (int32_t frame = -1; frame < frames; frame++)
        for (int32_t i = 0; i < count; i++) {
            const dpl_bench_case *which = &rigs[i].which;
            dpl_bench_progress("frame %d of %d: %s, threads %d, %d px", (int)frame + 1, (int)frames,
                               dpl_merge_name(which->merge), (int)which->threads, (int)which->size);
            if (!dpl_bench_rig_frame(&rigs[i], frame, error))
                return false;
        }
    return true;
}

/* The cases take turns frame by frame: when the machine is slower for a while, it is so for all of them, and
 * ratios between them stay fair. */
static bool measure_all(const settings *s, const dpl_bench_case *cases, int32_t count,
                        dpl_bench_measurement *measurements, dpl_error *error) {
    dpl_bench_rig *rigs = calloc((size_t)count, sizeof *rigs);
    bool good = rigs || dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    int32_t made = 0;
    for (; good && made < count; made++)
        good = dpl_bench_rig_create(&s->subject, &cases[made], &rigs[made], error);
    good = good && run_frames(rigs, count, s->subject.frames, error);
    for (int32_t i = 0; i < made; i++) {
        if (good)
            measurements[i] = dpl_bench_rig_read(&rigs[i]);
        dpl_bench_rig_free(&rigs[i]);
    }
    free(rigs);
    dpl_bench_progress_end();
    return good;
}

/* `largest` becomes the largest size that was reached by doubling. */
static bool write_all(const settings *s, const dpl_bench_machine *machine, const dpl_context *context,
                      const dpl_bench_measurement *measurements, int32_t count, dpl_error *error) {
    dpl_bench_findings findings = {&s->subject, machine,     context, measurements,
                                   count,       s->smallest, 0,       s->threads};
    findings.largest = measurements[count - 1].which.size;
    return dpl_bench_write_csv("scaling.csv", &findings, error) &&
           dpl_bench_write_markdown("scaling.md", &findings, error);
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    dpl_bench_case cases[MAX_CASES];
    dpl_context *context = NULL;
    int32_t count = list_cases(s, cases);
    dpl_bench_measurement *measurements = calloc((size_t)count, sizeof *measurements);
    dpl_status status = measurements ? dpl_context_create(NULL, &context) : DPL_ERROR_MEMORY;
    bool good = status == DPL_OK || dpl_error_set(error, "%s", dpl_status_text(status));
    good = good && measure_all(s, cases, count, measurements, error) &&
           write_all(s, machine, context, measurements, count, error);
    dpl_context_destroy(context);
    free(measurements);
    return good;
}

int main(int argc, char **argv) {
    settings s = {.subject = {.seed = 1, .scene = 25, .frames = 5}, .family = "arc"};
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256];
    s.smallest = 256;
    s.largest = 2048;
    s.threads = 2;
    int status = read_settings(argc, argv, &s);
    if (status != DPL_BENCH_GO)
        return status;
    snprintf(folder, sizeof folder, "bench/results/%s", machine.slug);
    if (dpl_bench_folder_enter(s.out ? s.out : folder, &error) &&
        (s.plot_only || run(&s, &machine, &error)) && (s.no_plot || dpl_bench_plot(&error)))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
