/* bench_speed: what a frame of the holographic solver takes, by size, scene, storage, threads and instruction
 * set, beside cascades. Run by hand as docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "report.h"

#include <stdio.h>
#include <stdlib.h>

static const char program[] = "bench_speed";

static const char help[] =
    "Usage: bench_speed [OPTIONS]\n"
    "\n"
    "Times solves of the holographic solver, in floats and halves, and of cascades beside it, on sparse and\n"
    "dense scenes; and one frame by every method, instruction set and number of threads. All take turns,\n"
    "round by round, so that ratios hold on a busy machine too. Writes speed.csv and speed.md.\n"
    "\n"
    "  --smallest N      size to begin with [px] (default 256)\n"
    "  --largest N       size to end with [px] (default 2048)\n"
    "  --threads N       from 1 thread to N, doubling (default 2)\n"
    "  --rounds N        (default 7)\n"
    "  --frames N        timed per turn, after one that is not (default 3)\n"
    "  --one-isa         the best instruction set alone\n"
    "  --frame           the one frame alone; writes frame.csv and frame.md\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

/* The first two are the solver's own; the next two stand beside it, where they do not take minutes; the last
 * are of the one frame alone. */
static const dpl_bench_method methods[] = {
    {.name = "holographic", .kind = DPL_SOLVER_HOLOGRAPHIC, .storage = DPL_STORAGE_FLOAT},
    {.name = "holographic half", .kind = DPL_SOLVER_HOLOGRAPHIC, .storage = DPL_STORAGE_HALF},
    {.name = "bilinear", .kind = DPL_SOLVER_CASCADES, .merge = DPL_MERGE_BILINEAR},
    {.name = "bilinear-fix", .kind = DPL_SOLVER_CASCADES, .merge = DPL_MERGE_BILINEAR_FIX},
    {.name = "bilinear exact",
     .kind = DPL_SOLVER_CASCADES,
     .merge = DPL_MERGE_BILINEAR,
     .skip = DPL_SKIP_EXACT},
    {.name = "bilinear bounded",
     .kind = DPL_SOLVER_CASCADES,
     .merge = DPL_MERGE_BILINEAR,
     .skip = DPL_SKIP_BOUNDED},
    {.name = "bilinear-fix exact",
     .kind = DPL_SOLVER_CASCADES,
     .merge = DPL_MERGE_BILINEAR_FIX,
     .skip = DPL_SKIP_EXACT},
    {.name = "bilinear-fix bounded",
     .kind = DPL_SOLVER_CASCADES,
     .merge = DPL_MERGE_BILINEAR_FIX,
     .skip = DPL_SKIP_BOUNDED},
    {.name = "holographic at half resolution",
     .kind = DPL_SOLVER_HOLOGRAPHIC,
     .resolution = DPL_RESOLUTION_HALF},
    {.name = "holographic at a quarter",
     .kind = DPL_SOLVER_HOLOGRAPHIC,
     .resolution = DPL_RESOLUTION_QUARTER},
};
enum { METHOD_COUNT = sizeof methods / sizeof methods[0], OWN = 2, BESIDE = 4, BESIDE_LARGEST = 1024 };

enum { FRAME_SIZE = 512 };

typedef struct settings {
    int32_t smallest;
    int32_t largest;
    int32_t threads;
    int32_t rounds;
    int32_t frames;
    bool one_isa;
    bool frame;
    const char *out; /* NULL: by machine */
} settings;

static int read_settings(int argc, char **argv, settings *s) {
    const dpl_bench_option options[] = {
        {"smallest", DPL_BENCH_INTEGER, &s->smallest, 16, 4096},
        {"largest", DPL_BENCH_INTEGER, &s->largest, 16, 4096},
        {"threads", DPL_BENCH_INTEGER, &s->threads, 1, DPL_MAX_THREADS},
        {"rounds", DPL_BENCH_INTEGER, &s->rounds, 1, 1000},
        {"frames", DPL_BENCH_INTEGER, &s->frames, 1, 1000},
        {"one-isa", DPL_BENCH_FLAG, &s->one_isa, 0, 0},
        {"frame", DPL_BENCH_FLAG, &s->frame, 0, 0},
        {"out", DPL_BENCH_TEXT, &s->out, 0, 0},
    };
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status == DPL_BENCH_GO && s->largest < s->smallest)
        return dpl_bench_usage(program, "--largest is below --smallest");
    return status;
}

/* ---- what is timed -------------------------------------------------------------------------------- */

static void add(dpl_bench_findings *f, const dpl_bench_trial *trial) {
    if (f->count < DPL_BENCH_MAX_TRIALS)
        f->trials[f->count++] = *trial;
}

/* One frame of the lightest scene: every method on every instruction set, and on several threads of the best.
 */
