/* dapple render: a scene file goes in, a picture of its light comes out. */
#include "cascades.h"
#include "command.h"
#include "holographic.h"
#include "options.h"
#include "output.h"
#include "paths.h"
#include "render.h"
#include "report.h"
#include "skip.h"

#include "image/picture.h"

#include <stdio.h>

static const char help[] =
    "Usage: dapple render SCENE -o OUT [options]\n"
    "\n"
    "Lights SCENE (a scene file, or a PNG of walls and lamps) and writes the mean radiance\n"
    "that arrives at each pixel's centre. The scene's `lights`, discs that shine and block\n"
    "nothing, are added with their shadows.\n"
    "\n"
    "Output:\n"
    "  -o, --output OUT     .png is tone-mapped sRGB for looking at; .pfm and .exr hold the\n"
    "                       linear result; - writes PFM to standard output\n"
    "  --stats FILE         also write times and counted rays as JSON\n"
    "\n"
    "Method:\n"
    "  --solver SOLVER      holographic, cascades, or reference, which is brute force (default\n"
    "                       holographic; cascades where one of their settings is given)\n"
    "  --bounces N          holographic and reference: how often walls reflect light, by their\n"
    "                       albedo, that of `lights` too: 0 to 8 (default 0)\n"
    "  --directions N       cascades: of each probe of level 0, a multiple of 4, 4 to 1024\n"
    "                       (default 4); reference: of each pixel, 1 to 1048576\n"
    "                       (default 4096)\n"
    "  --margin N           of the world around the picture, in place of the scene's own:\n"
    "                       0 to 4096 px. Lamps and walls there act but are not shown\n"
    "\n"
    "Holographic only:\n"
    "  --storage STORAGE    float, or half: faster, in half the memory (default float)\n"
    "  --resolution RES     full: a probe per pixel; half or quarter: per 2 x 2 or 4 x 4\n"
    "                       pixels, faster; double: four per pixel, about half the error for\n"
    "                       five times the time (default full)\n"
    "\n"
    "Lights:\n"
    "  --shadow METHOD      of `lights`: exact, rays (fast), mrma or reference (default exact)\n"
    "  --lights ON          on, or off: leave `lights` out (default on)\n"
    "\n"
    "Cascades only:\n"
    "  --merge MERGE        bilinear, bilinear-fix or nearest-fix (default bilinear-fix)\n"
    "  --spacing N          between the probes of level 0: 1 to 64 px (default 1)\n"
    "  --interval PX        length of the rays of level 0: 0.25 to 1024 px (default: two\n"
    "                       spacings)\n"
    "  --levels N           number of levels: 1 to 12 (default: until the diagonal is\n"
    "                       covered)\n"
    "  --profile PROFILE    default, or paper: geometry, march and edge blend of the ARC\n"
    "                       paper's own code, for scenes of shapes (default default)\n"
    "\n"
    "Ray skipping, cascades only:\n"
    "  --skip MODE          which rays to leave out: off, L5, L4, L3 or L2 (of five levels\n"
    "                       10, 20, 25 or 40 % of the rays), auto (L5, L4 or L3 by how\n"
    "                       bright and uneven the light is), custom, exact (what is\n"
    "                       proved not to matter: the picture of off, bit for bit) or\n"
    "                       bounded (more, within a bound on the error) (default off)\n"
    "  --skip-start LEVEL   custom: first level that skips: 0 to 11 (default 0)\n"
    "  --skip-bits BITS     custom: most skipping is 2^BITS: 0 to 2 (default 0)\n"
    "  --skip-low SCORE     auto: L5 below this (default 0.45)\n"
    "  --skip-high SCORE    auto: L4 below this, from there on L3 (default 1)\n"
    "  --skip-probes N      auto: probes to look at: 1 to 65536 (default 64; paper 16)\n"
    "  --bound DB           bounded: psnr_display against off to stay above: 20 to 120\n"
    "                       (default 50)\n"
    "  --skip-seed N        bounded: of the sample of guesses that is checked (default 0)\n"
    "\n"
    "Work:\n"
    "  --threads N          1 to 64 (default: one per processor)\n"
    "  --isa ISA            auto, scalar, sse2, avx2 or avx512 (default auto, the best that\n"
    "                       there is)\n"
    "  -h, --help           print this text\n"
    "\n"
    "The result is the same for every number of threads and every ISA. Ctrl-C ends the work\n"
    "and leaves no file.\n"
    "\n"
    "Example:\n"
    "  dapple render scene.json -o light.exr --merge nearest-fix --stats light.json\n";

#define REFERENCE_DIRECTIONS_MAX 1048576

