/* The scene that shadows in space are judged by: balls, boxes, thin slabs and poles on and above a square of
 * receivers, under a spot light. Used by tests and bench. */
#ifndef DPL_SCENES_SOLID_REFERENCE_H
#define DPL_SCENES_SOLID_REFERENCE_H

#include "../meshes/mesh_data.h"

#include <dapple/solid_shadow.h>

/* Half the side of the square of receivers, at y = 0 [scene unit]. */
#define DPL_SOLID_REFERENCE_HALF 2.0

/* The layout that figures are published for. */
#define DPL_SOLID_REFERENCE_SEED 7

/* What casts: 25 closed parts, laid out by a seed, balls of so many rings each. */
bool dpl_solid_reference_mesh(int32_t seed, int32_t rings, dpl_mesh_data *data, dpl_error *error);

/* The light, of a radius of one's choice [scene unit]. */
dpl_solid_light dpl_solid_reference_light(float radius);

/* Fills side x side receivers, which look up. */
void dpl_solid_reference_receivers(int32_t side, float (*positions)[3], float (*normals)[3]);

#endif
