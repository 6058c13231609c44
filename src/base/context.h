/* What every room needs from its context: memory, the last message, and handles of the job pool and the
 * kernel table (opaque here, so that base knows nobody). Made in src/api/context.c. */
#ifndef DPL_BASE_CONTEXT_H
#define DPL_BASE_CONTEXT_H

#include <dapple/context.h>
#include <stdbool.h>

struct dpl_jobs;
struct dpl_kernels;

#define DPL_MESSAGE_SIZE 512

struct dpl_context {
    dpl_allocator allocator;
    dpl_log_function log;
    void *log_user;
    char message[DPL_MESSAGE_SIZE];
    struct dpl_jobs *jobs;
    const struct dpl_kernels *kernels;
    uint64_t last_revision; /* given to a drawing, see dpl_field.revision */
};

#if defined(__GNUC__)
#define DPL_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define DPL_PRINTF(text, first)
#endif

/* Returns the status of a failing call to this function's caller. */
#define DPL_TRY(call)                                                                                        \
    do {                                                                                                     \
        dpl_status dpl_try_status = (call);                                                                  \
        if (dpl_try_status != DPL_OK)                                                                        \
            return dpl_try_status;                                                                           \
    } while (0)

/* Keeps the text as the context's message, logs it, and returns `status`. */
DPL_PRINTF(3, 4)
dpl_status dpl_fail(dpl_context *context, dpl_status status, const char *format, ...);

/* Memory of count * size bytes, aligned to 64, not cleared; NULL (and a message) when there is none or the
 * product overflows. Never zero-sized: asks for at least one byte. */
void *dpl_allocate(dpl_context *context, size_t count, size_t size);

/* Gives back what dpl_allocate() returned for the same count and size. NULL is fine. */
void dpl_release(dpl_context *context, void *memory, size_t count, size_t size);

/* A piece of memory that is kept from frame to frame and only ever grows. Zero-initialise. */
typedef struct dpl_buffer {
    void *data;
    size_t bytes;
} dpl_buffer;

/* Makes room for at least count * size bytes. Contents are lost when it grows. */
DPL_MUST_CHECK dpl_status dpl_buffer_reserve(dpl_context *context, dpl_buffer *buffer, size_t count,
                                             size_t size);

void dpl_buffer_free(dpl_context *context, dpl_buffer *buffer);

#endif
