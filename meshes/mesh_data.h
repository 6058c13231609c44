/* Triangles that grow: what mesh files and built-in shapes are read into, before they become a dpl_mesh. Used
 * by scenes/, tools, tests and bench; not part of the core library. */
#ifndef DPL_MESHES_MESH_DATA_H
#define DPL_MESHES_MESH_DATA_H

#include "../image/error.h"

#include <dapple/mesh.h>

/* Zero-initialise; free with dpl_mesh_data_free(). */
typedef struct dpl_mesh_data {
    float (*vertices)[3];
    int32_t vertex_count;
    int32_t vertex_room;
    int32_t (*indices)[3];
    int32_t triangle_count;
    int32_t triangle_room;
} dpl_mesh_data;

/* A point p becomes turn * p + move. */
typedef struct dpl_mesh_transform {
    double turn[3][3]; /* rows */
    double move[3];
} dpl_mesh_transform;

void dpl_mesh_data_free(dpl_mesh_data *data);

/* As the library takes it; a view of the data. */
dpl_mesh_desc dpl_mesh_data_desc(const dpl_mesh_data *data);

/* Makes room for as many more. False when out of memory or beyond what numbers of corners can count. */
bool dpl_mesh_data_reserve(dpl_mesh_data *data, int64_t vertices, int64_t triangles, dpl_error *error);

/* Appends without asking for room. Returns the corner's number. */
int32_t dpl_mesh_data_add_vertex(dpl_mesh_data *data, const dpl_mesh_transform *transform, double x, double y,
                                 double z);
void dpl_mesh_data_add_triangle(dpl_mesh_data *data, int32_t a, int32_t b, int32_t c);

/* Neither turned nor moved. */
dpl_mesh_transform dpl_mesh_transform_none(void);

/* Scaled along the axes, then turned around x, y, z in this order [rad], then moved. */
dpl_mesh_transform dpl_mesh_transform_of(const double scale[3], const double angles[3], const double move[3]);

/* ---- built-in shapes, closed but for the plane; each appends ------------------------------------------ */

/* The sphere of radius 1 around the origin, as a grid of `rings` from pole to pole along y. 3 .. 1024. */
bool dpl_mesh_data_add_sphere(dpl_mesh_data *data, const dpl_mesh_transform *transform, int32_t rings,
                              dpl_error *error);

/* The box -1 .. 1. */
bool dpl_mesh_data_add_box(dpl_mesh_data *data, const dpl_mesh_transform *transform, dpl_error *error);

/* The square -1 .. 1 in x and z at y = 0, facing +y: two triangles. */
bool dpl_mesh_data_add_plane(dpl_mesh_data *data, const dpl_mesh_transform *transform, dpl_error *error);

#endif
