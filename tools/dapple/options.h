/* Options of a subcommand as a table: names, types and ranges as data, parsed and checked in one place. Used
 * by every command. */
#ifndef DPL_TOOL_OPTIONS_H
#define DPL_TOOL_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

/* What an option's value is, and what dpl_option.target points to. */
typedef enum dpl_option_kind {
    DPL_OPTION_FLAG,    /* no value; bool, set to true */
    DPL_OPTION_TEXT,    /* const char * */
    DPL_OPTION_INTEGER, /* int32_t within minimum .. maximum */
    DPL_OPTION_SEED,    /* uint64_t */
    DPL_OPTION_NUMBER,  /* double within minimum .. maximum */
    DPL_OPTION_CHOICE,  /* int: the value of one of `choices` */
    DPL_OPTION_SIZE     /* int32_t[2]: WxH, both within minimum .. maximum */
} dpl_option_kind;

/* One name of an enumeration. Lists end with a NULL name. */
typedef struct dpl_choice {
    const char *name;
    int value;
} dpl_choice;

typedef struct dpl_option {
    const char *name; /* without the dashes */
    char letter;      /* short form, or 0 */
    dpl_option_kind kind;
    void *target; /* keeps what it holds when the option is not given */
    double minimum;
    double maximum;
    const dpl_choice *choices;
    bool *given; /* set to true when the option is there; may be NULL */
} dpl_option;

/* Most options of one command. */
#define DPL_OPTIONS_MAX 32

/* An argument without dashes. */
typedef struct dpl_operand {
    const char *name; /* for messages, as the help text spells it */
    bool required;
    const char **target;
} dpl_operand;

/* Everything that a command line of one command may say. */
typedef struct dpl_syntax {
    const char *command;
    const char *help; /* printed by --help, which every command has */
    const dpl_option *options;
    int option_count; /* at most DPL_OPTIONS_MAX */
    const dpl_operand *operands;
    int operand_count;
} dpl_syntax;

/* Nothing left to say: the command may start. No exit status has this value. */
#define DPL_OPTIONS_GO (-1)

/* Reads a command line (argv[0] is skipped). Returns DPL_OPTIONS_GO, or the exit status after --help or after
 * a wrong argument (which has been reported). */
int dpl_options_parse(const dpl_syntax *syntax, int argc, char **argv);

#endif
