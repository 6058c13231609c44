/* Parallel work: every item is handled exactly once, whoever does it: own threads or a user's task system. A
 * task system that errs gets an error, never memory. */
#include "testing.h"

#include "job/jobs.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* What a piece of work writes down. Checks on other threads only count: cmocka may not jump out of them. */
typedef struct ledger {
    int32_t item_count;
    int32_t min_range;
    int32_t worker_count;
    int32_t *handled; /* shape [item_count]: each item's own memory, so a second handler is a data race */
    atomic_bool working[DPL_MAX_THREADS];
    atomic_int short_ranges;
    atomic_int bad_ranges;
    atomic_int bad_workers;
    atomic_int shared_workers;
} ledger;

static void write_down(int32_t begin, int32_t end, int32_t worker, void *task) {
    ledger *l = task;
    if (worker < 0 || worker >= l->worker_count) {
        atomic_fetch_add(&l->bad_workers, 1);
        return;
    }
    if (begin < 0 || begin >= end || end > l->item_count) {
        atomic_fetch_add(&l->bad_ranges, 1);
        return;
    }
    if (atomic_exchange(&l->working[worker], true))
        atomic_fetch_add(&l->shared_workers, 1);
    if (end - begin < l->min_range && end != l->item_count)
        atomic_fetch_add(&l->short_ranges, 1);
    for (int32_t i = begin; i < end; i++)
        l->handled[i] += i + 1;
    atomic_store(&l->working[worker], false);
}

/* Runs the work with a fresh ledger; the caller frees l->handled. */
static dpl_status run_ledger(dpl_context *context, ledger *l, int32_t item_count, int32_t min_range) {
    memset(l, 0, sizeof *l);
    l->item_count = item_count;
    l->min_range = min_range;
    l->worker_count = dpl_context_thread_count(context);
    l->handled = calloc((size_t)item_count + 1, sizeof *l->handled);
    assert_non_null(l->handled);
    return dpl_jobs_run(context, write_down, item_count, min_range, l);
}

static void assert_all_handled_once(ledger *l) {
    assert_int_equal(atomic_load(&l->bad_workers), 0);
    assert_int_equal(atomic_load(&l->bad_ranges), 0);
    assert_int_equal(atomic_load(&l->shared_workers), 0);
    assert_int_equal(atomic_load(&l->short_ranges), 0);
    for (int32_t i = 0; i < l->item_count; i++)
        assert_int_equal(l->handled[i], i + 1);
    assert_int_equal(l->handled[l->item_count], 0);
}

static const int32_t item_counts[] = {0, 1, 2, 3, 15, 16, 17, 255, 256, 257, 1001, 9973};
static const int32_t min_ranges[] = {1, 2, 7, 64, 9972, 9973, 100000};

enum {
    ITEM_COUNTS = sizeof item_counts / sizeof item_counts[0],
    MIN_RANGES = sizeof min_ranges / sizeof min_ranges[0]
};

static void assert_every_item_of_every_size(dpl_context *context) {
    for (int c = 0; c < ITEM_COUNTS; c++)
        for (int r = 0; r < MIN_RANGES; r++) {
            ledger l;
            assert_ok(run_ledger(context, &l, item_counts[c], min_ranges[r]));
            assert_all_handled_once(&l);
            free(l.handled);
        }
}

static dpl_context *context_with(int32_t thread_count, const dpl_task_hooks *hooks) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.thread_count = thread_count;
    if (hooks)
        desc.tasks = *hooks;
    assert_ok(dpl_context_create(&desc, &context));
    return context;
}

static void own_threads_handle_every_item_once(void **state) {
    (void)state;
    const int32_t thread_counts[] = {1, 2, 3, 16};
    for (size_t i = 0; i < sizeof thread_counts / sizeof thread_counts[0]; i++) {
        dpl_context *context = context_with(thread_counts[i], NULL);
        assert_every_item_of_every_size(context);
        dpl_context_destroy(context);
    }
}

static void nothing_to_do_calls_nobody(void **state) {
    (void)state;
    dpl_context *context = context_with(3, NULL);
    assert_ok(dpl_jobs_run(context, NULL, 0, 1, NULL));
    assert_ok(dpl_jobs_run(context, NULL, -5, 1, NULL));
    dpl_context_destroy(context);
}

static void many_runs_in_a_row_lose_nothing(void **state) {
    (void)state;
    const int32_t thread_counts[] = {2, 4};
    for (size_t t = 0; t < sizeof thread_counts / sizeof thread_counts[0]; t++) {
        dpl_context *context = context_with(thread_counts[t], NULL);
        for (int32_t run = 0; run < 1500; run++) {
            ledger l;
            assert_ok(run_ledger(context, &l, 1 + run % 97, 1 + run % 5));
            assert_all_handled_once(&l);
            free(l.handled);
        }
        dpl_context_destroy(context);
    }
}

