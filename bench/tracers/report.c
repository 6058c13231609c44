/* Writes what was measured: every trial as a row of CSV, the rest as Markdown with its targets. Called by
 * main.c. */
#include "report.h"

#include "../../image/file.h"
#include "../common/fit.h"
#include "flat.h"
#include "frame.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define MOST_POINTS 64

/* ---- CSV ------------------------------------------------------------------------------------------ */

static void write_row(FILE *stream, const dpl_bench_trial *t) {
    fprintf(stream, "%s,%s,%s,%s,%d,%" PRId64 ",%" PRId64 ",%.4f,%.4f", t->part, t->set, t->query, t->method,
            (int)t->objects, t->rays, t->hits, t->tests_per_ray, t->visits_per_ray);
    fprintf(stream, ",%.2f,%.2f,%.2f,%.4f,%.4f,%.4f\n", t->summary.min, t->summary.median, t->summary.max,
            t->build_ms.min, t->build_ms.median, t->build_ms.max);
}

bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("part,set,query,method,objects,rays,hits,tests_per_ray,visits_per_ray,ns_min,ns_median,ns_max,"
          "build_ms_min,build_ms_median,build_ms_max\n",
          writer.stream);
    for (int32_t i = 0; i < f->trials->count; i++)
        write_row(writer.stream, &f->trials->trials[i]);
    return dpl_file_writer_close(&writer, true, error);
}

/* ---- looking up ----------------------------------------------------------------------------------- */

static bool is(const dpl_bench_trial *t, const char *part, const char *set, const char *method) {
    return strcmp(t->part, part) == 0 && strcmp(t->set, set) == 0 && strcmp(t->method, method) == 0;
}

/* The trial of another method with the same objects, rays and question, or NULL. */
static const dpl_bench_trial *rival(const dpl_bench_findings *f, const dpl_bench_trial *t,
                                    const char *method) {
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *other = &f->trials->trials[i];
        if (is(other, t->part, t->set, method) && other->objects == t->objects &&
            strcmp(other->query, t->query) == 0)
            return other;
    }
    return NULL;
}

static const char *verdict(bool met) {
    return met ? "met" : "**missed**";
}

/* ---- the plane ------------------------------------------------------------------------------------ */

static void write_spread(FILE *stream, const dpl_bench_summary *s, double scale, int decimals) {
    fprintf(stream, " %.*f (%.*f .. %.*f) |", decimals, s->median * scale, decimals, s->min * scale, decimals,
            s->max * scale);
}

static void write_flat_table(FILE *stream, const dpl_bench_findings *f, const char *set) {
    fprintf(stream,
            "### %s\n\n| shapes | naive [ns/ray] | tests/ray | hierarchy [ns/ray] | tests/ray | visits/ray | "
            "build [ms] |\n|---|---|---|---|---|---|---|\n",
            set);
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        const dpl_bench_trial *naive = is(t, "flat", set, "bvh") ? rival(f, t, "naive") : NULL;
        if (!naive)
            continue;
        fprintf(stream, "| %d |", (int)t->objects);
        write_spread(stream, &naive->summary, 1, 0);
        fprintf(stream, " %.0f |", naive->tests_per_ray);
        write_spread(stream, &t->summary, 1, 0);
        fprintf(stream, " %.2f | %.2f | %.3f |\n", t->tests_per_ray, t->visits_per_ray, t->build_ms.median);
    }
    fputs("\n", stream);
}

/* Which figure of a trial is fitted, over the logarithm of the objects. */
typedef enum figure { LOG_NS, LOG_TESTS, VISITS, TESTS } figure;

static double figure_of(const dpl_bench_trial *t, figure which) {
    switch (which) {
    case LOG_NS:
        return log10(t->summary.median);
    case LOG_TESTS:
        return log10(t->tests_per_ray);
    case VISITS:
        return t->visits_per_ray;
    default:
        return t->tests_per_ray;
    }
}

/* False with fewer than 3 points at `least` objects and more. */
static bool fit(const dpl_bench_findings *f, const char *set, const char *method, figure which, int32_t least,
                dpl_bench_fit *line) {
    double x[MOST_POINTS], y[MOST_POINTS];
    int32_t count = 0;
    for (int32_t i = 0; i < f->trials->count && count < MOST_POINTS; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        if (!is(t, "flat", set, method) || t->objects < least)
            continue;
        x[count] = log10(t->objects);
        y[count++] = figure_of(t, which);
    }
    if (count >= 3)
        *line = dpl_bench_fit_line(x, y, count);
    return count >= 3;
}

