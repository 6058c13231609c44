/* dapple shadow: the lights of a scene with their shadows, or the visibility of one. */
#include "command.h"
#include "options.h"
#include "output.h"
#include "paths.h"
#include "render.h"
#include "report.h"
#include "shadow.h"

#include "image/file.h"
#include "scenes/scene_read.h"
#include "scenes/solid_scene.h"

#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: dapple shadow SCENE -o OUT [options]\n"
    "\n"
    "Lights SCENE with its `lights`, discs that shine and block nothing, and writes the mean\n"
    "radiance that they give each pixel's centre; or, with --light, how much of one light\n"
    "each pixel sees. A scene of meshes (\"dapple3d\": 1) is handed on to `dapple shadow3d`,\n"
    "whose options then hold.\n"
    "\n"
    "Output:\n"
    "  -o, --output OUT     .png is tone-mapped sRGB for looking at, or grey from 0 to 1 with\n"
    "                       --light; .pfm and .exr hold the linear result; - writes PFM to\n"
    "                       standard output\n"
    "  --light K            the visibility of light K alone, counted from 0\n"
    "  --stats FILE         also write times, counted pixels and steps as JSON\n"
    "  --compare all        all methods against the reference on light K (default 0): a table\n"
    "                       of errors and costs on standard output (and as JSON in the\n"
    "                       --stats file); OUT, a .png, gets a sheet of pictures in the\n"
    "                       table's order, the reference first, below each its error times\n"
    "                       four: red is too bright, blue too dark\n"
    "\n"
    "Method:\n"
    "  --method METHOD      exact: the union of what opaque pixels cover (default)\n"
    "                       rays: the same from 56 places across the light, fast\n"
    "                       reference: brute force\n"
    "                       moments-2, moments-evsm, moments-4, moments-soft (or moments),\n"
    "                       pcss: polar shadow maps\n"
    "                       distance-hard, -quilez, -aaltonen, -signed, -two-sided, -cones (or\n"
    "                       distance): marches through the distance field\n"
    "                       mrma: a map and a march, blended\n"
    "  --samples N          reference: rays per pixel (default 256); pcss: taps (default 32);\n"
    "                       1 to 65536; rays: places, 1 to 256 (default 56)\n"
    "  --map-resolution N   texels around a light: 16 to 65536, a multiple of 4 (default 2048)\n"
    "  --field-level N      the march reads distances every 2^N px: 0 to 4 (default 0)\n"
    "  --sub-cones N        distance-cones: 1 to 64 (default 4)\n"
    "  --classify ON        on, or off: work on every pixel, also on those that are surely lit\n"
    "                       or dark (default on)\n"
    "\n"
    "M.R.M.A. only:\n"
    "  --weight WEIGHT      smooth-min, min, constant, distance, gap, variance or literal, the\n"
    "                       paper's own (default smooth-min)\n"
    "  --map MAP            rays, moments-soft or pcss (default rays)\n"
    "  --field FIELD        one of the distance methods (default distance-cones)\n"
    "  --tau T              of smooth-min: 0.0001 to 1 (default 0.03)\n"
    "  --constant A         share of the map: 0 to 1 (default 0.5)\n"
    "  --blend-distance PX  k of distance and gap: 0.001 to 1e6 (default 32)\n"
    "  --guard ON           on, or off: blend also where one term is known to be the worse\n"
    "                       (default on)\n"
    "\n"
    "Work:\n"
    "  --threads N          1 to 64 (default: one per processor)\n"
    "  -h, --help           print this text\n"
    "\n"
    "The result is the same for every number of threads.\n"
    "\n"
    "Example:\n"
    "  dapple scenes shadows --seed 1 --out scenes\n"
    "  dapple shadow scenes/shadows-01.json -o shadow.png --light 0\n";

