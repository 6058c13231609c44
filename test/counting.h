/* An allocator for tests: it counts, and fails where it is told to. For contexts that allocate on one thread.
 */
#ifndef DPL_TEST_COUNTING_H
#define DPL_TEST_COUNTING_H

#include <stddef.h>
#include <stdlib.h>

typedef struct counting {
    int allocations;
    int live;
    int fail_at; /* the allocation that fails, counted from 1; 0: none */
} counting;

static inline void *count_allocate(size_t bytes, size_t alignment, void *user) {
    counting *c = user;
    c->allocations++;
    if (c->allocations == c->fail_at)
        return NULL;
    void *memory = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    c->live += memory != NULL;
    return memory;
}

static inline void count_release(void *memory, size_t bytes, void *user) {
    (void)bytes;
    ((counting *)user)->live--;
    free(memory);
}

#endif
