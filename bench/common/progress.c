/* Draws the progress line. Called by both benchmarks between two measurements, never within one. */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

#define LINE_WIDTH 78

static void draw(const char *text) {
    if (isatty(STDERR_FILENO) != 1)
        return;
    fprintf(stderr, "\r%-*.*s\r", LINE_WIDTH, LINE_WIDTH, text);
    fflush(stderr);
}

void dpl_bench_progress(const char *format, ...) {
    char text[LINE_WIDTH + 1];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    draw(text);
}

void dpl_bench_progress_end(void) {
    draw("");
}