static const dpl_choice method_choices[] = {
    {"exact", DPL_SHADOW_EXACT},
    {"reference", DPL_SHADOW_REFERENCE},
    {"moments-2", DPL_SHADOW_MOMENTS_2},
    {"moments-evsm", DPL_SHADOW_MOMENTS_EXPONENTIAL},
    {"moments-4", DPL_SHADOW_MOMENTS_4},
    {"moments-soft", DPL_SHADOW_MOMENTS_SOFT},
    {"moments", DPL_SHADOW_MOMENTS_SOFT},
    {"pcss", DPL_SHADOW_PCSS},
    {"distance-hard", DPL_SHADOW_DISTANCE_HARD},
    {"distance-quilez", DPL_SHADOW_DISTANCE_QUILEZ},
    {"distance-aaltonen", DPL_SHADOW_DISTANCE_AALTONEN},
    {"distance-signed", DPL_SHADOW_DISTANCE_SIGNED},
    {"distance-two-sided", DPL_SHADOW_DISTANCE_TWO_SIDED},
    {"distance-cones", DPL_SHADOW_DISTANCE_CONES},
    {"distance", DPL_SHADOW_DISTANCE_CONES},
    {"mrma", DPL_SHADOW_MRMA},
    {"rays", DPL_SHADOW_RAYS},
    {NULL, 0},
};

static const dpl_choice map_choices[] = {
    {"rays", DPL_SHADOW_RAYS},
    {"moments-soft", DPL_SHADOW_MOMENTS_SOFT},
    {"pcss", DPL_SHADOW_PCSS},
    {NULL, 0},
};

static const dpl_choice field_choices[] = {
    {"distance-hard", DPL_SHADOW_DISTANCE_HARD},
    {"distance-quilez", DPL_SHADOW_DISTANCE_QUILEZ},
    {"distance-aaltonen", DPL_SHADOW_DISTANCE_AALTONEN},
    {"distance-signed", DPL_SHADOW_DISTANCE_SIGNED},
    {"distance-two-sided", DPL_SHADOW_DISTANCE_TWO_SIDED},
    {"distance-cones", DPL_SHADOW_DISTANCE_CONES},
    {NULL, 0},
};

static const dpl_choice weight_choices[] = {
    {"smooth-min", DPL_WEIGHT_SMOOTH_MIN},
    {"min", DPL_WEIGHT_MIN},
    {"constant", DPL_WEIGHT_CONSTANT},
    {"distance", DPL_WEIGHT_DISTANCE},
    {"gap", DPL_WEIGHT_GAP},
    {"variance", DPL_WEIGHT_VARIANCE},
    {"literal", DPL_WEIGHT_LITERAL},
    {NULL, 0},
};

static const dpl_choice switch_choices[] = {{"on", 1}, {"off", 0}, {NULL, 0}};
static const dpl_choice compare_choices[] = {{"all", 1}, {NULL, 0}};

/* What was asked for; choices are ints until all is read. */
typedef struct shadow_options {
    dpl_shadow_order order;
    int method, weight, map, field, guard, classify, compare;
    double tau, constant, blend_distance;
    bool blend_given; /* a setting of M.R.M.A. was named */
} shadow_options;

