/* Writes CSV and Markdown. Called by main.c at the end of a run. */
#include "report.h"

#include "../../image/file.h"
#include "../common/summary.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdlib.h>

/* ---- summaries of one column ---------------------------------------------------------------------- */

static const dpl_bench_score *score_of(const dpl_bench_findings *f, int32_t scene, int32_t method) {
    return &f->scores[scene * f->method_count + method];
}

/* A column of scores: where it stands in dpl_bench_score. */
static double read_column(const dpl_bench_score *score, size_t offset) {
    return *(const double *)(const void *)((const char *)score + offset);
}

/* Over the scenes; with `over` not negative, of ratios to that method in the same scene. `values` is room for
 * one figure per scene. */
static dpl_bench_summary summarise(const dpl_bench_findings *f, int32_t method, size_t offset, int32_t over,
                                   double *values) {
    for (int32_t scene = 0; scene < f->trial->count; scene++) {
        values[scene] = read_column(score_of(f, scene, method), offset);
        if (over >= 0)
            values[scene] /= read_column(score_of(f, scene, over), offset);
    }
    return dpl_bench_summarise(values, f->trial->count);
}

#define COLUMN(member) offsetof(dpl_bench_score, member)

/* ---- what all reports share ----------------------------------------------------------------------- */

/* Rows and tables are written by one of these. */
typedef void (*write_function)(FILE *stream, const dpl_bench_findings *f, double *values);

static bool write_file(const char *path, const dpl_bench_findings *f, write_function write,
                       dpl_error *error) {
    dpl_file_writer writer;
    double *values = malloc((size_t)f->trial->count * sizeof *values);
    if (!values)
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    bool good = dpl_file_writer_open(&writer, path, error);
    if (good) {
        write(writer.stream, f, values);
        good = dpl_file_writer_close(&writer, true, error);
    }
    free(values);
    return good;
}

static void write_head(FILE *stream, const char *title, const dpl_bench_findings *f) {
    const dpl_bench_trial *t = f->trial;
    fprintf(stream,
            "# %s\n\n- command: `bench_accuracy --family %s --seed %" PRIu64
            " --count %d --size %d --pixels %d --directions %d --bounces %d --threads %d%s`\n",
            title, f->next ? "each" : t->family->name, t->seed, (int)t->count, (int)t->size, (int)t->pixels,
            (int)t->directions, (int)t->bounces, (int)dpl_context_thread_count(f->context), f->options);
    dpl_bench_machine_write(f->machine, f->context, stream);
    fprintf(stream,
            "- truth: the reference solver, %d directions per pixel, at up to %d free pixels per scene drawn "
            "by chance;\n  every method is read at the same pixels\n\n",
            (int)t->directions, (int)t->pixels);
}

/* What cascades alone have; a dash for the rest: fields of the CSV are never empty. */
static void write_schedule(FILE *stream, const dpl_bench_method *method, int32_t size) {
    dpl_schedule schedule; /* fills in what the method leaves to the library's defaults */
    if (method->kind != DPL_SOLVER_CASCADES ||
        dpl_schedule_compute(&method->cascades, size, size, &schedule) != DPL_OK) {
        fputs("-,-,-,-,", stream);
        return;
    }
    fprintf(stream, "%s,%g,%d,%g,", dpl_merge_name(method->cascades.merge), schedule.levels[0].spacing,
            (int)schedule.levels[0].directions, schedule.levels[0].t1);
}

static void write_rows_of(FILE *stream, const dpl_bench_findings *f) {
    for (int32_t scene = 0; scene < f->trial->count; scene++)
        for (int32_t i = 0; i < f->method_count; i++) {
            const dpl_bench_score *s = score_of(f, scene, i);
            fprintf(stream, "%s,%" PRIu64 ",%d,%d,%s,%s,", f->trial->family->name, f->trial->seed, (int)scene,
                    (int)f->trial->size, f->methods[i].name, dpl_solver_kind_name(f->methods[i].kind));
            write_schedule(stream, &f->methods[i], f->trial->size);
            fprintf(stream, "%.6f,%.4f,%.4f,%.6f,%.6f,%" PRId64 ",%.3f,%.3f\n", s->rel_rmse, s->psnr_linear,
                    s->psnr_display, s->bias, s->mean_truth, s->rays, s->solve_ms, s->cpu_ms);
        }
}

