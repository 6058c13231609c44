/* Hints to compiler and processor; without support they are nothing. Used by src/flood, whose loops have a
 * copy per kind of world, and whose next cells lie where no hardware looks; by the marches, which have a copy
 * with light and one without; and by rows_ref.c, which has one per storage and colour. */
#ifndef DPL_KERNEL_HINTS_H
#define DPL_KERNEL_HINTS_H

#include <stddef.h>
#include <stdint.h>

/* Of a function with an argument that is constant where it is called: a copy for each such constant; not
 * where a file is made small. */
#if defined(__GNUC__) && !defined(DPL_SMALL)
#define DPL_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define DPL_ALWAYS_INLINE inline
#endif

/* Asks for memory that will soon be read and written. The place may lie outside any object: it is not read.
 */
static inline void dpl_prefetch(const void *base, ptrdiff_t bytes) {
#if defined(__GNUC__)
    __builtin_prefetch((const void *)((uintptr_t)base + (uintptr_t)bytes), 1);
#else
    (void)base, (void)bytes;
#endif
}

#endif
