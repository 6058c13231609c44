/* Picks a kernel table: best instruction set first. */
#include "kernel/kernel.h"

#include "os/machine.h"

#if defined(DPL_HAVE_X86_KERNELS)
extern const dpl_kernels dpl_kernels_avx512, dpl_kernels_avx2, dpl_kernels_sse2;
#elif defined(DPL_HAVE_WASM_KERNELS)
extern const dpl_kernels dpl_kernels_simd128;
#endif

static const dpl_kernels *const tables[] = {
#if defined(DPL_HAVE_X86_KERNELS)
    &dpl_kernels_avx512, &dpl_kernels_avx2, &dpl_kernels_sse2,
#endif
#if defined(DPL_HAVE_WASM_KERNELS)
    &dpl_kernels_simd128, /* alone: the whole module needs simd128, and pages load what is in it */
#else
    &dpl_kernels_ref,
#endif
};

enum { TABLE_COUNT = sizeof tables / sizeof tables[0] };

const dpl_kernels *dpl_kernels_select(uint32_t isa_mask) {
    uint32_t usable = isa_mask & dpl_machine_isa();
    for (int i = 0; i < TABLE_COUNT; i++)
        if (usable & (uint32_t)tables[i]->isa)
            return tables[i];
    return NULL;
}

uint32_t dpl_kernels_available(void) {
    uint32_t built = 0;
    for (int i = 0; i < TABLE_COUNT; i++)
        built |= (uint32_t)tables[i]->isa;
    return built & dpl_machine_isa();
}
