/* A child process, and the line in which it complains. */
#define _POSIX_C_SOURCE 200809L
#include "gnuplot.h"

#include "folder_file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Exit status of a child that could not become gnuplot. */
#define STATUS_MISSING 127

/* In the child: only calls that are safe between fork and exec. Does not return. */
static void become_gnuplot(const char *folder, const char *script, int complaints) {
    char *const arguments[] = {"gnuplot", "--default-settings", (char *)script, NULL};
    int nothing = open("/dev/null", O_RDWR);
    signal(SIGPIPE, SIG_DFL);
    if (nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(nothing, STDOUT_FILENO) >= 0 &&
        dup2(complaints, STDERR_FILENO) >= 0 && chdir(folder) == 0)
        execvp(arguments[0], arguments);
    _exit(STATUS_MISSING);
}

/* Reads until the child closes its end; keeps the last line that says something: gnuplot quotes the script
 * before it says what is wrong. */
static void read_complaint(int source, char *line, size_t size) {
    char block[512];
    size_t used = 0;
    bool ended = false;
    for (;;) {
        ssize_t count = read(source, block, sizeof block);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            break;
        for (ssize_t i = 0; i < count; i++) {
            if (block[i] == '\n') {
                ended = true;
                continue;
            }
            used = ended ? 0 : used;
            ended = false;
            if (used + 1 < size)
                line[used++] = block[i];
        }
    }
    line[used] = 0;
}

static bool judge(int status, const char *complaint, dpl_error *error) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == STATUS_MISSING)
        return dpl_error_set(error, "gnuplot is not there");
    return dpl_error_set(error, "gnuplot failed%s%s", complaint[0] ? ": " : "", complaint);
}

static bool run_gnuplot(const char *folder, const char *script, dpl_error *error) {
    int ends[2];
    char complaint[256];
    int status = 0;
    if (pipe(ends) != 0)
        return dpl_error_set(error, "gnuplot: %s", strerror(errno));
    pid_t child = fork();
    if (child == 0)
        become_gnuplot(folder, script, ends[1]);
    close(ends[1]);
    if (child < 0) {
        dpl_error_set(error, "gnuplot: %s", strerror(errno));
        close(ends[0]);
        return false;
    }
    read_complaint(ends[0], complaint, sizeof complaint);
    close(ends[0]);
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return dpl_error_set(error, "gnuplot: %s", strerror(errno));
    return judge(status, complaint, error);
}

static void remove_plots(const char *folder, const char *const *names, int count) {
    static const char *const endings[] = {"svg", "png"};
    for (int i = 0; i < count; i++)
        for (int e = 0; e < 2; e++) {
            char name[64];
            snprintf(name, sizeof name, "%s.%s", names[i], endings[e]);
            char *path = dpl_study_path(folder, name);
            if (path)
                unlink(path); /* there may be none */
            free(path);
        }
}

bool dpl_study_gnuplot_draw(const char *folder, const char *script, const char *const *names, int count,
                            dpl_error *error) {
    remove_plots(folder, names, count);
    if (run_gnuplot(folder, script, error))
        return true;
    remove_plots(folder, names, count);
    return false;
}
