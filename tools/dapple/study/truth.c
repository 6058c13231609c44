/* Picks pixels and traces them. */
#include "truth.h"

#include "scenes/random.h"

#include <dapple/tonemap.h>
#include <stdlib.h>
#include <string.h>

/* Keeps these random numbers apart from those that scenes are made of. */
#define STREAM_TRUTH ((uint64_t)0x7472757468 << 16)

dpl_status dpl_study_truth_create(dpl_context *context, const dpl_study_plan *plan,
                                  dpl_progress_function progress, void *user, dpl_study_truth *truth) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = DPL_STUDY_TRUTH_DIRECTIONS;
    desc.progress = progress;
    desc.progress_user = user;
    size_t count = (size_t)plan->truth, all = (size_t)plan->size * (size_t)plan->size;
    truth->capacity = plan->truth;
    truth->pixels = malloc(count * sizeof *truth->pixels);
    truth->rgb = malloc(count * sizeof *truth->rgb);
    truth->display = malloc(count * 3);
    truth->free_pixels = malloc(all * sizeof *truth->free_pixels);
    if (!truth->pixels || !truth->rgb || !truth->display || !truth->free_pixels)
        return DPL_ERROR_MEMORY;
    return dpl_solver_create(context, &desc, &truth->solver);
}

void dpl_study_truth_destroy(dpl_study_truth *truth) {
    dpl_solver_destroy(truth->solver);
    free(truth->pixels);
    free(truth->rgb);
    free(truth->display);
    free(truth->free_pixels);
    memset(truth, 0, sizeof *truth);
}

/* The first cards of a shuffled deck: no pixel twice, each equally likely. */
static void pick_pixels(dpl_study_truth *truth, const uint8_t *opaque, int32_t size, uint64_t seed,
                        int32_t index) {
    int32_t *deck = truth->free_pixels, cards = 0;
    for (int32_t i = 0; i < size * size; i++)
        if (!opaque[i])
            deck[cards++] = i;
    dpl_random random = dpl_random_start(seed, STREAM_TRUTH + (uint64_t)index);
    truth->count = cards < truth->capacity ? cards : truth->capacity;
    for (int32_t i = 0; i < truth->count; i++) {
        int32_t other = i + dpl_random_below(&random, cards - i), pixel = deck[other];
        deck[other] = deck[i];
        truth->pixels[i][0] = pixel % size;
        truth->pixels[i][1] = pixel / size;
    }
}

dpl_status dpl_study_tonemap_values(dpl_context *context, const float (*values)[3], int32_t count,
                                    uint8_t *display) {
    const dpl_pixels pixels = {
        .data = values, .format = DPL_FORMAT_F32, .width = 1, .height = count, .channels = 3};
    return dpl_tonemap(context, &pixels, display, 0);
}

dpl_status dpl_study_truth_trace(dpl_study_truth *truth, dpl_context *context, dpl_field *field,
                                 const uint8_t *opaque, int32_t size, uint64_t seed, int32_t index) {
    pick_pixels(truth, opaque, size, seed, index);
    if (truth->count == 0)
        return DPL_ERROR_SIZE;
    dpl_status status = dpl_reference_solve_pixels(truth->solver, field, (const int32_t(*)[2])truth->pixels,
                                                   truth->count, truth->rgb);
    if (status != DPL_OK)
        return status;
    return dpl_study_tonemap_values(context, (const float(*)[3])truth->rgb, truth->count, truth->display);
}

void dpl_study_truth_gather(const dpl_study_truth *truth, const float *picture, int32_t size,
                            float (*values)[3]) {
    for (int32_t i = 0; i < truth->count; i++) {
        size_t pixel = (size_t)truth->pixels[i][1] * (size_t)size + (size_t)truth->pixels[i][0];
        memcpy(values[i], picture + 3 * pixel, sizeof values[i]);
    }
}
