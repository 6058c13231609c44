/* bench_accuracy: how far each method is from the truth over a family of scenes. Run by hand as
 * docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/sample.h"
#include "report.h"

#include <stdio.h>
#include <stdlib.h>

static const char program[] = "bench_accuracy";

static const char help[] =
    "Usage: bench_accuracy [OPTIONS]\n"
    "\n"
    "Judges every method against the reference solver at chance pixels of a family's scenes.\n"
    "Writes accuracy.csv and accuracy.md (with --tune: tuning.csv and tuning.md).\n"
    "\n"
    "  --family NAME     scenes, as `dapple scenes` lists them (default arc)\n"
    "  --seed N          of the scenes and of the pixels (default 1: judging; 101 and up: tuning)\n"
    "  --count N         scenes (default: all of the family)\n"
    "  --size N          of a scene [px] (default 512)\n"
    "  --pixels N        judged per scene (default 4096)\n"
    "  --directions N    of the truth, per pixel (default 4096)\n"
    "  --threads N       (default: one per processor)\n"
    "  --all             also the methods that take long\n"
    "  --tune            instead sweep the length of the first interval for each merge\n"
    "  --out DIR         where results go (default bench/results/MACHINE, with --tune bench/results)\n"
    "  --help            print this text\n";

typedef struct settings {
    dpl_bench_trial trial;
    const char *family;
    const char *out; /* NULL: by machine */
    bool all;
    bool tune;
} settings;

static int read_settings(int argc, char **argv, settings *s) {
    dpl_bench_trial *t = &s->trial;
    const dpl_bench_option options[] = {
        {"family", DPL_BENCH_TEXT, &s->family, 0, 0},
        {"seed", DPL_BENCH_SEED, &t->seed, 0, 0},
        {"count", DPL_BENCH_INTEGER, &t->count, 1, 1000},
        {"size", DPL_BENCH_INTEGER, &t->size, 16, DPL_MAX_SIZE},
        {"pixels", DPL_BENCH_INTEGER, &t->pixels, 1, DPL_BENCH_MAX_PIXELS},
        {"directions", DPL_BENCH_INTEGER, &t->directions, 1, 1 << 20},
        {"threads", DPL_BENCH_INTEGER, &t->threads, 1, DPL_MAX_THREADS},
        {"all", DPL_BENCH_FLAG, &s->all, 0, 0},
        {"tune", DPL_BENCH_FLAG, &s->tune, 0, 0},
        {"out", DPL_BENCH_TEXT, &s->out, 0, 0},
    };
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    t->family = dpl_scene_family_find(s->family);
    if (!t->family)
        return dpl_bench_usage(program, "there is no family '%s'", s->family);
    if (t->count > t->family->count)
        return dpl_bench_usage(program, "family '%s' has %d scenes, not %d", s->family, (int)t->family->count,
                               (int)t->count);
    if (s->all && s->tune)
        return dpl_bench_usage(program, "--all and --tune exclude each other");
    if (t->count == 0)
        t->count = t->family->count;
    return DPL_BENCH_GO;
}

static bool judge_scenes(dpl_bench_judge *judge, const dpl_bench_findings *f, dpl_bench_score *scores,
                         dpl_error *error) {
    for (int32_t i = 0; i < f->trial->count; i++)
        if (!dpl_bench_judge_scene(judge, f->trial, i, &scores[i * f->method_count], error))
            return false;
    return true;
}

static bool write_findings(const settings *s, const dpl_bench_findings *f, dpl_error *error) {
    if (s->tune)
        return dpl_bench_write_csv("tuning.csv", f, error) && dpl_bench_write_tuning("tuning.md", f, error);
    return dpl_bench_write_csv("accuracy.csv", f, error) && dpl_bench_write_accuracy("accuracy.md", f, error);
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    dpl_bench_method methods[DPL_BENCH_MAX_METHODS];
    dpl_bench_judge judge = {0};
    int32_t count = s->tune ? dpl_bench_methods_sweep(methods) : dpl_bench_methods_standard(s->all, methods);
    dpl_bench_score *scores = calloc((size_t)(s->trial.count * count), sizeof *scores);
    bool good = scores ? dpl_bench_judge_create(&s->trial, methods, count, &judge, error)
                       : dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    dpl_bench_findings findings = {&s->trial,
                                   machine,
                                   judge.context,
                                   methods,
                                   count,
                                   scores,
                                   s->tune ? " --tune" : s->all ? " --all" : ""};
    good = good && judge_scenes(&judge, &findings, scores, error) && write_findings(s, &findings, error);
    dpl_bench_judge_free(&judge);
    free(scores);
    return good;
}

int main(int argc, char **argv) {
    settings s = {.trial = {.seed = 1, .size = 512, .pixels = 4096, .directions = 4096}, .family = "arc"};
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256];
    int status = read_settings(argc, argv, &s);
    if (status != DPL_BENCH_GO)
        return status;
    snprintf(folder, sizeof folder, "bench/results/%s", s.tune ? "" : machine.slug);
    if (dpl_bench_folder_enter(s.out ? s.out : folder, &error) && run(&s, &machine, &error))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
