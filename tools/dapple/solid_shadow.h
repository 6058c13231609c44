/* The work of `dapple shadow3d`, once its arguments are known to be good. */
#ifndef DPL_TOOL_SOLID_SHADOW_H
#define DPL_TOOL_SOLID_SHADOW_H

#include <dapple/solid_shadow.h>

typedef struct dpl_solid_shadow_order {
    const char *scene;            /* path to read */
    const char *output;           /* path to write */
    const char *stats;            /* path to write, or NULL */
    dpl_solid_shadow_desc shadow; /* all but the eye */
    int32_t field_resolution;     /* samples along the longest side of the distances */
    int32_t light;                /* that light's visibility alone; below 0: the light of all */
    int32_t threads;              /* 0: as many as the machine has processors */
} dpl_solid_shadow_order;

/* Renders, writes, reports what failed. Returns an exit status. */
int dpl_solid_shadow_run(const dpl_solid_shadow_order *order);

#endif
