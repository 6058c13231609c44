/* Makes the folder of results and goes there. Called by both benchmarks before the work starts, so that a
 * wrong path costs no time. */
#define _POSIX_C_SOURCE 200809L
#include "folder.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool make(const char *path, dpl_error *error) {
    if (mkdir(path, 0777) == 0 || errno == EEXIST)
        return true;
    return dpl_error_set(error, "%s: %s", path, strerror(errno));
}

bool dpl_bench_folder_enter(const char *path, dpl_error *error) {
    char part[4096];
    size_t length = strlen(path);
    if (length == 0 || length >= sizeof part)
        return dpl_error_set(error, "a folder's name has 1 to %zu characters", sizeof part - 1);
    memcpy(part, path, length + 1);
    for (char *slash = strchr(part + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        if (!make(part, error))
            return false;
        *slash = '/';
    }
    if (!make(path, error))
        return false;
    return chdir(path) == 0 || dpl_error_set(error, "%s: %s", path, strerror(errno));
}
