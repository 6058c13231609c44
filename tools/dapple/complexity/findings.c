/* Fits and reads off figures by table. Called by complexity.c. */
#include "findings.h"

#include "bench/common/fit.h"

#include <math.h>
#include <string.h>

#define MOST_POINTS 64

/* What is fitted. Both axes are logarithms where the slope is an exponent. */
typedef enum figure { WORK, TIME, LEAST_TIME, WORK_PER_RAY_LINEAR, STEPS_PER_RAY_LINEAR } figure;

/* Along what. */
typedef enum axis { ALONG_ITEMS, ALONG_RAYS } axis;

typedef struct fit_row {
    const char *what;
    const char *unit;
    dpl_complexity_method method;
    figure figure;
    axis axis;
    double from;
    double to;
    const char *target;
    double target_low; /* both 0: none */
    double target_high;
} fit_row;

#define EXPONENT "exponent"
#define PER_DECADE "per decade"
#define ONE "1.00 +- 0.05", 0.95, 1.05
#define NONE "", 0, 0

/* Below 1000 objects what a ray costs in any case still shows. Above some 10^4 objects and 10^6 cells worlds
 * leave the processor's caches: what the method costs and what memory adds are told apart by two ranges. What
 * others do to the caches meanwhile only adds, so least times tell most about the method. */
static const fit_row fits[] = {
    {"naive, object tests", EXPONENT, DPL_COMPLEXITY_NAIVE, WORK, ALONG_ITEMS, 1, 1e9, ONE},
    {"naive, time", EXPONENT, DPL_COMPLEXITY_NAIVE, TIME, ALONG_ITEMS, 1000, 10000, ONE},
    {"naive, least time", EXPONENT, DPL_COMPLEXITY_NAIVE, LEAST_TIME, ALONG_ITEMS, 1000, 10000, ONE},
    {"naive, time", EXPONENT, DPL_COMPLEXITY_NAIVE, TIME, ALONG_ITEMS, 1000, 1e9, ONE},
    {"naive, least time", EXPONENT, DPL_COMPLEXITY_NAIVE, LEAST_TIME, ALONG_ITEMS, 1000, 1e9, ONE},
    {"naive, object tests", EXPONENT, DPL_COMPLEXITY_NAIVE, WORK, ALONG_RAYS, 1, 1e9, ONE},
    {"naive, time", EXPONENT, DPL_COMPLEXITY_NAIVE, TIME, ALONG_RAYS, 1, 1e9, NONE},
    {"bvh, node visits per ray", PER_DECADE, DPL_COMPLEXITY_BVH, STEPS_PER_RAY_LINEAR, ALONG_ITEMS, 10, 1e9,
     NONE},
    {"bvh, object tests per ray", PER_DECADE, DPL_COMPLEXITY_BVH, WORK_PER_RAY_LINEAR, ALONG_ITEMS, 10, 1e9,
     NONE},
    {"bvh, time as a power", EXPONENT, DPL_COMPLEXITY_BVH, TIME, ALONG_ITEMS, 10, 10000, NONE},
    {"bvh, least time as a power", EXPONENT, DPL_COMPLEXITY_BVH, LEAST_TIME, ALONG_ITEMS, 10, 10000, NONE},
    {"bvh, time as a power", EXPONENT, DPL_COMPLEXITY_BVH, TIME, ALONG_ITEMS, 10, 1e9, NONE},
    {"bvh, least time as a power", EXPONENT, DPL_COMPLEXITY_BVH, LEAST_TIME, ALONG_ITEMS, 10, 1e9, NONE},
    {"bvh, object tests", EXPONENT, DPL_COMPLEXITY_BVH, WORK, ALONG_RAYS, 1, 1e9, NONE},
    {"bvh, time", EXPONENT, DPL_COMPLEXITY_BVH, TIME, ALONG_RAYS, 1, 1e9, NONE},
    {"flood fill, cells visited", EXPONENT, DPL_COMPLEXITY_FLOOD, WORK, ALONG_ITEMS, 1, 1e9, ONE},
    {"flood fill, time", EXPONENT, DPL_COMPLEXITY_FLOOD, TIME, ALONG_ITEMS, 1, 1024.0 * 1024.0, ONE},
    {"flood fill, least time", EXPONENT, DPL_COMPLEXITY_FLOOD, LEAST_TIME, ALONG_ITEMS, 1, 1024.0 * 1024.0,
     ONE},
    {"flood fill, time", EXPONENT, DPL_COMPLEXITY_FLOOD, TIME, ALONG_ITEMS, 1, 1e9, ONE},
    {"flood fill, least time", EXPONENT, DPL_COMPLEXITY_FLOOD, LEAST_TIME, ALONG_ITEMS, 1, 1e9, ONE},
};

