/* Stands in for mesh_file.c where Assimp is not installed. */
#include "mesh_file.h"

bool dpl_mesh_file_is_built_in(void) {
    return false;
}

bool dpl_mesh_file_read(const char *path, const dpl_mesh_transform *transform, dpl_mesh_data *data,
                        dpl_error *error) {
    (void)transform;
    (void)data;
    return dpl_error_set(error, "%s: this build reads no mesh files (it was made without Assimp)", path);
}
