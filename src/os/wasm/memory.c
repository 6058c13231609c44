/* The C library's memory, as a WebAssembly module has it. */
#include "os/memory.h"

#include <stdlib.h>

static void *allocate(size_t bytes, size_t alignment, void *user) {
    (void)user;
    size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    return rounded < bytes ? NULL : aligned_alloc(alignment, rounded);
}

static void release(void *memory, size_t bytes, void *user) {
    (void)bytes;
    (void)user;
    free(memory);
}

dpl_allocator dpl_allocator_default(void) {
    return (dpl_allocator){.allocate = allocate, .release = release};
}
