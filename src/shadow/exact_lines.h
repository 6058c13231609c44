/* The exact method for many receivers at once. Called by shadow.c for pixels that the horizon leaves open. */
#ifndef DPL_SHADOW_EXACT_LINES_H
#define DPL_SHADOW_EXACT_LINES_H

#include "shadow/shadow.h"

/* Up to DPL_RECEIVERS pixels in one line: they share u and are at v[i], in rising order. Turned: u is y, else
 * x. Each looks along u rather than along v at the light's centre, from beyond DPL_EXACT_LINES_NEAR. */
typedef struct dpl_receiver_line {
    bool turned;
    int32_t u;
    int32_t count;
    int32_t v[DPL_RECEIVERS];
    float visible[DPL_RECEIVERS]; /* receives V, or -1: dpl_shadow_exact() has to look */
} dpl_receiver_line;

/* Lights that are worth it: smaller ones cover too few of a float's steps [px]. */
#define DPL_EXACT_LINES_RADIUS 0.25

/* Receivers nearer than this many radii see the disc too wide for the kernel's arc tangent. */
#define DPL_EXACT_LINES_NEAR 1.5

void dpl_shadow_exact_line(const dpl_shadow_view *view, dpl_receiver_line *line, dpl_shadow_counts *counts);

#endif
