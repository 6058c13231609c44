/* What a subcommand is. Each cmd_*.c defines one; main.c has them in a table. */
#ifndef DPL_TOOL_COMMAND_H
#define DPL_TOOL_COMMAND_H

typedef struct dpl_command {
    const char *name;
    const char *summary; /* one line, for `dapple --help` */
    const char *help;    /* all of `dapple NAME --help` */
    /* argv[0] is the subcommand's name. Returns the exit status (report.h). */
    int (*run)(int argc, char **argv);
} dpl_command;

extern const dpl_command dpl_command_render;
extern const dpl_command dpl_command_trace;
extern const dpl_command dpl_command_flood;
extern const dpl_command dpl_command_shadow;
extern const dpl_command dpl_command_shadow3d;
extern const dpl_command dpl_command_compare;
extern const dpl_command dpl_command_scenes;
extern const dpl_command dpl_command_study;
extern const dpl_command dpl_command_complexity;
extern const dpl_command dpl_command_info;

#endif
