/* Checks of the lights that callers hand in. Used by shadow.c and solver.c of this folder. */
#ifndef DPL_API_LIGHT_FAULT_H
#define DPL_API_LIGHT_FAULT_H

#include "base/context.h"

#include <dapple/light.h>

/* Fails with a message that names the first bad one of `count` lights. */
DPL_MUST_CHECK dpl_status dpl_lights_check(dpl_context *context, const dpl_light *lights, int32_t count);

#endif
