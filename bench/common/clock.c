/* Reads the system's monotonic clock and the processor time of this program. Called by both benchmarks. */
#define _POSIX_C_SOURCE 200809L
#include "clock.h"

#include <time.h>

static double read_ms(clockid_t clock) {
    struct timespec now = {0, 0};
    clock_gettime(clock, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

dpl_bench_time dpl_bench_now(void) {
    return (dpl_bench_time){read_ms(CLOCK_MONOTONIC), read_ms(CLOCK_PROCESS_CPUTIME_ID)};
}

dpl_bench_time dpl_bench_since(dpl_bench_time start) {
    dpl_bench_time now = dpl_bench_now();
    return (dpl_bench_time){now.wall_ms - start.wall_ms, now.cpu_ms - start.cpu_ms};
}