static void write_rows(FILE *stream, const dpl_bench_findings *f, double *values) {
    (void)values;
    fputs("family,seed,scene,size,method,solver,merge,spacing,directions,interval,rel_rmse,psnr_linear,"
          "psnr_display,bias,mean_truth,rays,solve_ms,cpu_ms\n",
          stream);
    for (const dpl_bench_findings *each = f; each; each = each->next)
        write_rows_of(stream, each);
}

bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *findings, dpl_error *error) {
    return write_file(path, findings, write_rows, error);
}

/* ---- the judgement -------------------------------------------------------------------------------- */

static void write_errors(FILE *stream, const dpl_bench_findings *f, double *values) {
    fputs("| method | rel_rmse mean | min | median | max | psnr_display mean [dB] | min | median | max "
          "| bias mean | min | max |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
          stream);
    for (int32_t i = 0; i < f->method_count; i++) {
        dpl_bench_summary e = summarise(f, i, COLUMN(rel_rmse), -1, values);
        dpl_bench_summary p = summarise(f, i, COLUMN(psnr_display), -1, values);
        dpl_bench_summary b = summarise(f, i, COLUMN(bias), -1, values);
        fprintf(stream, "| %s | **%.4f** | %.4f | %.4f | %.4f | **%.2f** | %.2f | %.2f | %.2f ",
                f->methods[i].name, e.mean, e.min, e.median, e.max, p.mean, p.min, p.median, p.max);
        fprintf(stream, "| %+.4f | %+.4f | %+.4f |\n", b.mean, b.min, b.max);
    }
}

static void write_costs(FILE *stream, const dpl_bench_findings *f, double *values) {
    fprintf(stream,
            "\n| method | rays per scene | wall median [ms] | min | max | cpu median [ms] | min | max "
            "| cpu / cpu of %s: median | min | max |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
            f->methods[0].name);
    for (int32_t i = 0; i < f->method_count; i++) {
        dpl_bench_summary wall = summarise(f, i, COLUMN(solve_ms), -1, values);
        dpl_bench_summary cpu = summarise(f, i, COLUMN(cpu_ms), -1, values);
        dpl_bench_summary ratio = summarise(f, i, COLUMN(cpu_ms), 0, values);
        fprintf(stream,
                "| %s | %" PRId64 " | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.2f | %.2f | %.2f |\n",
                f->methods[i].name, score_of(f, 0, i)->rays, wall.median, wall.min, wall.max, cpu.median,
                cpu.min, cpu.max, ratio.median, ratio.min, ratio.max);
    }
    fputs(
        "\nWall time is what this run saw, other programs on the machine included; processor time is summed "
        "over the\nthreads. Neither holds the distance field. Ratios are taken scene by scene, then "
        "summarised.\n",
        stream);
}

/* One promise: a figure, and the bound that it must not be above, or below. */
static void write_target(FILE *stream, const char *method, const char *what, double value, double bound,
                         bool above) {
    bool met = above ? value <= bound : value >= bound;
    double gap = value > bound ? value - bound : bound - value;
    if (bound > 0)
        fprintf(stream, "- %s: %s %.4g, target %.4g or %s: **%s** by %.2g (%.0f %%)\n", method, what, value,
                bound, above ? "less" : "more", met ? "met" : "missed", gap, 100 * gap / bound);
}

/* Promised for all scenes of ARC at this size, at the defaults, and for nothing else. */
static void write_targets(FILE *stream, const dpl_bench_findings *f, double *values) {
    const dpl_bench_trial *t = f->trial;
    if (t->family != dpl_scene_family_find("arc") || t->count != t->family->count || t->size != 512)
        return;
    fputs("\n## Targets\n\n", stream);
    for (int32_t i = 0; i < f->method_count; i++) {
        const dpl_bench_method *m = &f->methods[i];
        dpl_bench_summary e = summarise(f, i, COLUMN(rel_rmse), -1, values);
        dpl_bench_summary p = summarise(f, i, COLUMN(psnr_display), -1, values);
        write_target(stream, m->name, "mean rel_rmse", e.mean, m->target.mean, true);
        write_target(stream, m->name, "greatest rel_rmse", e.max, m->target.worst, true);
        write_target(stream, m->name, "mean psnr_display [dB]", p.mean, m->target.display, false);
    }
}

