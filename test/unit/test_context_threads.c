/* A system that refuses threads or locks: the context is not made, and what was made on the way is undone.
 *
 * This file takes the place of src/os/thread.c: it defines everything that os/thread.h declares, so the
 * linker leaves the library's own out. The functions do what theirs do, but count, and refuse when told. */
#include "testing.h"

#include "os/thread.h"

#include <dapple/context.h>

#include <stdlib.h>

enum { LOCK, CONDITION, THREAD, KINDS };

static int32_t alive[KINDS];
static int32_t allowed; /* of all kinds together, until the system refuses */

static bool counted(int kind, bool made) {
    alive[kind] += made;
    return made;
}

static bool refuses(void) {
    return allowed-- <= 0;
}

bool dpl_thread_start(dpl_thread *thread, void *(*function)(void *), void *argument) {
    return !refuses() && counted(THREAD, pthread_create(&thread->handle, NULL, function, argument) == 0);
}

void dpl_thread_join(dpl_thread *thread) {
    alive[THREAD] -= pthread_join(thread->handle, NULL) == 0;
}

void dpl_thread_pause(void) {
}

bool dpl_mutex_create(dpl_mutex *mutex) {
    return !refuses() && counted(LOCK, pthread_mutex_init(&mutex->handle, NULL) == 0);
}

void dpl_mutex_destroy(dpl_mutex *mutex) {
    alive[LOCK] -= pthread_mutex_destroy(&mutex->handle) == 0;
}

void dpl_mutex_lock(dpl_mutex *mutex) {
    pthread_mutex_lock(&mutex->handle);
}

void dpl_mutex_unlock(dpl_mutex *mutex) {
    pthread_mutex_unlock(&mutex->handle);
}

bool dpl_condition_create(dpl_condition *condition) {
    return !refuses() && counted(CONDITION, pthread_cond_init(&condition->handle, NULL) == 0);
}

void dpl_condition_destroy(dpl_condition *condition) {
    alive[CONDITION] -= pthread_cond_destroy(&condition->handle) == 0;
}

void dpl_condition_wait(dpl_condition *condition, dpl_mutex *mutex) {
    pthread_cond_wait(&condition->handle, &mutex->handle);
}

void dpl_condition_wake_all(dpl_condition *condition) {
    pthread_cond_broadcast(&condition->handle);
}

static int32_t blocks;

static void *count_allocate(size_t bytes, size_t alignment, void *user) {
    (void)user;
    blocks++;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void count_release(void *memory, size_t bytes, void *user) {
    (void)bytes, (void)user;
    blocks--;
    free(memory);
}

static dpl_status last_logged;

static void keep_status(dpl_status status, const char *message, void *user) {
    (void)message, (void)user;
    last_logged = status;
}

static dpl_status create(int32_t thread_count, dpl_context **context) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = thread_count;
    desc.allocator = (dpl_allocator){.allocate = count_allocate, .release = count_release};
    desc.log = keep_status;
    last_logged = DPL_OK;
    return dpl_context_create(&desc, context);
}

static void assert_nothing_is_left(void) {
    for (int kind = 0; kind < KINDS; kind++)
        assert_int_equal(alive[kind], 0);
    assert_int_equal(blocks, 0);
}

static void refusal_at_any_point_leaves_nothing_behind(void **state) {
    (void)state;
    const int32_t thread_count = 6, needed = 1 + 2 + 5; /* a lock, two conditions, the other threads */
    for (int32_t n = 0; n < needed; n++) {
        dpl_context *context;
        allowed = n;
        assert_int_equal(create(thread_count, &context), DPL_ERROR_THREAD);
        assert_int_equal(last_logged, DPL_ERROR_THREAD);
        assert_null(context);
        assert_nothing_is_left();
    }
}

static void as_many_as_needed_are_enough_and_are_all_given_back(void **state) {
    (void)state;
    dpl_context *context;
    allowed = 1 + 2 + 5;
    assert_ok(create(6, &context));
    assert_int_equal(alive[LOCK], 1);
    assert_int_equal(alive[CONDITION], 2);
    assert_int_equal(alive[THREAD], 5);
    dpl_context_destroy(context);
    assert_nothing_is_left();
}

static void one_thread_needs_nothing_of_the_system(void **state) {
    (void)state;
    dpl_context *context;
    allowed = 0;
    assert_ok(create(1, &context));
    dpl_context_destroy(context);
    assert_nothing_is_left();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refusal_at_any_point_leaves_nothing_behind),
        cmocka_unit_test(as_many_as_needed_are_enough_and_are_all_given_back),
        cmocka_unit_test(one_thread_needs_nothing_of_the_system),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
