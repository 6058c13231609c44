/* The table of what is counted. Sizes are small: callgrind is fifty times as slow as the processor. Called by
 * main.c. */
#include "gate.h"

#define SOLVED .prepare = dpl_bench_gate_prepare_solver, .run = dpl_bench_gate_solve
#define PICTURES .prepare = dpl_bench_gate_prepare_pictures
#define SHADED .prepare = dpl_bench_gate_prepare_shadow, .run = dpl_bench_gate_cast_shadow
#define TRACED .prepare = dpl_bench_gate_prepare_tracer
#define FLOODED .prepare = dpl_bench_gate_prepare_flood

static const dpl_bench_gate_workload workloads[] = {
    {"holographic", "floats in the sparse scene", SOLVED, .size = 128, .solver = DPL_SOLVER_HOLOGRAPHIC},
    {"holographic-half", "halves, result in halves too", SOLVED, .size = 128, .world = DPL_BENCH_FEW,
     .solver = DPL_SOLVER_HOLOGRAPHIC, .storage = DPL_STORAGE_HALF, .format = DPL_FORMAT_F16},
    {"holographic-dense", "floats where no block is empty", SOLVED, .size = 128, .world = DPL_BENCH_NOISE,
     .solver = DPL_SOLVER_HOLOGRAPHIC},
    {"holographic-media", "floats in mist", SOLVED, .size = 96, .world = DPL_BENCH_MIST,
     .solver = DPL_SOLVER_HOLOGRAPHIC},
    {"holographic-bounce", "one bounce", SOLVED, .size = 96, .solver = DPL_SOLVER_HOLOGRAPHIC, .bounces = 1},
    {"cascades-off", "bilinear-fix, every ray", SOLVED, .size = 96, .solver = DPL_SOLVER_CASCADES},
    {"cascades-exact", "the same without rays that cannot matter", SOLVED, .size = 96,
     .solver = DPL_SOLVER_CASCADES, .skip = DPL_SKIP_EXACT},
    {"cascades-bounded", "the same with guesses under a bound", SOLVED, .size = 96,
     .solver = DPL_SOLVER_CASCADES, .skip = DPL_SKIP_BOUNDED},
    {"cascades-media", "every ray, in mist", SOLVED, .size = 48, .world = DPL_BENCH_MIST,
     .solver = DPL_SOLVER_CASCADES},
    {"reference", "brute force, 32 directions", SOLVED, .size = 64, .solver = DPL_SOLVER_REFERENCE},
    {"draw-layer", "float emission and opacity into a field", PICTURES, .run = dpl_bench_gate_draw_layer,
     .size = 256},
    {"distance", "exact distance transform, read", PICTURES, .run = dpl_bench_gate_read_distance,
     .again = dpl_bench_gate_draw_layer, .size = 256},
    {"lightmap", "float light on sRGB bytes", PICTURES, .run = dpl_bench_gate_apply_light, .size = 256},
    {"metrics", "every metric between two pictures", PICTURES, .run = dpl_bench_gate_compare, .size = 64},
    {"shadow-exact", "one light, angles", SHADED, .size = 96, .shadow = DPL_SHADOW_EXACT},
    {"shadow-rays", "one light, ray maps", SHADED, .size = 192, .shadow = DPL_SHADOW_RAYS},
    {"shadow-mrma", "one light, the blend", SHADED, .size = 192, .shadow = DPL_SHADOW_MRMA},
    {"tracer-build", "a hierarchy over 2000 discs", TRACED, .run = dpl_bench_gate_build, .size = 64},
    {"tracer-light", "16 directions among 2000 discs", TRACED, .run = dpl_bench_gate_trace, .size = 48},
    {"flood-solve", "all light from nothing", FLOODED, .run = dpl_bench_gate_flood_solve, .size = 128},
    {"flood-edit", "a torch moved, with its update", FLOODED, .run = dpl_bench_gate_flood_edit, .size = 128},
};

const dpl_bench_gate_workload *dpl_bench_gate_workloads(int32_t *count) {
    *count = sizeof workloads / sizeof workloads[0];
    return workloads;
}
