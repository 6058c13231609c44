/* The figure: the paper's three panels with measurements in them, and the paper's curves beside. Called by
 * complexity.c and page.c. */
#ifndef DPL_COMPLEXITY_FIGURE_H
#define DPL_COMPLEXITY_FIGURE_H

#include "results.h"

/* Name of the figure's files, without their endings. */
#define DPL_COMPLEXITY_FIGURE "complexity"

/* Writes complexity.gp, which holds its data: it draws the figure again without anything else. */
bool dpl_complexity_write_figure_script(const dpl_complexity_results *results, dpl_error *error);

/* Draws complexity.svg and complexity.png. False without gnuplot; the error then is a text for a note. */
bool dpl_complexity_draw_figure(const dpl_complexity_results *results, dpl_error *error);

#endif
