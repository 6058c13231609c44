/* How pixels lie in memory that the caller owns: bytes of a channel, steps between rows. Used by src/api/ to
 * check what it was given, and by those who then read or write it. */
#ifndef DPL_BASE_LAYOUT_H
#define DPL_BASE_LAYOUT_H

#include <dapple/image.h>
#include <stdbool.h>

/* Of one channel [byte]; 0 for a format that does not exist. */
static inline size_t dpl_format_bytes(dpl_format format) {
    switch (format) {
    case DPL_FORMAT_F32:
        return sizeof(float);
    case DPL_FORMAT_UNORM8:
    case DPL_FORMAT_SRGB8:
        return 1;
    case DPL_FORMAT_F16:
        return sizeof(uint16_t);
    }
    return 0;
}

/* Are data and rows on addresses that the channels' type may be read from? */
static inline bool dpl_layout_is_aligned(const void *data, ptrdiff_t row_stride, dpl_format format) {
    size_t bytes = dpl_format_bytes(format);
    return (uintptr_t)data % bytes == 0 && row_stride % (ptrdiff_t)bytes == 0;
}

#endif
