/* What the measurements say: fitted exponents with their intervals, figures at chosen sizes, the crossover.
 * Printed by tables.c and page.c. */
#ifndef DPL_COMPLEXITY_FINDINGS_H
#define DPL_COMPLEXITY_FINDINGS_H

#include "worlds.h"

typedef enum dpl_complexity_verdict {
    DPL_COMPLEXITY_NO_TARGET,
    DPL_COMPLEXITY_MET,
    DPL_COMPLEXITY_MISSED
} dpl_complexity_verdict;

#define DPL_COMPLEXITY_FINDINGS_MAX 32

typedef struct dpl_complexity_finding {
    const char *what;
    const char *unit; /* of the value */
    const char *of;   /* what `from` and `to` are: "objects", "rays" or "cells" */
    double from;      /* range of the measurements behind it */
    double to;        /* the same as `from` for a figure at one size */
    int32_t points;   /* in that range; 1 for a figure at one size */
    double value;
    double low;         /* of fits the 95 % interval, of times the least, else the value */
    double high;        /* the same, the greatest */
    double r2;          /* of fits the share of the variance that they explain; NAN */
    const char *target; /* "" where there is none */
    dpl_complexity_verdict verdict;
} dpl_complexity_finding;

typedef struct dpl_complexity_findings {
    dpl_complexity_finding list[DPL_COMPLEXITY_FINDINGS_MAX];
    int32_t count;
    int32_t fit_rays; /* in the runs that growth with objects is fitted to */
} dpl_complexity_findings;

/* Ranges without three points, and sizes that were not measured, are left out. */
void dpl_complexity_find_all(const dpl_complexity_worlds *worlds, dpl_complexity_findings *findings);

/* "", "met" or "missed". */
const char *dpl_complexity_verdict_name(dpl_complexity_verdict verdict);

#endif
