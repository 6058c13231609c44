/* The C library's memory, in large pages where there is much of it and the system has them: a frame walks
 * through rows that lie far apart, and finding its way by pages of 4 KiB took up to a tenth of it
 * (docs/algorithms/holographic.md). */
#define _DEFAULT_SOURCE /* madvise() */
#include "os/memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <sys/mman.h>

#define LARGE_PAGE ((size_t)2 << 20)

/* Blocks of so many bytes begin at a large page. */
#define MUCH (2 * LARGE_PAGE)

/* Asks for large pages where whole ones fit, so that none of them reaches beyond the block. That is a wish: a
 * system that does not grant it changes nothing. */
static void ask_for_large_pages(void *memory, size_t bytes) {
#if defined(MADV_HUGEPAGE)
    (void)madvise(memory, bytes / LARGE_PAGE * LARGE_PAGE, MADV_HUGEPAGE);
#else
    (void)memory, (void)bytes;
#endif
}

static void *allocate(size_t bytes, size_t alignment, void *user) {
    (void)user;
    bool much = bytes >= MUCH;
    if (much && alignment < LARGE_PAGE)
        alignment = LARGE_PAGE;
    size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void *memory = rounded < bytes ? NULL : aligned_alloc(alignment, rounded);
    if (memory && much)
        ask_for_large_pages(memory, bytes);
    return memory;
}

static void release(void *memory, size_t bytes, void *user) {
    (void)bytes;
    (void)user;
    free(memory);
}

dpl_allocator dpl_allocator_default(void) {
    return (dpl_allocator){.allocate = allocate, .release = release};
}
