/* Bytes that grow: where PNG and EXR are put together before they go to a file in one piece. */
#ifndef DPL_IMAGE_BUFFER_H
#define DPL_IMAGE_BUFFER_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise; free with dpl_byte_buffer_free(). */
typedef struct dpl_byte_buffer {
    unsigned char *bytes;
    size_t size;
    size_t capacity;
} dpl_byte_buffer;

/* Puts bytes at an offset, growing the buffer; a gap before them becomes zeros. False when out of memory. */
bool dpl_byte_buffer_put(dpl_byte_buffer *buffer, size_t offset, const void *bytes, size_t size);

void dpl_byte_buffer_free(dpl_byte_buffer *buffer);

#endif
