/* Making and ending a context: the one place that knows every room it is wired from. */
#include "base/context.h"

#include "base/desc.h"
#include "job/jobs.h"
#include "kernel/kernel.h"
#include "os/machine.h"
#include "os/memory.h"

static dpl_status check_desc(const dpl_context_desc *desc) {
    if (!DPL_DESC_IS_GOOD(desc))
        return DPL_ERROR_DESC;
    if (desc->thread_count < 0 || desc->thread_count > DPL_MAX_THREADS)
        return DPL_ERROR_ARGUMENT;
    if (!desc->allocator.allocate != !desc->allocator.release)
        return DPL_ERROR_ARGUMENT;
    if (!desc->tasks.enqueue != !desc->tasks.finish)
        return DPL_ERROR_ARGUMENT;
    return DPL_OK;
}

static int32_t worker_count(const dpl_context_desc *desc) {
    if (desc->thread_count > 0)
        return desc->thread_count;
    return desc->tasks.enqueue ? 1 : dpl_processor_count();
}

dpl_status dpl_context_create(const dpl_context_desc *desc, dpl_context **out) {
    if (!out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    dpl_context_desc defaults = dpl_context_desc_default();
    if (!desc)
        desc = &defaults;
    DPL_TRY(check_desc(desc));
    const dpl_kernels *kernels = dpl_kernels_select(desc->isa_mask);
    if (!kernels)
        return DPL_ERROR_UNAVAILABLE;
    /* The context itself is not in the context's books, so it is made and freed by hand. */
    dpl_allocator allocator = desc->allocator.allocate ? desc->allocator : dpl_allocator_default();
    dpl_context *context = allocator.allocate(sizeof *context, 64, allocator.user);
    if (!context)
        return DPL_ERROR_MEMORY;
    memset(context, 0, sizeof *context);
    context->allocator = allocator;
    context->log = desc->log;
    context->log_user = desc->log_user;
    context->kernels = kernels;
    dpl_status status = dpl_jobs_create(context, worker_count(desc), &desc->tasks, &context->jobs);
    if (status == DPL_OK)
        *out = context;
    else
        dpl_context_destroy(context);
    return status;
}

void dpl_context_destroy(dpl_context *context) {
    if (!context)
        return;
    dpl_jobs_destroy(context, context->jobs);
    context->allocator.release(context, sizeof *context, context->allocator.user);
}

const char *dpl_context_message(const dpl_context *context) {
    return context->message;
}

int32_t dpl_context_thread_count(const dpl_context *context) {
    return dpl_jobs_worker_count(context->jobs);
}

dpl_isa dpl_context_isa(const dpl_context *context) {
    return context->kernels->isa;
}

uint32_t dpl_isa_available(void) {
    return dpl_kernels_available();
}

const char *dpl_isa_name(dpl_isa isa) {
    switch (isa) {
    case DPL_ISA_SCALAR:
        return "scalar";
    case DPL_ISA_SSE2:
        return "sse2";
    case DPL_ISA_AVX2:
        return "avx2";
    case DPL_ISA_AVX512:
        return "avx512";
    case DPL_ISA_SIMD128:
        return "simd128";
    default:
        return "?";
    }
}