static const dpl_choice solver_choices[] = {
    {"holographic", DPL_SOLVER_HOLOGRAPHIC},
    {"cascades", DPL_SOLVER_CASCADES},
    {"reference", DPL_SOLVER_REFERENCE},
    {NULL, 0},
};

static const dpl_choice isa_choices[] = {
    {"auto", DPL_ISA_ALL},  {"scalar", DPL_ISA_SCALAR}, {"sse2", DPL_ISA_SSE2},
    {"avx2", DPL_ISA_AVX2}, {"avx512", DPL_ISA_AVX512}, {NULL, 0},
};

static const dpl_choice shadow_choices[] = {
    {"exact", DPL_SHADOW_EXACT},
    {"rays", DPL_SHADOW_RAYS},
    {"mrma", DPL_SHADOW_MRMA},
    {"reference", DPL_SHADOW_REFERENCE},
    {NULL, 0},
};

static const dpl_choice switch_choices[] = {{"on", 1}, {"off", 0}, {NULL, 0}};

typedef struct render_options {
    const char *scene;
    const char *output;
    const char *stats;
    int solver;
    bool solver_given;
    int isa;
    int shadow;
    int lights;
    int32_t threads;
    int32_t bounces;
    int32_t margin;
    dpl_cascades_settings cascades;
    dpl_skip_settings skip;
    dpl_holographic_settings holographic;
} render_options;

