/* Threads of a module in shared memory: the task hooks of its contexts. The host starts one worker per helper
 * and lets it call dpl_web_crew_help() whenever the crew's generation has changed. */
#ifndef DPL_WEB_CREW_H
#define DPL_WEB_CREW_H

#include <dapple/context.h>
#include <stdatomic.h>

/* Zero-initialise and set `helpers`. */
typedef struct dpl_web_crew {
    atomic_int generation; /* goes up with each piece of work: what helpers sleep on */
    atomic_int busy;       /* helpers that are not done with it: what the caller sleeps on */
    atomic_llong next;     /* first item that nobody has taken */
    dpl_task_function function;
    void *task;
    int32_t item_count;
    int32_t range;
    int32_t helpers;
} dpl_web_crew;

/* The hooks; none when there are no helpers. */
dpl_task_hooks dpl_web_crew_hooks(dpl_web_crew *crew);

/* Takes part in the work at hand as worker 1 .. helpers, until all of it is taken. */
void dpl_web_crew_help(dpl_web_crew *crew, int32_t worker);

#endif
