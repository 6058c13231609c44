/* What the module asks of its host: imports that web/module/core.js gives. */
#ifndef DPL_WEB_HOST_H
#define DPL_WEB_HOST_H

#include <stdint.h>

/* Monotonic time [ms]. */
double dpl_web_now(void);

/* How far the work has come, 0 .. 1. Returns 0 when it is to stop. */
int32_t dpl_web_progress(double done);

/* Keeps a text for the exception that follows. */
void dpl_web_report(const char *text);

/* One number of a study's record; its name is "WHERE" and "NAME" put together. */
void dpl_web_number(const char *where, const char *name, double value);

/* Between threads: sleeps while *place is `value`; wakes everyone who sleeps on it. */
void dpl_web_wait(const void *place, int32_t value);
void dpl_web_wake(const void *place);

#endif
