/* Command lines by table, on top of getopt_long. */
#define _GNU_SOURCE
#include "options.h"

#include "report.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* getopt's values for long options lie above every character; --help comes first. */
enum { VALUE_HELP = 256, VALUE_FIRST = 257 };

/* A whole text as an integer. strtoll takes blanks and a plus before a number; a command line does not. */
static bool read_integer(const char *text, double minimum, double maximum, int32_t *value) {
    if (*text != '-' && (*text < '0' || *text > '9'))
        return false;
    char *end;
    errno = 0;
    long long number = strtoll(text, &end, 10);
    if (errno || end == text || *end || (double)number < minimum || (double)number > maximum)
        return false;
    *value = (int32_t)number;
    return true;
}

static bool read_seed(const char *text, uint64_t *value) {
    if (*text < '0' || *text > '9')
        return false;
    char *end;
    errno = 0;
    unsigned long long number = strtoull(text, &end, 10);
    if (errno || *end || number > UINT64_MAX)
        return false;
    *value = (uint64_t)number;
    return true;
}

/* Decimal only: strtod alone would take "nan", "inf", hexadecimal and leading blanks. */
static bool read_number(const char *text, double minimum, double maximum, double *value) {
    if (!*text || strspn(text, "0123456789.+-eE") != strlen(text))
        return false;
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end || !isfinite(number) || number < minimum || number > maximum)
        return false;
    *value = number;
    return true;
}

static bool read_size(const char *text, double minimum, double maximum, int32_t size[2]) {
    char width[16];
    const char *cross = strchr(text, 'x');
    if (!cross || (size_t)(cross - text) >= sizeof width)
        return false;
    memcpy(width, text, (size_t)(cross - text));
    width[cross - text] = 0;
    int32_t result[2];
    if (!read_integer(width, minimum, maximum, &result[0]) ||
        !read_integer(cross + 1, minimum, maximum, &result[1]))
        return false;
    memcpy(size, result, sizeof result);
    return true;
}

static int report_choices(const char *command, const dpl_option *option, const char *text) {
    char list[256] = "";
    size_t used = 0;
    for (const dpl_choice *choice = option->choices; choice->name && used < sizeof list; choice++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", choice->name);
    return dpl_report_usage(command, "--%s cannot be '%s', only one of: %s", option->name, text, list);
}

static int read_choice(const char *command, const dpl_option *option, const char *text) {
    for (const dpl_choice *choice = option->choices; choice->name; choice++)
        if (strcmp(choice->name, text) == 0) {
            *(int *)option->target = choice->value;
            return DPL_OPTIONS_GO;
        }
    return report_choices(command, option, text);
}

static int report_range(const char *command, const dpl_option *option, const char *what, const char *text) {
    return dpl_report_usage(command, "--%s needs %s from %.10g to %.10g, not '%s'", option->name, what,
                            option->minimum, option->maximum, text);
}

static int read_value(const char *command, const dpl_option *option, const char *text) {
    switch (option->kind) {
    case DPL_OPTION_FLAG:
        *(bool *)option->target = true;
        return DPL_OPTIONS_GO;
    case DPL_OPTION_TEXT:
        *(const char **)option->target = text;
        return DPL_OPTIONS_GO;
    case DPL_OPTION_INTEGER:
        if (read_integer(text, option->minimum, option->maximum, option->target))
            return DPL_OPTIONS_GO;
        return report_range(command, option, "a whole number", text);
    case DPL_OPTION_SEED:
        if (read_seed(text, option->target))
            return DPL_OPTIONS_GO;
        return dpl_report_usage(command, "--%s needs a whole number from 0 to 18446744073709551615, not '%s'",
                                option->name, text);
    case DPL_OPTION_NUMBER:
        if (read_number(text, option->minimum, option->maximum, option->target))
            return DPL_OPTIONS_GO;
        return report_range(command, option, "a number", text);
    case DPL_OPTION_SIZE:
        if (read_size(text, option->minimum, option->maximum, option->target))
            return DPL_OPTIONS_GO;
        return report_range(command, option, "a size WxH with both", text);
    case DPL_OPTION_CHOICE:
        break;
    }
    return read_choice(command, option, text);
}

/* getopt's own tables, made from ours. */
typedef struct getopt_tables {
    struct option longs[DPL_OPTIONS_MAX + 2];
    char letters[2 * DPL_OPTIONS_MAX + 4];
} getopt_tables;

static void fill_tables(const dpl_syntax *syntax, getopt_tables *tables) {
    memset(tables, 0, sizeof *tables);
    char *letter = tables->letters;
    *letter++ = ':'; /* tells a missing value from an unknown option */
    *letter++ = 'h';
    tables->longs[0] = (struct option){.name = "help", .val = VALUE_HELP};
    for (int i = 0; i < syntax->option_count; i++) {
        const dpl_option *option = &syntax->options[i];
        bool has_value = option->kind != DPL_OPTION_FLAG;
        tables->longs[i + 1] = (struct option){.name = option->name,
                                               .has_arg = has_value ? required_argument : no_argument,
                                               .val = VALUE_FIRST + i};
        if (option->letter) {
            *letter++ = option->letter;
            if (has_value)
                *letter++ = ':';
        }
    }
}

static const dpl_option *find_option(const dpl_syntax *syntax, int value) {
    for (int i = 0; i < syntax->option_count; i++)
        if (value == VALUE_FIRST + i || (value != 0 && value == syntax->options[i].letter))
            return &syntax->options[i];
    return NULL;
}

/* What getopt found wrong: `found` is its result, optopt and argv say about what. */
static int report_getopt(const dpl_syntax *syntax, int found, char **argv) {
    const dpl_option *option = find_option(syntax, optopt);
    if (found == ':' && option)
        return dpl_report_usage(syntax->command, "%s needs a value", argv[optind - 1]);
    if (option || optopt == VALUE_HELP)
        return dpl_report_usage(syntax->command, "--%s takes no value", option ? option->name : "help");
    if (optopt != 0)
        return dpl_report_usage(syntax->command, "unknown option '-%c'", optopt);
    return dpl_report_usage(syntax->command, "unknown option '%s'", argv[optind - 1]);
}

static int read_operands(const dpl_syntax *syntax, int argc, char **argv) {
    int next = optind;
    for (int i = 0; i < syntax->operand_count; i++) {
        const dpl_operand *operand = &syntax->operands[i];
        if (next < argc)
            *operand->target = argv[next++];
        else if (operand->required)
            return dpl_report_usage(syntax->command, "%s is missing", operand->name);
    }
    if (next < argc)
        return dpl_report_usage(syntax->command, "unexpected argument '%s'", argv[next]);
    return DPL_OPTIONS_GO;
}

int dpl_options_parse(const dpl_syntax *syntax, int argc, char **argv) {
    getopt_tables tables;
    fill_tables(syntax, &tables);
    opterr = 0;
    for (;;) {
        int found = getopt_long(argc, argv, tables.letters, tables.longs, NULL);
        if (found == -1)
            return read_operands(syntax, argc, argv);
        if (found == 'h' || found == VALUE_HELP) {
            fputs(syntax->help, stdout);
            return DPL_EXIT_DONE;
        }
        if (found == '?' || found == ':')
            return report_getopt(syntax, found, argv);
        const dpl_option *option = find_option(syntax, found);
        int status = read_value(syntax->command, option, optarg);
        if (status != DPL_OPTIONS_GO)
            return status;
        if (option->given)
            *option->given = true;
    }
}
