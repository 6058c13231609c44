/* What a WebAssembly module is compiled for, and the time, which its host tells: dpl_web_now() is an import
 * of the module (web/wasm/host.h). */
#include "os/machine.h"

#include <dapple/context.h>

double dpl_web_now(void);

int32_t dpl_processor_count(void) {
    return 1; /* more come as task hooks */
}

uint32_t dpl_machine_isa(void) {
#if defined(__wasm_simd128__)
    return DPL_ISA_SCALAR | DPL_ISA_SIMD128;
#else
    return DPL_ISA_SCALAR;
#endif
}

double dpl_clock_ms(void) {
    return dpl_web_now();
}
