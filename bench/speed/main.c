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
    "dense scenes. All take turns, round by round, so that ratios hold on a busy machine too.\n"
    "Writes speed.csv and speed.md.\n"
    "\n"
    "  --smallest N      size to begin with [px] (default 256)\n"
    "  --largest N       size to end with [px] (default 2048)\n"
    "  --threads N       from 1 thread to N, doubling (default 2)\n"
    "  --rounds N        (default 7)\n"
    "  --frames N        timed per turn, after one that is not (default 3)\n"
    "  --one-isa         the best instruction set alone\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

/* The first two are the solver's own; the rest stand beside it, where they do not take minutes. */
static const dpl_bench_method methods[] = {
    {.name = "holographic", .kind = DPL_SOLVER_HOLOGRAPHIC, .storage = DPL_STORAGE_FLOAT},
    {.name = "holographic half", .kind = DPL_SOLVER_HOLOGRAPHIC, .storage = DPL_STORAGE_HALF},
    {.name = "bilinear", .kind = DPL_SOLVER_CASCADES, .merge = DPL_MERGE_BILINEAR},
    {.name = "bilinear-fix", .kind = DPL_SOLVER_CASCADES, .merge = DPL_MERGE_BILINEAR_FIX},
};
enum { METHOD_COUNT = sizeof methods / sizeof methods[0], OWN = 2, BESIDE_LARGEST = 1024 };

static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0], ISA_SIZE = 512 };

typedef struct settings {
    int32_t smallest;
    int32_t largest;
    int32_t threads;
    int32_t rounds;
    int32_t frames;
    bool one_isa;
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

/* Every instruction set of this machine, in the lightest scene, on one thread. */
static void list_isas(dpl_bench_findings *f, int32_t size) {
    for (int32_t i = 0; i < ISA_COUNT; i++)
        for (int32_t m = 0; m < OWN; m++)
            if (dpl_isa_available() & (uint32_t)isas[i])
                add(f, &(dpl_bench_trial){.method = &methods[m], .size = size, .threads = 1, .isa = isas[i]});
}

static void list_trials(dpl_bench_findings *f, const settings *s) {
    for (int32_t size = s->smallest; size <= s->largest; size *= 2) {
        for (int32_t scene = 0; scene < DPL_BENCH_WORLDS; scene++)
            for (int32_t m = 0; m < OWN; m++)
                for (int32_t threads = 1; threads <= s->threads; threads *= 2)
                    add(f, &(dpl_bench_trial){.method = &methods[m],
                                              .world = (dpl_bench_world)scene,
                                              .size = size,
                                              .threads = threads,
                                              .isa = DPL_ISA_ALL});
        for (int32_t m = OWN; m < METHOD_COUNT && size <= BESIDE_LARGEST; m++)
            add(f, &(dpl_bench_trial){.method = &methods[m], .size = size, .threads = 1, .isa = DPL_ISA_ALL});
    }
    if (!s->one_isa)
        list_isas(f, s->smallest <= ISA_SIZE && ISA_SIZE <= s->largest ? ISA_SIZE : s->smallest);
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
                 "bench_speed --smallest %d --largest %d --threads %d --rounds %d --frames %d%s",
                 (int)s->smallest, (int)s->largest, (int)s->threads, (int)s->rounds, (int)s->frames,
                 s->one_isa ? " --one-isa" : "");
        list_trials(f, s);
        good = measure(s, f, error) && dpl_bench_write_csv("speed.csv", f, error) &&
               dpl_bench_write_markdown("speed.md", f, error);
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