static void contexts_come_and_go_without_having_worked(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++)
        dpl_context_destroy(context_with(1 + i % 8, NULL));
}

/* Does one thing on a thread of its own and tells whether it went well. */
static void *use_a_context(void *argument) {
    atomic_int *failures = argument;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.thread_count = 3;
    if (dpl_context_create(&desc, &context) != DPL_OK) {
        atomic_fetch_add(failures, 1);
        return NULL;
    }
    int32_t handled[64] = {0};
    ledger l = {.item_count = 63, .min_range = 1, .worker_count = 3, .handled = handled};
    for (int run = 1; run <= 200; run++) {
        if (dpl_jobs_run(context, write_down, 63, 1, &l) != DPL_OK)
            atomic_fetch_add(failures, 1);
        for (int32_t i = 0; i < 63; i++)
            if (handled[i] != run * (i + 1))
                atomic_fetch_add(failures, 1);
    }
    dpl_context_destroy(context);
    return NULL;
}

static void contexts_on_several_threads_do_not_meet(void **state) {
    (void)state;
    atomic_int failures = 0;
    pthread_t threads[4];
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, use_a_context, &failures), 0);
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    assert_int_equal(atomic_load(&failures), 0);
}

/* A toy task system: one thread per worker, ranges dealt in turn from the last to the first. */
typedef struct toy_system {
    int32_t worker_count;
    int32_t started; /* handles given out and not finished yet */
} toy_system;

typedef struct toy_run {
    dpl_task_function function;
    void *task;
    int32_t item_count;
    int32_t range;
    atomic_int next; /* ranges still to be dealt */
    int32_t thread_count;
    struct toy_worker {
        pthread_t thread;
        struct toy_run *run;
        int32_t index;
    } workers[8];
} toy_run;

static void *toy_work(void *argument) {
    struct toy_worker *self = argument;
    toy_run *run = self->run;
    for (int32_t range; (range = atomic_fetch_sub(&run->next, 1) - 1) >= 0;) {
        int32_t begin = range * run->range;
        int32_t end = run->item_count - begin < run->range ? run->item_count : begin + run->range;
        run->function(begin, end, self->index, run->task);
        sched_yield();
    }
    return NULL;
}

static void *toy_enqueue(dpl_task_function function, int32_t item_count, int32_t min_range, void *task,
                         void *user) {
    toy_system *toys = user;
    toy_run *run = calloc(1, sizeof *run);
    assert_non_null(run);
    run->function = function;
    run->task = task;
    run->item_count = item_count;
    run->range = min_range + min_range / 2;
    run->thread_count = toys->worker_count;
    atomic_store(&run->next, (item_count - 1) / run->range + 1);
    for (int32_t i = 0; i < run->thread_count; i++) {
        run->workers[i].run = run;
        run->workers[i].index = i;
        assert_int_equal(pthread_create(&run->workers[i].thread, NULL, toy_work, &run->workers[i]), 0);
    }
    toys->started++;
    return run;
}

static void toy_finish(void *handle, void *user) {
    toy_system *toys = user;
    toy_run *run = handle;
    for (int32_t i = 0; i < run->thread_count; i++)
        assert_int_equal(pthread_join(run->workers[i].thread, NULL), 0);
    toys->started--;
    free(run);
}

static void a_users_task_system_handles_every_item_once(void **state) {
    (void)state;
    const int32_t worker_counts[] = {1, 3, 8};
    for (size_t i = 0; i < sizeof worker_counts / sizeof worker_counts[0]; i++) {
        toy_system toys = {.worker_count = worker_counts[i]};
        dpl_task_hooks hooks = {.enqueue = toy_enqueue, .finish = toy_finish, .user = &toys};
        dpl_context *context = context_with(worker_counts[i], &hooks);
        for (int c = 0; c < ITEM_COUNTS; c++) {
            ledger l;
            assert_ok(run_ledger(context, &l, item_counts[c], 50));
            assert_all_handled_once(&l);
            assert_int_equal(toys.started, 0);
            free(l.handled);
        }
        dpl_context_destroy(context);
    }
}

/* Hooks that do their work, or their mischief, before they return: a list of ranges to hand out. */
typedef struct script {
    const char *what;
    struct {
        int32_t begin, end, worker;
    } ranges[4];
    int32_t range_count;
} script;

static void *play_script(dpl_task_function function, int32_t item_count, int32_t min_range, void *task,
                         void *user) {
    const script *s = user;
    (void)item_count, (void)min_range;
    for (int32_t i = 0; i < s->range_count; i++)
        function(s->ranges[i].begin, s->ranges[i].end, s->ranges[i].worker, task);
    return NULL;
}

static void never_finish(void *handle, void *user) {
    (void)handle, (void)user;
    fail_msg("finish was called without a handle");
}

