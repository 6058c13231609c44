/* bench_choosing: the same scenes lit by every method, for choosing one (docs/choosing.md). Run by hand as
 * docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "../common/sample.h"
#include "report.h"

#include <stdio.h>

static const char program[] = "bench_choosing";

static const char help[] =
    "Usage: bench_choosing [OPTIONS]\n"
    "\n"
    "Lights a handful of scenes by rays, flood fill, cascades, holographic cascades and, where there is one\n"
    "disc light, by shadows: error against the truth, time, memory. Writes choosing.csv and choosing.md.\n"
    "\n"
    "  --seed N          of the scenes and of the pixels (default 1)\n"
    "  --size N          of a scene [px] (default 512)\n"
    "  --pixels N        judged per scene (default 4096)\n"
    "  --directions N    of rays, per pixel (default 64)\n"
    "  --truth N         directions of the truth, per pixel (default 4096)\n"
    "  --rounds N        timed; of pictures that take over a second at most 3 (default 9)\n"
    "  --threads N       (default 1)\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

static const dpl_bench_choosing_scene scenes[] = {
    {"arc", 3, "few small lights, few walls"},
    {"arc", 49, "fifty lights"},
    {"maze", 5, "thin walls"},
    {"area", 0, "large lights"},
    {"shadows", 1, "one disc light"},
};

enum { SCENE_COUNT = sizeof scenes / sizeof scenes[0] };

static bool run(const dpl_bench_choosing_plan *plan, const dpl_bench_machine *machine, dpl_error *error) {
    dpl_bench_choosing_score scores[SCENE_COUNT][DPL_BENCH_CHOOSING_METHODS];
    for (int32_t i = 0; i < SCENE_COUNT; i++)
        if (!dpl_bench_choosing_judge(plan, &scenes[i], scores[i], error))
            return false;
    dpl_context *context;
    dpl_status status = dpl_context_create(NULL, &context);
    if (status != DPL_OK)
        return dpl_error_set(error, "%s", dpl_status_text(status));
    const dpl_bench_choosing_results results = {
        plan,   machine,     context,
        scenes, SCENE_COUNT, (const dpl_bench_choosing_score(*)[DPL_BENCH_CHOOSING_METHODS])scores};
    bool good = dpl_bench_choosing_write_csv("choosing.csv", &results, error) &&
                dpl_bench_choosing_write_markdown("choosing.md", &results, error);
    dpl_context_destroy(context);
    return good;
}

int main(int argc, char **argv) {
    dpl_bench_choosing_plan p = {
        .seed = 1, .size = 512, .pixels = 4096, .directions = 64, .truth = 4096, .rounds = 9, .threads = 1};
    const char *out = NULL;
    const dpl_bench_option options[] = {
        {"seed", DPL_BENCH_SEED, &p.seed, 0, 0},
        {"size", DPL_BENCH_INTEGER, &p.size, 16, 4096},
        {"pixels", DPL_BENCH_INTEGER, &p.pixels, 1, DPL_BENCH_MAX_PIXELS},
        {"directions", DPL_BENCH_INTEGER, &p.directions, 1, 1 << 20},
        {"truth", DPL_BENCH_INTEGER, &p.truth, 1, 1 << 20},
        {"rounds", DPL_BENCH_INTEGER, &p.rounds, 1, DPL_BENCH_CHOOSING_ROUNDS_MAX},
        {"threads", DPL_BENCH_INTEGER, &p.threads, 1, DPL_MAX_THREADS},
        {"out", DPL_BENCH_TEXT, &out, 0, 0},
    };
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256];
    snprintf(folder, sizeof folder, "bench/results/%s", machine.slug);
    if (dpl_bench_folder_enter(out ? out : folder, &error) && run(&p, &machine, &error))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
