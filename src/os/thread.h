/* Threads, locks and conditions over pthreads (C11 threads crash under ThreadSanitizer). Used by src/job/.
 * A WebAssembly module has none of its own: its context has one thread, or the caller's task hooks. */
#ifndef DPL_OS_THREAD_H
#define DPL_OS_THREAD_H

#include <stdbool.h>

#if defined(__wasm__)
typedef int dpl_thread_handle, dpl_mutex_handle, dpl_condition_handle;
#else
#include <pthread.h>
typedef pthread_t dpl_thread_handle;
typedef pthread_mutex_t dpl_mutex_handle;
typedef pthread_cond_t dpl_condition_handle;
#endif

typedef struct dpl_thread {
    dpl_thread_handle handle;
} dpl_thread;

typedef struct dpl_mutex {
    dpl_mutex_handle handle;
} dpl_mutex;

typedef struct dpl_condition {
    dpl_condition_handle handle;
} dpl_condition;

/* The creating functions return false when the system refuses. */
bool dpl_thread_start(dpl_thread *thread, void *(*function)(void *), void *argument);
void dpl_thread_join(dpl_thread *thread);

/* Between two looks at what another thread will change: leaves the processor to others that share it. */
void dpl_thread_pause(void);

bool dpl_mutex_create(dpl_mutex *mutex);
void dpl_mutex_destroy(dpl_mutex *mutex);
void dpl_mutex_lock(dpl_mutex *mutex);
void dpl_mutex_unlock(dpl_mutex *mutex);

bool dpl_condition_create(dpl_condition *condition);
void dpl_condition_destroy(dpl_condition *condition);
void dpl_condition_wait(dpl_condition *condition, dpl_mutex *mutex);
void dpl_condition_wake_all(dpl_condition *condition);

#endif
