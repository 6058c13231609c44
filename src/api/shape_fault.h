/* Checks of shapes and colours, the same for everything that takes them. Used by field.c and tracer.c. */
#ifndef DPL_API_SHAPE_FAULT_H
#define DPL_API_SHAPE_FAULT_H

#include <dapple/shape.h>
#include <stdbool.h>

/* Finite for every purpose, with room to sum a few. */
#define HIGHEST_RADIANCE 3e38f

/* Are all three channels within 0 .. highest? */
static inline bool colour_is_good(const float rgb[3], float highest) {
    for (int c = 0; c < 3; c++)
        if (!(rgb[c] >= 0.0f && rgb[c] <= highest))
            return false;
    return true;
}

/* What is wrong with a shape, or NULL. */
const char *dpl_shape_fault(const dpl_shape *shape);

#endif
