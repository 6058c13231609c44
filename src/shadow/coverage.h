/* How much of a light a straight edge leaves in view. Pure mathematics, shared by the flat and the solid side
 * of this room. `offset` is where the edge stands: -1 covers all, 1 nothing, 0 half. */
#ifndef DPL_SHADOW_COVERAGE_H
#define DPL_SHADOW_COVERAGE_H

#include <math.h>

static inline double dpl_coverage_clamp(double offset) {
    return offset > -1.0 ? offset < 1.0 ? offset : 1.0 : -1.0;
}

/* Of an interval, as a disc is in two dimensions: offset measured in angle. */
static inline double dpl_coverage_interval(double offset) {
    return 0.5 * (1.0 + dpl_coverage_clamp(offset));
}

/* Of a disc, as a sphere's image is in three dimensions: the exact area beyond a chord. */
static inline double dpl_coverage_disc(double offset) {
    double x = dpl_coverage_clamp(offset);
    return 0.5 + (x * sqrt(1.0 - x * x) + asin(x)) / 3.14159265358979323846;
}

/* Quilez's polynomial for the same (2018): off by up to 0.0392. */
static inline double dpl_coverage_quilez(double offset) {
    double x = dpl_coverage_clamp(offset);
    return 0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x);
}

/* Half the angle at the light's centre that the penumbra of a blocker at distance `blocker` from it takes for
 * a receiver at `distance`: exact in the plane. 0 when the blocker is not before the receiver. */
static inline double dpl_penumbra_half_angle(double radius, double blocker, double distance) {
    if (!(blocker < distance))
        return 0.0;
    return (blocker > radius ? asin(radius / blocker) : 1.57079632679489661923) - asin(radius / distance);
}

#endif
