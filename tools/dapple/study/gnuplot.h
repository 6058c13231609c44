/* Runs gnuplot on a script. Called by plots.c. */
#ifndef DPL_STUDY_GNUPLOT_H
#define DPL_STUDY_GNUPLOT_H

#include "image/error.h"

/* Runs `gnuplot SCRIPT` with DIR as its folder, without a shell and without the user's settings. False when
 * there is no gnuplot or it failed; the error then is a text for a note. */
bool dpl_study_gnuplot_run(const char *folder, const char *script, dpl_error *error);

#endif
