/* The text of the journal: its head and its lines. Called by journal.c. */
#ifndef DPL_STUDY_JOURNAL_LINE_H
#define DPL_STUDY_JOURNAL_LINE_H

#include "record.h"

/* Both head lines, malloc'ed: what the results depend on, and the columns. NULL when out of memory. */
char *dpl_study_journal_head(const dpl_study_plan *plan);

/* A record as a line with its end, malloc'ed. Numbers read back to the same bits. NULL when out of memory. */
char *dpl_study_journal_line(const dpl_study_scene_record *record);

/* Reads a line without its end. False when it is not one that dpl_study_journal_line() writes. */
bool dpl_study_journal_parse(const char *line, dpl_study_scene_record *record);

#endif
