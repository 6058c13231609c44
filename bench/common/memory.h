/* An allocator that counts what the library holds. Used by the scaling benchmark. */
#ifndef DPL_BENCH_MEMORY_H
#define DPL_BENCH_MEMORY_H

#include <dapple/context.h>
#include <stdint.h>

/* For one context; a context allocates on the thread that calls it, so plain numbers do. */
typedef struct dpl_bench_memory {
    int64_t now;   /* [byte] */
    int64_t peak;  /* [byte] */
    int64_t calls; /* allocations so far */
} dpl_bench_memory;

/* Allocates from the C library and counts in `memory`, which must outlive the context. */
dpl_allocator dpl_bench_memory_allocator(dpl_bench_memory *memory);

#endif
