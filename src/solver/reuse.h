/* What a solver keeps of its last frame, where its desc asks for that: the planes that it was solved from,
 * and the pictures. src/api/solver.c asks what has changed and hands kept pictures out; a method that can
 * solve a part of the world asks where (src/cascade/). docs/algorithms/reuse.md says why nothing of it
 * changes a bit.
 */
#ifndef DPL_SOLVER_REUSE_H
#define DPL_SOLVER_REUSE_H

#include "field/field.h"

/* Side of the squares in which changes are noted [px]. */
#define DPL_REUSE_TILE 16

/* Most boxes that changes are gathered into. */
#define DPL_REUSE_BOXES 12

/* Mean, cosine, sine. */
#define DPL_REUSE_PICTURES 3

/* Planes of a field that light depends on. The last is measured, the others are drawn. */
typedef enum dpl_kept_plane {
    DPL_KEPT_KIND,
    DPL_KEPT_EMISSION,
    DPL_KEPT_EXTINCTION,
    DPL_KEPT_ALBEDO,
    DPL_KEPT_SURFACE,
    DPL_KEPT_CLEARANCE,
    DPL_KEPT_PLANES
} dpl_kept_plane;

/* Pixels x0 .. x1-1 of rows y0 .. y1-1 of the world. */
typedef struct dpl_reuse_box {
    int32_t x0, y0, x1, y1;
} dpl_reuse_box;

typedef struct dpl_reuse {
    /* A copy of the planes; one that the field does not have is not `there`. */
    dpl_buffer planes[DPL_KEPT_PLANES];
    bool there[DPL_KEPT_PLANES];
    dpl_buffer sky;
    int32_t sky_count;
    int32_t width, height, margin;
    uint64_t revision;                       /* of the drawing that the planes are a copy of */
    dpl_buffer pictures[DPL_REUSE_PICTURES]; /* float [y][x][3], of the picture's size */
    bool directional;                        /* all three, not the mean alone */
    bool solved;                             /* the pictures are of these planes */
    /* Of the frame at hand: */
    bool partial;      /* outside the tiles all planes are those of the last solved frame */
    dpl_buffer tiles;  /* uint8_t [y][x]: not 0 where something differs */
    int32_t box_count; /* of dpl_reuse_find_boxes() */
    dpl_reuse_box boxes[DPL_REUSE_BOXES];
} dpl_reuse;

/* Compares a field with what is kept, and keeps it. `bounces`: albedo counts. `same` receives whether the
 * kept pictures, and all that are wanted, are those of this field. Else they count as lost until
 * dpl_reuse_finish(). */
DPL_MUST_CHECK dpl_status dpl_reuse_look(dpl_reuse *reuse, const dpl_field *field, bool bounces,
                                         bool directional, bool *same);

/* Does anything that was drawn differ in the tiles of this box, parts of which may lie outside? */
bool dpl_reuse_touches(const dpl_reuse *reuse, dpl_reuse_box box);

/* Compares the clearances of a measured field too, and gathers all that differs in boxes. Where that is too
 * much to be worth looking at, `partial` is taken back. */
DPL_MUST_CHECK dpl_status dpl_reuse_find_boxes(dpl_reuse *reuse, const dpl_field *field);

/* The kept pictures are now those of the field that was looked at last. */
void dpl_reuse_finish(dpl_reuse *reuse);

/* What is kept is of no use: something else that light depends on has changed. */
void dpl_reuse_forget(dpl_reuse *reuse);

size_t dpl_reuse_bytes(const dpl_reuse *reuse);
void dpl_reuse_free(dpl_reuse *reuse, dpl_context *context);

#endif
