/* What the study has of the command line tool, as a page has it: the clock, the wish to stop, the bar,
 * errors. Stands in for tools/dapple/{clock,interrupt,progress,report}.c. */
#include "host.h"

#include "tools/dapple/clock.h"
#include "tools/dapple/interrupt.h"
#include "tools/dapple/progress.h"
#include "tools/dapple/report.h"

#include <stdarg.h>
#include <stdio.h>

double dpl_tool_clock_ms(void) {
    return dpl_web_now();
}

/* A share below 0 asks without telling. */
int dpl_interrupt_status(void) {
    return dpl_web_progress(-1.0) ? 0 : DPL_EXIT_FAILED;
}

void dpl_progress_begin(dpl_progress *progress) {
    *progress = (dpl_progress){.start_ms = dpl_web_now()};
}

void dpl_progress_update(dpl_progress *progress, double done) {
    (void)progress;
    (void)dpl_web_progress(done);
}

int dpl_report_failure(const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    dpl_web_report(text);
    return DPL_EXIT_FAILED;
}

int dpl_report_status(const dpl_context *context, dpl_status status) {
    const char *message = context ? dpl_context_message(context) : "";
    return dpl_report_failure("%s", message[0] ? message : dpl_status_text(status));
}
