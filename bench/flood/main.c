/* bench_flood: what tile light costs. Run by hand as docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "report.h"

#include <stdio.h>

static const char program[] = "bench_flood";

static const char help[] =
    "Usage: bench_flood [OPTIONS]\n"
    "\n"
    "Times flood-fill light: solves of worlds that double in size, level-14 torches and single blocks in\n"
    "3D, and counts what depth first would visit. Writes flood.csv and flood.md.\n"
    "\n"
    "  --largest N       side of the largest 2D world, from 64 doubling (default 4096)\n"
    "  --side N          side of the 3D world, at least 32 (default 128)\n"
    "  --frames N        samples of each figure (default 40)\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

static bool run(const dpl_bench_flood_plan *plan, const dpl_bench_machine *machine, dpl_error *error) {
    static dpl_bench_flood_table table;
    return dpl_bench_flood_measure(plan, &table, error) &&
           dpl_bench_flood_write_csv("flood.csv", &table, error) &&
           dpl_bench_flood_write_markdown("flood.md", plan, machine, &table, error);
}

int main(int argc, char **argv) {
    dpl_bench_flood_plan plan = {.largest = 4096, .side = 128, .frames = 40};
    const char *out = NULL;
    const dpl_bench_option options[] = {
        {"largest", DPL_BENCH_INTEGER, &plan.largest, 64, 8192},
        {"side", DPL_BENCH_INTEGER, &plan.side, 32, 512},
        {"frames", DPL_BENCH_INTEGER, &plan.frames, 1, 1000},
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
    dpl_status made = dpl_context_create(NULL, &plan.context);
    bool good = made == DPL_OK || dpl_error_set(&error, "%s", dpl_status_text(made));
    good = good && dpl_bench_folder_enter(out ? out : folder, &error) && run(&plan, &machine, &error);
    dpl_context_destroy(plan.context);
    if (good)
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
