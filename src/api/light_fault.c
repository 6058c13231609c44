/* See light_fault.h. */
#include "api/light_fault.h"

#include <math.h>

static const char *fault_of(const dpl_light *light) {
    for (int k = 0; k < 2; k++)
        if (!(fabs(light->position[k]) <= DPL_MAX_LIGHT_COORDINATE))
            return "the position must be finite and within 1e6";
    if (!(light->radius >= 0.0 && light->radius <= DPL_MAX_LIGHT_COORDINATE))
        return "the radius must be 0 .. 1e6";
    for (int c = 0; c < 3; c++)
        if (!(light->color[c] >= 0.0f && light->color[c] <= 3e38f))
            return "the colour must be finite and not negative";
    if (!(light->intensity >= 0.0f && light->intensity <= 3e38f))
        return "the intensity must be finite and not negative";
    return NULL;
}

dpl_status dpl_lights_check(dpl_context *context, const dpl_light *lights, int32_t count) {
    for (int32_t i = 0; i < count; i++) {
        const char *fault = fault_of(&lights[i]);
        if (fault)
            return dpl_fail(context, DPL_ERROR_ARGUMENT, "light %d: %s", i, fault);
    }
    return DPL_OK;
}