static dpl_status run_script(script *s, ledger *l, char message[DPL_MESSAGE_SIZE]) {
    dpl_task_hooks hooks = {.enqueue = play_script, .finish = never_finish, .user = s};
    dpl_context *context = context_with(4, &hooks);
    dpl_status status = run_ledger(context, l, 100, 10);
    strcpy(message, dpl_context_message(context));
    dpl_context_destroy(context);
    return status;
}

static void hooks_may_do_all_the_work_at_once(void **state) {
    (void)state;
    script scripts[] = {
        {"in one piece", {{0, 100, 0}}, 1},
        {"backwards", {{75, 100, 3}, {50, 75, 2}, {25, 50, 1}, {0, 25, 0}}, 4},
        {"odd pieces on one worker", {{33, 97, 2}, {97, 100, 2}, {0, 33, 2}}, 3},
    };
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++) {
        ledger l;
        char message[DPL_MESSAGE_SIZE];
        assert_ok(run_script(&scripts[i], &l, message));
        assert_all_handled_once(&l);
        assert_string_equal(message, "");
        free(l.handled);
    }
}

static void hooks_that_err_get_an_error_and_reach_no_memory(void **state) {
    (void)state;
    script scripts[] = {
        {"does nothing", {{0, 0, 0}}, 0},
        {"drops the last items", {{0, 50, 0}, {50, 99, 1}}, 2},
        {"drops the first items", {{1, 100, 0}}, 1},
        {"drops a middle", {{0, 40, 0}, {41, 100, 0}}, 2},
        {"does some twice", {{0, 100, 0}, {0, 1, 0}}, 2},
        {"begins below zero", {{-1, 100, 0}}, 1},
        {"ends past the end", {{0, 101, 0}}, 1},
        {"lies far outside", {{INT32_MIN, INT32_MAX, 0}}, 1},
        {"hands out empty ranges", {{50, 50, 0}, {60, 40, 0}}, 2},
        {"names worker -1", {{0, 50, 0}, {50, 100, -1}}, 2},
        {"names a worker too many", {{0, 50, 0}, {50, 100, 4}}, 2},
        {"names a worker too many for a piece beyond the work", {{0, 100, 0}, {0, 100, INT32_MAX}}, 2},
    };
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++) {
        ledger l;
        char message[DPL_MESSAGE_SIZE];
        dpl_status status = run_script(&scripts[i], &l, message);
        if (status != DPL_ERROR_ARGUMENT || !strstr(message, "task hooks"))
            fail_msg("a task system that %s got \"%s\", message \"%s\"", scripts[i].what,
                     dpl_status_text(status), message);
        assert_int_equal(atomic_load(&l.bad_workers), 0);
        assert_int_equal(atomic_load(&l.bad_ranges), 0);
        free(l.handled);
    }
}

static void a_context_works_again_after_its_hooks_erred(void **state) {
    (void)state;
    script s = {"drops the last items", {{0, 99, 0}}, 1};
    dpl_task_hooks hooks = {.enqueue = play_script, .finish = never_finish, .user = &s};
    dpl_context *context = context_with(1, &hooks);
    ledger l;
    assert_int_equal(run_ledger(context, &l, 100, 10), DPL_ERROR_ARGUMENT);
    free(l.handled);
    s.ranges[0].worker = 1;
    assert_int_equal(run_ledger(context, &l, 100, 10), DPL_ERROR_ARGUMENT);
    free(l.handled);
    s.ranges[0].worker = 0;
    s.ranges[0].end = 100;
    assert_ok(run_ledger(context, &l, 100, 10));
    assert_all_handled_once(&l);
    free(l.handled);
    dpl_context_destroy(context);
}

/* An allocator that counts how often it is asked. */
static void *count_allocation(size_t bytes, size_t alignment, void *user) {
    ++*(int32_t *)user;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void release_counted(void *memory, size_t bytes, void *user) {
    (void)bytes, (void)user;
    free(memory);
}

static void a_run_allocates_nothing(void **state) {
    (void)state;
    int32_t allocations = 0;
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 4;
    desc.allocator = (dpl_allocator){count_allocation, release_counted, &allocations};
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    int32_t before = allocations;
    for (int32_t items = 1; items < 200; items++) {
        ledger l;
        assert_ok(run_ledger(context, &l, items, 1));
        free(l.handled);
    }
    assert_int_equal(allocations, before);
    dpl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_threads_handle_every_item_once),
        cmocka_unit_test(nothing_to_do_calls_nobody),
        cmocka_unit_test(many_runs_in_a_row_lose_nothing),
        cmocka_unit_test(contexts_come_and_go_without_having_worked),
        cmocka_unit_test(contexts_on_several_threads_do_not_meet),
        cmocka_unit_test(a_users_task_system_handles_every_item_once),
        cmocka_unit_test(hooks_may_do_all_the_work_at_once),
        cmocka_unit_test(hooks_that_err_get_an_error_and_reach_no_memory),
        cmocka_unit_test(a_context_works_again_after_its_hooks_erred),
        cmocka_unit_test(a_run_allocates_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