static void list_frame(dpl_bench_findings *f, const settings *s, int32_t size) {
    int32_t best = DPL_BENCH_ISAS - 1;
    while (!(dpl_isa_available() & (uint32_t)dpl_bench_isas[best]))
        best--;
    for (int32_t m = 0; m < METHOD_COUNT; m++) {
        dpl_bench_trial trial = {.method = &methods[m], .size = size, .threads = 1};
        for (int32_t i = s->one_isa ? best : 0; i <= best; i++) {
            trial.isa = dpl_bench_isas[i];
            if (dpl_isa_available() & (uint32_t)trial.isa)
                add(f, &trial);
        }
        for (trial.threads = 2; trial.threads <= s->threads; trial.threads *= 2)
            add(f, &trial);
    }
}

static void list_trials(dpl_bench_findings *f, const settings *s) {
    for (int32_t size = s->smallest; size <= s->largest && !s->frame; size *= 2) {
        for (int32_t scene = 0; scene < DPL_BENCH_WORLDS; scene++)
            for (int32_t m = 0; m < OWN; m++)
                for (int32_t threads = 1; threads <= s->threads; threads *= 2)
                    add(f, &(dpl_bench_trial){.method = &methods[m],
                                              .world = (dpl_bench_world)scene,
                                              .size = size,
                                              .threads = threads,
                                              .isa = DPL_ISA_ALL});
        for (int32_t m = OWN; m < BESIDE && size <= BESIDE_LARGEST; m++)
            add(f, &(dpl_bench_trial){.method = &methods[m], .size = size, .threads = 1, .isa = DPL_ISA_ALL});
    }
    list_frame(f, s, s->smallest <= FRAME_SIZE && FRAME_SIZE <= s->largest ? FRAME_SIZE : s->smallest);
}

/* ---- the run -------------------------------------------------------------------------------------- */

static bool run_rounds(const settings *s, dpl_bench_findings *f, dpl_bench_copy *copy, dpl_error *error) {
    for (int32_t round = 0; round < s->rounds; round++) {
        dpl_bench_copy_run(copy);
        for (int32_t i = 0; i < f->count; i++) {
            dpl_bench_trial *t = &f->trials[i];
            dpl_bench_progress("round %d of %d: %s, %s, %d px, threads %d", (int)round + 1, (int)s->rounds,
                               t->method->name, dpl_bench_world_name(t->world), (int)t->size,
                               (int)t->threads);
            if (!dpl_bench_trial_run(t, s->frames, error))
                return false;
        }
    }
    for (int32_t i = 0; i < f->count; i++)
        dpl_bench_trial_finish(&f->trials[i]);
    f->copy_rate = copy->best;
    return true;
}

static bool measure(const settings *s, dpl_bench_findings *f, dpl_error *error) {
    dpl_bench_copy copy = {0};
    bool good = dpl_bench_copy_create(&copy, DPL_BENCH_COPY_MEMORY, error);
    for (int32_t i = 0; good && i < f->count; i++)
        good = dpl_bench_trial_prepare(&f->trials[i], s->rounds * s->frames, error);
    good = good && run_rounds(s, f, &copy, error);
    dpl_bench_progress_end();
    for (int32_t i = 0; i < f->count; i++)
        dpl_bench_trial_free(&f->trials[i]);
    dpl_bench_copy_free(&copy);
    return good;
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    dpl_bench_findings *f = calloc(1, sizeof *f);
    dpl_context *context = NULL;
    dpl_status status = f ? dpl_context_create(NULL, &context) : DPL_ERROR_MEMORY;
    bool good = status == DPL_OK || dpl_error_set(error, "%s", dpl_status_text(status));
    if (good) {
        f->machine = machine;
        f->context = context;
        snprintf(f->command, sizeof f->command,
                 "bench_speed --smallest %d --largest %d --threads %d --rounds %d --frames %d%s%s",
                 (int)s->smallest, (int)s->largest, (int)s->threads, (int)s->rounds, (int)s->frames,
                 s->one_isa ? " --one-isa" : "", s->frame ? " --frame" : "");
        list_trials(f, s);
        good = measure(s, f, error) && dpl_bench_write_csv(s->frame ? "frame.csv" : "speed.csv", f, error) &&
               (s->frame ? dpl_bench_write_frame("frame.md", f, error)
                         : dpl_bench_write_markdown("speed.md", f, error));
    }
    dpl_context_destroy(context);
    free(f);
    return good;
}

int main(int argc, char **argv) {
    settings s = {.smallest = 256, .largest = 2048, .threads = 2, .rounds = 7, .frames = 3};
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256];
    int status = read_settings(argc, argv, &s);
    if (status != DPL_BENCH_GO)
        return status;
    snprintf(folder, sizeof folder, "bench/results/%s", machine.slug);
    if (dpl_bench_folder_enter(s.out ? s.out : folder, &error) && run(&s, &machine, &error))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
