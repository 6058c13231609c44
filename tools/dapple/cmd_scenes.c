/* dapple scenes: writes the seeded scene families as scene files. */
#include "command.h"
#include "options.h"
#include "paths.h"
#include "report.h"

#include "scenes/families.h"

#include <stdio.h>

#define DEFAULT_SIZE 512

static const char help[] =
    "Usage: dapple scenes [NAME] --seed N --out DIR [--size PX]\n"
    "       dapple scenes --list\n"
    "\n"
    "Writes every scene of the family NAME as DIR/NAME-00.json and so on; without NAME,\n"
    "of all families. The same seed gives the same bytes on every machine.\n"
    "\n"
    "Options:\n"
    "  --seed N    where the random numbers start: 0 to 18446744073709551615\n"
    "  --out DIR   folder for the files; made if it is missing\n"
    "  --size PX   width and height of the scenes: 1 to 16384 (default 512)\n"
    "  --list      print the families: name, number of scenes, what they are\n"
    "  -h, --help  print this text\n"
    "\n"
    "Example: the 50 configurations of the ARC paper\n"
    "  dapple scenes arc --seed 1 --out out/arc\n";

static int list_families(void) {
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    for (int32_t i = 0; i < count; i++)
        printf("%-12s %4d  %s\n", families[i].name, (int)families[i].count, families[i].summary);
    return DPL_EXIT_DONE;
}

static int write_families(const dpl_scene_family *families, int32_t count, uint64_t seed, int32_t size,
                          const char *folder) {
    dpl_error error;
    if (!dpl_path_make_folder(folder, &error))
        return dpl_report_failure("%s", error.text);
    for (int32_t i = 0; i < count; i++)
        if (!dpl_scene_family_write(&families[i], seed, size, folder, &error))
            return dpl_report_failure("%s", error.text);
    return DPL_EXIT_DONE;
}

typedef struct scenes_options {
    const char *name;
    const char *folder;
    uint64_t seed;
    int32_t size;
    bool seed_given;
    bool list;
} scenes_options;

static int parse(int argc, char **argv, scenes_options *given) {
    const dpl_option options[] = {
        {.name = "seed", .kind = DPL_OPTION_SEED, .target = &given->seed, .given = &given->seed_given},
        {.name = "out", .kind = DPL_OPTION_TEXT, .target = &given->folder},
        {.name = "size",
         .kind = DPL_OPTION_INTEGER,
         .target = &given->size,
         .minimum = 1,
         .maximum = DPL_MAX_SIZE},
        {.name = "list", .kind = DPL_OPTION_FLAG, .target = &given->list},
    };
    const dpl_operand operands[] = {{.name = "NAME", .target = &given->name}};
    const dpl_syntax syntax = {
        .command = "scenes",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

static int run(int argc, char **argv) {
    scenes_options given = {.size = DEFAULT_SIZE};
    int status = parse(argc, argv, &given);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (given.list) {
        if (given.name || given.folder || given.seed_given)
            return dpl_report_usage("scenes", "--list goes alone");
        return list_families();
    }
    if (!given.seed_given)
        return dpl_report_usage("scenes", "--seed is missing");
    if (!given.folder || !given.folder[0])
        return dpl_report_usage("scenes", "--out is missing");
    int32_t count = 1;
    const dpl_scene_family *families =
        given.name ? dpl_scene_family_find(given.name) : dpl_scene_families(&count);
    if (!families)
        return dpl_report_usage("scenes", "there is no family '%s'; --list prints those there are",
                                given.name);
    return write_families(families, count, given.seed, given.size, given.folder);
}

const dpl_command dpl_command_scenes = {
    "scenes",
    "write the seeded scene families as scene files",
    help,
    run,
};
