/* The journal of a study: a line for each finished scene, written as soon as it is there, and read again when
 * the same study goes on. Also holds times, so it alone (with times.*) differs from run to run.
 *
 * Line 1 names the arguments, line 2 the columns. A line without its end is of a scene that was not finished
 * and is dropped. Called by study.c. */
#ifndef DPL_STUDY_JOURNAL_H
#define DPL_STUDY_JOURNAL_H

#include "record.h"

#include "image/error.h"

/* Zero-initialise. */
typedef struct dpl_study_journal {
    char *path;
    int file; /* descriptor, locked against a second study in the same folder */
    bool open;
} dpl_study_journal;

/* Opens the journal in the plan's folder (made before) and reads the scenes that are there into `records`
 * (room for all); `done` receives how many. Fails when it belongs to other arguments, is broken, or another
 * study is writing it. */
bool dpl_study_journal_open(const dpl_study_plan *plan, dpl_study_journal *journal,
                            dpl_study_scene_record *records, int32_t *done, dpl_error *error);

/* Appends a scene, and returns once it is on the disk. */
bool dpl_study_journal_append(dpl_study_journal *journal, const dpl_study_scene_record *record,
                              dpl_error *error);

void dpl_study_journal_close(dpl_study_journal *journal);

#endif
