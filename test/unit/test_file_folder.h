/* A folder of a test's own, and what lies in it. Used by the tests of files and pictures. Include after
 * testing.h, in a file that asks for POSIX names first. */
#ifndef DPL_TEST_FILE_FOLDER_H
#define DPL_TEST_FILE_FOLDER_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct test_folder {
    char name[32];
    char path[300]; /* of the file last asked for */
} test_folder;

/* A cmocka setup: makes the folder in the working directory. */
static inline int folder_setup(void **state) {
    test_folder *folder = calloc(1, sizeof *folder);
    if (!folder)
        return -1;
    strcpy(folder->name, "folder_XXXXXX");
    *state = folder;
    return mkdtemp(folder->name) ? 0 : -1;
}

/* The path of a file in the folder; good until the next call. */
static inline const char *folder_path(test_folder *folder, const char *name) {
    snprintf(folder->path, sizeof folder->path, "%s/%s", folder->name, name);
    return folder->path;
}

/* How many entries it has. */
static inline int folder_count(const test_folder *folder) {
    int count = 0;
    DIR *entries = opendir(folder->name);
    assert_non_null(entries);
    for (struct dirent *entry; (entry = readdir(entries));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(entries);
    return count;
}

/* A cmocka teardown: removes it with all its files. */
static inline int folder_teardown(void **state) {
    test_folder *folder = *state;
    DIR *entries = opendir(folder->name);
    for (struct dirent *entry; entries && (entry = readdir(entries));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            remove(folder_path(folder, entry->d_name));
    if (entries)
        closedir(entries);
    int result = rmdir(folder->name);
    free(folder);
    return result;
}

/* A test with a folder. */
#define folder_test(function) cmocka_unit_test_setup_teardown(function, folder_setup, folder_teardown)

#endif
