/* Where lamps are, coarsely. Used by the survey of --skip bounded: where a cone cannot see a lamp, all that
 * its rays hit is black. */
#ifndef DPL_CASCADE_LAMPS_H
#define DPL_CASCADE_LAMPS_H

#include "cascade/survey.h"

DPL_MUST_CHECK dpl_status dpl_lamps_plan(dpl_survey *survey, dpl_context *context,
                                         const dpl_schedule *schedule);

/* Fills survey->lamps from the field's opaque pixels. */
DPL_MUST_CHECK dpl_status dpl_lamps_measure(dpl_survey *survey, dpl_context *context, const dpl_field *field);

#endif
