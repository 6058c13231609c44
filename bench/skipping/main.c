/* bench_skipping: what exact and bounded ray skipping save in rays and time, and what bounded costs in
 * decibels. Run by hand as docs/benchmarks.md says, and in small by ctest. */
#include "../common/folder.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "report.h"
#include "subject.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char program[] = "bench_skipping";

static const char help[] =
    "Usage: bench_skipping [OPTIONS]\n"
    "\n"
    "Solves scenes without ray skipping, exactly and within a bound, and compares.\n"
    "Writes NAME.csv and NAME.md.\n"
    "\n"
    "  --families LIST   names with commas: families as `dapple scenes` lists them, and textured\n"
    "                    (default maze,rooms,thin,tiny,area,clutter,textured)\n"
    "  --seed N          of the first scenes (default 1: judging; 101 and up: tuning)\n"
    "  --seeds N         so many seeds in a row (default 1)\n"
    "  --count N         scenes per family and seed (default: all)\n"
    "  --size N          of a scene [px] (default 512)\n"
    "  --frames N        timed frames of each mode (default 3)\n"
    "  --merge N         0 bilinear (default), 1 bilinear-fix, 2 nearest-fix\n"
    "  --interval N      of level 0, in hundredths of a pixel; 0: the solver's default (default 100)\n"
    "  --bound N         what bounded is to keep [dB] (default 50)\n"
    "  --threads N       (default 1)\n"
    "  --name NAME       of the results (default skipping)\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

typedef struct settings {
    const char *families;
    uint64_t seed;
    int32_t seeds, count, size, frames, merge, interval, bound, threads;
    const char *name;
    const char *out;
    char command[256];
} settings;

static int read_settings(int argc, char **argv, settings *s) {
    const dpl_bench_option options[] = {
        {"families", DPL_BENCH_TEXT, &s->families, 0, 0},
        {"seed", DPL_BENCH_SEED, &s->seed, 0, 0},
        {"seeds", DPL_BENCH_INTEGER, &s->seeds, 1, 1000},
        {"count", DPL_BENCH_INTEGER, &s->count, 1, 1000},
        {"size", DPL_BENCH_INTEGER, &s->size, 16, DPL_MAX_SIZE},
        {"frames", DPL_BENCH_INTEGER, &s->frames, 1, 100},
        {"merge", DPL_BENCH_INTEGER, &s->merge, 0, 2},
        {"interval", DPL_BENCH_INTEGER, &s->interval, 0, 100000},
        {"bound", DPL_BENCH_INTEGER, &s->bound, 20, 120},
        {"threads", DPL_BENCH_INTEGER, &s->threads, 1, DPL_MAX_THREADS},
        {"name", DPL_BENCH_TEXT, &s->name, 0, 0},
        {"out", DPL_BENCH_TEXT, &s->out, 0, 0},
    };
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    char count[32] = "";
    if (s->count > 0)
        snprintf(count, sizeof count, " --count %d", (int)s->count);
    snprintf(s->command, sizeof s->command,
             "--families %s --seed %" PRIu64
             " --seeds %d%s --size %d --frames %d --merge %d --interval %d --bound %d --name %s",
             s->families, s->seed, (int)s->seeds, count, (int)s->size, (int)s->frames, (int)s->merge,
             (int)s->interval, (int)s->bound, s->name);
    return status;
}

/* Rows of all scenes, grown as they come. */
typedef struct row_list {
    dpl_bench_row *rows;
    int32_t count, capacity;
} row_list;

static dpl_bench_row *next_row(row_list *list, dpl_error *error) {
    if (list->count == list->capacity) {
        int32_t capacity = 2 * list->capacity + 64;
        dpl_bench_row *rows = realloc(list->rows, (size_t)capacity * sizeof *rows);
        if (!rows) {
            dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
            return NULL;
        }
        list->rows = rows;
        list->capacity = capacity;
    }
    return &list->rows[list->count++];
}

static bool measure_scene(const dpl_bench_plan *plan, dpl_context *context, const dpl_bench_subject *subject,
                          uint64_t seed, int32_t index, dpl_bench_row *row, dpl_error *error) {
    dpl_field *field = NULL;
    *row = (dpl_bench_row){.subject = subject->name, .seed = seed, .index = index};
    bool good = dpl_bench_subject_field(subject, seed, index, plan->size, context, &field, error) &&
                dpl_bench_measure(plan, context, field, row, error);
    dpl_field_destroy(field);
    return good;
}

static bool measure_family(const settings *s, const dpl_bench_plan *plan, dpl_context *context,
                           const char *name, row_list *list, dpl_error *error) {
    dpl_bench_subject subject;
    if (!dpl_bench_subject_find(name, &subject))
        return dpl_error_set(error, "there is no family '%s'", name);
    int32_t count = s->count && s->count < subject.count ? s->count : subject.count;
    for (int32_t i = 0; i < s->seeds * count; i++) {
        dpl_bench_row *row = next_row(list, error);
        dpl_bench_progress("%s %d of %d", name, (int)i + 1, (int)(s->seeds * count));
        if (!row ||
            !measure_scene(plan, context, &subject, s->seed + (uint64_t)(i / count), i % count, row, error))
            return false;
    }
    return true;
}

static bool measure_all(const settings *s, const dpl_bench_plan *plan, dpl_context *context, row_list *list,
                        dpl_error *error) {
    char names[256];
    bool good = snprintf(names, sizeof names, "%s", s->families) < (int)sizeof names;
    for (char *name = names, *end; good && name; name = end) {
        end = strchr(name, ',');
        if (end)
            *end++ = 0;
        good = measure_family(s, plan, context, name, list, error);
    }
    dpl_bench_progress_end();
    return good;
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    dpl_bench_plan plan = {.size = s->size, .frames = s->frames};
    plan.cascades.merge = (dpl_merge)s->merge;
    plan.cascades.interval = s->interval / 100.0;
    plan.cascades.skip.bound_db = s->bound;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context = NULL;
    row_list list = {0};
    char rows[128], table[128];
    desc.thread_count = s->threads;
    snprintf(rows, sizeof rows, "%s.csv", s->name);
    snprintf(table, sizeof table, "%s.md", s->name);
    bool good = dpl_context_create(&desc, &context) == DPL_OK || dpl_error_set(error, "no context");
    good = good && measure_all(s, &plan, context, &list, error);
    dpl_bench_findings findings = {&plan, machine, context, s->command, list.rows, list.count};
    good = good && dpl_bench_write_rows(rows, &findings, error) &&
           dpl_bench_write_table(table, &findings, error);
    dpl_context_destroy(context);
    free(list.rows);
    return good;
}

int main(int argc, char **argv) {
    settings s = {.families = "maze,rooms,thin,tiny,area,clutter,textured",
                  .seed = 1,
                  .seeds = 1,
                  .size = 512,
                  .frames = 3,
                  .interval = 100,
                  .bound = 50,
                  .threads = 1,
                  .name = "skipping"};
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
