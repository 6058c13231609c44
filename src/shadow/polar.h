/* Directions as numbers, without an arc tangent: where a direction leaves a square around the light. Used by
 * the horizon and the polar map, whose bins are equal stretches of that square's outline. */
#ifndef DPL_SHADOW_POLAR_H
#define DPL_SHADOW_POLAR_H

#include <math.h>

/* Position along the square's outline, 0 .. 4, growing with the angle: 0 .. 1 is its right side, from -45
 * degrees to 45. Only the direction's ratio counts. */
static inline double dpl_polar_from_direction(double dx, double dy) {
    if (fabs(dx) >= fabs(dy))
        return dx > 0.0 ? 0.5 + 0.5 * dy / dx : dx < 0.0 ? 2.5 + 0.5 * dy / dx : 0.5;
    return dy > 0.0 ? 1.5 - 0.5 * dx / dy : 3.5 - 0.5 * dx / dy;
}

/* Tangent of the angle between a position and the middle of its side; `side` receives 0 .. 3. */
static inline double dpl_polar_tangent(double position, int *side) {
    *side = position >= 4.0 ? 0 : (int)position;
    return 2.0 * (position - floor(position)) - 1.0;
}

/* The unit direction of a position. */
static inline void dpl_polar_direction(double position, double *dx, double *dy) {
    int side;
    double along = dpl_polar_tangent(position, &side), scale = 1.0 / sqrt(1.0 + along * along);
    double x[4] = {1.0, -along, -1.0, along}, y[4] = {along, 1.0, -along, -1.0};
    *dx = x[side] * scale;
    *dy = y[side] * scale;
}

#endif
