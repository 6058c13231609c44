/* One thread's memcpy(). Called by bench_speed and by the timing of kernels. */
#include "copy.h"

#include "clock.h"

#include <stdlib.h>
#include <string.h>

bool dpl_bench_copy_create(dpl_bench_copy *copy, size_t bytes, dpl_error *error) {
    copy->bytes = bytes;
    copy->from = malloc(bytes);
    copy->to = malloc(bytes);
    if (!copy->from || !copy->to)
        return dpl_error_set(error, "out of memory");
    memset(copy->from, 1, bytes);
    memset(copy->to, 2, bytes);
    return true;
}

void dpl_bench_copy_free(dpl_bench_copy *copy) {
    free(copy->from);
    free(copy->to);
}

void dpl_bench_copy_run(dpl_bench_copy *copy) {
    size_t times = DPL_BENCH_COPY_MEMORY / copy->bytes;
    dpl_bench_time start = dpl_bench_now();
    for (size_t i = 0; i < times; i++) {
        memcpy(copy->to, copy->from, copy->bytes);
        copy->from[0] = (unsigned char)(copy->to[copy->bytes - 1] + 1); /* so that no copy can be left out */
    }
    double ms = dpl_bench_since(start).cpu_ms;
    double rate = ms > 0 ? 2.0 * (double)(times * copy->bytes) / (ms * 1e6) : 0;
    copy->best = rate > copy->best ? rate : copy->best;
}
