/* Remembers a signal. */
#define _POSIX_C_SOURCE 200809L
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>

/* The one thing that a handler may write to, hence not in any struct. */
static volatile sig_atomic_t caught;

static void remember(int signal_number) {
    if (!caught)
        caught = signal_number;
}

void dpl_interrupt_catch(void) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int dpl_interrupt_status(void) {
    return caught ? 128 + (int)caught : 0;
}
