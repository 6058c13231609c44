/* Reflected light of the truth: which faces of opaque pixels reflect, and what they send out after N bounces.
 * Definition: docs/algorithms/bounces.md. Called by reference.c before it looks at pixels. */
#ifndef DPL_REFERENCE_BOUNCES_H
#define DPL_REFERENCE_BOUNCES_H

#include "reference/ray.h"
#include "solver/solver.h"

/* An opaque pixel that has albedo and a free pixel beside it. */
typedef struct dpl_reflector {
    int32_t x, y;    /* in the world */
    uint8_t exposed; /* bit f: face f looks at a free pixel */
} dpl_reflector;

/* Zero-initialise. Memory is kept from solve to solve. */
typedef struct dpl_bounces {
    dpl_buffer number;       /* int32_t per pixel of the world, as dpl_ray_world.reflector */
    dpl_buffer reflectors;   /* dpl_reflector each, row by row */
    dpl_buffer reflected[2]; /* dpl_faces per reflector: this bounce and the one before */
    dpl_buffer direct; /* dpl_faces per reflector: half of the irradiance of lights; where there are some */
    int32_t count;     /* of reflectors */
    int64_t faces;     /* of all reflectors */
} dpl_bounces;

/* Finds the reflectors of a field. */
DPL_MUST_CHECK dpl_status dpl_bounces_prepare(dpl_solver *solver, dpl_bounces *bounces,
                                              const dpl_field *field);

/* Rays that were traced from faces. */
typedef struct dpl_bounces_rays {
    int64_t to_world;
    int64_t to_lights;
} dpl_bounces_rays;

/* Bounces light `times` times; from then on rays through `world` see what is reflected. Progress goes from 0
 * to `share` of the whole solve. `rays` is added to. */
DPL_MUST_CHECK dpl_status dpl_bounces_run(dpl_solver *solver, dpl_bounces *bounces, dpl_ray_world *world,
                                          int32_t times, double share, dpl_bounces_rays *rays);

/* Adds to `rgb` what an opaque pixel of the world shows of its own reflections: the mean over its exposed
 * faces. */
void dpl_bounces_show(const dpl_bounces *bounces, const dpl_ray_world *world, size_t cell, double rgb[3]);

int64_t dpl_bounces_bytes(const dpl_bounces *bounces);
void dpl_bounces_free(dpl_context *context, dpl_bounces *bounces);

#endif
