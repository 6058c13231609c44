/* Whole files in, whole files out: the atomic writer behind every output of the tools, and the bounded reader
 * behind every input. Called by image/, scenes/ and the tools. */
#define _POSIX_C_SOURCE                                                                                      \
    200809L /* lstat, readlink, fsync, fchmod: the way to a file that is never half there */

#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* As many links as Linux follows. */
#define LINK_LIMIT 40
#define LINK_LENGTH_LIMIT 4096
/* Temporary names tried: others are leftovers of a process of the same id, or threads of this one. */
#define TEMPORARY_LIMIT 1000

static bool fail_errno(dpl_error *error, const char *path, int number) {
    return dpl_error_set(error, "%s: %s", path, strerror(number));
}

/* ---- Reading -------------------------------------------------------------------------------------- */

/* Reads to the end or to one byte past the limit, growing as the data comes: what the file system says about
 * the size of a pipe or a device is not to be believed. */
static bool read_stream(FILE *stream, const char *path, size_t limit, char **bytes, size_t *size,
                        dpl_error *error) {
    size_t capacity = 0;
    for (;;) {
        if (*size + 1 >= capacity) {
            if (capacity > SIZE_MAX / 2)
                return dpl_error_set(error, "%s: out of memory", path);
            capacity = capacity ? capacity * 2 : 65536;
            char *grown = realloc(*bytes, capacity);
            if (!grown)
                return dpl_error_set(error, "%s: out of memory", path);
            *bytes = grown;
        }
        errno = 0;
        size_t got = fread(*bytes + *size, 1, capacity - *size - 1, stream);
        *size += got;
        if (*size > limit)
            return dpl_error_set(error, "%s: larger than %zu bytes", path, limit);
        if (ferror(stream))
            return fail_errno(error, path, errno ? errno : EIO);
        if (got == 0)
            break;
    }
    (*bytes)[*size] = 0;
    return true;
}

bool dpl_file_read(const char *path, size_t limit, char **bytes, size_t *size, dpl_error *error) {
    *bytes = NULL;
    *size = 0;
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail_errno(error, path, errno);
    bool good = read_stream(stream, path, limit, bytes, size, error);
    fclose(stream); /* only read from: nothing to lose */
    if (!good) {
        free(*bytes);
        *bytes = NULL;
        *size = 0;
    }
    return good;
}

/* ---- Names ---------------------------------------------------------------------------------------- */

static char *join(const char *head, size_t head_size, const char *tail) {
    size_t tail_size = strlen(tail);
    char *text = malloc(head_size + tail_size + 1);
    if (text) {
        memcpy(text, head, head_size);
        memcpy(text + head_size, tail, tail_size + 1);
    }
    return text;
}

