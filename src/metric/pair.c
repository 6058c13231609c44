/* Checking and loading the two pictures of a comparison. Called by compare.c; the rest reads the pair. */
#include "metric/pair.h"

#include "job/jobs.h"
#include "metric/display.h"
#include "metric/view.h"

#include <math.h>

/* More than any display: keeps FLIP's filters, whose radius grows with it, at a finite size. */
#define PIXELS_PER_DEGREE_MAX 10000.0

static const char *const picture_names[DPL_PAIR_COUNT] = {"test picture", "reference picture"};

bool dpl_pair_is_free(const dpl_pair *pair, int32_t x, int32_t y) {
    return !pair->mask || pair->mask[y * pair->mask_stride + x] == 0;
}

const uint8_t *dpl_pair_display_row(const dpl_pair *pair, int picture, int32_t y) {
    return pair->display[picture] + (size_t)y * (size_t)pair->width * 3;
}

static dpl_status check_options(dpl_context *context, const dpl_metrics_desc *desc) {
    if (!(desc->pixels_per_degree > 0.0 && desc->pixels_per_degree <= PIXELS_PER_DEGREE_MAX))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "pixels_per_degree is %g, not within 0 .. %g",
                        desc->pixels_per_degree, PIXELS_PER_DEGREE_MAX);
    if (desc->display_referred != 0 && desc->display_referred != 1)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "display_referred is %d, not 0 or 1",
                        desc->display_referred);
    return DPL_OK;
}

static dpl_status check_pictures(dpl_context *context, const dpl_pair *pair) {
    const dpl_pixels *test = &pair->pixels[DPL_PAIR_TEST];
    const dpl_pixels *reference = &pair->pixels[DPL_PAIR_REFERENCE];
    DPL_TRY(dpl_view_check(context, picture_names[DPL_PAIR_TEST], test, DPL_ERROR_SIZE));
    DPL_TRY(dpl_view_check(context, picture_names[DPL_PAIR_REFERENCE], reference, DPL_ERROR_SIZE));
    if (test->width != reference->width || test->height != reference->height)
        return dpl_fail(context, DPL_ERROR_SIZE, "the test picture is %d x %d, the reference %d x %d",
                        test->width, test->height, reference->width, reference->height);
    if (pair->mask && !dpl_stride_holds(pair->mask_stride, pair->width))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "mask_stride %td is shorter than a row of %d bytes",
                        pair->mask_stride, pair->width);
    return DPL_OK;
}

static bool pixel_is_finite(const float *pixel) {
    return isfinite(pixel[0]) && isfinite(pixel[1]) && isfinite(pixel[2]);
}

/* Masked pixels too: what a solver wrote there is still a defect. */
static dpl_status check_finite(dpl_context *context, const dpl_pair *pair, int picture) {
    const dpl_pixels *pixels = &pair->pixels[picture];
    for (int32_t y = 0; y < pair->height; y++) {
        const float *row = dpl_view_row(pixels, y);
        for (int32_t x = 0; x < pair->width; x++)
            if (!pixel_is_finite(row + (ptrdiff_t)x * pixels->channels))
                return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: not finite at pixel (%d, %d)",
                                picture_names[picture], x, y);
    }
    return DPL_OK;
}

static int64_t count_free_pixels(const dpl_pair *pair) {
    int64_t count = 0;
    for (int32_t y = 0; y < pair->height; y++)
        for (int32_t x = 0; x < pair->width; x++)
            count += dpl_pair_is_free(pair, x, y);
    return count;
}

typedef struct load_work {
    const dpl_pair *pair;
    const dpl_kernels *kernels;
} load_work;

static uint8_t *load_row(const load_work *work, int picture, int32_t y) {
    const dpl_pair *pair = work->pair;
    const dpl_pixels *pixels = &pair->pixels[picture];
    uint8_t *rgb = pair->display[picture] + (size_t)y * (size_t)pair->width * 3;
    if (pair->display_referred)
        dpl_quantise_row(dpl_view_row(pixels, y), pixels->channels, pair->width, rgb);
    else
        dpl_tonemap_row(work->kernels, dpl_view_row(pixels, y), pixels->channels, pair->width, rgb);
    return rgb;
}

static void load_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const load_work *work = task;
    const dpl_pair *pair = work->pair;
    for (int32_t y = begin; y < end; y++) {
        uint8_t *test = load_row(work, DPL_PAIR_TEST, y);
        const uint8_t *reference = load_row(work, DPL_PAIR_REFERENCE, y);
        for (int32_t x = 0; x < pair->width; x++)
            if (!dpl_pair_is_free(pair, x, y))
                memcpy(test + 3 * x, reference + 3 * x, 3);
    }
}

static dpl_status load_displays(dpl_context *context, dpl_pair *pair) {
    const size_t bytes = (size_t)pair->width * (size_t)pair->height * 3;
    DPL_TRY(dpl_buffer_reserve(context, &pair->memory, DPL_PAIR_COUNT, bytes));
    for (int picture = 0; picture < DPL_PAIR_COUNT; picture++)
        pair->display[picture] = (uint8_t *)pair->memory.data + (size_t)picture * bytes;
    load_work work = {pair, context->kernels};
    dpl_status status = dpl_jobs_run(context, load_rows, pair->height, 1, &work);
    if (status != DPL_OK)
        dpl_pair_close(context, pair);
    return status;
}

dpl_status dpl_pair_open(dpl_context *context, const dpl_metrics_desc *desc, dpl_pair *pair) {
    *pair = (dpl_pair){
        .width = desc->test.width,
        .height = desc->test.height,
        .pixels = {[DPL_PAIR_TEST] = desc->test, [DPL_PAIR_REFERENCE] = desc->reference},
        .mask = desc->mask,
        .mask_stride = dpl_stride_or_tight(desc->mask_stride, desc->test.width),
        .display_referred = desc->display_referred != 0,
        .pixels_per_degree = desc->pixels_per_degree,
    };
    DPL_TRY(check_options(context, desc));
    DPL_TRY(check_pictures(context, pair));
    DPL_TRY(check_finite(context, pair, DPL_PAIR_TEST));
    DPL_TRY(check_finite(context, pair, DPL_PAIR_REFERENCE));
    pair->free_pixels = count_free_pixels(pair);
    if (pair->free_pixels == 0)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "every pixel is masked");
    return load_displays(context, pair);
}

void dpl_pair_close(dpl_context *context, dpl_pair *pair) {
    dpl_buffer_free(context, &pair->memory);
}
