/* One context for all tests of a program: pass both functions to cmocka_run_group_tests(). */
#ifndef DPL_TEST_SHARED_CONTEXT_H
#define DPL_TEST_SHARED_CONTEXT_H

#include "testing.h"

#include <dapple/context.h>

static dpl_context *context;

static int open_context(void **state) {
    (void)state;
    return dpl_context_create(NULL, &context) == DPL_OK ? 0 : -1;
}

static int close_context(void **state) {
    (void)state;
    dpl_context_destroy(context);
    return 0;
}

#endif
