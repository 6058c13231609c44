/* Statuses have texts, the version is the header's, and a desc without its cookie is refused. */
#include "testing.h"

#include <dapple/dapple.h>

#include <string.h>

static void every_status_has_its_own_text(void **state) {
    (void)state;
    for (int a = DPL_OK; a <= DPL_ERROR_CANCELLED; a++)
        for (int b = DPL_OK; b < a; b++)
            assert_string_not_equal(dpl_status_text((dpl_status)a), dpl_status_text((dpl_status)b));
    assert_string_equal(dpl_status_text((dpl_status)999), "unknown status");
}

static void version_is_that_of_the_headers(void **state) {
    (void)state;
    assert_string_equal(dpl_version(), "0.1.0");
}

static void a_desc_without_cookie_is_refused(void **state) {
    (void)state;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.cookie = 0;
    assert_int_equal(dpl_context_create(&desc, &context), DPL_ERROR_DESC);
    assert_null(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_its_own_text),
        cmocka_unit_test(version_is_that_of_the_headers),
        cmocka_unit_test(a_desc_without_cookie_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
