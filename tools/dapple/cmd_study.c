/* dapple study: the ARC paper's 50-scene study, run again. */
#include "command.h"
#include "options.h"
#include "report.h"
#include "study/study.h"

#include <dapple/context.h>

static const char help[] =
    "Usage: dapple study --seeds N --out DIR [options]\n"
    "\n"
    "Runs the 50-scene study of the ARC paper (adaptive ray skipping) again: every scene in\n"
    "every mode, in the paper's profile and in the corrected one, and puts the paper's\n"
    "figures, ours and verdicts side by side.\n"
    "\n"
    "What is run:\n"
    "  --seeds N         draws of the 50 scenes: 1 to 1000\n"
    "  --first-seed S    seed of the first draw, the others follow: 0 to\n"
    "                    18446744073709551615 (default 1)\n"
    "  --scenes COUNT    only the first COUNT scenes of each draw: 1 to 50 (default 50)\n"
    "  --size PX         width and height of the scenes: 64 to 4096 (default 512, the\n"
    "                    paper's)\n"
    "  --truth PIXELS    free pixels of each scene that the truth is traced at: 1 to 16384\n"
    "                    (default 4096)\n"
    "\n"
    "Work:\n"
    "  --out DIR         folder for the results; made if it is missing\n"
    "  --threads N       1 to 64 (default: one per processor)\n"
    "  -h, --help        print this text\n"
    "\n"
    "In DIR:\n"
    "  report.html       the paper's tables beside ours, verdicts, plots; one file\n"
    "  results.csv       a row for each seed, scene, profile and mode\n"
    "  signals.csv       the signals of each scene, and what auto chose\n"
    "  summary.csv       lowest, mean and highest by seed, profile and mode\n"
    "  correlations.csv  each signal with the quality of L2, with interval and p\n"
    "  headlines.csv, headlines-vs-truth.csv\n"
    "                    single numbers with their spread over seeds\n"
    "  below-50-db.csv   scenes that auto leaves at or below 50 dB\n"
    "  *.svg, *.png      plots, where gnuplot is installed; plots.gp draws them again\n"
    "  times.csv, times.md\n"
    "                    wall times and the machine\n"
    "  journal.csv       a line for each finished scene\n"
    "\n"
    "Ctrl-C ends the work; the same command goes on behind the last finished scene. All files\n"
    "but times.* and journal.csv are the same for the same arguments, whatever the number of\n"
    "threads and however often the work was stopped. 50 scenes take a few minutes.\n"
    "\n"
    "Example:\n"
    "  dapple study --seeds 1 --out out/study\n";

typedef struct study_options {
    dpl_study_plan plan;
    bool seeds_given;
} study_options;

static int parse(int argc, char **argv, study_options *given) {
    dpl_study_plan *plan = &given->plan;
    const dpl_option options[] = {
        {.name = "seeds",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->seeds,
         .minimum = 1,
         .maximum = DPL_STUDY_SEEDS_MAX,
         .given = &given->seeds_given},
        {.name = "first-seed", .kind = DPL_OPTION_SEED, .target = &plan->first_seed},
        {.name = "scenes",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->scenes,
         .minimum = 1,
         .maximum = DPL_STUDY_SCENES_MAX},
        {.name = "size",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->size,
         .minimum = DPL_STUDY_SIZE_MIN,
         .maximum = DPL_STUDY_SIZE_MAX},
        {.name = "truth",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->truth,
         .minimum = 1,
         .maximum = DPL_STUDY_TRUTH_MAX},
        {.name = "threads",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->threads,
         .minimum = 1,
         .maximum = DPL_MAX_THREADS},
        {.name = "out", .kind = DPL_OPTION_TEXT, .target = &plan->folder},
    };
    const dpl_syntax syntax = {
        .command = "study",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

static int run(int argc, char **argv) {
    study_options given = {
        .plan = {.first_seed = 1, .size = 512, .scenes = DPL_STUDY_SCENES_MAX, .truth = 4096}};
    int status = parse(argc, argv, &given);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (!given.seeds_given)
        return dpl_report_usage("study", "--seeds is missing");
    if (!given.plan.folder || !given.plan.folder[0])
        return dpl_report_usage("study", "--out is missing");
    if (given.plan.first_seed > UINT64_MAX - (uint64_t)(given.plan.seeds - 1))
        return dpl_report_usage("study", "there are no %d seeds from --first-seed on", (int)given.plan.seeds);
    return dpl_study_run(&given.plan);
}

const dpl_command dpl_command_study = {
    "study",
    "run the ARC paper's 50-scene study again and report on it",
    help,
    run,
};
