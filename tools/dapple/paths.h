/* Questions about files that are asked before the work starts, and folders made for its results. Used by
 * every command that writes. */
#ifndef DPL_TOOL_PATHS_H
#define DPL_TOOL_PATHS_H

#include "image/error.h"

/* Can a file be made (or replaced) under this name? "-" always can. Nothing is touched. */
bool dpl_path_check_writable(const char *path, dpl_error *error);

/* Does it end in this extension (".png"), in upper or lower case? */
bool dpl_path_has_extension(const char *path, const char *extension);

/* Makes a folder and those above it, where they are missing. */
bool dpl_path_make_folder(const char *path, dpl_error *error);

#endif
