/* A mesh as the rest of the library sees it: triangles in a hierarchy, and what is known of each part. Made
 * by src/api/mesh.c; read by the distances of this room and by the shadows of solids. */
#ifndef DPL_MESH_MESH_H
#define DPL_MESH_MESH_H

#include "bvh/triangle.h"

#include <dapple/mesh.h>

/* How a triangle says what is inside. */
typedef enum dpl_mesh_sign {
    DPL_MESH_CLOSED,     /* signed crossings */
    DPL_MESH_UNORIENTED, /* parity of crossings */
    DPL_MESH_OPEN,       /* winding number */
    DPL_MESH_NOTHING     /* no area */
} dpl_mesh_sign;

struct dpl_mesh {
    dpl_context *context;
    dpl_triangles triangles;
    dpl_buffer corners; /* float[3][3] per triangle, in the order given */
    dpl_buffer signs;   /* uint8_t per triangle: dpl_mesh_sign */
    dpl_buffer scratch; /* of dpl_mesh_sort_parts() */
    dpl_mesh_facts facts;
    bool is_solid; /* all parts are closed, with normals outwards: a line from outside to outside, or from
                      inside to outside, leaves through the back of a triangle whatever it meets */
};

typedef float dpl_mesh_corners[3][3];

static inline const dpl_mesh_corners *dpl_mesh_corners_of(const dpl_mesh *mesh) {
    return mesh->corners.data;
}

/* Copies triangles that have been checked. On failure the mesh has none. */
DPL_MUST_CHECK dpl_status dpl_mesh_keep(dpl_mesh *mesh, const dpl_mesh_desc *desc);

/* parts.c: finds the parts and fills `signs`, `is_solid` and the facts about parts; `corners` is filled. */
DPL_MUST_CHECK dpl_status dpl_mesh_sort_parts(dpl_mesh *mesh);

void dpl_mesh_free(dpl_mesh *mesh);

#endif