static void write_accuracy(FILE *stream, const dpl_bench_findings *f, double *values) {
    write_head(stream, "Accuracy against the truth", f);
    write_errors(stream, f, values);
    write_costs(stream, f, values);
    write_targets(stream, f, values);
}

bool dpl_bench_write_accuracy(const char *path, const dpl_bench_findings *findings, dpl_error *error) {
    return write_file(path, findings, write_accuracy, error);
}

/* ---- many families -------------------------------------------------------------------------------- */

/* The scene in which a method is farthest off. */
static int32_t find_worst(const dpl_bench_findings *f, int32_t method) {
    int32_t worst = 0;
    for (int32_t scene = 1; scene < f->trial->count; scene++)
        if (score_of(f, scene, method)->rel_rmse > score_of(f, worst, method)->rel_rmse)
            worst = scene;
    return worst;
}

static void write_families(FILE *stream, const dpl_bench_findings *f, double *values) {
    write_head(stream, "Accuracy by family of scenes", f);
    fputs("rel_rmse: mean over the family's first scenes (greatest, and the number of that scene).\n\n"
          "| family | scenes |",
          stream);
    for (int32_t i = 0; i < f->method_count; i++)
        fprintf(stream, " %s |", f->methods[i].name);
    fputs("\n|---|---|", stream);
    for (int32_t i = 0; i < f->method_count; i++)
        fputs("---|", stream);
    fputs("\n", stream);
    for (const dpl_bench_findings *each = f; each; each = each->next) {
        fprintf(stream, "| %s | %d |", each->trial->family->name, (int)each->trial->count);
        for (int32_t i = 0; i < f->method_count; i++) {
            dpl_bench_summary e = summarise(each, i, COLUMN(rel_rmse), -1, values);
            fprintf(stream, " **%.4f** (%.4f, #%d) |", e.mean, e.max, (int)find_worst(each, i));
        }
        fputs("\n", stream);
    }
}

bool dpl_bench_write_families(const char *path, const dpl_bench_findings *findings, dpl_error *error) {
    return write_file(path, findings, write_families, error);
}

/* ---- the sweep ------------------------------------------------------------------------------------ */

/* The method of this merge with the least mean error. */
static int32_t find_best(const dpl_bench_findings *f, dpl_merge merge, double *values) {
    int32_t best = -1;
    double least = 0;
    for (int32_t i = 0; i < f->method_count; i++) {
        if (f->methods[i].cascades.merge != merge)
            continue;
        double mean = summarise(f, i, COLUMN(rel_rmse), -1, values).mean;
        if (best < 0 || mean < least) {
            best = i;
            least = mean;
        }
    }
    return best;
}

static void write_tuning(FILE *stream, const dpl_bench_findings *f, double *values) {
    write_head(stream, "Length of the first interval, swept", f);
    fputs("Spacing 1, 4 directions. The least mean error of each merge is in bold. These seeds are for "
          "choosing defaults; judging\nuses others.\n\n"
          "| merge | interval [px] | rel_rmse mean | min | median | max | psnr_display mean [dB] | bias mean "
          "| rays | cpu median [ms] |\n|---|---|---|---|---|---|---|---|---|---|\n",
          stream);
    for (int32_t i = 0; i < f->method_count; i++) {
        const dpl_cascades_desc *c = &f->methods[i].cascades;
        const char *mark = find_best(f, c->merge, values) == i ? "**" : "";
        dpl_bench_summary e = summarise(f, i, COLUMN(rel_rmse), -1, values);
        fprintf(stream, "| %s | %g | %s%.4f%s | %.4f | %.4f | %.4f ", dpl_merge_name(c->merge), c->interval,
                mark, e.mean, mark, e.min, e.median, e.max);
        fprintf(stream, "| %.2f | %+.4f | %" PRId64 " | %.0f |\n",
                summarise(f, i, COLUMN(psnr_display), -1, values).mean,
                summarise(f, i, COLUMN(bias), -1, values).mean, score_of(f, 0, i)->rays,
                summarise(f, i, COLUMN(cpu_ms), -1, values).median);
    }
}

bool dpl_bench_write_tuning(const char *path, const dpl_bench_findings *findings, dpl_error *error) {
    return write_file(path, findings, write_tuning, error);
}
