/* Small pieces of work whose instructions are counted: what each is, and what it works on. Used by every file
 * of bench_gate; tools/check/instructions.py runs the program. */
#ifndef DPL_BENCH_GATE_H
#define DPL_BENCH_GATE_H

#include "../../image/picture.h"
#include "../common/world.h"

#include <dapple/dapple.h>

/* Everything that some workload holds; each fills the part that it needs. Zero-initialise. */
typedef struct dpl_bench_gate_rig {
    dpl_context *context; /* made by main.c, one thread */
    dpl_field *field;
    dpl_solver *solver;
    dpl_picture picture; /* where results go */
    dpl_output output;   /* a view of it */
    dpl_picture drawn;   /* of the world's size: what is laid into the field or compared */
    uint8_t *bytes;      /* [height][width][4] */
    dpl_shadow *shadow;
    dpl_light light;
    dpl_tracer *tracer;
    dpl_shape *shapes;
    int32_t shape_count;
    dpl_flood *flood;
    dpl_flood_light lamp;
} dpl_bench_gate_rig;

typedef struct dpl_bench_gate_workload {
    const char *name; /* in the stored table: no commas */
    const char *about;
    bool (*prepare)(const struct dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                    dpl_error *error);
    dpl_status (*run)(dpl_bench_gate_rig *rig);   /* once to get warm, once counted */
    dpl_status (*again)(dpl_bench_gate_rig *rig); /* in between, not counted; NULL: nothing */
    int32_t size;                                 /* of the world, a side [px or cells] */
    dpl_bench_world world;                        /* from here on: as `prepare` needs it */
    dpl_solver_kind solver;
    dpl_storage storage;
    int32_t bounces;
    dpl_format format; /* of the solver's output */
    dpl_skip_mode skip;
    dpl_shadow_method shadow;
} dpl_bench_gate_workload;

/* workloads.c */
const dpl_bench_gate_workload *dpl_bench_gate_workloads(int32_t *count);

/* measured.c: the one function that is counted. Calls `run`. */
dpl_status dpl_bench_gate_measured(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig);

/* solvers.c */
bool dpl_bench_gate_prepare_solver(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                   dpl_error *error);
dpl_status dpl_bench_gate_solve(dpl_bench_gate_rig *rig);

/* pictures.c */
bool dpl_bench_gate_prepare_pictures(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                     dpl_error *error);
dpl_status dpl_bench_gate_draw_layer(dpl_bench_gate_rig *rig);
dpl_status dpl_bench_gate_read_distance(dpl_bench_gate_rig *rig);
dpl_status dpl_bench_gate_apply_light(dpl_bench_gate_rig *rig);
dpl_status dpl_bench_gate_compare(dpl_bench_gate_rig *rig);

/* rays.c */
bool dpl_bench_gate_prepare_shadow(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                   dpl_error *error);
dpl_status dpl_bench_gate_cast_shadow(dpl_bench_gate_rig *rig);
bool dpl_bench_gate_prepare_tracer(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                   dpl_error *error);
dpl_status dpl_bench_gate_trace(dpl_bench_gate_rig *rig);
dpl_status dpl_bench_gate_build(dpl_bench_gate_rig *rig);

/* flood.c */
bool dpl_bench_gate_prepare_flood(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                  dpl_error *error);
dpl_status dpl_bench_gate_flood_solve(dpl_bench_gate_rig *rig);
dpl_status dpl_bench_gate_flood_edit(dpl_bench_gate_rig *rig);

/* The context's last message, or the status' text, as the error; true where the status is good. */
bool dpl_bench_gate_good(const dpl_bench_gate_rig *rig, dpl_status status, dpl_error *error);

#endif
