/* The stopwatch over the cases, and its report. Samples of all cases and instruction sets take turns, round
 * by round, so that ratios hold on a busy machine too. Called by test_kernel_cases.c. */
#include "testing.h"

#include "kernel/timing.h"

#include "../../bench/common/clock.h"
#include "../../bench/common/copy.h"
#include "../../bench/common/folder.h"
#include "../../bench/common/machine.h"
#include "../../bench/common/options.h"
#include "../../bench/common/progress.h"
#include "../../bench/common/summary.h"
#include "../../image/file.h"

#include <stdlib.h>
#include <string.h>

/* A sample runs a case for about this long [ms], so that the clock's grain does not show. */
#define SAMPLE_MS 0.25

enum { MOST_CASES = 64, ISAS = 4, COPIES = 3 };

static const dpl_isa isas[ISAS] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};

/* Copies as large as what a core's nearest cache, its own, and neither hold. */
static const size_t copy_bytes[COPIES] = {(size_t)16 << 10, (size_t)512 << 10, DPL_BENCH_COPY_MEMORY};

/* One case on one instruction set. */
typedef struct timed {
    const dpl_kernels *kernels; /* NULL: this machine cannot */
    int32_t times;              /* runs per sample */
    double *ns;                 /* per item: [rounds] */
    dpl_bench_summary summary;
} timed;

typedef struct timing {
    dpl_case_inputs *in;
    int32_t rounds;
    int32_t count;
    unsigned char *out[MOST_CASES];
    timed timed[MOST_CASES][ISAS];
    dpl_bench_copy copies[COPIES];
    dpl_bench_machine machine;
} timing;

/* ---- the stopwatch -------------------------------------------------------------------------------- */

/* After a run that does not count: caches and branch predictors know the case, as they do within a frame. The
 * scalar march takes twice as long without. */
static double run_ms(const timing *t, int32_t number, const timed *what) {
    const dpl_kernel_case *c = dpl_kernel_case_at(number);
    c->run(c, what->kernels, t->in, t->out[number]);
    dpl_bench_time start = dpl_bench_now();
    for (int32_t i = 0; i < what->times; i++)
        c->run(c, what->kernels, t->in, t->out[number]);
    return dpl_bench_since(start).cpu_ms;
}

static void prepare(timing *t) {
    const dpl_kernel_case *c;
    for (; t->count < MOST_CASES && (c = dpl_kernel_case_at(t->count)) != NULL; t->count++) {
        t->out[t->count] = aligned_alloc(64, DPL_CASE_OUT);
        assert_non_null(t->out[t->count]);
        dpl_case_fill_out(c, t->out[t->count]);
        for (int i = 0; i < ISAS; i++) {
            timed *what = &t->timed[t->count][i];
            what->kernels = dpl_kernels_select((uint32_t)isas[i]);
            if (!what->kernels)
                continue;
            what->ns = malloc((size_t)t->rounds * sizeof *what->ns);
            assert_non_null(what->ns);
            for (what->times = 1; run_ms(t, t->count, what) < SAMPLE_MS; what->times *= 2)
                continue;
        }
    }
    assert_null(dpl_kernel_case_at(t->count));
}

static void take_times(timing *t) {
    for (int32_t round = 0; round < t->rounds; round++) {
        dpl_bench_progress("round %d of %d", (int)round + 1, (int)t->rounds);
        for (int i = 0; i < COPIES; i++)
            dpl_bench_copy_run(&t->copies[i]);
        for (int32_t n = 0; n < t->count; n++)
            for (int i = 0; i < ISAS; i++) {
                timed *what = &t->timed[n][i];
                if (what->kernels)
                    what->ns[round] =
                        run_ms(t, n, what) * 1e6 / ((double)what->times * dpl_kernel_case_at(n)->items);
            }
    }
    dpl_bench_progress_end();
    for (int32_t n = 0; n < t->count; n++)
        for (int i = 0; i < ISAS; i++)
            if (t->timed[n][i].kernels)
                t->timed[n][i].summary = dpl_bench_summarise(t->timed[n][i].ns, t->rounds);
}

/* ---- derived figures ------------------------------------------------------------------------------ */

/* What this instruction set gains over the scalar reference, by least times. */
static double gain(const timing *t, int32_t n, int isa) {
    return t->timed[n][0].summary.min / t->timed[n][isa].summary.min;
}

static double rate(const timing *t, int32_t n, int isa) {
    return dpl_kernel_case_at(n)->bytes / t->timed[n][isa].summary.min; /* byte per ns: GB/s */
}

/* The copy whose two buffers are at least as large as what a run of the case touches. */
static double copy_rate(const timing *t, int32_t n) {
    const dpl_kernel_case *c = dpl_kernel_case_at(n);
    int i = 0;
    while (i < COPIES - 1 && c->bytes * c->items > 2.0 * (double)copy_bytes[i])
        i++;
    return t->copies[i].best;
}

static int best_isa(const timing *t) {
    int best = 0;
    for (int i = 0; i < ISAS; i++)
        best = t->timed[0][i].kernels ? i : best;
    return best;
}

/* Half of what a copy reaches is taken for the memory's bound: a kernel reads more streams than it writes. */
static const char *bound(const timing *t, int32_t n, int isa) {
    if (dpl_kernel_case_at(n)->bytes == 0.0)
        return "gathers";
    return rate(t, n, isa) >= 0.5 * copy_rate(t, n) ? "memory" : "arithmetic";
}

/* ---- report --------------------------------------------------------------------------------------- */

