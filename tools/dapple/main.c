/* The command `dapple`: finds the subcommand and runs it. */
#define _POSIX_C_SOURCE 200809L
#include "command.h"
#include "report.h"

#include <dapple/version.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const dpl_command *const commands[] = {
    &dpl_command_render,     &dpl_command_trace,   &dpl_command_flood,  &dpl_command_shadow,
    &dpl_command_shadow3d,   &dpl_command_compare, &dpl_command_scenes, &dpl_command_study,
    &dpl_command_complexity, &dpl_command_info,
};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static const dpl_command *find_command(const char *name) {
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(commands[i]->name, name) == 0)
            return commands[i];
    return NULL;
}

static int print_overview(void) {
    fputs("Usage: dapple COMMAND [ARGUMENTS]\n"
          "\n"
          "2D global illumination: scenes in, light out.\n"
          "\n"
          "Commands:\n",
          stdout);
    for (int i = 0; i < COMMAND_COUNT; i++)
        printf("  %-10s  %s\n", commands[i]->name, commands[i]->summary);
    fputs("\n"
          "Options:\n"
          "  -h, --help  print this text\n"
          "  --version   print the version\n"
          "\n"
          "`dapple help COMMAND` or `dapple COMMAND --help` explains a command.\n"
          "\n"
          "Exit status: 0 done; 1 the work failed, with one line that says why; 2 wrong usage.\n"
          "\n"
          "Example: light a scene and look at it\n"
          "  dapple render scene.json -o light.png\n",
          stdout);
    return DPL_EXIT_DONE;
}

static int print_version(void) {
    printf("dapple %s\n", dpl_version());
    return DPL_EXIT_DONE;
}

static int help_command(int argc, char **argv) {
    if (argc == 1)
        return print_overview();
    if (argc > 2)
        return dpl_report_usage(NULL, "unexpected argument '%s'", argv[2]);
    const dpl_command *command = find_command(argv[1]);
    if (!command)
        return dpl_report_usage(NULL, "unknown command '%s'", argv[1]);
    fputs(command->help, stdout);
    return DPL_EXIT_DONE;
}

static int run_first_argument(int argc, char **argv) {
    if (argc < 2)
        return dpl_report_usage(NULL, "a command is missing");
    const char *first = argv[1];
    const dpl_command *command = find_command(first);
    if (command)
        return command->run(argc - 1, argv + 1);
    if (strcmp(first, "help") == 0)
        return help_command(argc - 1, argv + 1);
    bool is_help = strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0;
    if (!is_help && strcmp(first, "--version") != 0)
        return dpl_report_usage(NULL, "unknown %s '%s'", first[0] == '-' ? "option" : "command", first);
    if (argc > 2)
        return dpl_report_usage(NULL, "unexpected argument '%s'", argv[2]);
    return is_help ? print_overview() : print_version();
}

/* A standard stream that was closed would have its number given to the next file that is opened, and results
 * printed into that. An unusable stand-in makes printing fail instead. */
static bool keep_standard_streams(void) {
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; number++) {
        if (fcntl(number, F_GETFD) != -1)
            continue;
        int stand_in = open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        if (stand_in != number)
            return false;
    }
    return true;
}

int main(int argc, char **argv) {
    if (!keep_standard_streams())
        return DPL_EXIT_FAILED;
    /* A reader that goes away is a write that fails, and is reported as one. */
    signal(SIGPIPE, SIG_IGN);
    int status = run_first_argument(argc, argv);
    return status == DPL_EXIT_DONE ? dpl_report_finish_output() : status;
}
