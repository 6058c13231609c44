/* dapple complexity: the M.R.M.A. paper's complexity figure, measured. */
#include "command.h"
#include "complexity/complexity.h"
#include "options.h"
#include "report.h"

#include <dapple/context.h>

static const char help[] =
    "Usage: dapple complexity --out DIR [options]\n"
    "\n"
    "Measures how the cost of lighting grows, where the M.R.M.A. paper plots formulas: time\n"
    "and counted work of rays against n objects, naively and through a hierarchy of boxes\n"
    "(BVH), for several numbers of rays in a run, and of flood fill against cells. Fits\n"
    "exponents with 95 % intervals, finds from how many objects on the hierarchy is faster,\n"
    "and lays the paper's curves beside. Fails when counts of two runs differ.\n"
    "\n"
    "What is run:\n"
    "  --largest N        objects, from 1 on: 1 to 1000000 (default 100000)\n"
    "  --largest-cells N  side of the largest flood-fill world, from 64 x 64 on doubling: 64\n"
    "                     to 4096 (default 4096)\n"
    "  --seed S           of objects and rays: 0 to 18446744073709551615 (default 0)\n"
    "  --quick            few and small: 200 objects, 128 x 128 cells, three rounds\n"
    "\n"
    "Work:\n"
    "  --out DIR          folder for the results; made if it is missing\n"
    "  --no-plot          draw no figure\n"
    "  --threads N        1 to 64 (default 1); times are processor time, summed over threads\n"
    "  -h, --help         print this text\n"
    "\n"
    "In DIR:\n"
    "  complexity.html    findings, figure and tables; one file\n"
    "  tracing.csv        a row for each method, number of objects and number of rays\n"
    "  flood.csv          a row for each world\n"
    "  findings.csv       exponents with intervals, the crossover, targets\n"
    "  paper.csv          the paper's three curves\n"
    "  complexity.svg, complexity.png\n"
    "                     the figure, where gnuplot is installed; complexity.gp draws it again\n"
    "\n"
    "Counts are the same for the same arguments. All takes a minute or two. Ctrl-C ends the\n"
    "work and leaves no files.\n"
    "\n"
    "Example:\n"
    "  dapple complexity --out out/complexity\n";

typedef struct complexity_options {
    dpl_complexity_plan plan;
    bool quick;
    bool no_plot;
    bool largest_given;
    bool side_given;
} complexity_options;

static int parse(int argc, char **argv, complexity_options *given) {
    dpl_complexity_plan *plan = &given->plan;
    const dpl_option options[] = {
        {.name = "largest",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->largest,
         .minimum = 1,
         .maximum = DPL_COMPLEXITY_LARGEST_MAX,
         .given = &given->largest_given},
        {.name = "largest-cells",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->side,
         .minimum = DPL_COMPLEXITY_SIDE_MIN,
         .maximum = DPL_COMPLEXITY_SIDE_MAX,
         .given = &given->side_given},
        {.name = "seed", .kind = DPL_OPTION_SEED, .target = &plan->seed},
        {.name = "quick", .kind = DPL_OPTION_FLAG, .target = &given->quick},
        {.name = "no-plot", .kind = DPL_OPTION_FLAG, .target = &given->no_plot},
        {.name = "threads",
         .kind = DPL_OPTION_INTEGER,
         .target = &plan->threads,
         .minimum = 1,
         .maximum = DPL_MAX_THREADS},
        {.name = "out", .kind = DPL_OPTION_TEXT, .target = &plan->folder},
    };
    const dpl_syntax syntax = {
        .command = "complexity",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

static int run(int argc, char **argv) {
    complexity_options given = {.plan = {.largest = 100000,
                                         .side = DPL_COMPLEXITY_SIDE_MAX,
                                         .rounds = DPL_COMPLEXITY_ROUNDS_MAX,
                                         .threads = 1}};
    int status = parse(argc, argv, &given);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (!given.plan.folder || !given.plan.folder[0])
        return dpl_report_usage("complexity", "--out is missing");
    if (given.quick) {
        given.plan.rounds = 3;
        given.plan.largest = given.largest_given ? given.plan.largest : 200;
        given.plan.side = given.side_given ? given.plan.side : 128;
    }
    given.plan.plot = !given.no_plot;
    return dpl_complexity_run(&given.plan);
}

const dpl_command dpl_command_complexity = {
    "complexity",
    "measure how the cost of rays and of flood fill grows",
    help,
    run,
};
