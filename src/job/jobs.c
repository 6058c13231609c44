/* The thread pool and the bridge to a user's task system. */
#include "job/jobs.h"

#include "os/machine.h"
#include "os/thread.h"

#include <stdatomic.h>

/* Ranges handed out per worker: enough to even out uneven work, few enough to stay cheap. */
#define RANGES_PER_WORKER 16
/* How long a thread that has nothing to do asks again before it sleeps [ms]. A frame is some fifty pieces of
 * work, one right after the other: to sleep between them takes longer than most of them, and the system may
 * wake a thread on the core of the one that woke it, where it waits for that one to end. */
#define AWAKE_MS 0.3
#define ASKS_PER_LOOK 16 /* at the clock */

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
    /* The pool: a new generation calls every thread once, and one that comes while there is work joins. The
     * caller takes part, closes the work when all is handed out, and waits for those that have joined: not
     * for one that has not woken yet. All of it changes under the mutex, and is asked for without. */
    int32_t thread_count;
    bool has_lock;
    dpl_mutex mutex;
    dpl_condition wake;
    dpl_condition idle;
    atomic_ullong generation;
    atomic_int busy;
    bool open;
    bool ending;
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

static bool has_new_work(dpl_jobs *jobs, uint64_t seen) {
    return atomic_load(&jobs->generation) != seen;
}

static bool is_idle(dpl_jobs *jobs, uint64_t seen) {
    (void)seen;
    return atomic_load(&jobs->busy) == 0;
}

/* Asks for a while, without sleep, but lets others have the core. */
static void stay_awake_until(bool (*is_so)(dpl_jobs *jobs, uint64_t seen), dpl_jobs *jobs, uint64_t seen) {
    double end = dpl_clock_ms() + AWAKE_MS;
    do {
        for (int32_t i = 0; i < ASKS_PER_LOOK; i++) {
            if (is_so(jobs, seen))
                return;
            dpl_thread_yield();
        }
    } while (dpl_clock_ms() < end);
}

/* Waits for work that this thread has not seen. False when there will be none. */
static bool pool_wait(dpl_jobs *jobs, uint64_t *seen, bool *joins) {
    stay_awake_until(has_new_work, jobs, *seen);
    dpl_mutex_lock(&jobs->mutex);
    while (!has_new_work(jobs, *seen))
        dpl_condition_wait(&jobs->wake, &jobs->mutex);
    *seen = atomic_load(&jobs->generation);
    *joins = jobs->open;
    if (*joins)
        atomic_fetch_add(&jobs->busy, 1);
    bool goes_on = !jobs->ending;
    dpl_mutex_unlock(&jobs->mutex);
    return goes_on;
}

static void *pool_thread(void *argument) {
    pool_worker *self = argument;
    dpl_jobs *jobs = self->jobs;
    uint64_t seen = 0;
    bool joins = false;
    while (pool_wait(jobs, &seen, &joins)) {
        if (!joins)
            continue;
        work_take_ranges(&jobs->work, self->index);
        dpl_mutex_lock(&jobs->mutex);
        if (atomic_fetch_sub(&jobs->busy, 1) == 1)
            dpl_condition_wake_all(&jobs->idle);
        dpl_mutex_unlock(&jobs->mutex);
    }
    return NULL;
}

/* Calls the threads: to work, or to end. */
static void pool_call(dpl_jobs *jobs, bool to_work) {
    dpl_mutex_lock(&jobs->mutex);
    jobs->open = to_work;
    jobs->ending = !to_work;
    atomic_fetch_add(&jobs->generation, 1);
    dpl_condition_wake_all(&jobs->wake);
    dpl_mutex_unlock(&jobs->mutex);
}

/* All work is handed out: nobody joins any more, and those that have done so come to an end. */
static void pool_finish(dpl_jobs *jobs) {
    dpl_mutex_lock(&jobs->mutex);
    jobs->open = false;
    dpl_mutex_unlock(&jobs->mutex);
    stay_awake_until(is_idle, jobs, 0);
    dpl_mutex_lock(&jobs->mutex);
    while (!is_idle(jobs, 0))
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
        pool_call(jobs, false);
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
        pool_call(jobs, true);
    work_take_ranges(w, 0);
    if (wake)
        pool_finish(jobs);
    return DPL_OK;
}
