/* Asks for a piece of memory that will soon be read and written. A hint: without compiler support it is
 * nothing. Used by src/flood, whose next cells lie where no hardware looks. */
#ifndef DPL_KERNEL_PREFETCH_H
#define DPL_KERNEL_PREFETCH_H

#include <stddef.h>
#include <stdint.h>

/* The place may lie outside any object: it is not read. */
static inline void dpl_prefetch(const void *base, ptrdiff_t bytes) {
#if defined(__GNUC__)
    __builtin_prefetch((const void *)((uintptr_t)base + (uintptr_t)bytes), 1);
#else
    (void)base, (void)bytes;
#endif
}

#endif
