/* Runs gnuplot on a script. Called by what draws plots. */
#ifndef DPL_STUDY_GNUPLOT_H
#define DPL_STUDY_GNUPLOT_H

#include "image/error.h"

/* Runs `gnuplot SCRIPT` with DIR as its folder, without a shell and without the user's settings; it makes
 * NAME.svg and NAME.png for each of `count` names. False when there is no gnuplot or it failed: there are no
 * such files then, not even old ones, and the error is a text for a note. */
bool dpl_study_gnuplot_draw(const char *folder, const char *script, const char *const *names, int count,
                            dpl_error *error);

#endif
