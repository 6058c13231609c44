/* Takes the times and checks the counts. Called by complexity.c. */
#ifndef DPL_COMPLEXITY_MEASURE_H
#define DPL_COMPLEXITY_MEASURE_H

#include "worlds.h"

/* Runs every case once to count, then `rounds` times for times, all cases taking turns: when the machine is
 * slower for a while, it is so for all. Draws a bar on a terminal. Returns an exit status; failures, also
 * counts that do not repeat or are not what they must be, have been reported. */
int dpl_complexity_measure(dpl_complexity_worlds *worlds);

#endif
