/* Writes CSV and Markdown. Called by main.c at the end of a run. */
#include "report.h"

#include "../../image/file.h"

#include <inttypes.h>

/* ---- derived figures ------------------------------------------------------------------------------ */

static double pixels_of(const dpl_bench_trial *t) {
    return (double)t->size * (double)t->size;
}

/* Neighbours on the machine only ever add time: the least is the steadier figure. */
static double unit_cost(const dpl_bench_trial *t) {
    return t->cpu.min * 1e6 / (pixels_of(t) * t->levels);
}

/* Bytes that a holographic frame moves beyond a core's own caches, nothing being empty, for elements of e
 * bytes. The report states the same sum in words. */
static double bytes_per_pixel(const dpl_bench_trial *t) {
    double e = t->method->storage == DPL_STORAGE_HALF ? 2 : 4;
    double load = 17 + 2 * 4 * e;
    double world = 2 * 4 * e, segments = 2.5 * 4 * e * 33 / 32, radiance = 2 * 3 * e, sums = 12 + 12 / 2.0;
    double finish = 2 * 12 + 12;
    return load + 4 * (world + segments + radiance + sums) + finish;
}

static bool is_holographic(const dpl_bench_trial *t) {
    return t->method->kind == DPL_SOLVER_HOLOGRAPHIC;
}

/* One that differs from `like` in the fields given; NULL when there is none. */
static const dpl_bench_trial *find(const dpl_bench_findings *f, const dpl_bench_trial *like,
                                   dpl_storage storage, int32_t size, int32_t threads) {
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        if (t->method->kind == like->method->kind && t->method->merge == like->method->merge &&
            t->world == like->world && t->isa == like->isa && t->method->storage == storage &&
            t->size == size && t->threads == threads)
            return t;
    }
    return NULL;
}

/* ---- CSV ------------------------------------------------------------------------------------------ */

static void write_row(FILE *stream, const dpl_bench_trial *t) {
    fprintf(stream, "%s,%s,%d,%d,%s,%s,%d,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%" PRId64 "\n",
            t->method->name, dpl_bench_world_name(t->world), (int)t->size, (int)t->threads,
            t->isa == DPL_ISA_ALL ? "auto" : "forced", dpl_isa_name(t->used), (int)t->levels, (int)t->count,
            t->wall.min, t->wall.median, t->wall.max, t->cpu.min, t->cpu.median, t->cpu.max, unit_cost(t),
            t->memory_bytes);
}

bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    fputs("method,scene,size,threads,isa_choice,isa,levels,frames,wall_min,wall_median,wall_max,cpu_min,"
          "cpu_median,cpu_max,ns_per_pixel_and_level,solver_bytes\n",
          writer.stream);
    for (int32_t i = 0; i < f->count; i++)
        write_row(writer.stream, &f->trials[i]);
    return dpl_file_writer_close(&writer, true, error);
}

/* ---- tables --------------------------------------------------------------------------------------- */

static bool has_world(const dpl_bench_findings *f, dpl_bench_world world) {
    for (int32_t i = 0; i < f->count; i++)
        if (f->trials[i].world == world)
            return true;
    return false;
}

static void write_head(FILE *stream, const dpl_bench_findings *f) {
    fprintf(stream, "# Speed of frames\n\n- command: `%s`\n", f->command);
    dpl_bench_machine_write(f->machine, f->context, stream);
    fputs("- a frame is one solve, without drawing the field; trials take turns, round by round. Processor "
          "time is summed over\n  the threads; wall time holds what other programs took\n",
          stream);
    for (int32_t i = 0; i < DPL_BENCH_WORLDS; i++)
        if (has_world(f, (dpl_bench_world)i))
            fprintf(stream, "- %s: %s\n", dpl_bench_world_name((dpl_bench_world)i),
                    dpl_bench_world_about((dpl_bench_world)i));
}

static void write_times(FILE *stream, const dpl_bench_findings *f) {
    fputs("\n## Times\n\n| method | scene | size [px] | threads | cpu min [ms] | median | wall min [ms] | "
          "median | cpu min per pixel and level [ns] | memory [MiB] |\n|---|---|---|---|---|---|---|---|---|"
          "---|\n",
          stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        if (t->isa == DPL_ISA_ALL)
            fprintf(stream, "| %s | %s | %d | %d | **%.2f** | %.2f | %.2f | %.2f | %.2f | %.1f |\n",
                    t->method->name, dpl_bench_world_name(t->world), (int)t->size, (int)t->threads,
                    t->cpu.min, t->cpu.median, t->wall.min, t->wall.median, unit_cost(t),
                    (double)t->memory_bytes / 1048576.0);
    }
}

