/* Metrics refuse what they cannot compare, say why, leave the result alone, and survive every failing
 * allocation without a leak. */
#include "testing.h"

#include <dapple/dapple.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 9, HEIGHT = 6, VALUES = WIDTH * HEIGHT * 3 };

typedef struct fixture {
    float test[VALUES];
    float reference[VALUES];
    uint8_t mask[WIDTH * HEIGHT];
    dpl_metrics_desc desc;
} fixture;

static void set_up(fixture *f) {
    memset(f, 0, sizeof *f);
    for (int i = 0; i < VALUES; i++) {
        f->test[i] = 0.01f * (float)i;
        f->reference[i] = 0.5f;
    }
    f->desc = dpl_metrics_desc_default();
    f->desc.test = (dpl_pixels){.data = f->test, .width = WIDTH, .height = HEIGHT, .channels = 3};
    f->desc.reference = (dpl_pixels){.data = f->reference, .width = WIDTH, .height = HEIGHT, .channels = 3};
}

/* The call fails with this status and a message that has `part`, and does not touch the result. */
static void assert_refused(dpl_context *context, const dpl_metrics_desc *desc, dpl_status status,
                           const char *part) {
    dpl_metrics metrics, before;
    memset(&metrics, 0x5a, sizeof metrics);
    before = metrics;
    assert_int_equal(dpl_metrics_compare(context, desc, &metrics), status);
    assert_memory_equal(&metrics, &before, sizeof metrics);
    if (!strstr(dpl_context_message(context), part))
        fail_msg("\"%s\" does not have \"%s\"", dpl_context_message(context), part);
}

static int make_context(void **state) {
    return dpl_context_create(NULL, (dpl_context **)state) == DPL_OK ? 0 : -1;
}

static int end_context(void **state) {
    dpl_context_destroy(*state);
    return 0;
}

static void missing_arguments_are_refused(void **state) {
    fixture f;
    set_up(&f);
    dpl_metrics metrics;
    assert_int_equal(dpl_metrics_compare(NULL, &f.desc, &metrics), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_metrics_compare(*state, NULL, &metrics), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_metrics_compare(*state, &f.desc, NULL), DPL_ERROR_ARGUMENT);
    f.desc.cookie = 0;
    assert_refused(*state, &f.desc, DPL_ERROR_DESC, "dpl_metrics_desc_default");
}

static void a_value_that_is_not_finite_is_refused_with_its_place(void **state) {
    static const float values[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        fixture f;
        set_up(&f);
        f.test[(2 * WIDTH + 5) * 3 + i] = values[i];
        assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "test picture: not finite at pixel (5, 2)");
        set_up(&f);
        f.reference[(4 * WIDTH + 1) * 3 + i] = values[i];
        assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "reference picture: not finite at pixel (1, 4)");
        f.mask[4 * WIDTH + 1] = 1;
        f.desc.mask = f.mask;
        assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "reference picture: not finite at pixel (1, 4)");
    }
}

static void a_picture_that_is_masked_throughout_is_refused(void **state) {
    fixture f;
    set_up(&f);
    memset(f.mask, 255, sizeof f.mask);
    f.desc.mask = f.mask;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "every pixel is masked");
    f.mask[WIDTH * HEIGHT - 1] = 0;
    dpl_metrics metrics;
    assert_ok(dpl_metrics_compare(*state, &f.desc, &metrics));
    assert_int_equal(metrics.pixels, 1);
}

static void sizes_that_differ_or_are_out_of_range_are_refused(void **state) {
    fixture f;
    set_up(&f);
    f.desc.reference.height = HEIGHT - 1;
    assert_refused(*state, &f.desc, DPL_ERROR_SIZE, "the test picture is 9 x 6, the reference 9 x 5");
    set_up(&f);
    f.desc.test.width = WIDTH - 1;
    assert_refused(*state, &f.desc, DPL_ERROR_SIZE, "8 x 6");
    static const int32_t bad_sizes[] = {0, -1, INT32_MIN, 16385, INT32_MAX};
    for (int i = 0; i < 5; i++) {
        set_up(&f);
        f.desc.test.width = bad_sizes[i];
        assert_refused(*state, &f.desc, DPL_ERROR_SIZE, "test picture: size");
        set_up(&f);
        f.desc.reference.height = bad_sizes[i];
        assert_refused(*state, &f.desc, DPL_ERROR_SIZE, "reference picture: size");
    }
}

static void pictures_of_another_format_or_layout_are_refused(void **state) {
    fixture f;
    set_up(&f);
    f.desc.test.data = NULL;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "test picture: data is NULL");
    set_up(&f);
    f.desc.reference.format = DPL_FORMAT_SRGB8;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "reference picture: format");
    static const int32_t bad_channels[] = {0, 1, 2, 5, -3};
    for (int i = 0; i < 5; i++) {
        set_up(&f);
        f.desc.test.channels = bad_channels[i];
        assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "channels");
    }
    set_up(&f);
    f.desc.test.row_stride = WIDTH * 3 * 4 - 4;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "test picture: row_stride 104");
    f.desc.test.row_stride = WIDTH * 3 * 4 + 2;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "aligned");
    set_up(&f);
    f.desc.mask = f.mask;
    f.desc.mask_stride = 1 - WIDTH;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "mask_stride -8");
}

