/* Times every case on every instruction set of this machine. Called by test_kernel_cases.c. */
#ifndef DPL_TEST_KERNEL_TIMING_H
#define DPL_TEST_KERNEL_TIMING_H

#include "kernel/cases.h"

/* Writes kernels.csv and kernels.md into the folder; returns an exit status. A NULL folder: by machine. */
int dpl_kernel_timing_run(int32_t rounds, const char *folder);

#endif
