/* Settings of ray skipping on the command line. Used by render. */
#ifndef DPL_TOOL_SKIP_H
#define DPL_TOOL_SKIP_H

#include "options.h"

#include <dapple/skip.h>

/* What was asked for; zero-initialise. */
typedef struct dpl_skip_settings {
    dpl_skip_desc desc;
    int mode;              /* desc.mode while options are read: a choice is an int */
    bool rule_given;       /* start level or bits */
    bool thresholds_given; /* low or high */
    bool probes_given;
    bool bound_given; /* or the seed of its checks */
} dpl_skip_settings;

/* As many rows as dpl_skip_fill_options() writes. */
#define DPL_SKIP_OPTION_COUNT 8

/* Writes the rows of --skip, --skip-start, --skip-bits, --skip-low, --skip-high,
 * --skip-probes, --bound and --skip-seed. */
void dpl_skip_fill_options(dpl_skip_settings *settings, dpl_option options[DPL_SKIP_OPTION_COUNT]);

/* Completes `desc` once options are read. Returns DPL_OPTIONS_GO, or reports what does not go together. */
int dpl_skip_settings_finish(dpl_skip_settings *settings, const char *command);

#endif