/* A ratio of least times and one of medians, or dashes where there is nothing to compare with. */
static void write_ratio(FILE *stream, const dpl_bench_summary *above, const dpl_bench_summary *below) {
    if (above && below)
        fprintf(stream, " %.2f (%.2f) |", above->min / below->min, above->median / below->median);
    else
        fputs(" - |", stream);
}

static void write_ratios(FILE *stream, const dpl_bench_findings *f) {
    fputs("\n## Ratios\n\nOf least times (of medians). Growth and storage: processor time. Threads: wall "
          "time, which says nothing where others were\nat work.\n\n| method | scene | size [px] | threads | "
          "this / half the size | half / float storage | 1 thread / this |\n|---|---|---|---|---|---|---|\n",
          stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        dpl_storage storage = t->method->storage;
        const dpl_bench_trial *smaller = find(f, t, storage, t->size / 2, t->threads);
        const dpl_bench_trial *floats = find(f, t, DPL_STORAGE_FLOAT, t->size, t->threads);
        const dpl_bench_trial *alone = find(f, t, storage, t->size, 1);
        if (t->isa != DPL_ISA_ALL)
            continue;
        fprintf(stream, "| %s | %s | %d | %d |", t->method->name, dpl_bench_world_name(t->world),
                (int)t->size, (int)t->threads);
        write_ratio(stream, &t->cpu, smaller ? &smaller->cpu : NULL);
        write_ratio(stream, &t->cpu, storage == DPL_STORAGE_HALF && floats ? &floats->cpu : NULL);
        write_ratio(stream, t->threads > 1 && alone ? &alone->wall : NULL, &t->wall);
        fputs("\n", stream);
    }
}

/* ---- one frame ------------------------------------------------------------------------------------ */

static bool is_of_frame(const dpl_bench_trial *t) {
    return t->isa != DPL_ISA_ALL;
}

/* The trial of the one frame by this method; NULL when there is none. */
static const dpl_bench_trial *find_frame(const dpl_bench_findings *f, const dpl_bench_method *method,
                                         dpl_isa isa, int32_t threads) {
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        if (is_of_frame(t) && t->method == method && t->isa == isa && t->threads == threads)
            return t;
    }
    return NULL;
}

/* The plain method of this kind, with the same instruction set and threads: what others are held against. */
static const dpl_bench_trial *find_standard(const dpl_bench_findings *f, const dpl_bench_trial *like,
                                            dpl_solver_kind kind, dpl_merge merge) {
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        if (is_of_frame(t) && t->method->kind == kind && t->method->merge == merge && !t->method->skip &&
            t->method->storage == DPL_STORAGE_FLOAT && t->method->resolution == DPL_RESOLUTION_FULL &&
            t->isa == like->isa && t->threads == like->threads)
            return t;
    }
    return NULL;
}

static void write_frame_row(FILE *stream, const dpl_bench_findings *f, const dpl_bench_trial *best) {
    const dpl_bench_method *m = best->method;
    const dpl_bench_trial *scalar = find_frame(f, m, DPL_ISA_SCALAR, 1);
    const dpl_bench_trial *two = find_frame(f, m, best->isa, 2);
    const dpl_bench_trial *holographic = find_standard(f, best, DPL_SOLVER_HOLOGRAPHIC, DPL_MERGE_BILINEAR);
    const dpl_bench_trial *off = find_standard(f, best, DPL_SOLVER_CASCADES, m->merge);
    fprintf(stream, "| %s |", m->name);
    for (int32_t i = 0; i < DPL_BENCH_ISAS; i++) {
        const dpl_bench_trial *t = find_frame(f, m, dpl_bench_isas[i], 1);
        if (!t)
            fputs(" - |", stream);
        else if (!scalar || t == scalar)
            fprintf(stream, " %.2f (%.2f) |", t->cpu.min, t->cpu.median);
        else
            fprintf(stream, " %.2f (%.2f), %.1f |", t->cpu.min, t->cpu.median, scalar->cpu.min / t->cpu.min);
    }
    write_ratio(stream, two ? &best->wall : NULL, two ? &two->wall : NULL);
    write_ratio(stream, m->skip && off ? &off->cpu : NULL, &best->cpu);
    write_ratio(stream, holographic ? &best->cpu : NULL, holographic ? &holographic->cpu : NULL);
    fputs("\n", stream);
}

