/* A file appears under its name only when it is whole; whatever fails leaves what was there and says why. */
#define _XOPEN_SOURCE 700 /* mkdtemp, symlink, mkfifo */

#include "testing.h"

#include "../../image/file.h"
#include "test_file_folder.h"

#include <errno.h>
#include <fcntl.h>

static void assert_holds(const char *path, const char *text) {
    char *bytes;
    size_t size;
    dpl_error error = {{0}};
    assert_true(dpl_file_read(path, 1 << 20, &bytes, &size, &error));
    assert_int_equal(size, strlen(text));
    assert_string_equal(bytes, text);
    free(bytes);
}

static void assert_error_ends(const dpl_error *error, const char *path, const char *what) {
    char text[sizeof error->text];
    snprintf(text, sizeof text, "%s: %s", path, what);
    assert_string_equal(error->text, text);
}

static unsigned mode_of(const char *path) {
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 0777;
}

/* ---- Reading -------------------------------------------------------------------------------------- */

static void what_is_written_is_read_back(void **state) {
    test_folder *folder = *state;
    size_t size = 200000; /* more than one buffer */
    char *bytes = malloc(size), *back;
    assert_non_null(bytes);
    for (size_t i = 0; i < size; i++)
        bytes[i] = (char)(i * 7 >> 3);
    const char *path = folder_path(folder, "bytes");
    dpl_error error = {{0}};
    assert_true(dpl_file_write(path, bytes, size, &error));
    size_t back_size;
    assert_true(dpl_file_read(path, size, &back, &back_size, &error));
    assert_int_equal(back_size, size);
    assert_memory_equal(back, bytes, size);
    assert_int_equal(back[size], 0);
    assert_int_equal(folder_count(folder), 1);
    free(bytes);
    free(back);
}

static void an_empty_file_is_read_as_an_empty_text(void **state) {
    const char *path = folder_path(*state, "empty");
    assert_true(dpl_file_write(path, "", 0, NULL));
    assert_holds(path, "");
}

static void a_file_over_the_limit_is_refused(void **state) {
    const char *path = folder_path(*state, "long");
    char *bytes;
    size_t size;
    dpl_error error = {{0}};
    assert_true(dpl_file_write(path, "12345", 5, &error));
    assert_false(dpl_file_read(path, 4, &bytes, &size, &error));
    assert_null(bytes);
    assert_error_ends(&error, path, "larger than 4 bytes");
    assert_false(dpl_file_read("/dev/zero", 100000, &bytes, &size, &error));
    assert_string_equal(error.text, "/dev/zero: larger than 100000 bytes");
}

static void what_cannot_be_read_is_named(void **state) {
    test_folder *folder = *state;
    char *bytes;
    size_t size;
    dpl_error error = {{0}};
    const char *path = folder_path(folder, "missing");
    assert_false(dpl_file_read(path, 10, &bytes, &size, &error));
    assert_null(bytes);
    assert_error_ends(&error, path, strerror(ENOENT));
    assert_false(dpl_file_read(folder->name, 10, &bytes, &size, &error));
    assert_null(bytes);
    assert_error_ends(&error, folder->name, strerror(EISDIR));
}

/* ---- Writing -------------------------------------------------------------------------------------- */

static void the_name_appears_only_at_the_end(void **state) {
    const char *path = folder_path(*state, "out");
    dpl_file_writer writer;
    dpl_error error = {{0}};
    assert_true(dpl_file_writer_open(&writer, path, &error));
    assert_true(fputs("hello", writer.stream) >= 0);
    assert_int_equal(fflush(writer.stream), 0);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_true(dpl_file_writer_close(&writer, true, &error));
    assert_holds(path, "hello");
    assert_null(writer.stream);
}

static void a_write_given_up_leaves_the_old_file(void **state) {
    test_folder *folder = *state;
    const char *path = folder_path(folder, "out");
    dpl_file_writer writer;
    dpl_error error = {{0}};
    assert_true(dpl_file_write(path, "old", 3, &error));
    assert_true(dpl_file_writer_open(&writer, path, &error));
    assert_true(fputs("new", writer.stream) >= 0);
    dpl_error_set(&error, "the reason");
    assert_false(dpl_file_writer_close(&writer, false, &error));
    assert_string_equal(error.text, "the reason");
    assert_holds(path, "old");
    assert_int_equal(folder_count(folder), 1);
}

static void two_writers_of_one_name_do_not_meet(void **state) {
    test_folder *folder = *state;
    const char *path = folder_path(folder, "out");
    dpl_file_writer first, second;
    assert_true(dpl_file_writer_open(&first, path, NULL));
    assert_true(dpl_file_writer_open(&second, path, NULL));
    assert_true(fputs("first", first.stream) >= 0);
    assert_true(fputs("second", second.stream) >= 0);
    assert_true(dpl_file_writer_close(&first, true, NULL));
    assert_holds(path, "first");
    assert_true(dpl_file_writer_close(&second, true, NULL));
    assert_holds(path, "second");
    assert_int_equal(folder_count(folder), 1);
}

static void a_full_disk_is_an_error(void **state) {
    (void)state;
    dpl_error error = {{0}};
    assert_false(dpl_file_write("/dev/full", "some", 4, &error));
    assert_error_ends(&error, "/dev/full", strerror(ENOSPC));
    char *many = calloc(1, 100000); /* more than a stream buffers: fails in the middle, not at the end */
    assert_non_null(many);
    error.text[0] = 0;
    assert_false(dpl_file_write("/dev/full", many, 100000, &error));
    assert_error_ends(&error, "/dev/full", strerror(ENOSPC));
    dpl_file_writer writer; /* and when the one who writes does not look */
    assert_true(dpl_file_writer_open(&writer, "/dev/full", &error));
    for (int i = 0; i < 3; i++)
        (void)!fwrite(many, 1, 100000, writer.stream);
    error.text[0] = 0;
    assert_false(dpl_file_writer_close(&writer, true, &error));
    assert_error_ends(&error, "/dev/full", strerror(ENOSPC));
    free(many);
}

