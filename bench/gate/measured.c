/* Alone in its file, so that no compiler can put it into its caller: callgrind counts what happens between
 * this function's entry and its return. Called by main.c. */
#include "gate.h"

dpl_status dpl_bench_gate_measured(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig) {
    return workload->run(rig);
}
