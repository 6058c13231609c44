/* One thread's memcpy() between buffers that no near cache holds. Called by main.c. */
#include "copy.h"

#include "../common/clock.h"

#include <stdlib.h>
#include <string.h>

#define BYTES ((size_t)64 << 20)

bool dpl_bench_copy_create(dpl_bench_copy *copy, dpl_error *error) {
    copy->from = malloc(BYTES);
    copy->to = malloc(BYTES);
    if (!copy->from || !copy->to)
        return dpl_error_set(error, "out of memory");
    memset(copy->from, 1, BYTES);
    memset(copy->to, 2, BYTES);
    return true;
}

void dpl_bench_copy_free(dpl_bench_copy *copy) {
    free(copy->from);
    free(copy->to);
}

void dpl_bench_copy_run(dpl_bench_copy *copy) {
    dpl_bench_time start = dpl_bench_now();
    memcpy(copy->to, copy->from, BYTES);
    double ms = dpl_bench_since(start).cpu_ms;
    copy->from[0] = (unsigned char)(copy->to[BYTES - 1] + 1); /* so that no copy can be left out */
    double rate = ms > 0 ? 2.0 * (double)BYTES / (ms * 1e6) : 0;
    copy->best = rate > copy->best ? rate : copy->best;
}
