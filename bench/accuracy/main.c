/* bench_accuracy: how far each method is from the truth over a family of scenes. Run by hand as
 * docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/sample.h"
#include "report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char program[] = "bench_accuracy";

static const char help[] =
    "Usage: bench_accuracy [OPTIONS]\n"
    "\n"
    "Judges every method against the reference solver at chance pixels of a family's scenes.\n"
    "Writes accuracy.csv and accuracy.md (with --tune: tuning.csv and tuning.md; with --family each:\n"
    "families.csv and families.md).\n"
    "\n"
    "  --family NAME     scenes, as `dapple scenes` lists them, or each: all families, one after the\n"
    "                    other (default arc)\n"
    "  --seed N          of the scenes and of the pixels (default 1: judging; 101 and up: tuning)\n"
    "  --count N         scenes, the family's first (default: all of them)\n"
    "  --size N          of a scene [px] (default 512)\n"
    "  --pixels N        judged per scene (default 4096)\n"
    "  --directions N    of the truth, per pixel (default 4096)\n"
    "  --bounces N       of light on walls, by the methods that know them (default 0)\n"
    "  --threads N       (default: one per processor)\n"
    "  --all             also the methods that take long\n"
    "  --tune            instead sweep the length of the first interval for each merge\n"
    "  --out DIR         where results go (default bench/results/MACHINE, with --tune bench/results)\n"
    "  --help            print this text\n";

#define MAX_FAMILIES 32

typedef struct settings {
    dpl_bench_trial trial; /* of the first family */
    const char *family;    /* or "each" */
    const dpl_scene_family *families;
    int32_t family_count;
    const char *out; /* NULL: by machine */
    bool all;
    bool tune;
} settings;

static int choose_families(settings *s) {
    dpl_bench_trial *t = &s->trial;
    s->families = strcmp(s->family, "each") == 0 ? dpl_scene_families(&s->family_count)
                                                 : dpl_scene_family_find(s->family);
    if (!s->families)
        return dpl_bench_usage(program, "there is no family '%s'", s->family);
    /* The last one has disc lights alone, which are for shadow methods: nothing emits in its world. */
    if (s->family_count > 1 && strcmp(s->families[s->family_count - 1].name, "shadows") == 0)
        s->family_count--;
    if (s->family_count > MAX_FAMILIES)
        s->family_count = MAX_FAMILIES;
    t->family = s->families;
    if (t->count > t->family->count)
        return dpl_bench_usage(program, "family '%s' has %d scenes, not %d", t->family->name,
                               (int)t->family->count, (int)t->count);
    if (s->family_count > 1 && s->tune)
        return dpl_bench_usage(program, "--tune takes one family");
    if (t->count == 0)
        t->count = t->family->count;
    return DPL_BENCH_GO;
}

static int read_settings(int argc, char **argv, settings *s) {
    dpl_bench_trial *t = &s->trial;
    const dpl_bench_option options[] = {
        {"family", DPL_BENCH_TEXT, &s->family, 0, 0},
        {"seed", DPL_BENCH_SEED, &t->seed, 0, 0},
        {"count", DPL_BENCH_INTEGER, &t->count, 1, 1000},
        {"size", DPL_BENCH_INTEGER, &t->size, 16, DPL_MAX_SIZE},
        {"pixels", DPL_BENCH_INTEGER, &t->pixels, 1, DPL_BENCH_MAX_PIXELS},
        {"directions", DPL_BENCH_INTEGER, &t->directions, 1, 1 << 20},
        {"bounces", DPL_BENCH_INTEGER, &t->bounces, 0, DPL_MAX_BOUNCES},
        {"threads", DPL_BENCH_INTEGER, &t->threads, 1, DPL_MAX_THREADS},
        {"all", DPL_BENCH_FLAG, &s->all, 0, 0},
        {"tune", DPL_BENCH_FLAG, &s->tune, 0, 0},
        {"out", DPL_BENCH_TEXT, &s->out, 0, 0},
    };
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    if (s->all && s->tune)
        return dpl_bench_usage(program, "--all and --tune exclude each other");
    if (t->bounces > 0 && s->tune)
        return dpl_bench_usage(program, "--bounces and --tune exclude each other");
    return choose_families(s);
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
    if (f->next)
        return dpl_bench_write_csv("families.csv", f, error) &&
               dpl_bench_write_families("families.md", f, error);
    return dpl_bench_write_csv("accuracy.csv", f, error) && dpl_bench_write_accuracy("accuracy.md", f, error);
}

/* Each family's first scenes, as many as the first family gives. */
static bool run_families(const settings *s, const dpl_bench_findings *common, dpl_bench_judge *judge,
                         dpl_bench_score *scores, dpl_error *error) {
    dpl_bench_findings findings[MAX_FAMILIES];
    dpl_bench_trial trials[MAX_FAMILIES];
    for (int32_t i = 0; i < s->family_count; i++) {
        trials[i] = s->trial;
        trials[i].family = &s->families[i];
        if (trials[i].count > trials[i].family->count)
            trials[i].count = trials[i].family->count;
        findings[i] = *common;
        findings[i].trial = &trials[i];
        findings[i].scores = scores;
        findings[i].next = i + 1 < s->family_count ? &findings[i + 1] : NULL;
        if (!judge_scenes(judge, &findings[i], scores, error))
            return false;
        scores += trials[i].count * common->method_count;
    }
    return write_findings(s, findings, error);
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    dpl_bench_method methods[DPL_BENCH_MAX_METHODS];
    dpl_bench_judge judge = {0};
    int32_t count = s->tune               ? dpl_bench_methods_sweep(methods)
                    : s->family_count > 1 ? dpl_bench_methods_families(s->all, methods)
                                          : dpl_bench_methods_standard(s->all, methods);
    if (s->trial.bounces > 0)
        count = dpl_bench_methods_that_bounce(methods, count);
    dpl_bench_score *scores = calloc((size_t)(s->trial.count * count * s->family_count), sizeof *scores);
    bool good = scores ? dpl_bench_judge_create(&s->trial, methods, count, &judge, error)
                       : dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    const dpl_bench_findings common = {.machine = machine,
                                       .context = judge.context,
                                       .methods = methods,
                                       .method_count = count,
                                       .options = s->tune  ? " --tune"
                                                  : s->all ? " --all"
                                                           : ""};
    good = good && run_families(s, &common, &judge, scores, error);
    dpl_bench_judge_free(&judge);
    free(scores);
    return good;
}

int main(int argc, char **argv) {
    settings s = {.trial = {.seed = 1, .size = 512, .pixels = 4096, .directions = 4096},
                  .family = "arc",
                  .family_count = 1};
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