static bool write_csv(const timing *t, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, "kernels.csv", error))
        return false;
    fputs("kernel,input,item,isa,rounds,ns_min,ns_median,gain_min,bytes_per_item,gb_per_s,copy_gb_per_s\n",
          writer.stream);
    for (int32_t n = 0; n < t->count; n++)
        for (int i = 0; i < ISAS; i++) {
            const dpl_kernel_case *c = dpl_kernel_case_at(n);
            const timed *what = &t->timed[n][i];
            if (what->kernels)
                fprintf(writer.stream, "%s,\"%s\",%s,%s,%d,%.4f,%.4f,%.2f,%g,%.2f,%.2f\n", c->kernel,
                        c->input, c->item, dpl_isa_name(isas[i]), (int)t->rounds, what->summary.min,
                        what->summary.median, gain(t, n, i), c->bytes, rate(t, n, i), copy_rate(t, n));
        }
    return dpl_file_writer_close(&writer, true, error);
}

static void write_head(const timing *t, FILE *stream) {
    fprintf(stream, "# Speed of the kernels\n\n- command: `test_kernel_cases --bench --rounds %d`\n",
            (int)t->rounds);
    dpl_bench_machine_write(&t->machine, t->in->context, stream);
    fputs("- ns per item, processor time of one thread, least of all rounds (median); a gain is the scalar "
          "reference's least\n  time over an instruction set's\n- GB/s: what the best set reads and writes, "
          "each value once, beside a copy of as much memory in this run:",
          stream);
    for (int i = 0; i < COPIES; i++)
        fprintf(stream, " %zu KiB %.0f GB/s%s", copy_bytes[i] >> 10, t->copies[i].best,
                i + 1 < COPIES ? "," : "\n");
    fputs("- bound: `memory` from half of that copy on; `arithmetic` below; `gathers` where rays decide what "
          "is read\n",
          stream);
}

static void write_table(const timing *t, FILE *stream) {
    int best = best_isa(t);
    fputs("\n| kernel | input | item | scalar [ns] |", stream);
    for (int i = 1; i <= best; i++)
        fprintf(stream, " %s | gain |", dpl_isa_name(isas[i]));
    fputs(" bytes | GB/s | of a copy | bound |\n|---|---|---|---|", stream);
    for (int i = 1; i <= best; i++)
        fputs("---|---|", stream);
    fputs("---|---|---|---|\n", stream);
    for (int32_t n = 0; n < t->count; n++) {
        const dpl_kernel_case *c = dpl_kernel_case_at(n);
        fprintf(stream, "| `%s` | %s | %s |", c->kernel, c->input, c->item);
        for (int i = 0; i <= best; i++) {
            const dpl_bench_summary *s = &t->timed[n][i].summary;
            fprintf(stream, " %.3g (%.3g) |", s->min, s->median);
            if (i > 0)
                fprintf(stream, " **%.1f** |", gain(t, n, i));
        }
        if (c->bytes > 0)
            fprintf(stream, " %g | %.1f | %.0f %% |", c->bytes, rate(t, n, best),
                    100 * rate(t, n, best) / copy_rate(t, n));
        else
            fputs(" - | - | - |", stream);
        fprintf(stream, " %s |\n", bound(t, n, best));
    }
}

/* Promised of march(): by instruction set, how many times the scalar reference. */
static void write_targets(const timing *t, FILE *stream) {
    static const double wanted[ISAS] = {0, 0, 3, 6};
    fputs("\n## Targets\n\n", stream);
    for (int32_t n = 0; n < t->count; n++)
        for (int i = 0; i < ISAS; i++)
            if (t->timed[n][i].kernels && wanted[i] > 0 &&
                strcmp(dpl_kernel_case_at(n)->kernel, "march") == 0)
                fprintf(stream,
                        "- `march`, %s, %s: %.2f times the scalar reference, target at least %g: %s\n",
                        dpl_kernel_case_at(n)->input, dpl_isa_name(isas[i]), gain(t, n, i), wanted[i],
                        gain(t, n, i) >= wanted[i] ? "met" : "**missed**");
}

static bool write_markdown(const timing *t, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, "kernels.md", error))
        return false;
    write_head(t, writer.stream);
    write_table(t, writer.stream);
    write_targets(t, writer.stream);
    return dpl_file_writer_close(&writer, true, error);
}

static void release(timing *t) {
    for (int32_t n = 0; n < t->count; n++) {
        free(t->out[n]);
        for (int i = 0; i < ISAS; i++)
            free(t->timed[n][i].ns);
    }
    for (int i = 0; i < COPIES; i++)
        dpl_bench_copy_free(&t->copies[i]);
    dpl_case_inputs_free(t->in);
}

int dpl_kernel_timing_run(int32_t rounds, const char *folder) {
    static timing t;
    dpl_error error = {""};
    char by_machine[256];
    t.machine = dpl_bench_machine_read();
    snprintf(by_machine, sizeof by_machine, "bench/results/%s", t.machine.slug);
    t.rounds = rounds;
    t.in = dpl_case_inputs_create();
    bool good = true;
    for (int i = 0; i < COPIES && good; i++)
        good = dpl_bench_copy_create(&t.copies[i], copy_bytes[i], &error);
    if (good) {
        prepare(&t);
        take_times(&t);
        good = dpl_bench_folder_enter(folder ? folder : by_machine, &error) && write_csv(&t, &error) &&
               write_markdown(&t, &error);
    }
    release(&t);
    if (!good)
        fprintf(stderr, "test_kernel_cases: %s\n", error.text);
    return good ? DPL_BENCH_DONE : DPL_BENCH_FAILED;
}