static double value_of(const dpl_complexity_case *c, figure which) {
    switch (which) {
    case WORK:
        return log10((double)c->counts[DPL_COMPLEXITY_WORK]);
    case TIME:
        return log10(c->cpu.median);
    case LEAST_TIME:
        return log10(c->cpu.min);
    case WORK_PER_RAY_LINEAR:
        return (double)c->counts[DPL_COMPLEXITY_WORK] / c->rays;
    default:
        return (double)c->counts[DPL_COMPLEXITY_STEPS] / c->rays;
    }
}

static dpl_complexity_finding *add(dpl_complexity_findings *f, const char *what, const char *unit,
                                   const char *of) {
    dpl_complexity_finding *finding = &f->list[f->count++];
    *finding = (dpl_complexity_finding){.what = what, .unit = unit, .of = of, .r2 = NAN, .target = ""};
    return finding;
}

static void judge(dpl_complexity_finding *finding, const char *target, double low, double high) {
    bool met = finding->value >= low && finding->value <= high;
    finding->target = target;
    finding->verdict = met ? DPL_COMPLEXITY_MET : DPL_COMPLEXITY_MISSED;
}

/* ---- fits ----------------------------------------------------------------------------------------- */

/* The objects at which cost is fitted along the rays: 1000, or the most there are. */
static int32_t objects_for_rays(const dpl_complexity_worlds *worlds) {
    int32_t objects = 0;
    for (int32_t i = 0; i < worlds->case_count; i++)
        if (worlds->cases[i].method == DPL_COMPLEXITY_BVH && worlds->cases[i].part == DPL_COMPLEXITY_GROWTH &&
            worlds->cases[i].size <= 1000)
            objects = worlds->cases[i].size;
    return objects;
}

/* The most rays per run that naive tracing was measured with at every size. */
static int32_t rays_for_objects(const dpl_complexity_worlds *worlds) {
    int32_t largest = 0, rays = 0;
    for (int32_t i = 0; i < worlds->case_count; i++)
        if (worlds->cases[i].method == DPL_COMPLEXITY_BVH && worlds->cases[i].size > largest)
            largest = worlds->cases[i].size;
    for (int i = 0; i < DPL_COMPLEXITY_RAY_COUNTS; i++)
        if (dpl_complexity_find(worlds, DPL_COMPLEXITY_NAIVE, largest, dpl_complexity_ray_counts[i]))
            rays = dpl_complexity_ray_counts[i];
    return rays;
}

static bool is_point(const dpl_complexity_case *c, const fit_row *row, int32_t objects, int32_t rays) {
    if (c->part != DPL_COMPLEXITY_GROWTH || c->method != row->method)
        return false;
    if (row->axis == ALONG_RAYS)
        return c->size == objects;
    const double items = dpl_complexity_items(c);
    return items >= row->from && items <= row->to && (c->rays == rays || c->rays == 0);
}

/* Two ranges are one where nothing that large was measured. */
static bool is_there(const dpl_complexity_findings *f, const char *what, double from, double to) {
    for (int32_t i = 0; i < f->count; i++)
        if (strcmp(f->list[i].what, what) == 0 && f->list[i].from == from && f->list[i].to == to)
            return true;
    return false;
}

static void add_fit(const dpl_complexity_worlds *worlds, const fit_row *row, int32_t objects,
                    dpl_complexity_findings *f) {
    double x[MOST_POINTS], y[MOST_POINTS];
    int32_t count = 0;
    for (int32_t i = 0; i < worlds->case_count && count < MOST_POINTS; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        if (!is_point(c, row, objects, f->fit_rays))
            continue;
        x[count] = log10(row->axis == ALONG_RAYS ? (double)c->rays : dpl_complexity_items(c));
        y[count++] = value_of(c, row->figure);
    }
    if (count < 3 || is_there(f, row->what, round(pow(10, x[0])), round(pow(10, x[count - 1]))))
        return;
    const dpl_bench_fit line = dpl_bench_fit_line(x, y, count);
    const char *of = row->axis == ALONG_RAYS               ? "rays"
                     : row->method == DPL_COMPLEXITY_FLOOD ? "cells"
                                                           : "objects";
    dpl_complexity_finding *finding = add(f, row->what, row->unit, of);
    finding->from = round(pow(10, x[0]));
    finding->to = round(pow(10, x[count - 1]));
    finding->points = count;
    finding->value = line.slope;
    finding->low = line.slope - line.half_width;
    finding->high = line.slope + line.half_width;
    finding->r2 = line.r2;
    if (row->target_high > 0)
        judge(finding, row->target, row->target_low, row->target_high);
}

