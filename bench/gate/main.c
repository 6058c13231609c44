/* bench_gate: one small piece of work, on one thread and a given instruction set, for tools/check/
 * instructions.py to count its instructions under callgrind; and all of them for ctest, so that they run. */
#include "gate.h"

#include "../common/machine.h"
#include "../common/options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PROGRAM "bench_gate"

static const char help[] =
    "Usage: bench_gate --list | --about | --work NAME [--isa SET] | --all [--isa SET]\n"
    "\n"
    "Runs a small piece of work twice on one thread, the second time inside dpl_bench_gate_measured(): what\n"
    "tools/check/instructions.py counts the instructions of.\n"
    "\n"
    "  --list        prints a line per piece of work: its name, a tab, what it is\n"
    "  --about       prints compiler and build type\n"
    "  --work NAME   runs it\n"
    "  --all         runs each in turn\n"
    "  --isa SET     scalar, sse2, avx2 or avx512 (default avx2)\n"
    "  --help        print this text\n";

bool dpl_bench_gate_good(const dpl_bench_gate_rig *rig, dpl_status status, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    const char *message = rig->context ? dpl_context_message(rig->context) : "";
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

static void release(dpl_bench_gate_rig *rig) {
    dpl_flood_destroy(rig->flood);
    dpl_tracer_destroy(rig->tracer);
    dpl_shadow_destroy(rig->shadow);
    dpl_solver_destroy(rig->solver);
    dpl_field_destroy(rig->field);
    dpl_context_destroy(rig->context);
    dpl_picture_free(&rig->picture);
    dpl_picture_free(&rig->drawn);
    free(rig->bytes);
    free(rig->shapes);
}

static bool work(const dpl_bench_gate_workload *w, dpl_isa isa, dpl_error *error) {
    dpl_bench_gate_rig rig = {0};
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 1;
    desc.isa_mask = (uint32_t)isa;
    bool good = dpl_bench_gate_good(&rig, dpl_context_create(&desc, &rig.context), error) &&
                w->prepare(w, &rig, error) && dpl_bench_gate_good(&rig, w->run(&rig), error) &&
                (!w->again || dpl_bench_gate_good(&rig, w->again(&rig), error)) &&
                dpl_bench_gate_good(&rig, dpl_bench_gate_measured(w, &rig), error);
    release(&rig);
    return good;
}

static bool find_isa(const char *name, dpl_isa *isa) {
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++)
        if (strcmp(dpl_isa_name(isas[i]), name) == 0) {
            *isa = isas[i];
            return true;
        }
    return false;
}

/* All of them, or the one of that name. */
static int run(const char *name, dpl_isa isa) {
    int32_t count, found = 0;
    const dpl_bench_gate_workload *workloads = dpl_bench_gate_workloads(&count);
    for (int32_t i = 0; i < count; i++) {
        dpl_error error = {""};
        if (name && strcmp(workloads[i].name, name) != 0)
            continue;
        found++;
        if (!work(&workloads[i], isa, &error)) {
            fprintf(stderr, PROGRAM ": %s: %s\n", workloads[i].name, error.text);
            return DPL_BENCH_FAILED;
        }
    }
    return found ? DPL_BENCH_DONE : dpl_bench_usage(PROGRAM, "there is no work called '%s'", name);
}

static int print_list(void) {
    int32_t count;
    const dpl_bench_gate_workload *workloads = dpl_bench_gate_workloads(&count);
    for (int32_t i = 0; i < count; i++)
        printf("%s\t%s\n", workloads[i].name, workloads[i].about);
    return DPL_BENCH_DONE;
}

int main(int argc, char **argv) {
    bool list = false, about = false, all = false;
    const char *name = NULL, *isa_name = "avx2";
    dpl_isa isa;
    const dpl_bench_option options[] = {
        {"list", DPL_BENCH_FLAG, &list, 0, 0},    {"about", DPL_BENCH_FLAG, &about, 0, 0},
        {"all", DPL_BENCH_FLAG, &all, 0, 0},      {"work", DPL_BENCH_TEXT, &name, 0, 0},
        {"isa", DPL_BENCH_TEXT, &isa_name, 0, 0},
    };
    int status =
        dpl_bench_options_read(PROGRAM, help, options, sizeof options / sizeof options[0], argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    if (!find_isa(isa_name, &isa))
        return dpl_bench_usage(PROGRAM, "--isa: there is no '%s'", isa_name);
    if (list)
        return print_list();
    if (about) {
        const dpl_bench_machine machine = dpl_bench_machine_read();
        printf("%s, %s\n", machine.compiler, machine.build);
        return DPL_BENCH_DONE;
    }
    return all || name ? run(name, isa) : dpl_bench_usage(PROGRAM, "give --list, --about, --work or --all");
}
