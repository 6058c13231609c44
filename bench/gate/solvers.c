/* Solving a frame, by any method. Called through the table of workloads.c. */
#include "gate.h"

/* Room for any output: floats, four channels. */
bool dpl_bench_gate_prepare_solver(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                   dpl_error *error) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = workload->solver;
    desc.holographic.storage = workload->storage;
    desc.bounces = workload->bounces;
    desc.cascades.skip.mode = workload->skip;
    desc.reference.directions = 32;
    if (!dpl_bench_world_make(workload->world, workload->size, rig->context, &rig->field, error) ||
        !dpl_picture_create(&rig->picture, workload->size, workload->size, 4, error))
        return false;
    rig->output = dpl_picture_output(&rig->picture);
    rig->output.format = workload->format;
    rig->output.row_stride = 0;
    return dpl_bench_gate_good(rig, dpl_solver_create(rig->context, &desc, &rig->solver), error);
}

dpl_status dpl_bench_gate_solve(dpl_bench_gate_rig *rig) {
    return dpl_solver_solve(rig->solver, rig->field, &rig->output);
}
