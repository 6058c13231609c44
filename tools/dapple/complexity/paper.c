/* The paper's section 1, as its code has it. */
#include "paper.h"

#include <math.h>

#define K 10.0
#define O 12.0
#define R 100.0

double dpl_complexity_paper_naive(double objects) {
    return O * (objects * objects * K);
}

double dpl_complexity_paper_optimized(double objects) {
    return R * log2(objects);
}

double dpl_complexity_paper_flood(void) {
    return DPL_COMPLEXITY_PAPER_CELLS;
}