/* A row for each method, at the last instruction set that its trials on one thread have: the best. */
static void write_frames(FILE *stream, const dpl_bench_findings *f) {
    const dpl_bench_trial *best = NULL;
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        bool last = i + 1 == f->count || f->trials[i + 1].method != t->method;
        if (!is_of_frame(t))
            continue;
        if (!best)
            fprintf(stream,
                    "\n## One frame\n\n%s, %d px, one thread where nothing else is said: least cpu [ms] "
                    "(median), gain over scalar. Then ratios of least\ntimes (medians) at the best "
                    "instruction set: wall time of one thread over two, cpu of the same merge without "
                    "skipping over\nthis, and cpu of this over `holographic`.\n\n"
                    "| method | scalar | sse2 | avx2 | avx512 | 1 / 2 threads | off / this | this / "
                    "holographic |\n|---|---|---|---|---|---|---|---|\n",
                    dpl_bench_world_name(t->world), (int)t->size);
        if (t->threads == 1)
            best = t;
        if (last)
            write_frame_row(stream, f, best);
    }
}

static void write_bytes(FILE *stream, const dpl_bench_findings *f) {
    fprintf(
        stream,
        "\n## Bytes\n\nThe model, for elements of e bytes and nothing that is empty: what leaves a core's "
        "own "
        "caches, per pixel. Loading reads\n17 bytes and writes two worlds of 4 e. Each of four quadrants "
        "reads the world twice, writes segments of level S\n(33/32 of 4 e for S = 5) and reads them once and "
        "a half, "
        "writes and reads radiance of level S (3 e), and writes its sums (12;\nthe second of each axis also "
        "reads them). Finishing reads 24 and writes 12. All else stays near. Empty blocks\nare not moved: "
        "the figure is an upper bound. One thread; a copy of 64 MiB in this run: **%.1f GB/s**, read and\n"
        "written together.\n\n| method | scene | size [px] | bytes per pixel | MB per frame | GB/s at the "
        "least cpu time | of the copy |\n|---|---|---|---|---|---|---|\n",
        f->copy_rate);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        if (!is_holographic(t) || t->threads != 1 || t->isa != DPL_ISA_ALL || t->world == DPL_BENCH_MIST)
            continue;
        double bytes = bytes_per_pixel(t) * pixels_of(t), rate = bytes / (t->cpu.min * 1e6);
        fprintf(stream, "| %s | %s | %d | %.0f | %.1f | %.1f | %.0f %% |\n", t->method->name,
                dpl_bench_world_name(t->world), (int)t->size, bytes_per_pixel(t), bytes / 1e6, rate,
                100 * rate / f->copy_rate);
    }
}

/* ---- targets -------------------------------------------------------------------------------------- */

static void write_target(FILE *stream, const dpl_bench_trial *t, const char *what, double value, double bound,
                         bool below) {
    bool met = below ? value <= bound : value >= bound;
    fprintf(stream, "- %s, %s, %s: %.2f, target %s %g: %s\n", t->method->name, dpl_bench_world_name(t->world),
            what, value, below ? "at most" : "at least", bound, met ? "met" : "**missed**");
}

/* Promised for the ARC scenes, at the best instruction set. */
static void write_targets(FILE *stream, const dpl_bench_findings *f) {
    fputs("\n## Targets\n\n", stream);
    for (int32_t i = 0; i < f->count; i++) {
        const dpl_bench_trial *t = &f->trials[i];
        bool arc = t->world == DPL_BENCH_FEW || t->world == DPL_BENCH_MANY;
        if (!is_holographic(t) || !arc || t->isa != DPL_ISA_ALL)
            continue;
        dpl_storage storage = t->method->storage;
        const dpl_bench_trial *smaller = find(f, t, storage, t->size / 2, 1);
        const dpl_bench_trial *alone = find(f, t, storage, t->size, 1);
        if (t->threads == 1 && t->size == 512)
            write_target(stream, t, "512 px on one thread, least cpu [ms]", t->cpu.min,
                         storage == DPL_STORAGE_HALF ? 20 : 30, true);
        if (t->threads == 1 && t->size == 1024 && smaller)
            write_target(stream, t, "1024 px / 512 px, least cpu", t->cpu.min / smaller->cpu.min, 5, true);
        if (t->threads == 2 && t->size == 512 && alone)
            write_target(stream, t, "512 px, gain by a second thread, least wall",
                         alone->wall.min / t->wall.min, 1.7, false);
    }
}

bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    write_head(writer.stream, f);
    write_times(writer.stream, f);
    write_ratios(writer.stream, f);
    write_frames(writer.stream, f);
    write_bytes(writer.stream, f);
    write_targets(writer.stream, f);
    return dpl_file_writer_close(&writer, true, error);
}

bool dpl_bench_write_frame(const char *path, const dpl_bench_findings *f, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    write_head(writer.stream, f);
    write_frames(writer.stream, f);
    return dpl_file_writer_close(&writer, true, error);
}