/* Bytes of a path up to and with its last slash; 0 without one. */
static size_t folder_size(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Where the link at `path` points to, seen from where we are; NULL with errno set on failure. */
static char *follow_link(const char *path) {
    char target[LINK_LENGTH_LIMIT];
    ssize_t size = readlink(path, target, sizeof target);
    if (size < 0)
        return NULL;
    if ((size_t)size >= sizeof target) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    target[size] = 0;
    return join(path, target[0] == '/' ? 0 : folder_size(path), target);
}

/* The name behind all links, so that a link stays a link and its target is replaced. The target need not
 * exist. Malloc'ed; NULL with errno set on failure. */
static char *resolve_links(const char *path) {
    char *name = join(path, strlen(path), "");
    for (int links = 0; name; links++) {
        struct stat status;
        if (lstat(name, &status) != 0 || !S_ISLNK(status.st_mode))
            return name;
        char *next = NULL;
        if (links < LINK_LIMIT)
            next = follow_link(name);
        else
            errno = ELOOP;
        int number = errno;
        free(name);
        errno = number;
        name = next;
    }
    return NULL;
}

/* ---- Writing -------------------------------------------------------------------------------------- */

static void forget(dpl_file_writer *writer) {
    free(writer->path);
    free(writer->temporary_path);
    *writer = (dpl_file_writer){0};
}

/* Creates a file of a name nobody has beside the target, with the permissions the umask gives. Returns the
 * descriptor, or -1 with errno set; the name is in temporary_path either way once there is one. */
static int create_temporary(dpl_file_writer *writer) {
    size_t folder = folder_size(writer->path);
    for (int attempt = 0; attempt < TEMPORARY_LIMIT; attempt++) {
        char name[64];
        snprintf(name, sizeof name, ".dapple-%ld-%d.tmp", (long)getpid(), attempt);
        free(writer->temporary_path);
        writer->temporary_path = join(writer->path, folder, name);
        if (!writer->temporary_path) {
            errno = ENOMEM;
            return -1;
        }
        int descriptor = open(writer->temporary_path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0 || errno != EEXIST)
            return descriptor;
    }
    errno = EEXIST;
    return -1;
}

static bool fail_create(const dpl_file_writer *writer, const char *path, dpl_error *error) {
    int number = errno;
    size_t folder = folder_size(writer->path);
    if (number == ENOENT && folder > 0)
        return dpl_error_set(error, "%s: there is no folder %.*s", path, (int)folder - (folder > 1),
                             writer->path);
    return fail_errno(error, path, number);
}

/* `existing` is what the file to be replaced is, or NULL. The new file gets its permissions. */
static bool open_temporary(dpl_file_writer *writer, const char *path, const struct stat *existing,
                           dpl_error *error) {
    int descriptor = create_temporary(writer);
    if (descriptor < 0)
        return fail_create(writer, path, error);
    if (!existing || fchmod(descriptor, existing->st_mode & 0777) == 0)
        writer->stream = fdopen(descriptor, "wb");
    if (writer->stream)
        return true;
    fail_errno(error, path, errno);
    close(descriptor);
    unlink(writer->temporary_path);
    return false;
}

static bool open_directly(dpl_file_writer *writer, const char *path, dpl_error *error) {
    writer->stream = fopen(path, "wb");
    return writer->stream ? true : fail_errno(error, path, errno);
}

static bool open_target(dpl_file_writer *writer, const char *path, dpl_error *error) {
    struct stat status;
    bool exists = stat(path, &status) == 0;
    if (!exists && errno != ENOENT)
        return fail_errno(error, path, errno);
    if (exists && S_ISDIR(status.st_mode))
        return fail_errno(error, path, EISDIR);
    if (exists && !S_ISREG(status.st_mode))
        return open_directly(writer, path, error);
    /* A rename would replace a write-protected file without asking. */
    if (exists && access(path, W_OK) != 0)
        return fail_errno(error, path, errno);
    return open_temporary(writer, path, exists ? &status : NULL, error);
}

bool dpl_file_writer_open(dpl_file_writer *writer, const char *path, dpl_error *error) {
    *writer = (dpl_file_writer){0};
    bool standard_output = strcmp(path, "-") == 0;
    writer->path = standard_output ? join(path, 1, "") : resolve_links(path);
    if (!writer->path)
        return fail_errno(error, path, errno ? errno : ENOMEM);
    if (standard_output) {
        writer->stream = stdout;
        return true;
    }
    if (open_target(writer, path, error))
        return true;
    forget(writer);
    return false;
}

/* Everything out of our hands and, for a real file, on the disk. Returns 0 or an errno. A write that failed
 * earlier leaves its mark in the stream; its errno is what the flush meets again, or the last one known. */
static int flush(const dpl_file_writer *writer, int last_errno) {
    if (fflush(writer->stream) != 0)
        return errno;
    if (ferror(writer->stream))
        return last_errno ? last_errno : EIO;
    if (writer->temporary_path && fsync(fileno(writer->stream)) != 0)
        return errno;
    return 0;
}

bool dpl_file_writer_close(dpl_file_writer *writer, bool good, dpl_error *error) {
    if (!writer->stream)
        return false;
    int number = flush(writer, errno);
    if (writer->stream != stdout && fclose(writer->stream) != 0 && number == 0)
        number = errno;
    if (writer->temporary_path) {
        if (good && number == 0 && rename(writer->temporary_path, writer->path) != 0)
            number = errno;
        if (!good || number != 0)
            unlink(writer->temporary_path);
    }
    if (good && number != 0)
        fail_errno(error, strcmp(writer->path, "-") == 0 ? "standard output" : writer->path, number);
    forget(writer);
    return good && number == 0;
}

bool dpl_file_write(const char *path, const void *bytes, size_t size, dpl_error *error) {
    dpl_file_writer writer;
    if (!dpl_file_writer_open(&writer, path, error))
        return false;
    errno = 0;
    bool good = fwrite(bytes, 1, size, writer.stream) == size;
    if (!good)
        fail_errno(error, path, errno ? errno : EIO);
    return dpl_file_writer_close(&writer, good, error);
}
