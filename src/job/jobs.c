/* The thread pool and the bridge to a user's task system. */
#include "job/jobs.h"

#include "os/machine.h"
#include "os/thread.h"

#include <stdatomic.h>

/* Ranges handed out per worker: enough to even out uneven work, few enough to stay cheap. */
#define RANGES_PER_WORKER 16

/* A thread looks so many times whether there is work, or an end of it, before it sleeps; that takes 0.1 ms.
 * The passes of a frame follow each other faster than a thread that sleeps can be woken. */
#define LOOKS 2000

/* The work that is being done now. */
typedef struct work {
    dpl_task_function function;
    void *task;
    int32_t item_count;
    int32_t range;
    atomic_llong next;      /* own threads: first item not handed out; may run past item_count */
    atomic_int done;        /* user's tasks: items handled */
    atomic_bool bad_worker; /* user's tasks: a worker index was out of range */
    int32_t worker_count;
} work;

typedef struct pool_worker {
    dpl_thread thread;
    dpl_jobs *jobs;
    int32_t index;
} pool_worker;

struct dpl_jobs {
    int32_t worker_count;
    dpl_task_hooks hooks;
    work work;
    /* The pool: a new generation wakes every thread once; the caller waits until none is busy. */
    int32_t thread_count;
    int32_t looks; /* 0 where threads take processors from each other */
    bool has_lock;
    dpl_mutex mutex;
    dpl_condition wake;
    dpl_condition idle;
    atomic_ullong generation; /* changes under the lock, like the next two */
    atomic_int busy;
    atomic_bool ending;
    pool_worker workers[DPL_MAX_THREADS];
};

static void work_take_ranges(work *w, int32_t worker) {
    for (;;) {
        long long next = atomic_fetch_add(&w->next, w->range);
        if (next >= w->item_count)
            return;
        int32_t begin = (int32_t)next;
        int32_t end = w->item_count - begin < w->range ? w->item_count : begin + w->range;
        w->function(begin, end, worker, w->task);
    }
}

/* Returns false when the pool ends. */
static bool pool_await_work(dpl_jobs *jobs, unsigned long long *seen) {
    for (int32_t i = 0; i < jobs->looks && jobs->generation == *seen && !jobs->ending; i++)
        dpl_thread_pause();
    dpl_mutex_lock(&jobs->mutex);
    while (jobs->generation == *seen && !jobs->ending)
        dpl_condition_wait(&jobs->wake, &jobs->mutex);
    *seen = jobs->generation;
    bool goes_on = !jobs->ending;
    dpl_mutex_unlock(&jobs->mutex);
    return goes_on;
}

static void *pool_thread(void *argument) {
    pool_worker *self = argument;
    dpl_jobs *jobs = self->jobs;
    unsigned long long seen = 0;
    while (pool_await_work(jobs, &seen)) {
        work_take_ranges(&jobs->work, self->index);
        dpl_mutex_lock(&jobs->mutex);
        if (--jobs->busy == 0)
            dpl_condition_wake_all(&jobs->idle);
        dpl_mutex_unlock(&jobs->mutex);
    }
    return NULL;
}

static void pool_wake(dpl_jobs *jobs) {
    dpl_mutex_lock(&jobs->mutex);
    jobs->busy = jobs->thread_count;
    jobs->generation++;
    dpl_condition_wake_all(&jobs->wake);
    dpl_mutex_unlock(&jobs->mutex);
}

static void pool_await_end(dpl_jobs *jobs) {
    for (int32_t i = 0; i < jobs->looks && jobs->busy > 0; i++)
        dpl_thread_pause();
    dpl_mutex_lock(&jobs->mutex);
    while (jobs->busy > 0)
        dpl_condition_wait(&jobs->idle, &jobs->mutex);
    dpl_mutex_unlock(&jobs->mutex);
}

static bool pool_create_lock(dpl_jobs *jobs) {
    if (!dpl_mutex_create(&jobs->mutex))
        return false;
    if (!dpl_condition_create(&jobs->wake)) {
        dpl_mutex_destroy(&jobs->mutex);
        return false;
    }
    if (!dpl_condition_create(&jobs->idle)) {
        dpl_condition_destroy(&jobs->wake);
        dpl_mutex_destroy(&jobs->mutex);
        return false;
    }
    return jobs->has_lock = true;
}

