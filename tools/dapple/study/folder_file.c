/* Writes files of the study's folder. */
#include "folder_file.h"

#include "image/file.h"

#include <stdlib.h>
#include <string.h>

char *dpl_study_path(const char *folder, const char *name) {
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", folder, name);
    return path;
}

bool dpl_study_write_file(const char *folder, const char *name, dpl_study_print print, const void *user,
                          dpl_error *error) {
    char *path = dpl_study_path(folder, name);
    if (!path)
        return dpl_error_set(error, "%s: out of memory", folder);
    dpl_file_writer writer;
    bool good = dpl_file_writer_open(&writer, path, error);
    if (good) {
        print(writer.stream, user);
        good = dpl_file_writer_close(&writer, true, error);
    }
    free(path);
    return good;
}
