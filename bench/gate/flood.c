/* Light of a tile world: all of it, and after an edit. Called through the table of workloads.c. */
#include "gate.h"

#include "../common/random.h"

#define TORCH 28672

/* A fifth are blocks, the same ones everywhere; round falloff and a sun make it the dearest kind. */
static dpl_status set_blocks(dpl_bench_gate_rig *rig, int32_t size) {
    uint64_t state = 1;
    dpl_status status = DPL_OK;
    for (int32_t i = 0; i < size * size && status == DPL_OK; i++)
        if (dpl_bench_random(&state, 0, 1) < 0.2)
            status = dpl_flood_set_cell(rig->flood, i % size, i / size, 0, 1);
    return status;
}

bool dpl_bench_gate_prepare_flood(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                  dpl_error *error) {
    static const uint16_t torch[DPL_FLOOD_MAX_CHANNELS] = {TORCH, TORCH, TORCH, TORCH};
    int32_t size = workload->size;
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = desc.height = size;
    desc.falloff = DPL_FLOOD_EUCLIDEAN;
    desc.sun = DPL_FLOOD_SUN_Y_UP;
    return dpl_bench_gate_good(rig, dpl_flood_create(rig->context, &desc, &rig->flood), error) &&
           dpl_bench_gate_good(rig, set_blocks(rig, size), error) &&
           dpl_bench_gate_good(rig, dpl_flood_add_light(rig->flood, size / 2, size / 2, 0, torch, &rig->lamp),
                               error) &&
           dpl_bench_gate_good(rig, dpl_flood_solve(rig->flood), error);
}

dpl_status dpl_bench_gate_flood_solve(dpl_bench_gate_rig *rig) {
    return dpl_flood_solve(rig->flood);
}

/* There and back: the world is as before. */
dpl_status dpl_bench_gate_flood_edit(dpl_bench_gate_rig *rig) {
    dpl_flood_desc desc;
    dpl_status status = dpl_flood_read_desc(rig->flood, &desc);
    for (int32_t away = 3; away >= 0 && status == DPL_OK; away -= 3) {
        status = dpl_flood_move_light(rig->flood, rig->lamp, desc.width / 2 + away, desc.height / 2, 0);
        if (status == DPL_OK)
            status = dpl_flood_update(rig->flood, NULL);
    }
    return status;
}
