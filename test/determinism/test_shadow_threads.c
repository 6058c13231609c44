/* Shadows are the same to the bit for every number of threads. */
#include "shadow_world.h"
#include "world.h"

#include <string.h>

enum { SIZE = 96 };

static void every_method_is_the_same_for_any_number_of_threads(void **state) {
    (void)state;
    static const int32_t threads[] = {1, 2, 3, 7};
    for (int method = 0; method < DPL_SHADOW_METHOD_COUNT; method++) {
        static float light_of[2][SIZE * SIZE * 3];
        for (int k = 0; k < 4; k++) {
            dpl_context_desc context_desc = dpl_context_desc_default();
            dpl_context *context;
            dpl_shadow *shadow;
            dpl_shadow_desc desc = dpl_test_method((dpl_shadow_method)method);
            dpl_light lights[2] = {dpl_test_light(40.3, 30.9, 5), dpl_test_light(90, 70, 12)};
            context_desc.thread_count = threads[k];
            desc.samples = 16;
            assert_ok(dpl_context_create(&context_desc, &context));
            dpl_field *field = dpl_test_world(context, SIZE, SIZE, 5, 1);
            dpl_output output = {.data = light_of[k > 0], .width = SIZE, .height = SIZE, .channels = 3};
            assert_ok(dpl_shadow_create(context, &desc, &shadow));
            assert_ok(dpl_shadow_light(shadow, field, lights, 2, &output));
            if (k > 0)
                assert_memory_equal(light_of[0], light_of[1], sizeof light_of[0]);
            dpl_shadow_destroy(shadow);
            dpl_field_destroy(field);
            dpl_context_destroy(context);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_is_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
