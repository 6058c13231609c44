/** @file
 * Statuses: what every fallible call of the library returns.
 */
#ifndef DAPPLE_STATUS_H
#define DAPPLE_STATUS_H

#include <dapple/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Every status with its text: the one list that the enum and dpl_status_text() are made from. */
#define DPL_STATUS_LIST(X)                                                                                   \
    X(DPL_OK, "ok")                                                                                          \
    X(DPL_ERROR_ARGUMENT, "an argument is out of range, not finite, or NULL")                                \
    X(DPL_ERROR_DESC, "a desc was not made by its default function")                                         \
    X(DPL_ERROR_MEMORY, "out of memory")                                                                     \
    X(DPL_ERROR_SIZE, "a size is zero, too large, or does not match")                                        \
    X(DPL_ERROR_UNAVAILABLE, "not available on this machine or in this build")                               \
    X(DPL_ERROR_THREAD, "a thread or lock could not be made")                                                \
    X(DPL_ERROR_CANCELLED, "cancelled by the progress hook")

/** Result of a call. Zero is success; everything else is an error and the call changed nothing. */
typedef enum dpl_status {
#define DPL_STATUS_ENUM(name, text) name,
    DPL_STATUS_LIST(DPL_STATUS_ENUM)
#undef DPL_STATUS_ENUM
} dpl_status;

/**
 * Says what a status means.
 * @param status any value
 * @return a static English text, never NULL. Thread-safe.
 */
DPL_API const char *dpl_status_text(dpl_status status);

#ifdef __cplusplus
}
#endif
#endif
