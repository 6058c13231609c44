/* Signed distances to a mesh on a grid. Made by the steps of this room in the order in which they stand here;
 * read by the march of src/shadow/. */
#ifndef DPL_MESH_FIELD_H
#define DPL_MESH_FIELD_H

#include "mesh/mesh.h"

/* What a sample knows while the field is being measured: the triangle that is nearest so far. */
typedef struct dpl_mesh_cell {
    float point[3];   /* the nearest point of it */
    int32_t triangle; /* -1: none yet */
} dpl_mesh_cell;

/* One node's children seen from afar, for winding numbers. */
typedef struct dpl_mesh_dipole {
    float center[3]; /* mean of the triangles, by area */
    float radius;    /* all of them lie within */
    float normal[3]; /* sum of areas times normals */
} dpl_mesh_dipole;

struct dpl_mesh_field {
    dpl_context *context;
    dpl_mesh_field_desc desc;
    dpl_mesh_grid grid;
    bool measured;
    dpl_buffer distance; /* float per sample */
    dpl_buffer cells;    /* dpl_mesh_cell per sample */
    dpl_buffer lines;    /* per worker: scratch of sign.c */
    dpl_buffer open;     /* int32_t: numbers of the open triangles */
    dpl_buffer bounds;   /* dpl_bounds of the open triangles */
    dpl_buffer dipoles;  /* dpl_mesh_dipole per child of a node */
    dpl_bvh tree;        /* of the open triangles */
    int32_t open_count;
};

static inline double dpl_mesh_coordinate(const dpl_mesh_grid *grid, int axis, int32_t i) {
    return (double)(grid->origin[axis] + grid->spacing * (float)i);
}

static inline size_t dpl_mesh_cell_at(const dpl_mesh_grid *grid, int32_t x, int32_t y, int32_t z) {
    return ((size_t)z * (size_t)grid->size[1] + (size_t)y) * (size_t)grid->size[0] + (size_t)x;
}

/* Measures. The mesh has triangles. */
DPL_MUST_CHECK dpl_status dpl_mesh_field_fill(dpl_mesh_field *field, const dpl_mesh *mesh);

/* band.c: the nearest triangle of every sample within the band; no triangle elsewhere. */
DPL_MUST_CHECK dpl_status dpl_mesh_field_fill_band(dpl_mesh_field *field, const dpl_mesh *mesh);

/* sweep.c: hands nearest triangles on to the other samples; then the distances, without signs. */
DPL_MUST_CHECK dpl_status dpl_mesh_field_sweep(dpl_mesh_field *field, const dpl_mesh *mesh);

/* sign.c: minus signs inside closed parts. */
DPL_MUST_CHECK dpl_status dpl_mesh_field_sign_closed(dpl_mesh_field *field, const dpl_mesh *mesh);

/* winding.c: minus signs inside open parts. */
DPL_MUST_CHECK dpl_status dpl_mesh_field_sign_open(dpl_mesh_field *field, const dpl_mesh *mesh);

void dpl_mesh_field_free(dpl_mesh_field *field);

#endif
