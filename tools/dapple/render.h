/* The work of `dapple render`, once its arguments are known to be good. */
#ifndef DPL_TOOL_RENDER_H
#define DPL_TOOL_RENDER_H

#include <dapple/context.h>
#include <dapple/shadow.h>
#include <dapple/solver.h>
#include <stdbool.h>

typedef struct dpl_render_order {
    const char *scene;      /* path to read */
    const char *output;     /* path to write, "-" for standard output */
    const char *stats;      /* path to write, or NULL */
    dpl_solver_desc solver; /* all but the progress hook */
    dpl_shadow_desc shadow; /* of the scene's `lights`; all but the progress hook */
    bool with_lights;       /* add what they give */
    int32_t threads;        /* 0: as many as the machine has processors */
    uint32_t isa_mask;      /* union of dpl_isa */
    int32_t margin;         /* in place of the scene's own [px]; below 0: the scene's */
} dpl_render_order;

/* Renders, writes, reports what failed. Returns an exit status: also 128 + the signal that ended it. */
int dpl_render_run(const dpl_render_order *order);

#endif
