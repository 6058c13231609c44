/* The work of `dapple shadow`, once its arguments are known to be good. */
#ifndef DPL_TOOL_SHADOW_H
#define DPL_TOOL_SHADOW_H

#include "progress.h"

#include "image/picture.h"
#include "scenes/scene.h"

#include <dapple/dapple.h>

#define DPL_SHADOW_ALL_LIGHTS (-1)

typedef struct dpl_shadow_order {
    const char *scene;      /* path to read */
    const char *output;     /* path to write, "-" for standard output */
    const char *stats;      /* path to write, or NULL */
    dpl_shadow_desc shadow; /* all but the progress hook */
    int32_t light;          /* whose V is wanted, or DPL_SHADOW_ALL_LIGHTS: the light of all */
    bool compare;           /* all methods against the reference instead */
    int32_t threads;        /* 0: as many as the machine has processors */
} dpl_shadow_order;

/* Everything that is open or in memory during the work. */
typedef struct dpl_shadow_job {
    const dpl_shadow_order *order;
    dpl_context *context;
    dpl_scene scene;
    dpl_field *field;
    dpl_light *lights; /* scene.light_count of them, malloc'ed */
    dpl_picture picture;
    dpl_progress progress;
    dpl_shadow_stats stats;
    double read_ms;
    double write_ms;
    double total_ms;
} dpl_shadow_job;

/* Computes, writes, reports what failed. Returns an exit status: also 128 + the signal that ended it. */
int dpl_shadow_run(const dpl_shadow_order *order);

/* shadow.c: V of one light by one method, into one channel of floats. Returns an exit status. */
int dpl_shadow_solve(dpl_shadow_job *job, const dpl_shadow_desc *desc, float *visibility,
                     dpl_shadow_stats *stats);

/* shadow_compare.c: the table on standard output, the sheet of pictures and the statistics. */
int dpl_shadow_compare(dpl_shadow_job *job);

/* shadow_stats.c: the JSON behind --stats, malloc'ed, or NULL with the error set. */
char *dpl_shadow_stats_text(const dpl_shadow_job *job, dpl_error *error);

#endif