static void write_exponents(FILE *stream, const dpl_bench_findings *f, const char *set) {
    dpl_bench_fit line;
    if (fit(f, set, "naive", LOG_TESTS, 1, &line))
        fprintf(stream, "- naive, tests: n^%.3f +- %.3f\n", line.slope, line.half_width);
    /* Below, what a ray costs in any case still shows. */
    if (fit(f, set, "naive", LOG_NS, 1000, &line))
        fprintf(stream, "- naive, time from 1000 shapes on: n^**%.3f** +- %.3f; target 1.00 +- 0.05: %s\n",
                line.slope, line.half_width, verdict(fabs(line.slope - 1.0) <= 0.05));
    if (fit(f, set, "bvh", VISITS, 10, &line))
        fprintf(stream,
                "- hierarchy, node visits from 10 shapes on: %.2f + **%.2f** (+- %.2f) per decade, R2 %.3f\n",
                line.offset, line.slope, line.half_width, line.r2);
    if (fit(f, set, "bvh", TESTS, 10, &line))
        fprintf(stream, "- hierarchy, shape tests from 10 shapes on: %.2f + %.2f (+- %.2f) per decade\n",
                line.offset, line.slope, line.half_width);
    if (fit(f, set, "bvh", LOG_NS, 100, &line))
        fprintf(stream, "- hierarchy, time from 100 shapes on, as a power: n^%.3f +- %.3f\n", line.slope,
                line.half_width);
}

/* Between which sizes the hierarchy becomes the faster one for good, read off by logarithms. */
static void write_crossover(FILE *stream, const dpl_bench_findings *f, const char *set) {
    double crossing = 0, before = 0, before_size = 0;
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        const dpl_bench_trial *naive = is(t, "flat", set, "bvh") ? rival(f, t, "naive") : NULL;
        if (!naive)
            continue;
        double lead = log(t->summary.median / naive->summary.median), size = log(t->objects);
        if (lead < 0 && before > 0)
            crossing = exp(before_size + (size - before_size) * before / (before - lead));
        before = lead;
        before_size = size;
    }
    if (before < 0)
        fprintf(stream, "- crossover: the hierarchy is faster from about **%.0f** shapes on\n",
                fmax(1.0, crossing));
}

static void write_most_tests(FILE *stream, const dpl_bench_findings *f, const char *set) {
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        if (is(t, "flat", set, "bvh") && t->objects == 100000)
            fprintf(stream, "- hierarchy, 100000 shapes: **%.1f** tests per ray; target at most 60: %s\n",
                    t->tests_per_ray, verdict(t->tests_per_ray <= 60.0));
    }
}

static void write_flat(FILE *stream, const dpl_bench_findings *f) {
    fputs("## The plane: shapes, one after another and through the hierarchy\n\nRandom shapes that cover a "
          "tenth of a square however many they are; rays from anywhere to anywhere; nearest hits.\n\n",
          stream);
    for (int32_t set = 0; set < DPL_BENCH_FLAT_SETS; set++) {
        write_flat_table(stream, f, dpl_bench_flat_sets[set]);
        write_exponents(stream, f, dpl_bench_flat_sets[set]);
        write_crossover(stream, f, dpl_bench_flat_sets[set]);
        write_most_tests(stream, f, dpl_bench_flat_sets[set]);
        fputs("\n", stream);
    }
}

/* ---- space ---------------------------------------------------------------------------------------- */

static void write_rates(FILE *stream, const dpl_bench_summary *ns) {
    fprintf(stream, " %.2f (%.2f .. %.2f) |", 1e3 / ns->median, 1e3 / ns->max, 1e3 / ns->min);
}

/* How many times faster `t` is than its rival, round by round: both ran one right after the other. */
static dpl_bench_summary speedup(const dpl_bench_findings *f, const dpl_bench_trial *t,
                                 const dpl_bench_trial *other) {
    double ratios[DPL_BENCH_MAX_ROUNDS];
    for (int32_t round = 0; round < f->rounds; round++)
        ratios[round] = other->ns[round] / t->ns[round];
    return dpl_bench_summarise(ratios, f->rounds);
}

/* Returns the median ratio of rates, or infinity without a rival. */
static double write_race(FILE *stream, const dpl_bench_findings *f, const dpl_bench_trial *t) {
    const dpl_bench_trial *embree = rival(f, t, "embree");
    fprintf(stream, "| %d | %s | %s | %.2f | %.2f | %.2f |", (int)t->objects, t->set, t->query,
            (double)t->hits / (double)t->rays, t->tests_per_ray, t->visits_per_ray);
    write_rates(stream, &t->summary);
    if (!embree) {
        fputs(" - | - |\n", stream);
        return INFINITY;
    }
    dpl_bench_summary ratio = speedup(f, t, embree);
    write_rates(stream, &embree->summary);
    write_spread(stream, &ratio, 1, 2);
    fputs("\n", stream);
    return ratio.median;
}

