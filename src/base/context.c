/* Errors and memory of a context. Called by every room. */
#include "base/context.h"

#include <stdarg.h>
#include <stdio.h>

#define DPL_ALIGNMENT 64

dpl_status dpl_fail(dpl_context *context, dpl_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context->message, sizeof context->message, format, arguments);
    va_end(arguments);
    if (context->log)
        context->log(status, context->message, context->log_user);
    return status;
}

/* count * size, or 0 where that does not fit (a size of nothing counts as one byte). */
static size_t checked_bytes(size_t count, size_t size) {
    if (count == 0 || size == 0)
        return 1;
    return count > SIZE_MAX / size ? 0 : count * size;
}

void *dpl_allocate(dpl_context *context, size_t count, size_t size) {
    size_t bytes = checked_bytes(count, size);
    void *memory = NULL;
    if (bytes != 0)
        memory = context->allocator.allocate(bytes, DPL_ALIGNMENT, context->allocator.user);
    if (!memory)
        (void)dpl_fail(context, DPL_ERROR_MEMORY, "no memory for %zu x %zu bytes", count, size);
    return memory;
}

void dpl_release(dpl_context *context, void *memory, size_t count, size_t size) {
    if (memory)
        context->allocator.release(memory, checked_bytes(count, size), context->allocator.user);
}

dpl_status dpl_buffer_reserve(dpl_context *context, dpl_buffer *buffer, size_t count, size_t size) {
    size_t bytes = checked_bytes(count, size);
    if (bytes != 0 && bytes <= buffer->bytes)
        return DPL_OK;
    void *data = dpl_allocate(context, count, size);
    if (!data)
        return DPL_ERROR_MEMORY;
    dpl_buffer_free(context, buffer);
    *buffer = (dpl_buffer){data, bytes};
    return DPL_OK;
}

void dpl_buffer_free(dpl_context *context, dpl_buffer *buffer) {
    dpl_release(context, buffer->data, buffer->bytes, 1);
    *buffer = (dpl_buffer){0};
}
