/* Exit statuses and the lines that go with them. */
#include "report.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define LINE_SIZE 2048

static void print_line(const char *prefix, const char *format, va_list arguments, const char *suffix) {
    char line[LINE_SIZE];
    vsnprintf(line, sizeof line, format, arguments);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    fprintf(stderr, "%s%s%s\n", prefix, line, suffix);
}

int dpl_report_failure(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_line("dapple: ", format, arguments, "");
    va_end(arguments);
    return DPL_EXIT_FAILED;
}

int dpl_report_status(const dpl_context *context, dpl_status status) {
    const char *message = context ? dpl_context_message(context) : "";
    return dpl_report_failure("%s", message[0] ? message : dpl_status_text(status));
}

int dpl_report_usage(const char *command, const char *format, ...) {
    char prefix[64];
    char suffix[96];
    const char *gap = command ? " " : "";
    if (!command)
        command = "";
    snprintf(prefix, sizeof prefix, "dapple%s%s: ", gap, command);
    snprintf(suffix, sizeof suffix, " (try 'dapple%s%s --help')", gap, command);
    va_list arguments;
    va_start(arguments, format);
    print_line(prefix, format, arguments, suffix);
    va_end(arguments);
    return DPL_EXIT_USAGE;
}

void dpl_report_note(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_line("dapple: note: ", format, arguments, "");
    va_end(arguments);
}

int dpl_report_finish_output(void) {
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout))
        return DPL_EXIT_DONE;
    return dpl_report_failure("standard output: %s", errno ? strerror(errno) : "could not be written");
}
