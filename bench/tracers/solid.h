/* Trials in space: triangles of a bumpy ball, our hierarchy beside Embree's. Used by main.c and report.c. */
#ifndef DPL_BENCH_SOLID_H
#define DPL_BENCH_SOLID_H

#include "embree.h"
#include "trial.h"

/* Kinds of rays, the meshes, and the two questions. */
enum { DPL_BENCH_SOLID_KINDS = 3, DPL_BENCH_SOLID_MESHES = 2, DPL_BENCH_SOLID_QUERIES = 2 };
extern const char *const dpl_bench_solid_kinds[DPL_BENCH_SOLID_KINDS];
extern const char *const dpl_bench_solid_queries[DPL_BENCH_SOLID_QUERIES];

/* At most this share of rays may get another answer from Embree, whose triangles are not watertight at their
 * silhouettes; for the rest t must agree to this much, relative. */
#define DPL_BENCH_DIFFERENT_SHARE 1e-4
#define DPL_BENCH_DIFFERENT_T 1e-4f

/* How answers of both compare, over all meshes, kinds and queries. */
typedef struct dpl_bench_agreement {
    int64_t rays;
    int64_t different; /* one hits and the other does not, or t differs by more than the tolerance */
    double largest_t;  /* greatest relative difference of t among the others */
} dpl_bench_agreement;

typedef struct dpl_bench_solid_world dpl_bench_solid_world;

/* Zero-initialise. */
typedef struct dpl_bench_solid {
    dpl_context *context;
    dpl_bench_solid_world *worlds; /* per mesh */
    int32_t ray_count;
    bool embree;
    dpl_bench_agreement agreement;
} dpl_bench_solid;

/* Adds trials for meshes of about 8000 triangles and, unless `small`, 131000. With `embree`, Embree's as
 * well, and compares all answers. The trials point into `solid`. */
bool dpl_bench_solid_prepare(dpl_bench_solid *solid, bool small, int32_t builds, dpl_bench_trials *trials,
                             dpl_error *error);

void dpl_bench_solid_free(dpl_bench_solid *solid);

#endif
