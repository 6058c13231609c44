/* The settings of cascades on the command line: what render and info share. */
#ifndef DPL_TOOL_CASCADES_H
#define DPL_TOOL_CASCADES_H

#include "options.h"

#include <dapple/schedule.h>

/* What was asked for. Make it with dpl_cascades_settings_default(). */
typedef struct dpl_cascades_settings {
    dpl_cascades_desc desc; /* what is not given stays at the solver's default */
    int merge;              /* desc.merge while options are read: a choice is an int */
    int profile;            /* desc.profile likewise */
    bool merge_given;
    bool given; /* profile, spacing, interval or levels were named */
    bool directions_given;
} dpl_cascades_settings;

/* As many rows as dpl_cascades_fill_options() writes. */
#define DPL_CASCADES_OPTION_COUNT 6

dpl_cascades_settings dpl_cascades_settings_default(void);

/* Writes the rows of --merge, --profile, --spacing, --interval, --levels and --directions, the last taking 1
 * to `directions_maximum`: a command that gives it a second meaning checks that itself. */
void dpl_cascades_fill_options(dpl_cascades_settings *settings, int32_t directions_maximum,
                               dpl_option options[DPL_CASCADES_OPTION_COUNT]);

/* Completes `desc` once options are read. Returns DPL_OPTIONS_GO, or reports what is wrong. */
int dpl_cascades_settings_finish(dpl_cascades_settings *settings, const char *command);

#endif
