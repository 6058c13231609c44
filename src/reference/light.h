/* What lights give to the faces of walls, in the truth: brute force. Called by bounces.c. */
#ifndef DPL_REFERENCE_LIGHT_H
#define DPL_REFERENCE_LIGHT_H

#include "reference/ray.h"
#include "solver/solver.h"

/* Rays from a face to each light. */
#define DPL_LIGHT_RAYS 256

/* Half of the irradiance of a solver's lights on a face of the world. Returns the rays that were traced. */
int64_t dpl_lights_on_face(const dpl_solver *solver, const dpl_field *field, const dpl_face *face,
                           double half[3]);

#endif
