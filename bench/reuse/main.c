/* bench_reuse: what a frame costs a solver that keeps its last frame, against one that solves anew. Run by
 * hand as docs/benchmarks.md says, and in small by ctest. */
#include "../../image/file.h"
#include "../common/folder.h"
#include "../common/machine.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "measure.h"

#include <inttypes.h>
#include <string.h>

static const char program[] = "bench_reuse";

static const char help[] =
    "Usage: bench_reuse [OPTIONS]\n"
    "\n"
    "Solves sequences of frames in which little changes, with and without reuse, and "
    "compares.\nWrites NAME.csv and NAME.md.\n"
    "\n"
    "  --smallest PX     first size (default 512)\n"
    "  --largest PX      last size, doubling (default 1024)\n"
    "  --frames N        timed frames (default 12)\n"
    "  --methods N       the first N of holographic, bilinear, bilinear-fix (default 3)\n"
    "  --threads N       (default 1)\n"
    "  --name NAME       of the results (default reuse)\n"
    "  --out DIR         where results go (default bench/results/MACHINE)\n"
    "  --help            print this text\n";

static const dpl_bench_method methods[] = {
    {"holographic", DPL_SOLVER_HOLOGRAPHIC, DPL_MERGE_BILINEAR_FIX},
    {"cascades bilinear", DPL_SOLVER_CASCADES, DPL_MERGE_BILINEAR},
    {"cascades bilinear-fix", DPL_SOLVER_CASCADES, DPL_MERGE_BILINEAR_FIX},
};

enum { METHODS = sizeof methods / sizeof methods[0], MOST_ROWS = 512 };

typedef struct settings {
    int32_t smallest, largest, frames, methods, threads;
    const char *name;
    const char *out;
} settings;

typedef struct findings {
    dpl_bench_row rows[MOST_ROWS];
    int32_t count;
} findings;

static bool measure_all(const settings *s, dpl_context *context, findings *f, dpl_error *error) {
    int32_t count;
    const dpl_bench_situation *situations = dpl_bench_situations(&count);
    for (int32_t size = s->smallest; size <= s->largest; size *= 2)
        for (int32_t i = 0; i < count; i++)
            for (int m = 0; m < s->methods && f->count < MOST_ROWS; m++) {
                dpl_bench_row *row = &f->rows[f->count++];
                dpl_bench_progress("%d px, %s, %s", (int)size, situations[i].name, methods[m].name);
                *row = (dpl_bench_row){.situation = &situations[i], .method = &methods[m], .size = size};
                if (!dpl_bench_reuse_measure(context, s->frames, row, error))
                    return false;
            }
    dpl_bench_progress_end();
    return true;
}

static bool write_csv(const char *path, const findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("size,situation,method,anew_ms,anew_most_ms,reuse_ms,reuse_most_ms,anew_rays,reuse_rays,"
          "anew_bytes,reuse_bytes,equal\n",
          writer.stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_row *r = &f->rows[i];
        fprintf(writer.stream,
                "%d,\"%s\",%s,%.3f,%.3f,%.3f,%.3f,%" PRId64 ",%" PRId64 ",%" PRId64 ",%" PRId64 ",%d\n",
                (int)r->size, r->situation->name, r->method->name, r->cpu_ms[0], r->most_ms[0], r->cpu_ms[1],
                r->most_ms[1], r->rays[0], r->rays[1], r->memory[0], r->memory[1], r->equal);
    }
    return dpl_file_writer_close(&writer, true, error);
}

static bool write_table(const char *path, const settings *s, const dpl_bench_machine *machine,
                        const dpl_context *context, const findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fprintf(writer.stream,
            "# Reuse from frame to frame\n\n- command: `bench_reuse --smallest %d --largest %d --frames %d "
            "--methods %d --threads %d --name %s`\n",
            (int)s->smallest, (int)s->largest, (int)s->frames, (int)s->methods, (int)s->threads, s->name);
    dpl_bench_machine_write(machine, context, writer.stream);
    fputs(
        "\nA frame, solved anew and with `reuse`: processor time, the least of the frames (the greatest in "
        "brackets);\ncounted rays, mean of the frames; memory of the solver.\n\n"
        "| px | what changes | method | anew [ms] | reuse [ms] | time | rays | anew, reuse [MB] | equal bits "
        "|\n|---|---|---|---|---|---|---|---|---|\n",
        writer.stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_row *r = &f->rows[i];
        fprintf(writer.stream,
                "| %d | %s | %s | %.1f (%.1f) | %.1f (%.1f) | %.3f | %.4f | %.0f, %.0f | %s |\n",
                (int)r->size, r->situation->name, r->method->name, r->cpu_ms[0], r->most_ms[0], r->cpu_ms[1],
                r->most_ms[1], r->cpu_ms[1] / r->cpu_ms[0], (double)r->rays[1] / (double)r->rays[0],
                (double)r->memory[0] / 1e6, (double)r->memory[1] / 1e6, r->equal ? "yes" : "no");
    }
    return dpl_file_writer_close(&writer, true, error);
}

static bool run(const settings *s, const dpl_bench_machine *machine, dpl_error *error) {
    static findings f;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context = NULL;
    char csv[128], table[128];
    desc.thread_count = s->threads;
    snprintf(csv, sizeof csv, "%s.csv", s->name);
    snprintf(table, sizeof table, "%s.md", s->name);
    bool good = dpl_context_create(&desc, &context) == DPL_OK || dpl_error_set(error, "no context");
    good = good && measure_all(s, context, &f, error) && write_csv(csv, &f, error) &&
           write_table(table, s, machine, context, &f, error);
    dpl_context_destroy(context);
    return good;
}

int main(int argc, char **argv) {
    settings s = {
        .smallest = 512, .largest = 1024, .frames = 12, .methods = METHODS, .threads = 1, .name = "reuse"};
    const dpl_bench_option options[] = {
        {"smallest", DPL_BENCH_INTEGER, &s.smallest, 32, DPL_MAX_SIZE},
        {"largest", DPL_BENCH_INTEGER, &s.largest, 32, DPL_MAX_SIZE},
        {"frames", DPL_BENCH_INTEGER, &s.frames, 1, 1000},
        {"methods", DPL_BENCH_INTEGER, &s.methods, 1, METHODS},
        {"threads", DPL_BENCH_INTEGER, &s.threads, 1, DPL_MAX_THREADS},
        {"name", DPL_BENCH_TEXT, &s.name, 0, 0},
        {"out", DPL_BENCH_TEXT, &s.out, 0, 0},
    };
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_error error = {""};
    char folder[256];
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    snprintf(folder, sizeof folder, "bench/results/%s", machine.slug);
    if (dpl_bench_folder_enter(s.out ? s.out : folder, &error) && run(&s, &machine, &error))
        return DPL_BENCH_DONE;
    fprintf(stderr, "%s: %s\n", program, error.text);
    return DPL_BENCH_FAILED;
}
