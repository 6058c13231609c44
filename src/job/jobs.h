/* Parallel work over items: the context's own threads, or the user's task system. Used by every solver.
 *
 * Results must not depend on which worker handles which items: each item writes its own memory. */
#ifndef DPL_JOB_JOBS_H
#define DPL_JOB_JOBS_H

#include "base/context.h"

typedef struct dpl_jobs dpl_jobs;

/* Starts thread_count-1 threads (the caller is a worker too), or keeps the hooks when they are given. */
DPL_MUST_CHECK dpl_status dpl_jobs_create(dpl_context *context, int32_t thread_count,
                                          const dpl_task_hooks *hooks, dpl_jobs **jobs);
void dpl_jobs_destroy(dpl_context *context, dpl_jobs *jobs);

int32_t dpl_jobs_worker_count(const dpl_jobs *jobs);

/* Runs `function` over items [0, item_count) in ranges of at least min_range and returns when all are done.
 * Never allocates. Fails (DPL_ERROR_ARGUMENT) only when the user's task system left items out or named a
 * worker that does not exist. */
DPL_MUST_CHECK dpl_status dpl_jobs_run(dpl_context *context, dpl_task_function function, int32_t item_count,
                                       int32_t min_range, void *task);

#endif
