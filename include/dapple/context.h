/** @file
 * The context: allocator, log, threads or the user's own task system, and the choice of kernels.
 *
 * Make one per thread that calls the library. Objects made from a context (fields, solvers) use its
 * allocator, threads and kernels and must be destroyed before it.
 */
#ifndef DAPPLE_CONTEXT_H
#define DAPPLE_CONTEXT_H

#include <dapple/export.h>
#include <dapple/status.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Most threads (or workers of a task system) that a context uses. */
#define DPL_MAX_THREADS 64

/** Instruction sets that kernels are built for, as bits of a mask. */
typedef enum dpl_isa {
    DPL_ISA_SCALAR = 1,   /**< plain C, the reference of every other */
    DPL_ISA_SSE2 = 2,     /**< x86-64 baseline, 4 lanes */
    DPL_ISA_AVX2 = 4,     /**< 8 lanes: AVX2 and F16C */
    DPL_ISA_AVX512 = 8,   /**< 16 lanes: F, DQ, BW and VL */
    DPL_ISA_SIMD128 = 16, /**< WebAssembly, 4 lanes */
    DPL_ISA_ALL = 0x7fff  /**< whatever this machine has */
} dpl_isa;

/** The user's memory functions. Must be thread-safe if several contexts share them. */
typedef struct dpl_allocator {
    /** Returns `bytes` [byte] aligned to `alignment` (a power of two, at least 64), or NULL. */
    void *(*allocate)(size_t bytes, size_t alignment, void *user);
    /** Takes back what `allocate` gave; `bytes` is the size then asked for. Never called with NULL. */
    void (*release)(void *memory, size_t bytes, void *user);
    /** Handed to both functions. */
    void *user;
} dpl_allocator;

/** Receives one line of text, without a newline, for each error. Called on the thread of the failing call. */
typedef void (*dpl_log_function)(dpl_status status, const char *message, void *user);

/**
 * A piece of parallel work: handles items [begin, end).
 * @param begin  first item
 * @param end    one past the last item
 * @param worker 0 .. thread_count-1; two calls at the same time never share a worker
 * @param task   what dpl_task_hooks::enqueue was given as `task`
 */
typedef void (*dpl_task_function)(int32_t begin, int32_t end, int32_t worker, void *task);

/** An engine's own job system. Leave `enqueue` NULL to let the context make its own threads. */
typedef struct dpl_task_hooks {
    /**
     * Starts work over items [0, item_count), cut into ranges of at least `min_range` items as the engine
     * likes, in any order, on any thread. May also do all of it before returning.
     * Returns a handle for `finish`, or NULL when everything is done already.
     */
    void *(*enqueue)(dpl_task_function function, int32_t item_count, int32_t min_range, void *task,
                     void *user);
    /** Waits until the work behind a handle is done. Called on the thread that called the library. */
    void (*finish)(void *handle, void *user);
    /** Handed to both functions. */
    void *user;
} dpl_task_hooks;

/** How to make a context. Start from dpl_context_desc_default(). */
typedef struct dpl_context_desc {
    uint32_t struct_size;    /**< stamped by the default function */
    uint32_t cookie;         /**< stamped by the default function */
    dpl_allocator allocator; /**< all NULL: the C library's aligned memory */
    dpl_log_function log;    /**< NULL: silent; dpl_context_message() still has the last error */
    void *log_user;          /**< handed to `log` */
    int32_t thread_count; /**< 1 .. DPL_MAX_THREADS; 0 (default): as many as the machine has processors. With
                               task hooks: the number of workers, and 0 means 1 */
    dpl_task_hooks tasks; /**< all NULL: own threads */
    uint32_t isa_mask;    /**< union of dpl_isa that may be used, default DPL_ISA_ALL */
} dpl_context_desc;

/** Opaque. One thread at a time may use a context and what was made from it. */
typedef struct dpl_context dpl_context;

/** Defaults of a context: C library memory, silent, one thread per processor, best kernels. */
static inline dpl_context_desc dpl_context_desc_default(void) {
    dpl_context_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.isa_mask = DPL_ISA_ALL;
    return desc;
}

/**
 * Makes a context.
 * @param desc    from dpl_context_desc_default(); NULL means all defaults
 * @param context receives the context, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT, _MEMORY, _THREAD; _UNAVAILABLE when the mask leaves no kernels
 * Thread-safe.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_context_create(const dpl_context_desc *desc, dpl_context **context);

/** Ends the threads and frees the context. NULL is fine. Destroy everything made from it first. */
DPL_API void dpl_context_destroy(dpl_context *context);

/**
 * Text of the last error in this context, with the detail that a status has no room for.
 * @return never NULL, "" when nothing has failed; valid until the next call with this context
 */
DPL_API const char *dpl_context_message(const dpl_context *context);

/** Number of workers that this context uses, 1 .. DPL_MAX_THREADS. */
DPL_API int32_t dpl_context_thread_count(const dpl_context *context);

/** The kernels in use: exactly one of the dpl_isa bits. */
DPL_API dpl_isa dpl_context_isa(const dpl_context *context);

/**
 * The instruction sets that this machine and this build could use, whatever any mask says.
 * @return a union of dpl_isa bits, always with DPL_ISA_SCALAR. Thread-safe.
 */
DPL_API uint32_t dpl_isa_available(void);

/**
 * Name of an instruction set as the command line spells it.
 * @return "scalar", "sse2", "avx2", "avx512", "simd128", or "?" for anything else. Thread-safe.
 */
DPL_API const char *dpl_isa_name(dpl_isa isa);

#ifdef __cplusplus
}
#endif
#endif