static void a_missing_folder_is_named(void **state) {
    test_folder *folder = *state;
    const char *path = folder_path(folder, "nowhere/out");
    char what[400];
    dpl_error error = {{0}};
    snprintf(what, sizeof what, "there is no folder %s/nowhere", folder->name);
    assert_false(dpl_file_write(path, "x", 1, &error));
    assert_error_ends(&error, path, what);
    assert_int_equal(folder_count(folder), 0);
}

static void a_folder_is_not_written_over(void **state) {
    test_folder *folder = *state;
    dpl_error error = {{0}};
    assert_false(dpl_file_write(folder->name, "x", 1, &error));
    assert_error_ends(&error, folder->name, strerror(EISDIR));
    assert_int_equal(folder_count(folder), 0);
}

static void an_empty_path_is_an_error(void **state) {
    (void)state;
    dpl_error error = {{0}};
    assert_false(dpl_file_write("", "x", 1, &error));
    assert_error_ends(&error, "", strerror(ENOENT));
}

static void the_permissions_are_those_of_any_other_file(void **state) {
    const char *path = folder_path(*state, "out");
    mode_t before = umask(027);
    bool good = dpl_file_write(path, "x", 1, NULL);
    umask(before);
    assert_true(good);
    assert_int_equal(mode_of(path), 0640);
    assert_int_equal(chmod(path, 0600), 0); /* and a file that is private stays so */
    assert_true(dpl_file_write(path, "y", 1, NULL));
    assert_int_equal(mode_of(path), 0600);
    assert_holds(path, "y");
}

static void a_write_protected_file_is_kept(void **state) {
    const char *path = folder_path(*state, "out");
    if (geteuid() == 0)
        skip(); /* nothing is protected from root */
    assert_true(dpl_file_write(path, "old", 3, NULL));
    assert_int_equal(chmod(path, 0400), 0);
    dpl_error error = {{0}};
    assert_false(dpl_file_write(path, "new", 3, &error));
    assert_error_ends(&error, path, strerror(EACCES));
    assert_holds(path, "old");
}

/* ---- Links and pipes ------------------------------------------------------------------------------ */

static bool is_link(const char *path) {
    struct stat status;
    assert_int_equal(lstat(path, &status), 0);
    return S_ISLNK(status.st_mode);
}

static void a_link_stays_and_its_target_is_replaced(void **state) {
    test_folder *folder = *state;
    assert_true(dpl_file_write(folder_path(folder, "target"), "old", 3, NULL));
    assert_int_equal(symlink("target", folder_path(folder, "link")), 0);
    assert_int_equal(symlink("link", folder_path(folder, "link to link")), 0);
    assert_true(dpl_file_write(folder_path(folder, "link to link"), "new", 3, NULL));
    assert_true(is_link(folder_path(folder, "link to link")));
    assert_true(is_link(folder_path(folder, "link")));
    assert_holds(folder_path(folder, "target"), "new");
    assert_int_equal(folder_count(folder), 3);
}

static void a_link_to_nothing_makes_its_target(void **state) {
    test_folder *folder = *state;
    assert_int_equal(symlink("target", folder_path(folder, "link")), 0);
    assert_true(dpl_file_write(folder_path(folder, "link"), "new", 3, NULL));
    assert_true(is_link(folder_path(folder, "link")));
    assert_holds(folder_path(folder, "target"), "new");
}

static void a_circle_of_links_is_an_error(void **state) {
    test_folder *folder = *state;
    assert_int_equal(symlink("b", folder_path(folder, "a")), 0);
    assert_int_equal(symlink("a", folder_path(folder, "b")), 0);
    dpl_error error = {{0}};
    assert_false(dpl_file_write(folder_path(folder, "a"), "x", 1, &error));
    assert_error_ends(&error, folder_path(folder, "a"), strerror(ELOOP));
    assert_int_equal(folder_count(folder), 2);
}

static void a_pipe_is_written_directly(void **state) {
    test_folder *folder = *state;
    const char *path = folder_path(folder, "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    int reader = open(path, O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    assert_true(dpl_file_write(path, "through", 7, NULL));
    char got[16] = {0};
    assert_int_equal(read(reader, got, sizeof got), 7);
    assert_string_equal(got, "through");
    close(reader);
    assert_int_equal(folder_count(folder), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        folder_test(what_is_written_is_read_back),
        folder_test(an_empty_file_is_read_as_an_empty_text),
        folder_test(a_file_over_the_limit_is_refused),
        folder_test(what_cannot_be_read_is_named),
        folder_test(the_name_appears_only_at_the_end),
        folder_test(a_write_given_up_leaves_the_old_file),
        folder_test(two_writers_of_one_name_do_not_meet),
        cmocka_unit_test(a_full_disk_is_an_error),
        folder_test(a_missing_folder_is_named),
        folder_test(a_folder_is_not_written_over),
        cmocka_unit_test(an_empty_path_is_an_error),
        folder_test(the_permissions_are_those_of_any_other_file),
        folder_test(a_write_protected_file_is_kept),
        folder_test(a_link_stays_and_its_target_is_replaced),
        folder_test(a_link_to_nothing_makes_its_target),
        folder_test(a_circle_of_links_is_an_error),
        folder_test(a_pipe_is_written_directly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
