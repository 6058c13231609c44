/* Writes CSV and Markdown. Called by main.c at the end of a run. */
#include "report.h"

#include "../../image/file.h"

#include <inttypes.h>

static const char *const part_names[DPL_BENCH_PARTS] = {"draw", "distance", "solve"};

/* ---- CSV ------------------------------------------------------------------------------------------ */

static void write_header(FILE *stream) {
    fputs("merge,threads,size,levels,rays,frames", stream);
    for (int32_t part = 0; part < DPL_BENCH_PARTS; part++)
        fprintf(stream, ",%s_wall_min,%s_wall_median,%s_wall_max,%s_cpu_min,%s_cpu_median,%s_cpu_max",
                part_names[part], part_names[part], part_names[part], part_names[part], part_names[part],
                part_names[part]);
    fputs(",solver_bytes,total_bytes,later_allocations\n", stream);
}

static void write_row(FILE *stream, const dpl_bench_measurement *m, int32_t frames) {
    fprintf(stream, "%s,%d,%d,%d,%" PRId64 ",%d", dpl_merge_name(m->which.merge), (int)m->which.threads,
            (int)m->which.size, (int)m->levels, m->rays, (int)frames);
    for (int32_t part = 0; part < DPL_BENCH_PARTS; part++) {
        const dpl_bench_summary *wall = &m->wall_ms[part], *cpu = &m->cpu_ms[part];
        fprintf(stream, ",%.4f,%.4f,%.4f,%.4f,%.4f,%.4f", wall->min, wall->median, wall->max, cpu->min,
                cpu->median, cpu->max);
    }
    fprintf(stream, ",%" PRId64 ",%" PRId64 ",%" PRId64 "\n", m->solver_bytes, m->total_bytes,
            m->later_allocations);
}

bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    write_header(writer.stream);
    for (int32_t i = 0; i < f->count; i++)
        write_row(writer.stream, &f->measurements[i], f->subject->frames);
    return dpl_file_writer_close(&writer, true, error);
}

/* ---- derived figures ------------------------------------------------------------------------------ */

static double pixels_of(const dpl_bench_measurement *m) {
    return (double)m->which.size * (double)m->which.size;
}

/* Processor time per pixel and level [ns], from the median or the least time of a solve [ms]. */
static double unit_cost(const dpl_bench_measurement *m, double ms) {
    return ms * 1e6 / (pixels_of(m) * m->levels);
}

static double median_cost(const dpl_bench_measurement *m) {
    return unit_cost(m, m->cpu_ms[DPL_BENCH_SOLVE].median);
}

/* Neighbours on the machine only ever add time: on a busy one this is the steadier figure. */
static double least_cost(const dpl_bench_measurement *m) {
    return unit_cost(m, m->cpu_ms[DPL_BENCH_SOLVE].min);
}

/* The measurement of another size or thread count, or NULL. */
static const dpl_bench_measurement *find(const dpl_bench_findings *f, dpl_bench_case which) {
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_case *c = &f->measurements[i].which;
        if (c->merge == which.merge && c->threads == which.threads && c->size == which.size)
            return &f->measurements[i];
    }
    return NULL;
}

static const dpl_bench_measurement *at_size(const dpl_bench_findings *f, const dpl_bench_measurement *m,
                                            int32_t size) {
    return find(f, (dpl_bench_case){m->which.merge, m->which.threads, size});
}

/* ---- Markdown ------------------------------------------------------------------------------------- */

static void write_head(FILE *stream, const dpl_bench_findings *f) {
    const dpl_bench_subject *s = f->subject;
    fprintf(stream,
            "# Time and memory against size\n\n- command: `bench_scaling --family %s --seed %" PRIu64
            " --scene %d --smallest %d --largest %d --threads %d --frames %d`\n",
            s->family->name, s->seed, (int)s->scene, (int)f->smallest, (int)f->largest, (int)f->max_threads,
            (int)s->frames);
    dpl_bench_machine_write(f->machine, f->context, stream);
    fprintf(
        stream,
        "- %d frames after one that is not counted, each with field drawing, distance transform and solve; "
        "times are\n  median (min .. max). Processor time is summed over the threads; wall time holds what "
        "other programs took\n\n![time per pixel and level](scaling.png)\n\n",
        (int)s->frames);
}

static void write_time(FILE *stream, const dpl_bench_summary *ms, int decimals) {
    fprintf(stream, " %.*f (%.*f .. %.*f) |", decimals, ms->median, decimals, ms->min, decimals, ms->max);
}

