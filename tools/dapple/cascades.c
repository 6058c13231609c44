/* Settings of cascades on the command line. */
#include "cascades.h"

#include "report.h"

#include <dapple/solver.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Ranges as the comments of dpl_cascades_desc state them. */
#define SPACING_MAX 64
#define DIRECTIONS_MIN 4
#define DIRECTIONS_MAX 1024
#define INTERVAL_MIN 0.25
#define INTERVAL_MAX 1024

static const dpl_choice merges[] = {
    {"bilinear", DPL_MERGE_BILINEAR},
    {"bilinear-fix", DPL_MERGE_BILINEAR_FIX},
    {"nearest-fix", DPL_MERGE_NEAREST_FIX},
    {NULL, 0},
};

static const dpl_choice profiles[] = {
    {"default", DPL_PROFILE_DEFAULT},
    {"paper", DPL_PROFILE_PAPER},
    {NULL, 0},
};

dpl_cascades_settings dpl_cascades_settings_default(void) {
    dpl_cascades_settings settings = {.desc = dpl_solver_desc_default().cascades};
    settings.merge = (int)settings.desc.merge;
    return settings;
}

void dpl_cascades_fill_options(dpl_cascades_settings *settings, int32_t directions_maximum,
                               dpl_option options[DPL_CASCADES_OPTION_COUNT]) {
    const dpl_option rows[DPL_CASCADES_OPTION_COUNT] = {
        {.name = "merge",
         .kind = DPL_OPTION_CHOICE,
         .target = &settings->merge,
         .choices = merges,
         .given = &settings->merge_given},
        {.name = "profile",
         .kind = DPL_OPTION_CHOICE,
         .target = &settings->profile,
         .choices = profiles,
         .given = &settings->given},
        {.name = "spacing",
         .kind = DPL_OPTION_INTEGER,
         .target = &settings->desc.spacing,
         .minimum = 1,
         .maximum = SPACING_MAX,
         .given = &settings->given},
        {.name = "interval",
         .kind = DPL_OPTION_NUMBER,
         .target = &settings->desc.interval,
         .minimum = INTERVAL_MIN,
         .maximum = INTERVAL_MAX,
         .given = &settings->given},
        {.name = "levels",
         .kind = DPL_OPTION_INTEGER,
         .target = &settings->desc.levels,
         .minimum = 1,
         .maximum = DPL_MAX_LEVELS,
         .given = &settings->given},
        {.name = "directions",
         .kind = DPL_OPTION_INTEGER,
         .target = &settings->desc.directions,
         .minimum = 1,
         .maximum = directions_maximum,
         .given = &settings->directions_given},
    };
    memcpy(options, rows, sizeof rows);
}

/* Every level has four times the directions of the one below; their number must stay an int32_t. */
static bool levels_fit(const dpl_cascades_desc *desc) {
    int64_t directions = desc->directions;
    for (int32_t i = 1; i < desc->levels; i++)
        directions *= DPL_BRANCHING;
    return directions <= INT32_MAX;
}

int dpl_cascades_settings_finish(dpl_cascades_settings *settings, const char *command) {
    settings->desc.merge = (dpl_merge)settings->merge;
    settings->desc.profile = (dpl_profile)settings->profile;
    if (settings->desc.profile == DPL_PROFILE_PAPER && !settings->merge_given)
        settings->desc.merge = DPL_MERGE_BILINEAR;
    if (settings->desc.profile == DPL_PROFILE_PAPER && settings->desc.merge != DPL_MERGE_BILINEAR)
        return dpl_report_usage(command, "--profile paper knows no --merge but bilinear");
    int32_t directions = settings->desc.directions;
    if (settings->directions_given &&
        (directions < DIRECTIONS_MIN || directions > DIRECTIONS_MAX || directions % DPL_BRANCHING != 0))
        return dpl_report_usage(command,
                                "--directions of level 0 needs a multiple of %d from %d to %d, not '%d'",
                                DPL_BRANCHING, DIRECTIONS_MIN, DIRECTIONS_MAX, (int)directions);
    if (!levels_fit(&settings->desc))
        return dpl_report_usage(command, "--levels %d is too many for --directions %d",
                                (int)settings->desc.levels, (int)directions);
    return DPL_OPTIONS_GO;
}
