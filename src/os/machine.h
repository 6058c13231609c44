/* What the machine is and what time it is. Used by src/api/ and the solvers. */
#ifndef DPL_OS_MACHINE_H
#define DPL_OS_MACHINE_H

#include <stdint.h>

/* Processors that may run threads now, at least 1. */
int32_t dpl_processor_count(void);

/* Union of dpl_isa bits that this processor can run, always with DPL_ISA_SCALAR. */
uint32_t dpl_machine_isa(void);

/* Monotonic wall time [ms]. */
double dpl_clock_ms(void);

#endif
