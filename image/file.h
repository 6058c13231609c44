/* Whole files in, whole files out. Used by image/, scenes/ and the tools. */
#ifndef DPL_IMAGE_FILE_H
#define DPL_IMAGE_FILE_H

#include "error.h"

#include <stddef.h>
#include <stdio.h>

/* Reads a whole file of at most `limit` bytes into malloc'ed memory with a zero byte behind the end. */
bool dpl_file_read(const char *path, size_t limit, char **bytes, size_t *size, dpl_error *error);

/* A file that appears under its name only when it is complete. */
typedef struct dpl_file_writer {
    FILE *stream;         /* write here */
    char *path;           /* final name, behind all links */
    char *temporary_path; /* NULL when writing directly: standard output, or what is no regular file */
} dpl_file_writer;

/* Opens. "-" is standard output; an existing path that is not a regular file (a pipe, /dev/full) is written
 * directly. */
bool dpl_file_writer_open(dpl_file_writer *writer, const char *path, dpl_error *error);

/* Flushes, checks for every write error, and renames into place; on failure, or with `good` false, removes
 * the temporary file. Returns false with the error set when anything failed (an error set before is kept when
 * `good` is false). */
bool dpl_file_writer_close(dpl_file_writer *writer, bool good, dpl_error *error);

/* Opens, writes all bytes, closes. */
bool dpl_file_write(const char *path, const void *bytes, size_t size, dpl_error *error);

#endif
