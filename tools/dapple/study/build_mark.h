/* Which build this is, for the journal: results of two builds may differ in their last digits and must not
 * mix. */
#ifndef DPL_STUDY_BUILD_MARK_H
#define DPL_STUDY_BUILD_MARK_H

#include <stdint.h>

/* A hash of the running program's file; 0 where the system does not show it. */
uint64_t dpl_study_build_mark(void);

#endif
