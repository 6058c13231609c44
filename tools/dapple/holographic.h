/* Settings of the holographic solver on the command line. Used by render. */
#ifndef DPL_TOOL_HOLOGRAPHIC_H
#define DPL_TOOL_HOLOGRAPHIC_H

#include "options.h"

#include <dapple/solver.h>

/* What was asked for; zero-initialise. A choice is an int while options are read. */
typedef struct dpl_holographic_settings {
    int storage;
    int resolution;
    bool given;
} dpl_holographic_settings;

/* As many rows as dpl_holographic_fill_options() writes. */
#define DPL_HOLOGRAPHIC_OPTION_COUNT 2

/* Writes the rows of --storage and --resolution. */
void dpl_holographic_fill_options(dpl_holographic_settings *settings,
                                  dpl_option options[DPL_HOLOGRAPHIC_OPTION_COUNT]);

/* As the command line spells them. */
const char *dpl_holographic_storage_name(dpl_storage storage);
const char *dpl_holographic_resolution_name(dpl_resolution resolution);

#endif
