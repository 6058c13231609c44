/* One ray of the truth: exact traversal of the pixel grid in double precision. Used by reference.c for what
 * pixels see, by bounces.c for what walls see, and by light.c for lights. */
#ifndef DPL_REFERENCE_RAY_H
#define DPL_REFERENCE_RAY_H

#include "field/field.h"

typedef struct dpl_ray_direction {
    double angle;   /* from +x towards +y */
    double unit[2]; /* its cosine and sine */
} dpl_ray_direction;

/* The faces of an opaque pixel, by where they look: face f looks along the angle f * pi/2. */
enum { DPL_FACE_RIGHT, DPL_FACE_BELOW, DPL_FACE_LEFT, DPL_FACE_ABOVE, DPL_FACE_COUNT };

/* What faces reflect, RGB. */
typedef double dpl_faces[DPL_FACE_COUNT][3];

/* What rays travel through, and which rays there are. */
typedef struct dpl_ray_world {
    const dpl_field *field;
    const dpl_ray_direction *directions; /* uniformly spaced */
    int32_t direction_count;
    const int32_t *reflector; /* per pixel of the world: its number in `reflected`, or -1; NULL: all are -1 */
    const dpl_faces *reflected; /* in all directions alike */
} dpl_ray_world;

/* Radiance that arrives at the centre of the world's pixel (x, y) from one direction. */
void dpl_ray_trace(const dpl_ray_world *world, int32_t x, int32_t y, const dpl_ray_direction *direction,
                   double radiance[3]);

/* Does a ray from there come as far as `length` without entering an opaque pixel? `passed` receives what
 * media let through until then. */
bool dpl_ray_reaches(const dpl_field *field, int32_t x, int32_t y, const double unit[2], double length,
                     double passed[3]);

#endif
