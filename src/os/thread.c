/* The pthreads side of thread.h. */
#include "os/thread.h"

bool dpl_thread_start(dpl_thread *thread, void *(*function)(void *), void *argument) {
    return pthread_create(&thread->handle, NULL, function, argument) == 0;
}

void dpl_thread_join(dpl_thread *thread) {
    pthread_join(thread->handle, NULL);
}

void dpl_thread_pause(void) {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

bool dpl_mutex_create(dpl_mutex *mutex) {
    return pthread_mutex_init(&mutex->handle, NULL) == 0;
}

void dpl_mutex_destroy(dpl_mutex *mutex) {
    pthread_mutex_destroy(&mutex->handle);
}

void dpl_mutex_lock(dpl_mutex *mutex) {
    pthread_mutex_lock(&mutex->handle);
}

void dpl_mutex_unlock(dpl_mutex *mutex) {
    pthread_mutex_unlock(&mutex->handle);
}

bool dpl_condition_create(dpl_condition *condition) {
    return pthread_cond_init(&condition->handle, NULL) == 0;
}

void dpl_condition_destroy(dpl_condition *condition) {
    pthread_cond_destroy(&condition->handle);
}

void dpl_condition_wait(dpl_condition *condition, dpl_mutex *mutex) {
    pthread_cond_wait(&condition->handle, &mutex->handle);
}

void dpl_condition_wake_all(dpl_condition *condition) {
    pthread_cond_broadcast(&condition->handle);
}