static void write_builds(FILE *stream, const dpl_bench_findings *f) {
    fputs("\n| triangles | our build [ms] | Embree's [ms] |\n|---|---|---|\n", stream);
    int32_t last = 0;
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        if (strcmp(t->part, "solid") != 0 || strcmp(t->method, "bvh") != 0 || t->objects == last)
            continue;
        const dpl_bench_trial *embree = rival(f, t, "embree");
        last = t->objects;
        fprintf(stream, "| %d |", (int)t->objects);
        write_spread(stream, &t->build_ms, 1, 1);
        if (embree)
            write_spread(stream, &embree->build_ms, 1, 1);
        else
            fputs(" - |", stream);
        fputs("\n", stream);
    }
}

static void write_agreement(FILE *stream, const dpl_bench_agreement *a) {
    if (a->rays == 0)
        return;
    fprintf(stream,
            "- answers: of %" PRId64 " rays %" PRId64 " differ from Embree's (hit or not, or t by more than "
            "%g, relative); the others' t differ by at most %.1e. Allowed: %g of the rays\n",
            a->rays, a->different, (double)DPL_BENCH_DIFFERENT_T, a->largest_t, DPL_BENCH_DIFFERENT_SHARE);
}

static void write_solid(FILE *stream, const dpl_bench_findings *f) {
    const char *version = f->agreement->rays > 0 ? dpl_bench_embree_version() : NULL;
    double least = INFINITY;
    fprintf(
        stream,
        "## Space: triangles of a bumpy ball, one ray at a time\n\n%s%s. Rates in million rays per second "
        "of one thread; the ratio is taken round by round, as both run one right after the other. Median "
        "(min .. max).\n\n| triangles | rays | query | hit | tests/ray | "
        "visits/ray | ours | Embree | "
        "ours / Embree |\n|---|---|---|---|---|---|---|---|---|\n",
        version ? "Beside Embree " : "Without Embree", version ? version : "");
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        if (strcmp(t->part, "solid") == 0 && strcmp(t->method, "bvh") == 0)
            least = fmin(least, write_race(stream, f, t));
    }
    write_builds(stream, f);
    fputs("\n", stream);
    if (version)
        fprintf(stream, "- least median ratio of rates: **%.2f**; target at least 0.35: %s\n", least,
                verdict(least >= 0.35));
    write_agreement(stream, f->agreement);
    fputs("\n", stream);
}

/* ---- frames --------------------------------------------------------------------------------------- */

static void write_frames(FILE *stream, const dpl_bench_findings *f) {
    fprintf(
        stream,
        "## Frames: %d shapes that stand still, and a few that move\n\n%d x %d pixels, %d directions. A "
        "frame places the moving shapes and lights the picture, with both layers traced anew or with "
        "static hits kept (%.1f MiB). The pictures are equal bit for bit: the benchmark fails "
        "otherwise.\n\n| moving | anew [ms] | tests/ray | visits/ray | kept [ms] | tests/ray | visits/ray | "
        "anew / kept |\n|---|---|---|---|---|---|---|---|\n",
        DPL_BENCH_FRAME_STATICS, DPL_BENCH_FRAME_SIZE, DPL_BENCH_FRAME_SIZE, DPL_BENCH_FRAME_DIRECTIONS,
        (double)f->kept_bytes / 1048576.0);
    for (int32_t i = 0; i < f->trials->count; i++) {
        const dpl_bench_trial *t = &f->trials->trials[i];
        const dpl_bench_trial *kept = is(t, "frame", "discs", "anew") ? rival(f, t, "kept") : NULL;
        if (!kept)
            continue;
        double ms = (double)t->rays * 1e-6;
        fprintf(stream, "| %d |", (int)t->objects);
        write_spread(stream, &t->summary, ms, 1);
        fprintf(stream, " %.3f | %.3f |", t->tests_per_ray, t->visits_per_ray);
        write_spread(stream, &kept->summary, ms, 1);
        fprintf(stream, " %.3f | %.3f | %.1f |\n", kept->tests_per_ray, kept->visits_per_ray,
                t->summary.median / kept->summary.median);
    }
}

bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fprintf(writer.stream, "# Rays against geometry\n\n- command: `%s`\n", f->command);
    dpl_bench_machine_write(f->machine, f->context, writer.stream);
    fprintf(writer.stream,
            "- one thread, processor time; %d rounds in which all cases take turns, after one that is not "
            "counted; median (min .. max). Counters repeat exactly: the benchmark fails otherwise. "
            "Intervals are 95 %%\n\n",
            (int)f->rounds);
    write_flat(writer.stream, f);
    write_solid(writer.stream, f);
    write_frames(writer.stream, f);
    return dpl_file_writer_close(&writer, true, error);
}
