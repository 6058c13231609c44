/* dapple info: what this build and this machine can do, and what a cascade schedule looks like. */
#define _POSIX_C_SOURCE 200809L
#include "cascades.h"
#include "command.h"
#include "json.h"
#include "options.h"
#include "report.h"
#include "schedule_report.h"

#include "image/picture.h"

#include <dapple/context.h>
#include <dapple/solver.h>
#include <dapple/version.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

static const char help[] =
    "Usage: dapple info [--json]\n"
    "       dapple info --schedule WxH [--merge MERGE] [--spacing N] [--directions N]\n"
    "                   [--interval PX] [--levels N] [--profile PROFILE] [--json]\n"
    "\n"
    "Prints what this build and this machine can do, or the cascade schedule of a picture\n"
    "of W by H pixels: the probes, directions and intervals of every level.\n"
    "\n"
    "Options:\n"
    "  --schedule WxH  print the schedule for a picture of this size: each 1 to 16384 px\n"
    "  --merge MERGE   bilinear, bilinear-fix or nearest-fix (default bilinear-fix)\n"
    "  --spacing N     between the probes of level 0: 1 to 64 px (default 1)\n"
    "  --directions N  of each probe of level 0: a multiple of 4, 4 to 1024 (default 4)\n"
    "  --interval PX   length of the rays of level 0: 0.25 to 1024 px (default: two spacings)\n"
    "  --profile PROFILE default, or paper: that of the ARC paper (default default)\n"
    "  --levels N      number of levels: 1 to 12 (default: until the diagonal is covered)\n"
    "  --json          print JSON (default: a table)\n"
    "  -h, --help      print this text\n"
    "\n"
    "Example: what a full-HD frame costs\n"
    "  dapple info --schedule 1920x1080\n";

typedef struct info_options {
    int32_t size[2]; /* of the picture whose schedule is asked for */
    bool size_given;
    dpl_cascades_settings cascades;
    bool json;
} info_options;

/* What there is to tell. */
typedef struct information {
    char build[160];
    char machine[256];
    char isas[64];
    const char *isa;
    int processors;
    int threads;
    bool exr;
} information;

static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
static const dpl_solver_kind solvers[] = {DPL_SOLVER_HOLOGRAPHIC, DPL_SOLVER_CASCADES, DPL_SOLVER_REFERENCE};

enum { ISA_COUNT = sizeof isas / sizeof isas[0], SOLVER_COUNT = sizeof solvers / sizeof solvers[0] };

static int parse(int argc, char **argv, info_options *given) {
    enum { OWN = 2 };
    dpl_option options[OWN + DPL_CASCADES_OPTION_COUNT] = {
        {.name = "schedule",
         .kind = DPL_OPTION_SIZE,
         .target = given->size,
         .minimum = 1,
         .maximum = DPL_MAX_SIZE,
         .given = &given->size_given},
        {.name = "json", .kind = DPL_OPTION_FLAG, .target = &given->json},
    };
    dpl_cascades_fill_options(&given->cascades, 1024, options + OWN);
    const dpl_syntax syntax = {
        .command = "info",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
    };
    int status = dpl_options_parse(&syntax, argc, argv);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (!given->size_given &&
        (given->cascades.given || given->cascades.merge_given || given->cascades.directions_given))
        return dpl_report_usage("info", "settings of a schedule go with --schedule");
    return dpl_cascades_settings_finish(&given->cascades, "info");
}

static void describe_build(char *text, size_t size) {
#if defined(__clang__)
    const char *compiler = "clang " __clang_version__;
#elif defined(__GNUC__)
    const char *compiler = "gcc " __VERSION__;
#else
    const char *compiler = "unknown compiler";
#endif
    const char *sanitizers = DPL_BUILD_SANITIZE;
    snprintf(text, size, "%s, %s%s%s", DPL_BUILD_TYPE, compiler, sanitizers[0] ? ", sanitizers " : "",
             sanitizers);
}

static void describe_machine(char *text, size_t size) {
    struct utsname name;
    if (uname(&name) < 0)
        snprintf(text, size, "unknown");
    else
        snprintf(text, size, "%.80s %.80s", name.sysname, name.machine);
}

static void list_isas(char *text, size_t size) {
    uint32_t available = dpl_isa_available();
    size_t used = 0;
    for (int i = 0; i < ISA_COUNT && used < size; i++)
        if (available & (uint32_t)isas[i])
            used +=
                (size_t)snprintf(text + used, size - used, "%s%s", used ? " " : "", dpl_isa_name(isas[i]));
}

static int collect(information *info) {
    dpl_context *context;
    dpl_status status = dpl_context_create(NULL, &context);
    if (status != DPL_OK)
        return dpl_report_status(NULL, status);
    describe_build(info->build, sizeof info->build);
    describe_machine(info->machine, sizeof info->machine);
    list_isas(info->isas, sizeof info->isas);
    info->isa = dpl_isa_name(dpl_context_isa(context));
    info->processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    info->threads = (int)dpl_context_thread_count(context);
    info->exr = dpl_picture_has_exr();
    dpl_context_destroy(context);
    return DPL_EXIT_DONE;
}

static int print_table(const information *info) {
    printf("version      dapple %s\n", dpl_version());
    printf("build        %s\n", info->build);
    printf("machine      %s, %d processors\n", info->machine, info->processors);
    printf("isa          %s (usable: %s)\n", info->isa, info->isas);
    printf("threads      %d (at most %d)\n", info->threads, DPL_MAX_THREADS);
    printf("exr          %s\n", info->exr ? "yes" : "no");
    printf("solvers     ");
    for (int i = 0; i < SOLVER_COUNT; i++)
        printf(" %s", dpl_solver_kind_name(solvers[i]));
    printf("\n");
    return DPL_EXIT_DONE;
}

static json_t *isas_json(void) {
    json_t *list = json_array();
    for (int i = 0; i < ISA_COUNT; i++)
        if (dpl_isa_available() & (uint32_t)isas[i])
            list = dpl_json_append(list, json_string(dpl_isa_name(isas[i])));
    return list;
}

static json_t *solvers_json(void) {
    json_t *list = json_array();
    for (int i = 0; i < SOLVER_COUNT; i++)
        list = dpl_json_append(list, json_string(dpl_solver_kind_name(solvers[i])));
    return list;
}

static int print_json(const information *info) {
    return dpl_json_print(json_pack("{s:s, s:s, s:s, s:i, s:s, s:o, s:i, s:b, s:o}", "version", dpl_version(),
                                    "build", info->build, "machine", info->machine, "processors",
                                    info->processors, "isa", info->isa, "isas", isas_json(), "threads",
                                    info->threads, "exr", (int)info->exr, "solvers", solvers_json()));
}

static int run(int argc, char **argv) {
    info_options given = {.cascades = dpl_cascades_settings_default()};
    int status = parse(argc, argv, &given);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (given.size_given)
        return dpl_schedule_report(&given.cascades.desc, given.size[0], given.size[1], given.json);
    information info = {0};
    status = collect(&info);
    if (status != DPL_EXIT_DONE)
        return status;
    return given.json ? print_json(&info) : print_table(&info);
}

const dpl_command dpl_command_info = {
    "info",
    "what this build and this machine can do",
    help,
    run,
};
