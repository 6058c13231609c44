/* The study's plots: a gnuplot script with its data, and the SVG and PNG files it makes. Called by study.c;
 * the report embeds the SVGs. */
#ifndef DPL_STUDY_PLOTS_H
#define DPL_STUDY_PLOTS_H

#include "results.h"

#include "image/error.h"

#include <stdio.h>

/* One plot: NAME.svg and NAME.png. */
typedef struct dpl_study_plot {
    const char *name;
    const char *caption;
    void (*print)(FILE *script); /* the commands, data blocks being there already */
} dpl_study_plot;

const dpl_study_plot *dpl_study_plots(int *count);

/* Most scenes that a plot shows: those of the first seeds. */
#define DPL_STUDY_PLOT_SCENES 600

/* Writes plots.gp into the folder. */
bool dpl_study_write_plot_script(const dpl_study_results *results, dpl_error *error);

/* Runs it. False, with a text for a note, when there is no gnuplot or it failed: then no plot is left. */
bool dpl_study_draw_plots(const dpl_study_results *results, dpl_error *error);

#endif
