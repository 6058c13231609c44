/* Settings of ray skipping on the command line. */
#include "skip.h"

#include "report.h"

#include <stddef.h>
#include <string.h>

/* Ranges as the comments of dpl_skip_desc state them. */
#define START_LEVEL_MAX 11
#define BITS_MAX 2
#define PROBES_MAX 65536
#define BOUND_MIN 20
#define BOUND_MAX 120
#define SCORE_MIN 1e-9
#define SCORE_MAX 1e9

static const dpl_choice modes[] = {
    {"off", DPL_SKIP_OFF},         {"L5", DPL_SKIP_L5},
    {"L4", DPL_SKIP_L4},           {"L3", DPL_SKIP_L3},
    {"L2", DPL_SKIP_L2},           {"auto", DPL_SKIP_AUTO},
    {"custom", DPL_SKIP_CUSTOM},   {"exact", DPL_SKIP_EXACT},
    {"bounded", DPL_SKIP_BOUNDED}, {NULL, 0},
};

void dpl_skip_fill_options(dpl_skip_settings *settings, dpl_option options[DPL_SKIP_OPTION_COUNT]) {
    dpl_skip_desc *desc = &settings->desc;
    const dpl_option rows[DPL_SKIP_OPTION_COUNT] = {
        {.name = "skip", .kind = DPL_OPTION_CHOICE, .target = &settings->mode, .choices = modes},
        {.name = "skip-start",
         .kind = DPL_OPTION_INTEGER,
         .target = &desc->custom.start_level,
         .maximum = START_LEVEL_MAX,
         .given = &settings->rule_given},
        {.name = "skip-bits",
         .kind = DPL_OPTION_INTEGER,
         .target = &desc->custom.max_bits,
         .maximum = BITS_MAX,
         .given = &settings->rule_given},
        {.name = "skip-low",
         .kind = DPL_OPTION_NUMBER,
         .target = &desc->thresholds[0],
         .minimum = SCORE_MIN,
         .maximum = SCORE_MAX,
         .given = &settings->thresholds_given},
        {.name = "skip-high",
         .kind = DPL_OPTION_NUMBER,
         .target = &desc->thresholds[1],
         .minimum = SCORE_MIN,
         .maximum = SCORE_MAX,
         .given = &settings->thresholds_given},
        {.name = "skip-probes",
         .kind = DPL_OPTION_INTEGER,
         .target = &desc->signal_probes,
         .minimum = 1,
         .maximum = PROBES_MAX,
         .given = &settings->probes_given},
        {.name = "bound",
         .kind = DPL_OPTION_NUMBER,
         .target = &desc->bound_db,
         .minimum = BOUND_MIN,
         .maximum = BOUND_MAX,
         .given = &settings->bound_given},
        {.name = "skip-seed",
         .kind = DPL_OPTION_SEED,
         .target = &desc->seed,
         .given = &settings->bound_given},
    };
    memcpy(options, rows, sizeof rows);
}

int dpl_skip_settings_finish(dpl_skip_settings *settings, const char *command) {
    dpl_skip_desc *desc = &settings->desc;
    desc->mode = (dpl_skip_mode)settings->mode;
    if (settings->rule_given && desc->mode != DPL_SKIP_CUSTOM)
        return dpl_report_usage(command, "--skip-start and --skip-bits are settings of --skip custom");
    if ((settings->thresholds_given || settings->probes_given) && desc->mode != DPL_SKIP_AUTO)
        return dpl_report_usage(command,
                                "--skip-low, --skip-high and --skip-probes are settings of --skip auto");
    if (settings->bound_given && desc->mode != DPL_SKIP_BOUNDED)
        return dpl_report_usage(command, "--bound and --skip-seed are settings of --skip bounded");
    if (settings->thresholds_given && !(desc->thresholds[0] > 0 && desc->thresholds[1] > desc->thresholds[0]))
        return dpl_report_usage(command,
                                "--skip-low and --skip-high go together, the first below the second");
    return DPL_OPTIONS_GO;
}
