/* Bytes that grow. Called by the PNG and EXR writers. */
#include "buffer.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static bool reserve(dpl_byte_buffer *buffer, size_t size) {
    if (size <= buffer->capacity)
        return true;
    size_t capacity = size > SIZE_MAX / 2 ? size : size * 2;
    unsigned char *bytes = realloc(buffer->bytes, capacity);
    if (!bytes)
        return false;
    buffer->bytes = bytes;
    buffer->capacity = capacity;
    return true;
}

bool dpl_byte_buffer_put(dpl_byte_buffer *buffer, size_t offset, const void *bytes, size_t size) {
    if (size == 0)
        return true;
    if (offset > SIZE_MAX - size || !reserve(buffer, offset + size))
        return false;
    if (offset > buffer->size)
        memset(buffer->bytes + buffer->size, 0, offset - buffer->size);
    memcpy(buffer->bytes + offset, bytes, size);
    if (buffer->size < offset + size)
        buffer->size = offset + size;
    return true;
}

void dpl_byte_buffer_free(dpl_byte_buffer *buffer) {
    free(buffer->bytes);
    *buffer = (dpl_byte_buffer){0};
}
