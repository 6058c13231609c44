/* dapple flood: a scene file goes in, a picture of its light as a tile game would have it comes out. */
#include "command.h"
#include "flood.h"
#include "options.h"
#include "output.h"
#include "paths.h"
#include "render.h"
#include "report.h"

#include "image/picture.h"

static const char help[] =
    "Usage: dapple flood SCENE -o OUT [options]\n"
    "\n"
    "Lights SCENE (a scene file, or a PNG of walls and lamps) by flood fill, a pixel to a\n"
    "cell: light steps from cell to cell and loses some of itself with each step. Opaque\n"
    "pixels are blocks; pixels that emit are lights, `lights` too, at their centre; media\n"
    "take light in steps of a quarter. The brightest light reaches --range pixels far.\n"
    "\n"
    "Output:\n"
    "  -o, --output OUT   .png is tone-mapped sRGB for looking at; .pfm and .exr hold the\n"
    "                     linear result; - writes PFM to standard output\n"
    "  --stats FILE       also write times and counted visits as JSON\n"
    "\n"
    "Light:\n"
    "  --falloff FALLOFF  round or multiplicative (nearly round, or diamonds; each step\n"
    "                     takes a share, and a hundredth is left at --range), euclidean or\n"
    "                     subtractive (the same shapes; each step takes an amount, so the\n"
    "                     weak channels of a colour end first) (default round)\n"
    "  --range N          1 to 4096 px (default 64)\n"
    "  --sun              the scene's sky falls straight down until something stops it\n"
    "  -h, --help         print this text\n"
    "\n"
    "Example:\n"
    "  dapple flood scene.json -o light.png --range 100 --sun\n";

static const dpl_choice falloff_choices[] = {
    {"subtractive", DPL_FLOOD_SUBTRACTIVE},
    {"multiplicative", DPL_FLOOD_MULTIPLICATIVE},
    {"euclidean", DPL_FLOOD_EUCLIDEAN},
    {"round", DPL_FLOOD_ROUND},
    {NULL, 0},
};

static int parse(int argc, char **argv, dpl_flood_order *order, int *falloff) {
    const dpl_option options[] = {
        {.name = "output", .letter = 'o', .kind = DPL_OPTION_TEXT, .target = &order->output},
        {.name = "stats", .kind = DPL_OPTION_TEXT, .target = &order->stats},
        {.name = "falloff", .kind = DPL_OPTION_CHOICE, .target = falloff, .choices = falloff_choices},
        {.name = "range",
         .kind = DPL_OPTION_INTEGER,
         .target = &order->rules.range,
         .minimum = 1,
         .maximum = 4096},
        {.name = "sun", .kind = DPL_OPTION_FLAG, .target = &order->rules.sun},
    };
    const dpl_operand operands[] = {{.name = "SCENE", .required = true, .target = &order->scene}};
    const dpl_syntax syntax = {
        .command = "flood",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

/* Names that cannot be right, before any work. */
static int check_names(const dpl_flood_order *order) {
    dpl_error error;
    const dpl_tool_files files = {"flood", order->scene, order->output, order->stats};
    int status = dpl_tool_check_files(&files);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (!dpl_path_check_writable(order->output, &error))
        return dpl_report_failure("%s", error.text);
    return DPL_OPTIONS_GO;
}

static int run(int argc, char **argv) {
    dpl_flood_order order = {.rules = {.range = 64}};
    int falloff = DPL_FLOOD_ROUND;
    int status = parse(argc, argv, &order, &falloff);
    if (status == DPL_OPTIONS_GO)
        status = check_names(&order);
    if (status != DPL_OPTIONS_GO)
        return status;
    order.rules.falloff = (dpl_flood_falloff)falloff;
    return dpl_flood_run(&order);
}

const dpl_command dpl_command_flood = {
    "flood",
    "light a scene by flood fill, as tile games do",
    help,
    run,
};
