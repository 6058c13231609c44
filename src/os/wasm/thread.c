/* The side of thread.h where a module runs on the one thread that called it: none is started, so locks have
 * nobody to keep out and conditions nobody to wait for. */
#include "os/thread.h"

bool dpl_thread_start(dpl_thread *thread, void *(*function)(void *), void *argument) {
    (void)thread, (void)function, (void)argument;
    return false;
}

void dpl_thread_join(dpl_thread *thread) {
    (void)thread;
}

void dpl_thread_pause(void) {
}

bool dpl_mutex_create(dpl_mutex *mutex) {
    mutex->handle = 0;
    return true;
}

void dpl_mutex_destroy(dpl_mutex *mutex) {
    (void)mutex;
}

void dpl_mutex_lock(dpl_mutex *mutex) {
    (void)mutex;
}

void dpl_mutex_unlock(dpl_mutex *mutex) {
    (void)mutex;
}

bool dpl_condition_create(dpl_condition *condition) {
    condition->handle = 0;
    return true;
}

void dpl_condition_destroy(dpl_condition *condition) {
    (void)condition;
}

void dpl_condition_wait(dpl_condition *condition, dpl_mutex *mutex) {
    (void)condition, (void)mutex;
}

void dpl_condition_wake_all(dpl_condition *condition) {
    (void)condition;
}
