/* The three curves that the M.R.M.A. paper plots: formulas without a unit, never measured. Used by tables.c
 * and figure.c. */
#ifndef DPL_COMPLEXITY_PAPER_H
#define DPL_COMPLEXITY_PAPER_H

/* "O(r * n * k)": plotted as 12 N N 10, which is quadratic in the objects and does not read r. */
double dpl_complexity_paper_naive(double objects);

/* "O(R * log(N))": 100 log2 N, which is nothing for one object. */
double dpl_complexity_paper_optimized(double objects);

/* "O(w * h)": 100 * 100, a level line over the number of objects. */
double dpl_complexity_paper_flood(void);

/* The paper's cells. */
#define DPL_COMPLEXITY_PAPER_CELLS 10000.0

/* The objects up to which the paper plots. */
#define DPL_COMPLEXITY_PAPER_LARGEST 1000

#endif
