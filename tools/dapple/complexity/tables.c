/* Prints the tables. Counts are the same for the same arguments; times are of this machine. */
#include "tables.h"

#include "../study/folder_file.h"
#include "paper.h"

#include "bench/common/scatter.h"

#include <inttypes.h>
#include <math.h>

static void put_times(FILE *stream, const dpl_complexity_case *c) {
    fprintf(stream, ",%.6f,%.6f,%.6f,%.6f\n", c->cpu.min, c->cpu.median, c->cpu.max, c->wall.median);
}

static void print_tracing(FILE *stream, const void *user) {
    const dpl_complexity_worlds *worlds = ((const dpl_complexity_results *)user)->worlds;
    static const char *const parts[] = {"growth", "crossover"};
    fputs("part,method,objects,rays,object_tests,node_visits,cpu_ms_min,cpu_ms_median,cpu_ms_max,"
          "wall_ms_median\n",
          stream);
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        if (c->method == DPL_COMPLEXITY_FLOOD)
            continue;
        fprintf(stream, "%s,%s,%d,%d,%" PRId64 ",%" PRId64, parts[c->part],
                dpl_complexity_method_name(c->method), (int)c->size, (int)c->rays,
                c->counts[DPL_COMPLEXITY_WORK], c->counts[DPL_COMPLEXITY_STEPS]);
        put_times(stream, c);
    }
}

static void print_flood(FILE *stream, const void *user) {
    const dpl_complexity_worlds *worlds = ((const dpl_complexity_results *)user)->worlds;
    fputs("width,height,cells,visits,pushes,cpu_ms_min,cpu_ms_median,cpu_ms_max,wall_ms_median\n", stream);
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        if (c->method != DPL_COMPLEXITY_FLOOD)
            continue;
        fprintf(stream, "%d,%d,%.0f,%" PRId64 ",%" PRId64, (int)c->size, (int)c->size,
                dpl_complexity_items(c), c->counts[DPL_COMPLEXITY_WORK], c->counts[DPL_COMPLEXITY_STEPS]);
        put_times(stream, c);
    }
}

static void print_findings(FILE *stream, const void *user) {
    const dpl_complexity_findings *findings = &((const dpl_complexity_results *)user)->findings;
    fputs("what,unit,over,from,to,points,value,low,high,r2,target,verdict\n", stream);
    for (int32_t i = 0; i < findings->count; i++) {
        const dpl_complexity_finding *f = &findings->list[i];
        fprintf(stream, "\"%s\",%s,%s,%.0f,%.0f,%d,%.4f,%.4f,%.4f,", f->what, f->unit, f->of, f->from, f->to,
                (int)f->points, f->value, f->low, f->high);
        if (!isnan(f->r2))
            fprintf(stream, "%.4f", f->r2);
        fprintf(stream, ",%s,%s\n", f->target, dpl_complexity_verdict_name(f->verdict));
    }
}

static void print_paper(FILE *stream, const void *user) {
    (void)user;
    fputs("objects,naive,optimized,flood\n", stream);
    for (int32_t n = 1; n <= DPL_COMPLEXITY_PAPER_LARGEST; n = dpl_bench_next_size(n))
        fprintf(stream, "%d,%.0f,%.4f,%.0f\n", (int)n, dpl_complexity_paper_naive(n),
                dpl_complexity_paper_optimized(n), dpl_complexity_paper_flood());
}

bool dpl_complexity_write_tables(const dpl_complexity_results *results, dpl_error *error) {
    static const struct {
        const char *name;
        dpl_study_print print;
    } tables[] = {
        {"tracing.csv", print_tracing},
        {"flood.csv", print_flood},
        {"findings.csv", print_findings},
        {"paper.csv", print_paper},
    };
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++)
        if (!dpl_study_write_file(results->worlds->plan->folder, tables[i].name, tables[i].print, results,
                                  error))
            return false;
    return true;
}
