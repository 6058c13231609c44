/* The context: its defaults, every desc that is refused, memory that runs out at any point, the log, and the
 * choice of kernels. */
#include "testing.h"

#include "base/context.h"
#include "os/machine.h"

#include <dapple/dapple.h>

#include <stdlib.h>
#include <string.h>

/* A user's allocator that keeps books and can run out. */
typedef struct books {
    int32_t allowed; /* allocations until it refuses; negative: never */
    int32_t blocks;  /* alive now */
    size_t bytes;    /* alive now */
    int32_t mistakes;
} books;

static void *book_allocate(size_t bytes, size_t alignment, void *user) {
    books *b = user;
    if (bytes == 0 || alignment < 64 || (alignment & (alignment - 1)) != 0)
        b->mistakes++;
    if (b->allowed == 0)
        return NULL;
    b->allowed--;
    void *memory = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    assert_non_null(memory);
    memset(memory, 0xa5, bytes); /* nobody may count on zeros */
    b->blocks++;
    b->bytes += bytes;
    return memory;
}

static void book_release(void *memory, size_t bytes, void *user) {
    books *b = user;
    if (!memory || bytes > b->bytes)
        b->mistakes++;
    b->blocks--;
    b->bytes -= bytes;
    free(memory);
}

static dpl_context_desc desc_with_books(books *b) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.allocator = (dpl_allocator){.allocate = book_allocate, .release = book_release, .user = b};
    return desc;
}

/* What a log hook was told. */
typedef struct log_book {
    int32_t lines;
    dpl_status status;
    char message[DPL_MESSAGE_SIZE];
} log_book;

static void keep_line(dpl_status status, const char *message, void *user) {
    log_book *log = user;
    log->lines++;
    log->status = status;
    strncpy(log->message, message, sizeof log->message - 1);
}

static void *enqueue_nothing(dpl_task_function function, int32_t item_count, int32_t min_range, void *task,
                             void *user) {
    (void)function, (void)item_count, (void)min_range, (void)task, (void)user;
    return NULL;
}

static void finish_nothing(void *handle, void *user) {
    (void)handle, (void)user;
}

static void without_a_desc_all_is_default(void **state) {
    (void)state;
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    assert_non_null(context);
    assert_string_equal(dpl_context_message(context), "");
    assert_int_equal(dpl_context_thread_count(context), dpl_processor_count());
    dpl_isa isa = dpl_context_isa(context);
    assert_int_not_equal((uint32_t)isa & dpl_isa_available(), 0);
    dpl_context_destroy(context);
}

static void the_default_desc_is_the_same_as_none(void **state) {
    (void)state;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *with, *without;
    assert_ok(dpl_context_create(&desc, &with));
    assert_ok(dpl_context_create(NULL, &without));
    assert_int_equal(dpl_context_thread_count(with), dpl_context_thread_count(without));
    assert_int_equal(dpl_context_isa(with), dpl_context_isa(without));
    dpl_context_destroy(with);
    dpl_context_destroy(without);
}

static void the_default_is_the_best_instruction_set(void **state) {
    (void)state;
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    /* The bits are in order of their worth: nothing usable lies above the one chosen. */
    assert_true((uint32_t)dpl_context_isa(context) * 2 > dpl_isa_available());
    dpl_context_destroy(context);
}

static void a_thread_count_that_is_given_is_kept(void **state) {
    (void)state;
    const int32_t counts[] = {1, 2, 3, DPL_MAX_THREADS};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *context;
        desc.thread_count = counts[i];
        assert_ok(dpl_context_create(&desc, &context));
        assert_int_equal(dpl_context_thread_count(context), counts[i]);
        dpl_context_destroy(context);
    }
}

static void task_hooks_mean_one_worker_unless_told(void **state) {
    (void)state;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.tasks = (dpl_task_hooks){.enqueue = enqueue_nothing, .finish = finish_nothing};
    assert_ok(dpl_context_create(&desc, &context));
    assert_int_equal(dpl_context_thread_count(context), 1);
    dpl_context_destroy(context);
    desc.thread_count = 5;
    assert_ok(dpl_context_create(&desc, &context));
    assert_int_equal(dpl_context_thread_count(context), 5);
    dpl_context_destroy(context);
}

