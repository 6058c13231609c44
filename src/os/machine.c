/* Asks the system and the processor. */
#define _POSIX_C_SOURCE 200809L
#include "os/machine.h"

#include <dapple/context.h>
#include <stdbool.h>
#include <time.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

int32_t dpl_processor_count(void) {
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > DPL_MAX_THREADS ? DPL_MAX_THREADS : (int32_t)count;
}

#if defined(__x86_64__)
/* Half precision conversions. Asked of the processor itself: clang 14 has no name for them. */
static bool has_f16c(void) {
    unsigned eax, ebx, ecx, edx;
    return __get_cpuid(1, &eax, &ebx, &ecx, &edx) && (ecx & bit_F16C);
}
#endif

uint32_t dpl_machine_isa(void) {
    uint32_t isa = DPL_ISA_SCALAR;
#if defined(__x86_64__)
    __builtin_cpu_init();
    isa |= DPL_ISA_SSE2; /* part of x86-64 */
    if (__builtin_cpu_supports("avx2") && has_f16c())
        isa |= DPL_ISA_AVX2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        isa |= DPL_ISA_AVX512;
#endif
    return isa;
}

double dpl_clock_ms(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}