static void options_out_of_range_are_refused(void **state) {
    static const double bad_distances[] = {0.0, -1.0, NAN, INFINITY, 1e5};
    fixture f;
    for (int i = 0; i < 5; i++) {
        set_up(&f);
        f.desc.pixels_per_degree = bad_distances[i];
        assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "pixels_per_degree");
    }
    set_up(&f);
    f.desc.display_referred = 2;
    assert_refused(*state, &f.desc, DPL_ERROR_ARGUMENT, "display_referred");
}

/* ---- failing memory ------------------------------------------------------------------------------- */

/* Counts what is out, and gives nothing at call number `fail_at`. */
typedef struct counting {
    int calls;
    int fail_at;
    int64_t blocks;
    int64_t bytes;
} counting;

static void *counting_allocate(size_t bytes, size_t alignment, void *user) {
    counting *count = user;
    if (count->calls++ == count->fail_at)
        return NULL;
    void *memory = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory) {
        count->blocks++;
        count->bytes += (int64_t)bytes;
    }
    return memory;
}

static void counting_release(void *memory, size_t bytes, void *user) {
    counting *count = user;
    count->blocks--;
    count->bytes -= (int64_t)bytes;
    free(memory);
}

static dpl_context *counted_context(counting *count) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 2;
    desc.allocator = (dpl_allocator){counting_allocate, counting_release, count};
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    return context;
}

static void every_failing_allocation_is_survived_without_a_leak(void **state) {
    (void)state;
    fixture f;
    set_up(&f);
    counting count = {.fail_at = -1};
    dpl_context *context = counted_context(&count);
    const int64_t blocks = count.blocks, bytes = count.bytes;
    const int calls = count.calls;
    dpl_metrics metrics;
    assert_ok(dpl_metrics_compare(context, &f.desc, &metrics));
    const int per_compare = count.calls - calls;
    assert_true(per_compare >= 5);
    assert_int_equal(count.blocks, blocks);
    assert_int_equal(count.bytes, bytes);
    for (int n = 0; n < per_compare; n++) {
        count.fail_at = count.calls + n;
        assert_refused(context, &f.desc, DPL_ERROR_MEMORY, "no memory");
        assert_int_equal(count.blocks, blocks);
        assert_int_equal(count.bytes, bytes);
    }
    dpl_metrics again;
    assert_ok(dpl_metrics_compare(context, &f.desc, &again));
    assert_memory_equal(&again, &metrics, sizeof again);
    dpl_context_destroy(context);
    assert_int_equal(count.blocks, 0);
    assert_int_equal(count.bytes, 0);
}

/* ---- a task system that does not do its work ------------------------------------------------------ */

static void *enqueue_all_but_one(dpl_task_function function, int32_t item_count, int32_t min_range,
                                 void *task, void *user) {
    int *skip = user;
    (void)min_range;
    if ((*skip)-- != 0)
        function(0, item_count, 0, task);
    return NULL;
}

static void finish_nothing(void *handle, void *user) {
    (void)handle;
    (void)user;
}

static void a_task_system_that_drops_work_is_an_error_without_a_leak(void **state) {
    (void)state;
    fixture f;
    set_up(&f);
    counting count = {.fail_at = -1};
    int skip = -1;
    dpl_context_desc desc = dpl_context_desc_default();
    desc.allocator = (dpl_allocator){counting_allocate, counting_release, &count};
    desc.tasks = (dpl_task_hooks){enqueue_all_but_one, finish_nothing, &skip};
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    const int64_t blocks = count.blocks;
    dpl_metrics metrics;
    assert_ok(dpl_metrics_compare(context, &f.desc, &metrics));
    const int runs = -1 - skip;
    assert_true(runs >= 4);
    for (int n = 0; n < runs; n++) {
        skip = n;
        assert_refused(context, &f.desc, DPL_ERROR_ARGUMENT, "handled 0 of 6 items");
        assert_int_equal(count.blocks, blocks);
    }
    dpl_context_destroy(context);
    assert_int_equal(count.blocks, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_arguments_are_refused),
        cmocka_unit_test(a_value_that_is_not_finite_is_refused_with_its_place),
        cmocka_unit_test(a_picture_that_is_masked_throughout_is_refused),
        cmocka_unit_test(sizes_that_differ_or_are_out_of_range_are_refused),
        cmocka_unit_test(pictures_of_another_format_or_layout_are_refused),
        cmocka_unit_test(options_out_of_range_are_refused),
        cmocka_unit_test(every_failing_allocation_is_survived_without_a_leak),
        cmocka_unit_test(a_task_system_that_drops_work_is_an_error_without_a_leak),
    };
    return cmocka_run_group_tests(tests, make_context, end_context);
}
