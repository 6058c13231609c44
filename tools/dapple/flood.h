/* The work of `dapple flood`, once its arguments are known to be good. */
#ifndef DPL_TOOL_FLOOD_H
#define DPL_TOOL_FLOOD_H

#include "scenes/scene_flood.h"

typedef struct dpl_flood_order {
    const char *scene;  /* path to read */
    const char *output; /* path to write, "-" for standard output */
    const char *stats;  /* path to write, or NULL */
    dpl_scene_flood_rules rules;
} dpl_flood_order;

/* Reads, lights, writes, reports what failed. Returns an exit status. */
int dpl_flood_run(const dpl_flood_order *order);

#endif
