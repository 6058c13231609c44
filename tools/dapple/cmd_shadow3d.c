/* dapple shadow3d: a scene of meshes and lights goes in, what its camera sees comes out. */
#include "command.h"
#include "options.h"
#include "output.h"
#include "paths.h"
#include "report.h"
#include "solid_shadow.h"

#include "image/picture.h"

static const char help[] =
    "Usage: dapple shadow3d SCENE -o OUT [options]\n"
    "\n"
    "Lights the meshes of SCENE (a JSON file with \"dapple3d\": 1) by its lights, with soft\n"
    "shadows, and writes what its camera sees.\n"
    "\n"
    "Options:\n"
    "  -o, --output OUT  .png is tone-mapped sRGB for looking at; .pfm and .exr hold the\n"
    "                    linear result; - writes PFM to standard output\n"
    "  --method METHOD   mrma, by the light's map, and rays where that is open;\n"
    "                    moments; march; reference, by rays alone (default mrma)\n"
    "  --light K         the visibility of light K (from 0) alone, 0 to 1, not tone-mapped\n"
    "  --weight WEIGHT   of mrma: smooth-min, min or constant (default smooth-min)\n"
    "  --map N           texels along a side of a light's map: 16 to 4096 (default 512)\n"
    "  --field N         samples of distance along the longest side: 8 to 512 (default 128)\n"
    "  --cones N         parts of the light that a march is made for: 1, 4, 9 or 16\n"
    "                    (default 1)\n"
    "  --rays N          of mrma, where the map is open: 0 to 256; 0 blends the map's\n"
    "                    moments and a march instead (default 32)\n"
    "  --threshold T     rays only where those two differ by more: 0 to 1, 0 for\n"
    "                    everywhere (default 0)\n"
    "  --near D          rays only this near to the camera (default everywhere)\n"
    "  --samples N       rays of the reference: 1 to 65536 (default 256)\n"
    "  --threads N       1 to 64 (default: one per processor)\n"
    "  --stats FILE      also write times and counts as JSON\n"
    "  -h, --help        print this text\n"
    "\n"
    "Example:\n"
    "  dapple shadow3d room.json -o room.png --stats room-stats.json\n";

static const dpl_choice method_choices[] = {
    {"mrma", DPL_SOLID_MRMA},
    {"moments", DPL_SOLID_MOMENTS},
    {"march", DPL_SOLID_MARCH},
    {"reference", DPL_SOLID_REFERENCE},
    {NULL, 0},
};

static const dpl_choice weight_choices[] = {
    {"smooth-min", DPL_SOLID_WEIGHT_SMOOTH_MIN},
    {"min", DPL_SOLID_WEIGHT_MIN},
    {"constant", DPL_SOLID_WEIGHT_CONSTANT},
    {NULL, 0},
};

static const dpl_choice cone_choices[] = {{"1", 1}, {"4", 4}, {"9", 9}, {"16", 16}, {NULL, 0}};

/* What the desc keeps as other types than options have. */
typedef struct given_options {
    dpl_solid_shadow_order order;
    int method;
    int weight;
    int cones;
    double threshold;
    double near;
} given_options;

static dpl_option whole(const char *name, int32_t *target, double minimum, double maximum) {
    return (dpl_option){
        .name = name, .kind = DPL_OPTION_INTEGER, .target = target, .minimum = minimum, .maximum = maximum};
}

static dpl_option choice(const char *name, int *target, const dpl_choice *choices) {
    return (dpl_option){.name = name, .kind = DPL_OPTION_CHOICE, .target = target, .choices = choices};
}

static int parse(int argc, char **argv, given_options *given) {
    dpl_solid_shadow_order *order = &given->order;
    const dpl_option options[] = {
        {.name = "output", .letter = 'o', .kind = DPL_OPTION_TEXT, .target = &order->output},
        {.name = "stats", .kind = DPL_OPTION_TEXT, .target = &order->stats},
        choice("method", &given->method, method_choices),
        choice("weight", &given->weight, weight_choices),
        choice("cones", &given->cones, cone_choices),
        whole("light", &order->light, 0, 1e6),
        whole("map", &order->shadow.map_resolution, 16, 4096),
        whole("field", &order->field_resolution, 8, DPL_MAX_MESH_RESOLUTION),
        whole("rays", &order->shadow.refine_rays, 0, 256),
        whole("samples", &order->shadow.samples, 1, 65536),
        whole("threads", &order->threads, 1, DPL_MAX_THREADS),
        {.name = "threshold", .kind = DPL_OPTION_NUMBER, .target = &given->threshold, .maximum = 1},
        {.name = "near", .kind = DPL_OPTION_NUMBER, .target = &given->near, .minimum = 1e-6, .maximum = 1e9},
    };
    const dpl_operand operands[] = {{.name = "SCENE", .required = true, .target = &order->scene}};
    const dpl_syntax syntax = {
        .command = "shadow3d",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

static int check_names(const dpl_solid_shadow_order *order) {
    dpl_error error;
    const dpl_tool_files files = {"shadow3d", order->scene, order->output, order->stats};
    int status = dpl_tool_check_files(&files);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (order->shadow.map_resolution % 4 != 0)
        return dpl_report_usage("shadow3d", "--map must be a multiple of 4");
    if (!dpl_path_check_writable(order->output, &error) ||
        (order->stats && !dpl_path_check_writable(order->stats, &error)))
        return dpl_report_failure("%s", error.text);
    return DPL_OPTIONS_GO;
}

static int run(int argc, char **argv) {
    given_options given = {.order = {.shadow = dpl_solid_shadow_desc_default()}};
    dpl_solid_shadow_desc *shadow = &given.order.shadow;
    given.order.light = -1;
    given.order.field_resolution = dpl_mesh_field_desc_default().resolution;
    given.cones = shadow->sub_cones;
    given.threshold = (double)shadow->refine_threshold;
    given.near = (double)shadow->refine_distance;
    int status = parse(argc, argv, &given);
    if (status == DPL_OPTIONS_GO)
        status = check_names(&given.order);
    if (status != DPL_OPTIONS_GO)
        return status;
    shadow->method = (dpl_solid_method)given.method;
    shadow->weight = (dpl_solid_weight)given.weight;
    shadow->sub_cones = given.cones;
    shadow->refine_threshold = (float)given.threshold;
    shadow->refine_distance = (float)given.near;
    return dpl_solid_shadow_run(&given.order);
}

const dpl_command dpl_command_shadow3d = {
    "shadow3d",
    "light meshes with soft shadows",
    help,
    run,
};
