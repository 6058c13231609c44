/* See output.h. */
#include "output.h"

#include "options.h"
#include "paths.h"
#include "report.h"

#include <dapple/tonemap.h>
#include <stdlib.h>
#include <string.h>

int dpl_tool_check_files(const dpl_tool_files *files) {
    dpl_error error;
    if (!files->output)
        return dpl_report_usage(files->command, "-o OUT is missing");
    if (dpl_path_has_extension(files->output, ".exr") && !dpl_picture_has_exr())
        return dpl_report_failure("%s: this build cannot write EXR", files->output);
    if (!dpl_picture_can_write(files->output, &error))
        return dpl_report_usage(files->command, "%s", error.text);
    if (strcmp(files->output, files->scene) == 0)
        return dpl_report_usage(files->command, "'%s' is the scene and the output", files->output);
    if (files->stats && strcmp(files->output, files->stats) == 0)
        return dpl_report_usage(files->command, "'%s' is the output and the --stats file", files->output);
    return DPL_OPTIONS_GO;
}

static void fill_shares(const dpl_picture *picture, uint8_t *bytes) {
    size_t count = (size_t)picture->width * (size_t)picture->height * (size_t)picture->channels;
    for (size_t i = 0; i < count; i++)
        bytes[i] = (uint8_t)(picture->data[i] * 255.0f + 0.5f);
}

static int write_png(dpl_context *context, const char *path, const dpl_picture *picture, dpl_tool_look look) {
    dpl_error error;
    uint8_t *bytes = malloc((size_t)picture->width * (size_t)picture->height * (size_t)picture->channels);
    if (!bytes)
        return dpl_report_status(NULL, DPL_ERROR_MEMORY);
    dpl_status status = DPL_OK;
    dpl_pixels pixels = dpl_picture_pixels(picture);
    if (look == DPL_LOOK_SHARE)
        fill_shares(picture, bytes);
    else
        status = dpl_tonemap(context, &pixels, bytes, 0);
    int result = DPL_EXIT_DONE;
    if (status != DPL_OK)
        result = dpl_report_status(context, status);
    else if (!dpl_picture_write_png(path, picture->width, picture->height, picture->channels, bytes, &error))
        result = dpl_report_failure("%s", error.text);
    free(bytes);
    return result;
}

int dpl_tool_write_picture(dpl_context *context, const char *path, const dpl_picture *picture,
                           dpl_tool_look look) {
    dpl_error error;
    if (dpl_path_has_extension(path, ".png"))
        return write_png(context, path, picture, look);
    return dpl_picture_write(path, picture, &error) ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}
