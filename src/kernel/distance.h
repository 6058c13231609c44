/* What the kernel `distance_along` works on. Filled in by src/field/distance.c. */
#ifndef DPL_KERNEL_DISTANCE_H
#define DPL_KERNEL_DISTANCE_H

#include <stddef.h>
#include <stdint.h>

/* A band of rows of a picture, from the top down. Planes have height*width entries. */
typedef struct dpl_distance_rows {
    int32_t width;
    int32_t height;
    int32_t nowhere;     /* a column distance from which on the column has no occupied pixel */
    const uint8_t *kind; /* 0: empty, 2: opaque; occupied is what is not 0 */
    const int32_t *runs; /* distance to the nearest occupied pixel of the column, 0 there [px] */
    float *clearance;    /* the result, as dpl_grid has it; may be the memory of `runs` */
} dpl_distance_rows;

/* Bytes that the kernel wants to itself: three rows of numbers; in a narrow picture the vectors' pads. */
static inline size_t dpl_distance_scratch(int32_t width) {
    return (3 * (size_t)width + 320) * sizeof(int32_t);
}

#endif
