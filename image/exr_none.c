/* EXR where it is not built in: says so. Chosen by CMake instead of exr_read.c and exr_write.c. */
#include "formats.h"

bool dpl_picture_has_exr(void) {
    return false;
}

bool dpl_exr_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error) {
    (void)picture;
    return dpl_error_set(error, "%s: this build reads no EXR; use PFM or PNG", source->name);
}

bool dpl_exr_write(const char *path, const dpl_picture *picture, dpl_error *error) {
    (void)picture;
    return dpl_error_set(error, "%s: this build writes no EXR; use .pfm or .png", path);
}
