/* Reads a command line by table. Called by both main.c. */
#include "options.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int dpl_bench_usage(const char *program, const char *format, ...) {
    va_list arguments;
    fprintf(stderr, "%s: ", program);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, "; see %s --help\n", program);
    return DPL_BENCH_USAGE;
}

/* Digits alone: strtoull would also take blanks and signs. */
static bool read_whole(const char *text, uint64_t *value) {
    char *end;
    if (*text < '0' || *text > '9')
        return false;
    errno = 0;
    *value = strtoull(text, &end, 10);
    return errno == 0 && *end == 0;
}

static int read_value(const char *program, const dpl_bench_option *option, const char *text) {
    uint64_t whole = 0;
    if (option->kind == DPL_BENCH_TEXT) {
        *(const char **)option->target = text;
        return DPL_BENCH_GO;
    }
    bool good = read_whole(text, &whole);
    if (option->kind == DPL_BENCH_SEED) {
        if (!good)
            return dpl_bench_usage(program, "--%s needs a whole number, not '%s'", option->name, text);
        *(uint64_t *)option->target = whole;
        return DPL_BENCH_GO;
    }
    if (!good || whole < (uint64_t)option->minimum || whole > (uint64_t)option->maximum)
        return dpl_bench_usage(program, "--%s needs a whole number from %d to %d, not '%s'", option->name,
                               (int)option->minimum, (int)option->maximum, text);
    *(int32_t *)option->target = (int32_t)whole;
    return DPL_BENCH_GO;
}

static const dpl_bench_option *find(const dpl_bench_option *options, int count, const char *argument) {
    if (strncmp(argument, "--", 2) != 0)
        return NULL;
    for (int i = 0; i < count; i++)
        if (strcmp(options[i].name, argument + 2) == 0)
            return &options[i];
    return NULL;
}

int dpl_bench_options_read(const char *program, const char *help, const dpl_bench_option *options, int count,
                           int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(help, stdout);
            return DPL_BENCH_DONE;
        }
        const dpl_bench_option *option = find(options, count, argv[i]);
        if (!option)
            return dpl_bench_usage(program, "unknown argument '%s'", argv[i]);
        if (option->kind == DPL_BENCH_FLAG) {
            *(bool *)option->target = true;
            continue;
        }
        if (i + 1 == argc)
            return dpl_bench_usage(program, "--%s needs a value", option->name);
        int status = read_value(program, option, argv[++i]);
        if (status != DPL_BENCH_GO)
            return status;
    }
    return DPL_BENCH_GO;
}
