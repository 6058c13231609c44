/* Records to text and back. */
#include "journal_line.h"

#include "build_mark.h"

#include <dapple/version.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Raised when lines change their meaning. */
#define FORMAT_VERSION 1
/* Room for any number, or for the longest name of a column, and a comma. */
#define CELL_SIZE 64

/* A text that grows cell by cell, in room that is known to be enough. */
typedef struct cell_writer {
    char *text;
    size_t used;
    size_t size;
} cell_writer;

static void put(cell_writer *writer, const char *cell) {
    writer->used += (size_t)snprintf(writer->text + writer->used, writer->size - writer->used, "%s%s",
                                     writer->used ? "," : "", cell);
}

static bool put_name(const char *where, const dpl_study_record_field *field, void *value, void *user) {
    char cell[CELL_SIZE];
    (void)value;
    snprintf(cell, sizeof cell, "%s%s", where, field->name);
    put(user, cell);
    return true;
}

static bool put_number(const char *where, const dpl_study_record_field *field, void *value, void *user) {
    char cell[CELL_SIZE] = "";
    (void)where;
    switch (field->kind) {
    case DPL_STUDY_INT32:
        snprintf(cell, sizeof cell, "%" PRId32, *(int32_t *)value);
        break;
    case DPL_STUDY_INT64:
        snprintf(cell, sizeof cell, "%" PRId64, *(int64_t *)value);
        break;
    case DPL_STUDY_UINT64:
        snprintf(cell, sizeof cell, "%" PRIu64, *(uint64_t *)value);
        break;
    case DPL_STUDY_DOUBLE:
        snprintf(cell, sizeof cell, "%.17g", *(double *)value);
        break;
    }
    put(user, cell);
    return true;
}

static bool create_line(cell_writer *writer) {
    writer->used = 0;
    writer->size = (size_t)dpl_study_record_size() * CELL_SIZE + 2;
    writer->text = malloc(writer->size);
    return writer->text != NULL;
}

char *dpl_study_journal_head(const dpl_study_plan *plan) {
    char arguments[160];
    cell_writer columns;
    dpl_study_scene_record nothing = {0};
    snprintf(arguments, sizeof arguments,
             "# dapple %s build %016" PRIx64 " study %d: --first-seed %" PRIu64
             " --seeds %d --scenes %d --size %d --truth %d",
             dpl_version(), dpl_study_build_mark(), FORMAT_VERSION, plan->first_seed, (int)plan->seeds,
             (int)plan->scenes, (int)plan->size, (int)plan->truth);
    if (!create_line(&columns))
        return NULL;
    dpl_study_record_each(&nothing, put_name, &columns);
    size_t size = strlen(arguments) + columns.used + 3;
    char *head = malloc(size);
    if (head)
        snprintf(head, size, "%s\n%s\n", arguments, columns.text);
    free(columns.text);
    return head;
}

char *dpl_study_journal_line(const dpl_study_scene_record *record) {
    cell_writer writer;
    dpl_study_scene_record copy = *record;
    if (!create_line(&writer))
        return NULL;
    dpl_study_record_each(&copy, put_number, &writer);
    memcpy(writer.text + writer.used, "\n", 2);
    return writer.text;
}

static bool read_number(const dpl_study_record_field *field, const char *text, char **end, void *value) {
    errno = 0;
    if (field->kind == DPL_STUDY_DOUBLE) {
        *(double *)value = strtod(text, end);
        return *end != text && !isnan(*(double *)value);
    }
    if (field->kind == DPL_STUDY_UINT64) {
        *(uint64_t *)value = strtoull(text, end, 10);
        return *end != text && !errno;
    }
    long long number = strtoll(text, end, 10);
    if (*end == text || errno)
        return false;
    if (field->kind == DPL_STUDY_INT64)
        *(int64_t *)value = number;
    else if (number >= INT32_MIN && number <= INT32_MAX)
        *(int32_t *)value = (int32_t)number;
    else
        return false;
    return true;
}

/* `user` points to the text that is left to read. */
static bool take_number(const char *where, const dpl_study_record_field *field, void *value, void *user) {
    const char **text = user;
    char *end;
    (void)where;
    if (!*text || !read_number(field, *text, &end, value) || (*end != ',' && *end != 0))
        return false;
    *text = *end ? end + 1 : NULL;
    return true;
}

/* Numbers that are used as indices later. */
static bool is_sound(const dpl_study_scene_record *record) {
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        for (int m = 0; m < DPL_STUDY_MODES; m++) {
            const dpl_study_mode_record *mode = &record->profiles[p].modes[m];
            if (mode->used < 0 || mode->used >= DPL_STUDY_MODES || mode->full <= 0)
                return false;
        }
    return true;
}

bool dpl_study_journal_parse(const char *line, dpl_study_scene_record *record) {
    memset(record, 0, sizeof *record);
    return dpl_study_record_each(record, take_number, &line) && !line && is_sound(record);
}
