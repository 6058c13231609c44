/* Asks for a piece of memory that will soon be read and written. A hint: without compiler support it is
 * nothing. Used by src/flood, whose next cells lie where no hardware looks. */
#ifndef DPL_KERNEL_PREFETCH_H
#define DPL_KERNEL_PREFETCH_H

/* `address` may lie outside any object: it is not read. */
static inline void dpl_prefetch(const void *address) {
#if defined(__GNUC__)
    __builtin_prefetch(address, 1);
#else
    (void)address;
#endif
}

#endif
