/* Draws the progress bar. */
#define _POSIX_C_SOURCE 200809L
#include "progress.h"

#include "clock.h"

#include <stdio.h>
#include <unistd.h>

#define FIRST_MS 300.0
#define EVERY_MS 100.0
#define BAR_WIDTH 30
/* "100% [" bar "] " two times " elapsed, " " left"; the times are at most 9 characters. */
#define LINE_WIDTH (6 + BAR_WIDTH + 2 + 9 + 10 + 9 + 5)

void dpl_progress_begin(dpl_progress *progress) {
    progress->terminal = isatty(STDERR_FILENO) == 1;
    progress->drawn = false;
    progress->start_ms = dpl_tool_clock_ms();
    progress->next_ms = progress->start_ms + FIRST_MS;
}

/* "3:07" or "1:02:09". */
static void format_time(double ms, char *text, size_t size) {
    if (!(ms < 1e9)) {
        snprintf(text, size, "?");
        return;
    }
    long seconds = (long)(ms / 1e3 + 0.5);
    if (seconds < 3600)
        snprintf(text, size, "%ld:%02ld", seconds / 60, seconds % 60);
    else
        snprintf(text, size, "%ld:%02ld:%02ld", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

void dpl_progress_update(dpl_progress *progress, double done) {
    if (!progress->terminal)
        return;
    double now = dpl_tool_clock_ms();
    if (now < progress->next_ms)
        return;
    progress->next_ms = now + EVERY_MS;
    progress->drawn = true;
    done = done >= 0 ? done <= 1 ? done : 1 : 0;

    char bar[BAR_WIDTH + 1];
    for (int i = 0; i < BAR_WIDTH; i++)
        bar[i] = i < (int)(done * BAR_WIDTH) ? '#' : '.';
    bar[BAR_WIDTH] = 0;
    char elapsed[32];
    char left[32];
    double elapsed_ms = now - progress->start_ms;
    format_time(elapsed_ms, elapsed, sizeof elapsed);
    format_time(done > 0 ? elapsed_ms * (1 - done) / done : 1e9, left, sizeof left);
    char line[LINE_WIDTH + 64];
    snprintf(line, sizeof line, "%3d%% [%s] %s elapsed, %s left", (int)(done * 100), bar, elapsed, left);
    fprintf(stderr, "\r%-*s", LINE_WIDTH, line);
    fflush(stderr);
}

void dpl_progress_end(dpl_progress *progress) {
    if (progress->drawn)
        fprintf(stderr, "\r%*s\r", LINE_WIDTH, "");
    progress->drawn = false;
}
