/* The folder that a benchmark writes to. Used by both main.c. */
#ifndef DPL_BENCH_FOLDER_H
#define DPL_BENCH_FOLDER_H

#include "../../image/error.h"

/* Makes a folder with its parents if they are missing, and makes it the working folder: results are then
 * written by their plain names. */
bool dpl_bench_folder_enter(const char *path, dpl_error *error);

#endif
