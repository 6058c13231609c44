/* What commands that turn a scene into a picture share: the names they are given, and how the picture is
 * written. */
#ifndef DPL_TOOL_OUTPUT_H
#define DPL_TOOL_OUTPUT_H

#include "image/picture.h"

#include <dapple/context.h>

/* Files of a command line. */
typedef struct dpl_tool_files {
    const char *command;
    const char *scene;
    const char *output; /* NULL: not given */
    const char *stats;  /* or NULL */
} dpl_tool_files;

/* Is there an output, of a kind that can be written, under a name that is no other's? DPL_OPTIONS_GO, or the
 * exit status of what is wrong, which has been told. */
int dpl_tool_check_files(const dpl_tool_files *files);

/* How a PNG shows values. Other kinds of files hold them as they are. */
typedef enum dpl_tool_look {
    DPL_LOOK_LIGHT, /* through the library's tone map; RGB */
    DPL_LOOK_SHARE  /* 0 is black, 1 is white */
} dpl_tool_look;

/* Writes the picture in the kind that the name asks for. Returns an exit status; a failure has been told. */
int dpl_tool_write_picture(dpl_context *context, const char *path, const dpl_picture *picture,
                           dpl_tool_look look);

#endif
