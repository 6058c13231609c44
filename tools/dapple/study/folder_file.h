/* Files of the study's folder, written by functions that print into a stream. Used by everything that writes
 * results. */
#ifndef DPL_STUDY_FOLDER_FILE_H
#define DPL_STUDY_FOLDER_FILE_H

#include "image/error.h"

#include <stdio.h>

/* Prints a file's content. Errors of the stream are found when it is closed. */
typedef void (*dpl_study_print)(FILE *stream, const void *user);

/* DIR/NAME, malloc'ed; NULL when out of memory. */
char *dpl_study_path(const char *folder, const char *name);

/* Writes DIR/NAME: complete, or not at all. */
bool dpl_study_write_file(const char *folder, const char *name, dpl_study_print print, const void *user,
                          dpl_error *error);

#endif