static int parse(int argc, char **argv, render_options *given) {
    enum { OWN = 9 };
    dpl_option options[OWN + DPL_CASCADES_OPTION_COUNT + DPL_SKIP_OPTION_COUNT +
                       DPL_HOLOGRAPHIC_OPTION_COUNT] = {
        {.name = "output", .letter = 'o', .kind = DPL_OPTION_TEXT, .target = &given->output},
        {.name = "stats", .kind = DPL_OPTION_TEXT, .target = &given->stats},
        {.name = "solver",
         .kind = DPL_OPTION_CHOICE,
         .target = &given->solver,
         .choices = solver_choices,
         .given = &given->solver_given},
        {.name = "isa", .kind = DPL_OPTION_CHOICE, .target = &given->isa, .choices = isa_choices},
        {.name = "shadow", .kind = DPL_OPTION_CHOICE, .target = &given->shadow, .choices = shadow_choices},
        {.name = "lights", .kind = DPL_OPTION_CHOICE, .target = &given->lights, .choices = switch_choices},
        {.name = "threads",
         .kind = DPL_OPTION_INTEGER,
         .target = &given->threads,
         .minimum = 1,
         .maximum = DPL_MAX_THREADS},
        {.name = "bounces",
         .kind = DPL_OPTION_INTEGER,
         .target = &given->bounces,
         .minimum = 0,
         .maximum = DPL_MAX_BOUNCES},
        {.name = "margin",
         .kind = DPL_OPTION_INTEGER,
         .target = &given->margin,
         .minimum = 0,
         .maximum = DPL_MAX_MARGIN},
    };
    dpl_cascades_fill_options(&given->cascades, REFERENCE_DIRECTIONS_MAX, options + OWN);
    dpl_skip_fill_options(&given->skip, options + OWN + DPL_CASCADES_OPTION_COUNT);
    dpl_holographic_fill_options(&given->holographic,
                                 options + OWN + DPL_CASCADES_OPTION_COUNT + DPL_SKIP_OPTION_COUNT);
    const dpl_operand operands[] = {{.name = "SCENE", .required = true, .target = &given->scene}};
    const dpl_syntax syntax = {
        .command = "render",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

/* Settings that some solvers lack. */
enum {
    SET_CASCADES = 1 << 0,
    SET_SKIP = 1 << 1,
    SET_DIRECTIONS = 1 << 2,
    SET_HOLOGRAPHIC = 1 << 3,
    SET_BOUNCES = 1 << 4
};

#define CASCADES_SETTINGS "--merge, --profile, --spacing, --interval and --levels are settings of cascades, "
#define HOLOGRAPHIC_SETTINGS "--storage and --resolution are settings of the holographic solver, "

/* A setting that does nothing is a mistake. */
static const struct {
    dpl_solver_kind solver;
    unsigned settings;
    const char *refusal;
} refusals[] = {
    {DPL_SOLVER_HOLOGRAPHIC, SET_CASCADES, CASCADES_SETTINGS "not of the holographic solver"},
    {DPL_SOLVER_HOLOGRAPHIC, SET_SKIP,
     "--skip is a setting of cascades: the holographic solver skips no ray"},
    {DPL_SOLVER_HOLOGRAPHIC, SET_DIRECTIONS,
     "--directions is a setting of cascades and of the reference: the holographic solver has its own"},
    {DPL_SOLVER_CASCADES, SET_HOLOGRAPHIC, HOLOGRAPHIC_SETTINGS "not of cascades"},
    {DPL_SOLVER_CASCADES, SET_BOUNCES,
     "--bounces is a setting of the holographic solver and of the reference: cascades reflect no light"},
    {DPL_SOLVER_REFERENCE, SET_CASCADES, CASCADES_SETTINGS "not of the reference"},
    {DPL_SOLVER_REFERENCE, SET_SKIP, "--skip is a setting of cascades: the reference leaves out no ray"},
    {DPL_SOLVER_REFERENCE, SET_HOLOGRAPHIC, HOLOGRAPHIC_SETTINGS "not of the reference"},
};

static unsigned settings_of(const render_options *given) {
    const dpl_cascades_settings *cascades = &given->cascades;
    return (cascades->given || cascades->merge_given ? SET_CASCADES : 0u) |
           (given->skip.desc.mode != DPL_SKIP_OFF ? SET_SKIP : 0u) |
           (cascades->directions_given ? SET_DIRECTIONS : 0u) |
           (given->holographic.given ? SET_HOLOGRAPHIC : 0u) | (given->bounces > 0 ? SET_BOUNCES : 0u);
}

static int choose_solver(render_options *given, dpl_solver_desc *desc) {
    int status = dpl_skip_settings_finish(&given->skip, "render");
    if (status != DPL_OPTIONS_GO)
        return status;
    unsigned settings = settings_of(given);
    if (!given->solver_given && (settings & (SET_CASCADES | SET_SKIP | SET_DIRECTIONS)))
        given->solver = DPL_SOLVER_CASCADES;
    desc->kind = (dpl_solver_kind)given->solver;
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++)
        if (refusals[i].solver == desc->kind && (refusals[i].settings & settings))
            return dpl_report_usage("render", "%s", refusals[i].refusal);
    desc->bounces = given->bounces;
    desc->holographic.storage = (dpl_storage)given->holographic.storage;
    desc->holographic.resolution = (dpl_resolution)given->holographic.resolution;
    desc->reference.directions = given->cascades.desc.directions;
    if (desc->kind != DPL_SOLVER_CASCADES)
        return DPL_OPTIONS_GO;
    status = dpl_cascades_settings_finish(&given->cascades, "render");
    desc->cascades = given->cascades.desc;
    desc->cascades.skip = given->skip.desc;
    return status;
}

/* Names that cannot be right, whatever is on the disk. */
static int check_isa(const render_options *given) {
    uint32_t available = dpl_isa_available();
    if (available & (uint32_t)given->isa)
        return DPL_OPTIONS_GO;
    char list[64] = "";
    size_t used = 0;
    const char *asked = "?";
    for (const dpl_choice *choice = isa_choices; choice->name && used < sizeof list; choice++) {
        if (choice->value == given->isa)
            asked = choice->name;
        if (choice->value != DPL_ISA_ALL && (available & (uint32_t)choice->value))
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", choice->name);
    }
    return dpl_report_failure("--isa %s: not on this machine or not in this build, which have %s", asked,
                              list);
}

static int check(render_options *given, dpl_solver_desc *desc) {
    dpl_error error;
    const dpl_tool_files files = {"render", given->scene, given->output, given->stats};
    int status = choose_solver(given, desc);
    if (status == DPL_OPTIONS_GO)
        status = dpl_tool_check_files(&files);
    if (status == DPL_OPTIONS_GO)
        status = check_isa(given);
    if (status == DPL_OPTIONS_GO && !dpl_path_check_writable(given->output, &error))
        status = dpl_report_failure("%s", error.text);
    return status;
}

static int run(int argc, char **argv) {
    render_options given = {.solver = DPL_SOLVER_HOLOGRAPHIC,
                            .isa = DPL_ISA_ALL,
                            .shadow = DPL_SHADOW_EXACT,
                            .lights = 1,
                            .margin = -1,
                            .cascades = dpl_cascades_settings_default()};
    dpl_render_order order = {.solver = dpl_solver_desc_default(), .shadow = dpl_shadow_desc_default()};
    int status = parse(argc, argv, &given);
    if (status == DPL_OPTIONS_GO)
        status = check(&given, &order.solver);
    if (status != DPL_OPTIONS_GO)
        return status;
    order.scene = given.scene;
    order.output = given.output;
    order.stats = given.stats;
    order.shadow.method = (dpl_shadow_method)given.shadow;
    order.with_lights = given.lights != 0;
    order.threads = given.threads;
    order.isa_mask = (uint32_t)given.isa;
    order.margin = given.margin;
    return dpl_render_run(&order);
}

const dpl_command dpl_command_render = {
    "render",
    "light a scene and write the picture",
    help,
    run,
};
