/* Hands ranges to helpers. Every value is written by exactly one item, so who takes which range cannot show.
 */
#include "crew.h"

#include "host.h"

/* Ranges per worker: enough to even out uneven work, few enough to stay cheap. */
#define RANGES_PER_WORKER 16

static void take_ranges(dpl_web_crew *crew, int32_t worker) {
    for (;;) {
        long long next = atomic_fetch_add(&crew->next, crew->range);
        if (next >= crew->item_count)
            return;
        int32_t begin = (int32_t)next;
        int32_t end = crew->item_count - begin < crew->range ? crew->item_count : begin + crew->range;
        crew->function(begin, end, worker, crew->task);
    }
}

static void *enqueue(dpl_task_function function, int32_t item_count, int32_t min_range, void *task,
                     void *user) {
    dpl_web_crew *crew = user;
    int32_t even = item_count / ((crew->helpers + 1) * RANGES_PER_WORKER);
    crew->range = even > min_range ? even : min_range > 1 ? min_range : 1;
    if (item_count <= crew->range) {
        function(0, item_count, 0, task);
        return NULL;
    }
    crew->function = function;
    crew->task = task;
    crew->item_count = item_count;
    atomic_store(&crew->next, 0);
    atomic_store(&crew->busy, crew->helpers);
    atomic_fetch_add(&crew->generation, 1);
    dpl_web_wake(&crew->generation);
    take_ranges(crew, 0);
    return crew;
}

static void finish(void *handle, void *user) {
    dpl_web_crew *crew = user;
    (void)handle;
    for (int left = atomic_load(&crew->busy); left > 0; left = atomic_load(&crew->busy))
        dpl_web_wait(&crew->busy, left);
}

dpl_task_hooks dpl_web_crew_hooks(dpl_web_crew *crew) {
    if (crew->helpers == 0)
        return (dpl_task_hooks){0};
    return (dpl_task_hooks){.enqueue = enqueue, .finish = finish, .user = crew};
}

void dpl_web_crew_help(dpl_web_crew *crew, int32_t worker) {
    take_ranges(crew, worker);
    if (atomic_fetch_sub(&crew->busy, 1) == 1)
        dpl_web_wake(&crew->busy);
}
