/* A cascade schedule as a table or as JSON: `info --schedule`. */
#ifndef DPL_TOOL_SCHEDULE_REPORT_H
#define DPL_TOOL_SCHEDULE_REPORT_H

#include <dapple/schedule.h>
#include <stdbool.h>

/* Computes and prints the schedule for a picture of width x height. Returns an exit status. */
int dpl_schedule_report(const dpl_cascades_desc *desc, int32_t width, int32_t height, bool json);

#endif
