/* Counts bytes on their way to and from the C library. Called by the library through dpl_allocator. */
#include "memory.h"

#include <stdlib.h>

static void *allocate(size_t bytes, size_t alignment, void *user) {
    dpl_bench_memory *memory = user;
    if (bytes > SIZE_MAX - alignment)
        return NULL;
    void *result = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (!result)
        return NULL;
    memory->calls++;
    memory->now += (int64_t)bytes;
    if (memory->now > memory->peak)
        memory->peak = memory->now;
    return result;
}

static void release(void *pointer, size_t bytes, void *user) {
    ((dpl_bench_memory *)user)->now -= (int64_t)bytes;
    free(pointer);
}

dpl_allocator dpl_bench_memory_allocator(dpl_bench_memory *memory) {
    return (dpl_allocator){allocate, release, memory};
}
