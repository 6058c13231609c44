/* Writes a row per scene, and a table with a row per family. Called by main.c. */
#include "report.h"

#include "../../image/file.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

bool dpl_bench_write_rows(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("family,seed,scene,exact_saved,exact_equal,exact_time,bounded_saved,bounded_psnr_display,"
          "bounded_rel_rmse,bounded_time,guessed,checked,wrong,off_ms\n",
          writer.stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_row *r = &f->rows[i];
        fprintf(writer.stream,
                "%s,%" PRIu64 ",%d,%.5f,%d,%.3f,%.5f,%.2f,%.3g,%.3f,%.5f,%" PRId64 ",%" PRId64 ",%.2f\n",
                r->subject, r->seed, (int)r->index, r->saved[DPL_BENCH_EXACT], r->equal[DPL_BENCH_EXACT],
                r->cpu_ms[DPL_BENCH_EXACT] / r->cpu_ms[DPL_BENCH_OFF], r->saved[DPL_BENCH_BOUNDED],
                r->psnr_display[DPL_BENCH_BOUNDED], r->rel_rmse[DPL_BENCH_BOUNDED],
                r->cpu_ms[DPL_BENCH_BOUNDED] / r->cpu_ms[DPL_BENCH_OFF], r->guessed, r->checked, r->wrong,
                r->cpu_ms[DPL_BENCH_OFF]);
    }
    return dpl_file_writer_close(&writer, true, error);
}

/* Over the scenes of one family; all times are sums. */
typedef struct family_sum {
    int32_t count, equal;
    double saved[DPL_BENCH_MODES], least_saved[DPL_BENCH_MODES], cpu_ms[DPL_BENCH_MODES];
    double lowest_db, greatest_error;
} family_sum;

static void add_row(family_sum *s, const dpl_bench_row *r) {
    for (int m = 0; m < DPL_BENCH_MODES; m++) {
        s->saved[m] += r->saved[m];
        s->cpu_ms[m] += r->cpu_ms[m];
        if (s->count == 0 || r->saved[m] < s->least_saved[m])
            s->least_saved[m] = r->saved[m];
    }
    if (s->count == 0 || r->psnr_display[DPL_BENCH_BOUNDED] < s->lowest_db)
        s->lowest_db = r->psnr_display[DPL_BENCH_BOUNDED];
    s->greatest_error = fmax(s->greatest_error, r->rel_rmse[DPL_BENCH_BOUNDED]);
    s->equal += r->equal[DPL_BENCH_EXACT];
    s->count++;
}

static void write_sum(FILE *stream, const char *name, const family_sum *s) {
    fprintf(stream,
            "| %s | %d | %.1f / %.1f %% | %d of %d | %.2f | %.1f / %.1f %% | %.1f dB | %.2g | %.2f |\n", name,
            (int)s->count, 100.0 * s->saved[DPL_BENCH_EXACT] / s->count,
            100.0 * s->least_saved[DPL_BENCH_EXACT], (int)s->equal, (int)s->count,
            s->cpu_ms[DPL_BENCH_EXACT] / s->cpu_ms[DPL_BENCH_OFF],
            100.0 * s->saved[DPL_BENCH_BOUNDED] / s->count, 100.0 * s->least_saved[DPL_BENCH_BOUNDED],
            s->lowest_db, s->greatest_error, s->cpu_ms[DPL_BENCH_BOUNDED] / s->cpu_ms[DPL_BENCH_OFF]);
}

static void write_sums(FILE *stream, const dpl_bench_findings *f) {
    family_sum all = {0};
    for (int32_t i = 0; i < f->count;) {
        family_sum family = {0};
        const char *name = f->rows[i].subject;
        for (; i < f->count && strcmp(f->rows[i].subject, name) == 0; i++) {
            add_row(&family, &f->rows[i]);
            add_row(&all, &f->rows[i]);
        }
        write_sum(stream, name, &family);
        if (i == f->count && family.count < all.count)
            write_sum(stream, "all", &all);
    }
}

bool dpl_bench_write_table(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fprintf(writer.stream, "# Ray skipping, exact and bounded\n\n- command: `bench_skipping %s`\n",
            f->command);
    dpl_bench_machine_write(f->machine, f->context, writer.stream);
    fprintf(writer.stream,
            "\nAll against `off` at the same settings. Saved: counted rays, sweeps and checks among them, "
            "mean / least "
            "over\nthe scenes. Time: processor time, least of %d frames each in turns, sum over the scenes / "
            "that of "
            "off; the\ndistance field is measured before. Lowest: psnr_display of the worst scene (120: "
            "equal).\n\n"
            "| family | scenes | exact: saved | equal bits | time | bounded: saved | lowest | rel_rmse at "
            "most | time "
            "|\n|---|---|---|---|---|---|---|---|---|\n",
            (int)f->plan->frames);
    write_sums(writer.stream, f);
    return dpl_file_writer_close(&writer, true, error);
}
