/* Checks of the pictures that callers hand in to be written. Used by the rooms' public faces in this folder.
 */
#ifndef DPL_API_OUTPUT_FAULT_H
#define DPL_API_OUTPUT_FAULT_H

#include "base/context.h"

#include <dapple/image.h>

/* What a writer can do with an output. */
typedef struct dpl_output_rules {
    int32_t width; /* that it must have [px] */
    int32_t height;
    const char *owner; /* whose size that is, for the message */
    bool halves;       /* DPL_FORMAT_F16 as well as DPL_FORMAT_F32 */
} dpl_output_rules;

/* Fails with a message when the output cannot be written; a stride of 0 becomes that of packed rows. */
DPL_MUST_CHECK dpl_status dpl_output_check(dpl_context *context, const dpl_output_rules *rules,
                                           dpl_output *output);

#endif
