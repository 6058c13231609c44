/* Wall time for stopwatches and the progress bar. */
#ifndef DPL_TOOL_CLOCK_H
#define DPL_TOOL_CLOCK_H

/* Monotonic time since some fixed moment [ms]. */
double dpl_tool_clock_ms(void);

#endif