/* ---- figures at one size -------------------------------------------------------------------------- */

static void at_size(dpl_complexity_finding *finding, double size, double low, double value, double high) {
    finding->from = finding->to = size;
    finding->points = 1;
    finding->low = low;
    finding->value = value;
    finding->high = high;
}

static void add_tests_per_ray(const dpl_complexity_worlds *worlds, dpl_complexity_findings *f) {
    const int32_t rays = dpl_complexity_ray_counts[DPL_COMPLEXITY_RAY_COUNTS - 1];
    const dpl_complexity_case *c = dpl_complexity_find(worlds, DPL_COMPLEXITY_BVH, 100000, rays);
    if (!c)
        return;
    dpl_complexity_finding *finding = add(f, "bvh, object tests per ray", "tests", "objects");
    double tests = (double)c->counts[DPL_COMPLEXITY_WORK] / c->rays;
    at_size(finding, c->size, tests, tests, tests);
    judge(finding, "at most 60", 0, 60);
}

/* By median and by least time, as exponents are. */
static void add_ns_per_cell(const dpl_complexity_worlds *worlds, int32_t side, double most,
                            dpl_complexity_findings *f) {
    const dpl_complexity_case *c = dpl_complexity_find(worlds, DPL_COMPLEXITY_FLOOD, side, 0);
    for (int least = 0; c && least < 2; least++) {
        const double cells = dpl_complexity_items(c), ns = 1e6 / cells;
        dpl_complexity_finding *finding =
            add(f, least ? "flood fill, least time" : "flood fill, time", "ns per cell", "cells");
        at_size(finding, cells, c->cpu.min * ns, (least ? c->cpu.min : c->cpu.median) * ns, c->cpu.max * ns);
        if (most > 0)
            judge(finding, "at most 8", 0, most);
    }
}

/* ---- crossover ------------------------------------------------------------------------------------ */

/* The least number of objects from which on the hierarchy is faster; one more than measured: never. Cases of
 * one size stand beside each other, naive first. `round` below 0: by the least times. */
static int32_t crossover(const dpl_complexity_worlds *worlds, int32_t round) {
    int32_t from = 1;
    for (int32_t i = 0; i + 1 < worlds->case_count; i++) {
        const dpl_complexity_case *naive = &worlds->cases[i], *bvh = naive + 1;
        if (naive->part != DPL_COMPLEXITY_CROSSOVER || naive->method != DPL_COMPLEXITY_NAIVE)
            continue;
        double naive_ms = round < 0 ? naive->cpu.min : naive->cpu_ms[round];
        double bvh_ms = round < 0 ? bvh->cpu.min : bvh->cpu_ms[round];
        if (bvh_ms >= naive_ms)
            from = naive->size + 1;
    }
    return from;
}

static void add_crossover(const dpl_complexity_worlds *worlds, dpl_complexity_findings *f) {
    dpl_complexity_finding *finding = add(f, "bvh faster than naive", "objects and more", "objects");
    int32_t low = crossover(worlds, 0), high = low;
    for (int32_t round = 1; round < worlds->plan->rounds; round++) {
        int32_t from = crossover(worlds, round);
        low = from < low ? from : low;
        high = from > high ? from : high;
    }
    finding->from = 1;
    for (int32_t i = 0; i < worlds->case_count; i++)
        if (worlds->cases[i].part == DPL_COMPLEXITY_CROSSOVER &&
            worlds->cases[i].method == DPL_COMPLEXITY_NAIVE) {
            finding->to = worlds->cases[i].size;
            finding->points++;
        }
    finding->value = crossover(worlds, -1);
    finding->low = low;
    finding->high = high;
}

void dpl_complexity_find_all(const dpl_complexity_worlds *worlds, dpl_complexity_findings *findings) {
    const int32_t objects = objects_for_rays(worlds);
    findings->count = 0;
    findings->fit_rays = rays_for_objects(worlds);
    for (size_t i = 0; i < sizeof fits / sizeof fits[0]; i++)
        add_fit(worlds, &fits[i], objects, findings);
    add_tests_per_ray(worlds, findings);
    add_ns_per_cell(worlds, 1024, 8, findings);
    add_ns_per_cell(worlds, 4096, 0, findings);
    add_crossover(worlds, findings);
}

const char *dpl_complexity_verdict_name(dpl_complexity_verdict verdict) {
    static const char *const names[] = {"", "met", "missed"};
    return names[verdict];
}
