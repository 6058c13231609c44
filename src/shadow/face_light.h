/* What lights give to the faces of walls, for solvers whose walls reflect it. Handed to them by
 * src/api/solver.c as dpl_solver.light_faces. */
#ifndef DPL_SHADOW_FACE_LIGHT_H
#define DPL_SHADOW_FACE_LIGHT_H

#include "solver/solver.h"

/* Lights faces by the exact method, each from the centre of the free pixel before it. */
DPL_MUST_CHECK dpl_status dpl_face_light_fill(dpl_solver *solver, const dpl_face_order *order);

/* Frees what was kept in dpl_solver.face_state. */
void dpl_face_light_free(dpl_solver *solver);

#endif