dpl_status dpl_jobs_create(dpl_context *context, int32_t thread_count, const dpl_task_hooks *hooks,
                           dpl_jobs **out) {
    dpl_jobs *jobs = dpl_allocate(context, 1, sizeof *jobs);
    if (!jobs)
        return DPL_ERROR_MEMORY;
    memset(jobs, 0, sizeof *jobs);
    jobs->worker_count = thread_count;
    jobs->hooks = *hooks;
    jobs->looks = thread_count <= dpl_processor_count() ? LOOKS : 0;
    *out = jobs;
    if (hooks->enqueue || thread_count == 1)
        return DPL_OK;
    bool good = pool_create_lock(jobs);
    for (int32_t i = 1; i < thread_count && good; i++) {
        jobs->workers[i] = (pool_worker){.jobs = jobs, .index = i};
        good = dpl_thread_start(&jobs->workers[i].thread, pool_thread, &jobs->workers[i]);
        if (good)
            jobs->thread_count++;
    }
    if (good)
        return DPL_OK;
    int32_t started = jobs->thread_count;
    dpl_jobs_destroy(context, jobs);
    *out = NULL;
    return dpl_fail(context, DPL_ERROR_THREAD, "only %d of %d threads could be started", started + 1,
                    thread_count);
}

void dpl_jobs_destroy(dpl_context *context, dpl_jobs *jobs) {
    if (!jobs)
        return;
    if (jobs->has_lock) {
        dpl_mutex_lock(&jobs->mutex);
        jobs->ending = true;
        dpl_condition_wake_all(&jobs->wake);
        dpl_mutex_unlock(&jobs->mutex);
        for (int32_t i = 1; i <= jobs->thread_count; i++)
            dpl_thread_join(&jobs->workers[i].thread);
        dpl_condition_destroy(&jobs->idle);
        dpl_condition_destroy(&jobs->wake);
        dpl_mutex_destroy(&jobs->mutex);
    }
    dpl_release(context, jobs, 1, sizeof *jobs);
}

int32_t dpl_jobs_worker_count(const dpl_jobs *jobs) {
    return jobs->worker_count;
}

/* Stands between a user's task system and the work, so that its mistakes cannot reach memory. */
static void run_user_range(int32_t begin, int32_t end, int32_t worker, void *task) {
    work *w = task;
    if (worker < 0 || worker >= w->worker_count) {
        atomic_store(&w->bad_worker, true);
        return;
    }
    if (begin < 0 || end > w->item_count || begin >= end)
        return;
    w->function(begin, end, worker, w->task);
    atomic_fetch_add(&w->done, end - begin);
}

static dpl_status run_on_user_tasks(dpl_context *context, dpl_jobs *jobs, int32_t min_range) {
    work *w = &jobs->work;
    void *handle = jobs->hooks.enqueue(run_user_range, w->item_count, min_range, w, jobs->hooks.user);
    if (handle)
        jobs->hooks.finish(handle, jobs->hooks.user);
    if (atomic_load(&w->bad_worker))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the task hooks named a worker outside 0 .. %d",
                        jobs->worker_count - 1);
    if (atomic_load(&w->done) != w->item_count)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the task hooks handled %d of %d items",
                        atomic_load(&w->done), w->item_count);
    return DPL_OK;
}

dpl_status dpl_jobs_run(dpl_context *context, dpl_task_function function, int32_t item_count,
                        int32_t min_range, void *task) {
    dpl_jobs *jobs = context->jobs;
    if (item_count <= 0)
        return DPL_OK;
    int32_t even = item_count / (jobs->worker_count * RANGES_PER_WORKER);
    work *w = &jobs->work;
    w->function = function;
    w->task = task;
    w->item_count = item_count;
    w->range = even > min_range ? even : min_range > 1 ? min_range : 1;
    w->worker_count = jobs->worker_count;
    atomic_store(&w->next, 0);
    atomic_store(&w->done, 0);
    atomic_store(&w->bad_worker, false);
    if (jobs->hooks.enqueue)
        return run_on_user_tasks(context, jobs, min_range);
    bool wake = jobs->thread_count > 0 && item_count > w->range;
    if (wake)
        pool_wake(jobs);
    work_take_ranges(w, 0);
    if (wake)
        pool_await_end(jobs);
    return DPL_OK;
}
