/* The weight of the map term, by every rule that may be asked for. Pure mathematics. The solid side of this
 * room has a desc of its own and shares the smooth minimum. */
#ifndef DPL_SHADOW_BLEND_H
#define DPL_SHADOW_BLEND_H

#include <dapple/shadow.h>
#include <math.h>

/* a of the smooth minimum of two terms: near 1 where the map's is the lower by more than tau. */
static inline double dpl_blend_smooth_minimum(double map, double field, double tau) {
    return 1.0 / (1.0 + exp((map - field) / tau));
}

/* What a rule may look at. */
typedef struct dpl_blend_terms {
    double map;          /* V of the map term */
    double field;        /* V of the field term */
    double distance;     /* from receiver to light */
    double gap;          /* from receiver to the blocker that the march met; 0: none */
    double map_variance; /* estimated squared errors of the two */
    double field_variance;
} dpl_blend_terms;

/* a, 0 .. 1, in V = a map + (1 - a) field. DPL_WEIGHT_LITERAL is no such rule: it gives 0. */
double dpl_blend_weight(const dpl_shadow_desc *desc, const dpl_blend_terms *terms);

#endif
