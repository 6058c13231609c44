/* Ctrl-C (SIGINT) and SIGTERM as something to ask for, so that long work ends cleanly. Used by render. */
#ifndef DPL_TOOL_INTERRUPT_H
#define DPL_TOOL_INTERRUPT_H

/* From now on such signals are only remembered: the first one counts. A second does not end the program at
 * once, because some senders (timeout, a terminal and a shell together) send two, and files would be left
 * behind. */
void dpl_interrupt_catch(void);

/* 0, or the exit status of a program ended by the signal that came: 128 + its number. */
int dpl_interrupt_status(void);

#endif