static void no_cookie(dpl_context_desc *desc) {
    desc->cookie = 0;
}
static void wrong_cookie(dpl_context_desc *desc) {
    desc->cookie++;
}
static void no_size(dpl_context_desc *desc) {
    desc->struct_size = 0;
}
static void too_large_a_size(dpl_context_desc *desc) {
    desc->struct_size++;
}
static void all_zeros(dpl_context_desc *desc) {
    memset(desc, 0, sizeof *desc);
}
static void negative_threads(dpl_context_desc *desc) {
    desc->thread_count = -1;
}
static void too_many_threads(dpl_context_desc *desc) {
    desc->thread_count = DPL_MAX_THREADS + 1;
}
static void most_threads_of_all(dpl_context_desc *desc) {
    desc->thread_count = INT32_MAX;
}
static void allocate_alone(dpl_context_desc *desc) {
    desc->allocator.allocate = book_allocate;
}
static void release_alone(dpl_context_desc *desc) {
    desc->allocator.release = book_release;
}
static void enqueue_alone(dpl_context_desc *desc) {
    desc->tasks.enqueue = enqueue_nothing;
}
static void finish_alone(dpl_context_desc *desc) {
    desc->tasks.finish = finish_nothing;
}
static void no_instruction_set(dpl_context_desc *desc) {
    desc->isa_mask = 0;
}
static void an_instruction_set_nobody_has(dpl_context_desc *desc) {
    desc->isa_mask = 0x4000;
}

static void every_bad_desc_is_refused(void **state) {
    (void)state;
    const struct {
        void (*spoil)(dpl_context_desc *desc);
        dpl_status expected;
    } cases[] = {
        {no_cookie, DPL_ERROR_DESC},
        {wrong_cookie, DPL_ERROR_DESC},
        {no_size, DPL_ERROR_DESC},
        {too_large_a_size, DPL_ERROR_DESC},
        {all_zeros, DPL_ERROR_DESC},
        {negative_threads, DPL_ERROR_ARGUMENT},
        {too_many_threads, DPL_ERROR_ARGUMENT},
        {most_threads_of_all, DPL_ERROR_ARGUMENT},
        {allocate_alone, DPL_ERROR_ARGUMENT},
        {release_alone, DPL_ERROR_ARGUMENT},
        {enqueue_alone, DPL_ERROR_ARGUMENT},
        {finish_alone, DPL_ERROR_ARGUMENT},
        {no_instruction_set, DPL_ERROR_UNAVAILABLE},
        {an_instruction_set_nobody_has, DPL_ERROR_UNAVAILABLE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char something;
        dpl_context *context = (dpl_context *)(void *)&something;
        dpl_context_desc desc = dpl_context_desc_default();
        cases[i].spoil(&desc);
        assert_int_equal(dpl_context_create(&desc, &context), cases[i].expected);
        assert_null(context);
    }
    assert_int_equal(dpl_context_create(NULL, NULL), DPL_ERROR_ARGUMENT);
}

static void destroying_nothing_is_fine(void **state) {
    (void)state;
    dpl_context_destroy(NULL);
}

static void memory_that_runs_out_anywhere_leaves_nothing_behind(void **state) {
    (void)state;
    int32_t failures = 0;
    for (int32_t allowed = 0;; allowed++) {
        books b = {.allowed = allowed};
        dpl_context_desc desc = desc_with_books(&b);
        desc.thread_count = 4;
        dpl_context *context;
        dpl_status status = dpl_context_create(&desc, &context);
        if (status == DPL_OK) {
            assert_true(b.blocks > 0);
            dpl_context_destroy(context);
        } else {
            assert_int_equal(status, DPL_ERROR_MEMORY);
            assert_null(context);
            failures++;
        }
        assert_int_equal(b.blocks, 0);
        assert_int_equal(b.bytes, 0);
        assert_int_equal(b.mistakes, 0);
        if (status == DPL_OK)
            break;
    }
    assert_true(failures >= 2); /* the context itself, and its jobs */
}

static void an_overflowing_size_is_out_of_memory_and_never_reaches_the_allocator(void **state) {
    (void)state;
    books b = {.allowed = -1};
    dpl_context_desc desc = desc_with_books(&b);
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    int32_t blocks = b.blocks;
    assert_null(dpl_allocate(context, SIZE_MAX / 2, 3));
    assert_int_equal(b.blocks, blocks);
    assert_string_not_equal(dpl_context_message(context), "");
    dpl_context_destroy(context);
    assert_int_equal(b.blocks, 0);
}

static void a_buffer_that_cannot_grow_keeps_what_it_has(void **state) {
    (void)state;
    books b = {.allowed = -1};
    dpl_context_desc desc = desc_with_books(&b);
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    dpl_buffer buffer = {0};
    assert_ok(dpl_buffer_reserve(context, &buffer, 100, 4));
    void *data = buffer.data;
    assert_ok(dpl_buffer_reserve(context, &buffer, 50, 8));
    assert_ptr_equal(buffer.data, data);
    b.allowed = 0;
    assert_int_equal(dpl_buffer_reserve(context, &buffer, 101, 4), DPL_ERROR_MEMORY);
    assert_ptr_equal(buffer.data, data);
    assert_int_equal(dpl_buffer_reserve(context, &buffer, SIZE_MAX, SIZE_MAX), DPL_ERROR_MEMORY);
    assert_ptr_equal(buffer.data, data);
    dpl_buffer_free(context, &buffer);
    dpl_context_destroy(context);
    assert_int_equal(b.blocks, 0);
    assert_int_equal(b.bytes, 0);
    assert_int_equal(b.mistakes, 0);
}

static void the_log_hears_of_an_error_while_a_context_is_made(void **state) {
    (void)state;
    books b = {.allowed = 1}; /* the context itself, then no more */
    log_book log = {0};
    dpl_context_desc desc = desc_with_books(&b);
    desc.log = keep_line;
    desc.log_user = &log;
    dpl_context *context;
    assert_int_equal(dpl_context_create(&desc, &context), DPL_ERROR_MEMORY);
    assert_int_equal(log.lines, 1);
    assert_int_equal(log.status, DPL_ERROR_MEMORY);
    assert_non_null(strstr(log.message, "memory"));
}

static void log_and_message_have_the_same_text_of_the_last_error(void **state) {
    (void)state;
    log_book log = {0};
    dpl_context_desc desc = dpl_context_desc_default();
    desc.log = keep_line;
    desc.log_user = &log;
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    assert_int_equal(log.lines, 0);
    assert_int_equal(dpl_fail(context, DPL_ERROR_SIZE, "width %d", 0), DPL_ERROR_SIZE);
    assert_int_equal(dpl_fail(context, DPL_ERROR_ARGUMENT, "radius of shape %d", 7), DPL_ERROR_ARGUMENT);
    assert_int_equal(log.lines, 2);
    assert_int_equal(log.status, DPL_ERROR_ARGUMENT);
    assert_string_equal(log.message, "radius of shape 7");
    assert_string_equal(dpl_context_message(context), log.message);
    dpl_context_destroy(context);
}

static void a_message_that_is_too_long_is_cut(void **state) {
    (void)state;
    char text[2 * DPL_MESSAGE_SIZE];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    dpl_context *context;
    assert_ok(dpl_context_create(NULL, &context));
    assert_int_equal(dpl_fail(context, DPL_ERROR_SIZE, "%s", text), DPL_ERROR_SIZE);
    assert_int_equal(strlen(dpl_context_message(context)), DPL_MESSAGE_SIZE - 1);
    dpl_context_destroy(context);
}

static void a_mask_of_one_bit_gives_that_instruction_set_or_nothing(void **state) {
    (void)state;
    assert_true(dpl_isa_available() & DPL_ISA_SCALAR);
    for (uint32_t bit = 1; bit < DPL_ISA_ALL; bit <<= 1) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *context;
        desc.isa_mask = bit;
        dpl_status status = dpl_context_create(&desc, &context);
        if (dpl_isa_available() & bit) {
            assert_int_equal(status, DPL_OK);
            assert_int_equal(dpl_context_isa(context), bit);
        } else {
            assert_int_equal(status, DPL_ERROR_UNAVAILABLE);
            assert_null(context);
        }
        dpl_context_destroy(context);
    }
}