static int parse(int argc, char **argv, shadow_options *g) {
    dpl_shadow_desc *desc = &g->order.shadow;
    bool *blend = &g->blend_given;
    const dpl_option options[] = {
        {"output", 'o', DPL_OPTION_TEXT, &g->order.output, 0, 0, NULL, NULL},
        {"stats", 0, DPL_OPTION_TEXT, &g->order.stats, 0, 0, NULL, NULL},
        {"light", 0, DPL_OPTION_INTEGER, &g->order.light, 0, 1e6, NULL, NULL},
        {"compare", 0, DPL_OPTION_CHOICE, &g->compare, 0, 0, compare_choices, NULL},
        {"method", 0, DPL_OPTION_CHOICE, &g->method, 0, 0, method_choices, NULL},
        {"samples", 0, DPL_OPTION_INTEGER, &desc->samples, 1, 65536, NULL, NULL},
        {"map-resolution", 0, DPL_OPTION_INTEGER, &desc->map_resolution, 16, 65536, NULL, NULL},
        {"field-level", 0, DPL_OPTION_INTEGER, &desc->field_level, 0, 4, NULL, NULL},
        {"sub-cones", 0, DPL_OPTION_INTEGER, &desc->sub_cones, 1, 64, NULL, NULL},
        {"classify", 0, DPL_OPTION_CHOICE, &g->classify, 0, 0, switch_choices, NULL},
        {"weight", 0, DPL_OPTION_CHOICE, &g->weight, 0, 0, weight_choices, blend},
        {"map", 0, DPL_OPTION_CHOICE, &g->map, 0, 0, map_choices, blend},
        {"field", 0, DPL_OPTION_CHOICE, &g->field, 0, 0, field_choices, blend},
        {"tau", 0, DPL_OPTION_NUMBER, &g->tau, 0.0001, 1, NULL, blend},
        {"constant", 0, DPL_OPTION_NUMBER, &g->constant, 0, 1, NULL, blend},
        {"blend-distance", 0, DPL_OPTION_NUMBER, &g->blend_distance, 0.001, 1e6, NULL, blend},
        {"guard", 0, DPL_OPTION_CHOICE, &g->guard, 0, 0, switch_choices, blend},
        {"threads", 0, DPL_OPTION_INTEGER, &g->order.threads, 1, DPL_MAX_THREADS, NULL, NULL},
    };
    const dpl_operand operands[] = {{.name = "SCENE", .required = true, .target = &g->order.scene}};
    const dpl_syntax syntax = {
        .command = "shadow",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

static void finish_desc(shadow_options *g) {
    dpl_shadow_desc *desc = &g->order.shadow;
    desc->method = (dpl_shadow_method)g->method;
    desc->weight = (dpl_shadow_weight)g->weight;
    desc->map_method = (dpl_shadow_method)g->map;
    desc->field_method = (dpl_shadow_method)g->field;
    desc->guard = g->guard;
    desc->classify = g->classify;
    desc->tau = (float)g->tau;
    desc->constant = (float)g->constant;
    desc->blend_distance = (float)g->blend_distance;
    g->order.compare = g->compare != 0;
}

/* What cannot be right, whatever is on the disk. */
static int check(const shadow_options *g) {
    dpl_error error;
    const dpl_shadow_order *order = &g->order;
    const dpl_tool_files files = {"shadow", order->scene, order->output, order->stats};
    int status = dpl_tool_check_files(&files);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (order->compare && !dpl_path_has_extension(order->output, ".png"))
        return dpl_report_usage("shadow", "--compare writes a sheet of pictures: OUT must be a .png");
    if (order->shadow.map_resolution % 4 != 0)
        return dpl_report_usage("shadow", "--map-resolution must be a multiple of 4");
    if (g->blend_given && order->shadow.method != DPL_SHADOW_MRMA && !order->compare)
        return dpl_report_usage("shadow", "--weight, --map, --field, --tau, --constant, --blend-distance and "
                                          "--guard are settings of --method mrma");
    if (!dpl_path_check_writable(order->output, &error))
        return dpl_report_failure("%s", error.text);
    if (order->stats && !dpl_path_check_writable(order->stats, &error))
        return dpl_report_failure("%s", error.text);
    return DPL_OPTIONS_GO;
}

/* Is an argument the file of a scene in space? Those have a command of their own, with its own options. */
static bool names_solid_scene(int argc, char **argv) {
    bool found = false;
    for (int i = 1; i < argc && !found; i++) {
        char *bytes;
        size_t size;
        dpl_error ignored;
        const char *dot = strrchr(argv[i], '.');
        if (!dot || strcmp(dot, ".json") != 0 ||
            !dpl_file_read(argv[i], DPL_SCENE_FILE_LIMIT, &bytes, &size, &ignored))
            continue; /* what cannot be read is told of where it is wanted */
        found = dpl_solid_scene_is_one(bytes, size);
        free(bytes);
    }
    return found;
}

static int run(int argc, char **argv) {
    if (names_solid_scene(argc, argv))
        return dpl_command_shadow3d.run(argc, argv);
    shadow_options given = {.order = {.shadow = dpl_shadow_desc_default(), .light = DPL_SHADOW_ALL_LIGHTS}};
    const dpl_shadow_desc *desc = &given.order.shadow;
    given.method = (int)desc->method;
    given.weight = (int)desc->weight;
    given.map = (int)desc->map_method;
    given.field = (int)desc->field_method;
    given.guard = desc->guard;
    given.classify = desc->classify;
    given.tau = (double)desc->tau;
    given.constant = (double)desc->constant;
    given.blend_distance = (double)desc->blend_distance;
    int status = parse(argc, argv, &given);
    if (status != DPL_OPTIONS_GO)
        return status;
    finish_desc(&given);
    status = check(&given);
    return status == DPL_OPTIONS_GO ? dpl_shadow_run(&given.order) : status;
}

const dpl_command dpl_command_shadow = {
    "shadow",
    "light a scene's disc lights, with soft shadows",
    help,
    run,
};
