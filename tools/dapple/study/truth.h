/* The truth of a scene at seeded pixels: brute force on the pixel world, shared by both profiles. Used by
 * stage.c and scene_run.c. */
#ifndef DPL_STUDY_TRUTH_H
#define DPL_STUDY_TRUTH_H

#include "plan.h"

#include <dapple/context.h>
#include <stdbool.h>
#include <stdint.h>

/* Buffers and solver of the truth, made once for a study. Zero-initialise. */
typedef struct dpl_study_truth {
    dpl_solver *solver;
    int32_t capacity; /* pixels asked for */
    int32_t count;    /* pixels there are: the free ones, if those are fewer */
    int32_t (*pixels)[2];
    float (*rgb)[3];      /* the truth at them */
    uint8_t *display;     /* the same after the tone map, 3 bytes each */
    int32_t *free_pixels; /* scratch: all free pixels of the scene */
} dpl_study_truth;

dpl_status dpl_study_truth_create(dpl_context *context, const dpl_study_plan *plan,
                                  dpl_progress_function progress, void *user, dpl_study_truth *truth);

void dpl_study_truth_destroy(dpl_study_truth *truth);

/* Picks the pixels among those that `opaque` (size x size) leaves free, by scene seed and index, and traces
 * them in the pixel world of `field`. DPL_ERROR_SIZE when no pixel is free. */
dpl_status dpl_study_truth_trace(dpl_study_truth *truth, dpl_context *context, dpl_field *field,
                                 const uint8_t *opaque, int32_t size, uint64_t seed, int32_t index);

/* Copies a picture's values at the truth's pixels, shape [count][3]. */
void dpl_study_truth_gather(const dpl_study_truth *truth, const float *picture, int32_t size,
                            float (*values)[3]);

/* Tone-maps `count` RGB values into 3 bytes each. */
dpl_status dpl_study_tonemap_values(dpl_context *context, const float (*values)[3], int32_t count,
                                    uint8_t *display);

#endif
