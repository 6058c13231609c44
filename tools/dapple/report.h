/* Exit statuses, and the one line on standard error that goes with each failure. Used by every command. */
#ifndef DPL_TOOL_REPORT_H
#define DPL_TOOL_REPORT_H

#include <dapple/context.h>
#include <dapple/status.h>

enum {
    DPL_EXIT_DONE = 0,
    DPL_EXIT_FAILED = 1, /* the work failed */
    DPL_EXIT_USAGE = 2   /* wrong usage */
};

#if defined(__GNUC__)
#define DPL_REPORT_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define DPL_REPORT_PRINTF(text, first)
#endif

/* Prints "dapple: TEXT" and returns DPL_EXIT_FAILED. Control characters (from file names) are made visible,
 * so that one failure stays one line. */
DPL_REPORT_PRINTF(1, 2)
int dpl_report_failure(const char *format, ...);

/* The same from a status of the library: the context's message where it has one. `context` may be NULL. */
int dpl_report_status(const dpl_context *context, dpl_status status);

/* Prints "dapple COMMAND: TEXT (try 'dapple COMMAND --help')" and returns DPL_EXIT_USAGE. `command` NULL: of
 * no subcommand. */
DPL_REPORT_PRINTF(2, 3)
int dpl_report_usage(const char *command, const char *format, ...);

/* Prints "dapple: note: TEXT". Only for work that succeeded. */
DPL_REPORT_PRINTF(1, 2)
void dpl_report_note(const char *format, ...);

/* Flushes standard output: DPL_EXIT_DONE when everything printed has arrived, else reports. */
int dpl_report_finish_output(void);

#endif
