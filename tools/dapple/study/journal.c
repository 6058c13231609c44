/* Opens, locks, trims and extends the journal. What its lines say is journal_line.c's. */
#define _POSIX_C_SOURCE 200809L
#include "journal.h"

#include "journal_line.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FILE_NAME "journal.csv"
/* A thousand seeds of fifty scenes at most: far below this. */
#define FILE_LIMIT ((off_t)1 << 30)

static bool fail(const dpl_study_journal *journal, dpl_error *error) {
    return dpl_error_set(error, "%s: %s", journal->path, strerror(errno));
}

static bool lock(const dpl_study_journal *journal, dpl_error *error) {
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(journal->file, F_SETLK, &whole) == 0)
        return true;
    if (errno == EACCES || errno == EAGAIN)
        return dpl_error_set(error, "%s: another study is at work in this folder", journal->path);
    return fail(journal, error);
}

static bool write_all(const dpl_study_journal *journal, const char *text, size_t size, dpl_error *error) {
    for (size_t written = 0; written < size;) {
        ssize_t count = write(journal->file, text + written, size - written);
        if (count < 0 && errno != EINTR)
            return fail(journal, error);
        if (count > 0)
            written += (size_t)count;
    }
    return fdatasync(journal->file) == 0 || errno == EINVAL || fail(journal, error);
}

/* The head of a fresh journal. */
static bool begin(const dpl_study_plan *plan, const dpl_study_journal *journal, dpl_error *error) {
    if (ftruncate(journal->file, 0) != 0)
        return fail(journal, error);
    char *head = dpl_study_journal_head(plan);
    if (!head)
        return dpl_error_set(error, "%s: out of memory", journal->path);
    bool good = write_all(journal, head, strlen(head), error);
    free(head);
    return good;
}

/* Is this the head that these arguments would write? An early end of it counts as well: then nothing was
 * done. */
static bool check_head(const dpl_study_journal *journal, const dpl_study_plan *plan, const char *text,
                       size_t size, size_t *head_size, dpl_error *error) {
    char *head = dpl_study_journal_head(plan);
    if (!head)
        return dpl_error_set(error, "%s: out of memory", journal->path);
    *head_size = strlen(head);
    bool same = memcmp(text, head, size < *head_size ? size : *head_size) == 0;
    size_t arguments = strcspn(head, "\n");
    if (!same)
        dpl_error_set(error,
                      "%s: belongs to a study with other arguments or of another build ('%.*s', not '%.*s'): "
                      "take another --out, "
                      "or remove it",
                      journal->path, (int)strcspn(text, "\n"), text, (int)arguments, head);
    free(head);
    return same;
}

/* Lines in the order of the plan, as far as they are whole. `kept` receives the bytes they take. */
static bool read_scenes(const dpl_study_plan *plan, const dpl_study_journal *journal, char *text,
                        size_t *kept, dpl_study_scene_record *records, int32_t *done, dpl_error *error) {
    for (char *line = text + *kept, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        *end = 0;
        int32_t k = *done;
        if (k >= dpl_study_scene_count(plan) || !dpl_study_journal_parse(line, &records[k]) ||
            records[k].seed != plan->first_seed + (uint64_t)(k / plan->scenes) ||
            records[k].index != k % plan->scenes)
            return dpl_error_set(error, "%s:%d: not a line of this study: mend or remove the file",
                                 journal->path, (int)k + 3);
        *done = k + 1;
        *kept = (size_t)(end + 1 - text);
    }
    return true;
}

/* Through our own descriptor: closing any other of the same file would give the lock away. */
static bool read_text(const dpl_study_journal *journal, char **text, size_t *size, dpl_error *error) {
    struct stat found;
    *size = 0;
    if (fstat(journal->file, &found) != 0)
        return fail(journal, error);
    if (!S_ISREG(found.st_mode) || found.st_size > FILE_LIMIT)
        return dpl_error_set(error, "%s: not a journal", journal->path);
    *text = malloc((size_t)found.st_size + 1);
    if (!*text)
        return dpl_error_set(error, "%s: out of memory", journal->path);
    while (*size < (size_t)found.st_size) {
        ssize_t count = pread(journal->file, *text + *size, (size_t)found.st_size - *size, (off_t)*size);
        if (count == 0)
            break;
        if (count > 0)
            *size += (size_t)count;
        else if (errno != EINTR) {
            free(*text);
            return fail(journal, error);
        }
    }
    (*text)[*size] = 0;
    return true;
}

static bool read_back(const dpl_study_plan *plan, const dpl_study_journal *journal,
                      dpl_study_scene_record *records, int32_t *done, dpl_error *error) {
    char *text = NULL;
    size_t size, kept = 0;
    *done = 0;
    if (!read_text(journal, &text, &size, error))
        return false;
    bool good = check_head(journal, plan, text, size, &kept, error);
    bool fresh = good && size < kept;
    if (good && !fresh)
        good = read_scenes(plan, journal, text, &kept, records, done, error);
    free(text);
    if (!good)
        return false;
    if (fresh)
        return begin(plan, journal, error);
    return ftruncate(journal->file, (off_t)kept) == 0 || fail(journal, error);
}

bool dpl_study_journal_open(const dpl_study_plan *plan, dpl_study_journal *journal,
                            dpl_study_scene_record *records, int32_t *done, dpl_error *error) {
    size_t length = strlen(plan->folder) + sizeof "/" FILE_NAME;
    journal->path = malloc(length);
    if (!journal->path)
        return dpl_error_set(error, "%s: out of memory", plan->folder);
    snprintf(journal->path, length, "%s/" FILE_NAME, plan->folder);
    journal->file = open(journal->path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (journal->file < 0)
        return fail(journal, error);
    journal->open = true;
    return lock(journal, error) && read_back(plan, journal, records, done, error);
}

bool dpl_study_journal_append(dpl_study_journal *journal, const dpl_study_scene_record *record,
                              dpl_error *error) {
    char *line = dpl_study_journal_line(record);
    if (!line)
        return dpl_error_set(error, "%s: out of memory", journal->path);
    bool good = write_all(journal, line, strlen(line), error);
    free(line);
    return good;
}

void dpl_study_journal_close(dpl_study_journal *journal) {
    if (journal->open)
        close(journal->file);
    free(journal->path);
    memset(journal, 0, sizeof *journal);
}
