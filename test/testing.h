/* What every test starts from: cmocka with the headers it wants before it. */
#ifndef DPL_TEST_TESTING_H
#define DPL_TEST_TESTING_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* A call that must succeed. */
#define assert_ok(call) assert_int_equal((call), DPL_OK)

#endif
