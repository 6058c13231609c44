/* Meshes on disk: glTF, OBJ, PLY, through the Assimp library. mesh_file.c where it is there,
 * mesh_file_none.c where not. Used by scenes/. */
#ifndef DPL_MESHES_MESH_FILE_H
#define DPL_MESHES_MESH_FILE_H

#include "mesh_data.h"

/* Appends all triangles of a file, with the transforms that the file itself gives them and then this one.
 * Polygons are cut into triangles; points, lines, materials and animation are left out. Errors name the file:
 * one that cannot be read, is of another format, has no triangles, or has corners that are not finite. */
bool dpl_mesh_file_read(const char *path, const dpl_mesh_transform *transform, dpl_mesh_data *data,
                        dpl_error *error);

/* Is reading built in? */
bool dpl_mesh_file_is_built_in(void);

#endif
