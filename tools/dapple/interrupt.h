/* Ctrl-C (SIGINT) and SIGTERM as something to ask for, so that long work ends cleanly. Used by render. */
#ifndef DPL_TOOL_INTERRUPT_H
#define DPL_TOOL_INTERRUPT_H

/* From now on the first such signal is only remembered; a second one ends the program at once. */
void dpl_interrupt_catch(void);

/* 0, or the exit status of a program ended by the signal that came: 128 + its number. */
int dpl_interrupt_status(void);

#endif