static void instruction_sets_are_named_as_on_the_command_line(void **state) {
    (void)state;
    assert_string_equal(dpl_isa_name(DPL_ISA_SCALAR), "scalar");
    assert_string_equal(dpl_isa_name(DPL_ISA_SSE2), "sse2");
    assert_string_equal(dpl_isa_name(DPL_ISA_AVX2), "avx2");
    assert_string_equal(dpl_isa_name(DPL_ISA_AVX512), "avx512");
    assert_string_equal(dpl_isa_name((dpl_isa)0), "?");
    assert_string_equal(dpl_isa_name(DPL_ISA_ALL), "?");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_desc_all_is_default),
        cmocka_unit_test(the_default_desc_is_the_same_as_none),
        cmocka_unit_test(the_default_is_the_best_instruction_set),
        cmocka_unit_test(a_thread_count_that_is_given_is_kept),
        cmocka_unit_test(task_hooks_mean_one_worker_unless_told),
        cmocka_unit_test(every_bad_desc_is_refused),
        cmocka_unit_test(destroying_nothing_is_fine),
        cmocka_unit_test(memory_that_runs_out_anywhere_leaves_nothing_behind),
        cmocka_unit_test(an_overflowing_size_is_out_of_memory_and_never_reaches_the_allocator),
        cmocka_unit_test(a_buffer_that_cannot_grow_keeps_what_it_has),
        cmocka_unit_test(the_log_hears_of_an_error_while_a_context_is_made),
        cmocka_unit_test(log_and_message_have_the_same_text_of_the_last_error),
        cmocka_unit_test(a_message_that_is_too_long_is_cut),
        cmocka_unit_test(a_mask_of_one_bit_gives_that_instruction_set_or_nothing),
        cmocka_unit_test(instruction_sets_are_named_as_on_the_command_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
