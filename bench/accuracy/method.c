/* The tables of methods. Called by main.c. */
#include "method.h"

#include <stdio.h>
#include <string.h>

#define COUNT(list) (int32_t)(sizeof(list) / sizeof(list)[0])

/* The first is what the others' times are compared with. */
static const dpl_bench_method standard[] = {
    {.name = "holographic", .kind = DPL_SOLVER_HOLOGRAPHIC, .target = {0.013, 0.022, 48}},
    {.name = "holographic half",
     .kind = DPL_SOLVER_HOLOGRAPHIC,
     .holographic = {.storage = DPL_STORAGE_HALF},
     .target = {0.013, 0.022, 48}},
    {.name = "bilinear", .cascades = {.merge = DPL_MERGE_BILINEAR}, .target = {.mean = 0.060}},
    {.name = "bilinear-fix", .cascades = {.merge = DPL_MERGE_BILINEAR_FIX}, .target = {.mean = 0.035}},
    {.name = "nearest-fix", .cascades = {.merge = DPL_MERGE_NEAREST_FIX}},
    {.name = "bilinear spacing 2 directions 16",
     .cascades = {.merge = DPL_MERGE_BILINEAR, .spacing = 2, .directions = 16}},
    {.name = "bilinear-fix spacing 2 directions 16",
     .cascades = {.merge = DPL_MERGE_BILINEAR_FIX, .spacing = 2, .directions = 16}},
};

/* The first of those above, and then cascades: what a table of families has room for. */
enum { IN_FAMILIES = 4 };

/* In families there is room for the first. */
static const dpl_bench_method slow[] = {
    {.name = "holographic double",
     .kind = DPL_SOLVER_HOLOGRAPHIC,
     .holographic = {.resolution = DPL_RESOLUTION_DOUBLE}},
    {.name = "holographic half resolution",
     .kind = DPL_SOLVER_HOLOGRAPHIC,
     .holographic = {.resolution = DPL_RESOLUTION_HALF}},
    {.name = "holographic quarter resolution",
     .kind = DPL_SOLVER_HOLOGRAPHIC,
     .holographic = {.resolution = DPL_RESOLUTION_QUARTER}},
    {.name = "bilinear-fix directions 16", .cascades = {.merge = DPL_MERGE_BILINEAR_FIX, .directions = 16}},
};

/* [px] at spacing 1. */
static const double intervals[] = {0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 4};
static const dpl_merge merges[] = {DPL_MERGE_BILINEAR, DPL_MERGE_BILINEAR_FIX, DPL_MERGE_NEAREST_FIX};

int32_t dpl_bench_methods_standard(bool all, dpl_bench_method methods[DPL_BENCH_MAX_METHODS]) {
    memcpy(methods, standard, sizeof standard);
    if (!all)
        return COUNT(standard);
    memcpy(methods + COUNT(standard), slow, sizeof slow);
    return COUNT(standard) + COUNT(slow);
}

int32_t dpl_bench_methods_families(bool all, dpl_bench_method methods[DPL_BENCH_MAX_METHODS]) {
    memcpy(methods, standard, IN_FAMILIES * sizeof *methods);
    if (all)
        methods[IN_FAMILIES] = slow[0];
    return all ? IN_FAMILIES + 1 : IN_FAMILIES;
}

int32_t dpl_bench_methods_sweep(dpl_bench_method methods[DPL_BENCH_MAX_METHODS]) {
    int32_t count = 0;
    for (int32_t m = 0; m < COUNT(merges); m++)
        for (int32_t i = 0; i < COUNT(intervals); i++, count++) {
            dpl_bench_method *method = &methods[count];
            *method = (dpl_bench_method){.cascades = {.merge = merges[m], .interval = intervals[i]}};
            snprintf(method->name, sizeof method->name, "%s interval %g", dpl_merge_name(merges[m]),
                     intervals[i]);
        }
    return count;
}

int32_t dpl_bench_methods_that_bounce(dpl_bench_method methods[DPL_BENCH_MAX_METHODS], int32_t count) {
    int32_t kept = 0;
    for (int32_t i = 0; i < count; i++)
        if (methods[i].kind == DPL_SOLVER_HOLOGRAPHIC)
            methods[kept++] = methods[i];
    return kept;
}