static void write_solves(FILE *stream, const dpl_bench_findings *f) {
    fputs("## Solve\n\n| merge | threads | size [px] | levels | rays | wall [ms] | cpu [ms] | cpu per pixel "
          "and level [ns] | ratio to linear | the same of least times | wall of 1 thread / wall |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|\n",
          stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_measurement *m = &f->measurements[i];
        const dpl_bench_measurement *small = at_size(f, m, f->smallest);
        const dpl_bench_measurement *alone = find(f, (dpl_bench_case){m->which.merge, 1, m->which.size});
        fprintf(stream, "| %s | %d | %d | %d | %" PRId64 " |", dpl_merge_name(m->which.merge),
                (int)m->which.threads, (int)m->which.size, (int)m->levels, m->rays);
        write_time(stream, &m->wall_ms[DPL_BENCH_SOLVE], 0);
        write_time(stream, &m->cpu_ms[DPL_BENCH_SOLVE], 0);
        fprintf(stream, " %.1f | %.2f | %.2f | %.2f |\n", median_cost(m), median_cost(m) / median_cost(small),
                least_cost(m) / least_cost(small),
                alone->wall_ms[DPL_BENCH_SOLVE].median / m->wall_ms[DPL_BENCH_SOLVE].median);
    }
}

static void write_growth(FILE *stream, const dpl_bench_findings *f) {
    fputs("\nRatio to linear: processor time per pixel and level over that at the smallest size, same merge "
          "and "
          "threads; 1 is growth\nexactly as pixels x levels. Medians, and least times, which other programs "
          "disturb "
          "less.\n\n",
          stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_measurement *m = &f->measurements[i];
        if (m->which.size != f->largest || f->largest == f->smallest)
            continue;
        const dpl_bench_measurement *small = at_size(f, m, f->smallest);
        double work = pixels_of(m) * m->levels / (pixels_of(small) * small->levels);
        fprintf(
            stream,
            "- %s, %d thread%s, %d -> %d px: pixels x levels grow %.1f-fold; per pixel and level **%.2f** of "
            "linear by medians, **%.2f** by least times\n",
            dpl_merge_name(m->which.merge), (int)m->which.threads, m->which.threads > 1 ? "s" : "",
            (int)f->smallest, (int)f->largest, work, median_cost(m) / median_cost(small),
            least_cost(m) / least_cost(small));
    }
}

/* The field does not know the merge: the first one's figures are shown. */
static void write_fields(FILE *stream, const dpl_bench_findings *f) {
    fputs(
        "\n## Field\n\n| threads | size [px] | drawing: wall [ms] | cpu per pixel [ns] | distance transform: "
        "wall [ms] | cpu per pixel [ns] |\n|---|---|---|---|---|---|\n",
        stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_measurement *m = &f->measurements[i];
        if (m->which.merge != f->measurements[0].which.merge)
            continue;
        fprintf(stream, "| %d | %d |", (int)m->which.threads, (int)m->which.size);
        for (int32_t part = DPL_BENCH_DRAW; part <= DPL_BENCH_DISTANCE; part++) {
            write_time(stream, &m->wall_ms[part], 2);
            fprintf(stream, " %.2f |", m->cpu_ms[part].median * 1e6 / pixels_of(m));
        }
        fputs("\n", stream);
    }
    fputs("\nThe distance transform's time holds one copy of its result.\n", stream);
}

static void write_memory(FILE *stream, const dpl_bench_findings *f) {
    fputs("\n## Memory\n\n| merge | threads | size [px] | solver [MiB] | solver + field + context, counted "
          "[MiB] | bytes per pixel | allocations after the first frame |\n|---|---|---|---|---|---|---|\n",
          stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_measurement *m = &f->measurements[i];
        fprintf(stream, "| %s | %d | %d | %.1f | %.1f | %.1f | %" PRId64 " |\n",
                dpl_merge_name(m->which.merge), (int)m->which.threads, (int)m->which.size,
                (double)m->solver_bytes / 1048576.0, (double)m->total_bytes / 1048576.0,
                (double)m->total_bytes / pixels_of(m), m->later_allocations);
    }
}

bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    write_head(writer.stream, f);
    write_solves(writer.stream, f);
    write_growth(writer.stream, f);
    write_fields(writer.stream, f);
    write_memory(writer.stream, f);
    return dpl_file_writer_close(&writer, true, error);
}
