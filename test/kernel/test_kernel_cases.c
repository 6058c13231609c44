/* Every kernel, on the inputs that it is timed on, equals the scalar reference bit for bit and writes nothing
 * beside its result. With --bench the same cases are timed instead: the command of docs/benchmarks.md. */
#include "testing.h"

#include "kernel/cases.h"
#include "kernel/timing.h"

#include "../../bench/common/options.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 256, GUARD_BYTE = 0xa5 };

static const char help[] =
    "Usage: test_kernel_cases [--bench [OPTIONS]]\n"
    "\n"
    "Holds every kernel against the scalar reference. With --bench times them instead, on every instruction\n"
    "set of this machine, and writes kernels.csv and kernels.md.\n"
    "\n"
    "  --rounds N   samples of each case (default 25)\n"
    "  --out DIR    where results go (default bench/results/MACHINE)\n"
    "  --help       print this text\n";

/* What a case writes to, between guard bands. */
static unsigned char *new_out(const dpl_kernel_case *c) {
    unsigned char *memory = aligned_alloc(64, DPL_CASE_OUT + 2 * GUARD);
    assert_non_null(memory);
    memset(memory, GUARD_BYTE, DPL_CASE_OUT + 2 * GUARD);
    dpl_case_fill_out(c, memory + GUARD);
    return memory;
}

static void assert_guards(const dpl_kernel_case *c, const unsigned char *memory) {
    for (size_t i = 0; i < GUARD; i++) {
        assert_int_equal(memory[i], GUARD_BYTE);
        assert_int_equal(memory[GUARD + c->out_bytes + i], GUARD_BYTE);
    }
}

/* Twice over: many kernels add to what is there. */
static unsigned char *result_of(const dpl_kernel_case *c, const dpl_kernels *kernels,
                                const dpl_case_inputs *in) {
    unsigned char *memory = new_out(c);
    for (int i = 0; i < 2; i++)
        c->run(c, kernels, in, memory + GUARD);
    assert_guards(c, memory);
    return memory;
}

static void every_timed_kernel_equals_the_reference(void **state) {
    (void)state;
    static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    dpl_case_inputs *in = dpl_case_inputs_create();
    const dpl_kernel_case *c;
    for (int32_t n = 0; (c = dpl_kernel_case_at(n)) != NULL; n++) {
        unsigned char *before = new_out(c), *expected = result_of(c, &dpl_kernels_ref, in);
        /* a kernel that did nothing would equal another that does nothing */
        assert_memory_not_equal(before, expected, DPL_CASE_OUT + 2 * GUARD);
        for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
            const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
            if (!kernels)
                continue;
            unsigned char *found = result_of(c, kernels, in);
            if (memcmp(expected, found, DPL_CASE_OUT + 2 * GUARD) != 0)
                fail_msg("%s, %s: %s differs from the reference", c->kernel, c->input, dpl_isa_name(isas[i]));
            free(found);
        }
        free(before);
        free(expected);
    }
    dpl_case_inputs_free(in);
}

int main(int argc, char **argv) {
    bool bench = false;
    int32_t rounds = 25;
    const char *out = NULL;
    const dpl_bench_option options[] = {
        {"bench", DPL_BENCH_FLAG, &bench, 0, 0},
        {"rounds", DPL_BENCH_INTEGER, &rounds, 1, 1000},
        {"out", DPL_BENCH_TEXT, &out, 0, 0},
    };
    int status = dpl_bench_options_read("test_kernel_cases", help, options,
                                        sizeof options / sizeof options[0], argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    if (bench)
        return dpl_kernel_timing_run(rounds, out);
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_timed_kernel_equals_the_reference)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
