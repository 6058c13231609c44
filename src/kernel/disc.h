/* A disc seen from a point, and triangles in between: which points of the disc do they cover? Types of the
 * kernel `cover`; called by the shadows of solids for the few rays of a receiver at once.
 *
 * The corners of a triangle span three planes with the eye. A line from the eye meets the triangle where it
 * is on the same side of all three as the triangle is, and sides are affine functions of the disc's a and b:
 * nine numbers per triangle answer for all points. (Kautz, Lehtinen, Aila 2004 cover hemispheres so, with
 * tables in place of the sums.) Two triangles that share an edge get exactly opposite numbers for it, so no
 * line passes between them. */
#ifndef DPL_KERNEL_DISC_H
#define DPL_KERNEL_DISC_H

#include <stdbool.h>
#include <stdint.h>

/* Most points of a disc, and what their number is filled up to a multiple of. */
#define DPL_DISC_MOST 256
#define DPL_DISC_BLOCK 16

/* Most triangles at once; a multiple of the widest vector. */
#define DPL_DISC_TRIANGLES 64

/* Triangles that span more than this with the eye, six times their volume, are not met: all sums are finite.
 */
#define DISC_MOST_VOLUME 1e37f

/* The line to a point (a, b) of the unit disc is eye + t (axis[2] + a axis[0] + b axis[1]), 0 < t <= far. */
typedef struct dpl_disc_view {
    float eye[3];
    float axis[3][3];
    float far; /* finite */
    bool ends; /* some triangle may reach beyond `far` */
} dpl_disc_view;

/* Points of the unit disc. */
typedef struct dpl_disc_points {
    int32_t count; /* a multiple of DPL_DISC_BLOCK */
    float a[DPL_DISC_MOST];
    float b[DPL_DISC_MOST];
} dpl_disc_points;

/* Corners of triangles, side by side. */
typedef struct dpl_disc_triangles {
    int32_t count;
    bool exits_only; /* only what is met from behind counts: for lines that leave whatever they enter */
    float corner[3][3][DPL_DISC_TRIANGLES]; /* [corner][axis]; what is behind `count` is set to anything */
} dpl_disc_triangles;

#endif
