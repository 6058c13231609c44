/* Metrics: closed forms, numbers from an independent program, masks, layouts, thread counts. */
#include "testing.h"

#include <dapple/dapple.h>

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* ---- pictures to compare -------------------------------------------------------------------------- */

enum { WIDTH = 40, HEIGHT = 30, BLOCK = 8, VALUES = WIDTH * HEIGHT * 3 };

/* Blocks of colour under noise, and the same with more noise. */
typedef struct pair {
    float test[VALUES];
    float reference[VALUES];
} pair;

static float next_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static void fill_pair(pair *p) {
    enum { ACROSS = WIDTH / BLOCK, DOWN = HEIGHT / BLOCK + 1 };
    uint32_t state = 1;
    float blocks[DOWN * ACROSS * 3];
    for (int i = 0; i < DOWN * ACROSS * 3; i++)
        blocks[i] = next_random(&state);
    for (int i = 0; i < VALUES; i++) {
        const int c = i % 3, x = i / 3 % WIDTH, y = i / 3 / WIDTH;
        const float block = blocks[(y / BLOCK * ACROSS + x / BLOCK) * 3 + c];
        p->reference[i] = 0.75f * block + 0.25f * next_random(&state);
        p->test[i] = 0.75f * p->reference[i] + 0.25f * next_random(&state);
    }
}

/* Masks a box inside the picture. */
static void fill_mask(uint8_t mask[HEIGHT * WIDTH]) {
    memset(mask, 0, HEIGHT * WIDTH);
    for (int y = 5; y < 15; y++)
        memset(&mask[y * WIDTH + 10], 1, 15);
}

static dpl_pixels view(const float *data, int32_t width, int32_t height) {
    return (dpl_pixels){.data = data, .width = width, .height = height, .channels = 3};
}

static dpl_metrics_desc desc_of(const float *test, const float *reference, int32_t width, int32_t height) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    desc.test = view(test, width, height);
    desc.reference = view(reference, width, height);
    return desc;
}

static dpl_metrics_desc desc_of_pair(const pair *p) {
    return desc_of(p->test, p->reference, WIDTH, HEIGHT);
}

/* A single colour everywhere. */
static void fill_constant(float *data, int count, float r, float g, float b) {
    for (int i = 0; i < count; i++) {
        data[3 * i] = r;
        data[3 * i + 1] = g;
        data[3 * i + 2] = b;
    }
}

static dpl_metrics compare(dpl_context *context, const dpl_metrics_desc *desc) {
    dpl_metrics metrics;
    memset(&metrics, 0x5a, sizeof metrics);
    assert_ok(dpl_metrics_compare(context, desc, &metrics));
    return metrics;
}

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.12g is not within %g of %.12g", value, tolerance, expected);
}

static void assert_same_metrics(const dpl_metrics *a, const dpl_metrics *b) {
    assert_memory_equal(a, b, sizeof *a);
}

static int make_context(void **state) {
    return dpl_context_create(NULL, (dpl_context **)state) == DPL_OK ? 0 : -1;
}

static int end_context(void **state) {
    dpl_context_destroy(*state);
    return 0;
}

/* ---- closed forms --------------------------------------------------------------------------------- */

static void a_constant_offset_has_the_psnr_and_rmse_of_its_formula(void **state) {
    enum { SIDE = 16 };
    float test[SIDE * SIDE * 3] = {0}, reference[SIDE * SIDE * 3] = {0};
    fill_constant(test, SIDE * SIDE, 0.375f, 0.375f, 0.375f);
    fill_constant(reference, SIDE * SIDE, 0.25f, 0.25f, 0.25f);
    dpl_metrics_desc desc = desc_of(test, reference, SIDE, SIDE);
    const dpl_metrics linear = compare(*state, &desc);
    assert_near(linear.psnr_linear, 20.0 * log10(8.0), 1e-12);
    assert_near(linear.rel_rmse, 0.5, 1e-15);
    assert_int_equal(linear.pixels, SIDE * SIDE);
    /* The tone map gives 1 - (1 + pi/2)^-2.5 = 0.9056 and 1 - (1 + 3pi/4)^-2.5 = 0.9515: 231 and 243. */
    assert_near(linear.psnr_display, 20.0 * log10(255.0 / 12.0), 1e-12);
    /* Constants have no variance: only the brightness term of SSIM is left. */
    const double c1 = 2.55 * 2.55;
    assert_near(linear.ssim, (2.0 * 231.0 * 243.0 + c1) / (231.0 * 231.0 + 243.0 * 243.0 + c1), 1e-9);
}

static void radiance_above_one_is_not_clamped_in_linear_metrics(void **state) {
    float test[3] = {0}, reference[3] = {0};
    fill_constant(test, 1, 7.0f, 7.0f, 7.0f);
    fill_constant(reference, 1, 5.0f, 5.0f, 5.0f);
    dpl_metrics_desc desc = desc_of(test, reference, 1, 1);
    const dpl_metrics metrics = compare(*state, &desc);
    assert_near(metrics.psnr_linear, -20.0 * log10(2.0), 1e-12);
    assert_near(metrics.rel_rmse, 0.4, 1e-15);
}

static void identical_pictures_have_no_error_at_all(void **state) {
    pair p;
    fill_pair(&p);
    dpl_metrics_desc desc = desc_of(p.test, p.test, WIDTH, HEIGHT);
    const dpl_metrics metrics = compare(*state, &desc);
    assert_true(isinf(metrics.psnr_linear) && metrics.psnr_linear > 0.0);
    assert_true(isinf(metrics.psnr_display) && metrics.psnr_display > 0.0);
    assert_true(metrics.rel_rmse == 0.0);
    assert_true(metrics.ssim == 1.0);
    assert_true(metrics.flip == 0.0);
    assert_int_equal(metrics.pixels, WIDTH * HEIGHT);
}

static void relative_error_against_black_is_infinite_unless_both_are_black(void **state) {
    const float black[3] = {0.0f, 0.0f, 0.0f}, grey[3] = {0.1f, 0.1f, 0.1f};
    dpl_metrics_desc desc = desc_of(grey, black, 1, 1);
    assert_true(isinf(compare(*state, &desc).rel_rmse));
    desc = desc_of(black, black, 1, 1);
    assert_true(compare(*state, &desc).rel_rmse == 0.0);
}

static void display_colours_are_rounded_for_display_and_decoded_for_light(void **state) {
    /* 127.4 and 63.6 of 255 round to 127 and 64; outside 0 .. 1 the display clamps. */
    const float test[6] = {127.4f / 255.0f, 127.4f / 255.0f, 127.4f / 255.0f, 1.5f, 1.5f, 1.5f};
    const float reference[6] = {63.6f / 255.0f, 63.6f / 255.0f, 63.6f / 255.0f, 1.0f, 1.0f, 1.0f};
    dpl_metrics_desc desc = desc_of(test, reference, 2, 1);
    desc.display_referred = 1;
    const dpl_metrics metrics = compare(*state, &desc);
    assert_near(metrics.psnr_display, 10.0 * log10(255.0 * 255.0 * 2.0 / (63.0 * 63.0)), 1e-12);
    const double light_test = pow(((double)test[0] + 0.055) / 1.055, 2.4);
    const double light_reference = pow(((double)reference[0] + 0.055) / 1.055, 2.4);
    const double bright = pow((1.5 + 0.055) / 1.055, 2.4) - 1.0;
    const double dark = light_test - light_reference;
    const double expected = sqrt((dark * dark + bright * bright) / 2.0) / ((light_reference + 1.0) / 2.0);
    assert_near(metrics.rel_rmse, expected, 1e-12);
}

static void flip_of_green_and_blue_is_one_and_of_black_and_white_as_published(void **state) {
    enum { SIDE = 8 };
    float a[SIDE * SIDE * 3] = {0}, b[SIDE * SIDE * 3] = {0};
    dpl_metrics_desc desc = desc_of(a, b, SIDE, SIDE);
    desc.display_referred = 1;
    fill_constant(a, SIDE * SIDE, 0.0f, 1.0f, 0.0f);
    fill_constant(b, SIDE * SIDE, 0.0f, 0.0f, 1.0f);
    assert_near(compare(*state, &desc).flip, 1.0, 1e-6);
    fill_constant(a, SIDE * SIDE, 0.0f, 0.0f, 0.0f);
    fill_constant(b, SIDE * SIDE, 1.0f, 1.0f, 1.0f);
    assert_near(compare(*state, &desc).flip, 0.9673797619, 1e-6);
}

/* ---- numbers from an independent program ---------------------------------------------------------- */

/* What a direct two-dimensional implementation in another language gives for the same pair. */
typedef struct expectation {
    int32_t display_referred;
    bool masked;
    double pixels_per_degree;
    double psnr_linear, psnr_display, rel_rmse, ssim, flip;
} expectation;

static const expectation expectations[] = {
    {1, false, 67.020643, 20.1836237603, 20.6526690199, 0.3696382074, 0.7884066156, 0.3269211556},
    {1, false, 30.0, 20.1836237603, 20.6526690199, 0.3696382074, 0.7884066156, 0.3749153397},
    {1, false, 2.0, 20.1836237603, 20.6526690199, 0.3696382074, 0.7884066156, 0.4779233518},
    {1, true, 67.020643, 19.8732604577, 20.6600658008, 0.3629669438, 0.7826654540, 0.3331705245},
    {0, false, 67.020643, 20.6562181952, 24.0606167941, 0.1907712664, 0.7969119916, 0.2084789523},
    {0, false, 2.0, 20.6562181952, 24.0606167941, 0.1907712664, 0.7969119916, 0.2842673915},
    {0, true, 67.020643, 20.6630995285, 24.4558008363, 0.1847260452, 0.8258437787, 0.1843695353},
};

static void every_metric_equals_an_independent_program(void **state) {
    pair p;
    uint8_t mask[HEIGHT * WIDTH];
    fill_pair(&p);
    fill_mask(mask);
    for (size_t i = 0; i < sizeof expectations / sizeof expectations[0]; i++) {
        const expectation *expected = &expectations[i];
        dpl_metrics_desc desc = desc_of_pair(&p);
        desc.display_referred = expected->display_referred;
        desc.pixels_per_degree = expected->pixels_per_degree;
        desc.mask = expected->masked ? mask : NULL;
        const dpl_metrics metrics = compare(*state, &desc);
        assert_near(metrics.psnr_linear, expected->psnr_linear, 1e-8);
        assert_near(metrics.psnr_display, expected->psnr_display, 1e-8);
        assert_near(metrics.rel_rmse, expected->rel_rmse, 1e-9);
        assert_near(metrics.ssim, expected->ssim, 1e-8);
        assert_near(metrics.flip, expected->flip, 1e-6);
        assert_int_equal(metrics.pixels, expected->masked ? 1050 : 1200);
    }
}

/* ---- properties ----------------------------------------------------------------------------------- */

static void ssim_and_flip_do_not_care_which_picture_is_the_reference(void **state) {
    pair p;
    fill_pair(&p);
    dpl_metrics_desc forward = desc_of_pair(&p);
    dpl_metrics_desc backward = desc_of(p.reference, p.test, WIDTH, HEIGHT);
    const dpl_metrics a = compare(*state, &forward), b = compare(*state, &backward);
    assert_near(a.ssim, b.ssim, 1e-14);
    assert_near(a.flip, b.flip, 1e-14);
    assert_true(a.rel_rmse != b.rel_rmse);
}

static void more_noise_is_worse_in_every_metric(void **state) {
    pair p;
    fill_pair(&p);
    dpl_metrics_desc desc = desc_of_pair(&p);
    const dpl_metrics much = compare(*state, &desc);
    for (int i = 0; i < VALUES; i++)
        p.test[i] = 0.5f * (p.test[i] + p.reference[i]);
    const dpl_metrics little = compare(*state, &desc);
    assert_true(little.psnr_linear > much.psnr_linear);
    assert_true(little.psnr_display > much.psnr_display);
    assert_true(little.rel_rmse < much.rel_rmse);
    assert_true(little.ssim > much.ssim);
    assert_true(little.flip < much.flip && little.flip > 0.0);
}

static void garbage_under_the_mask_changes_nothing(void **state) {
    pair p;
    uint8_t mask[HEIGHT * WIDTH];
    fill_pair(&p);
    fill_mask(mask);
    for (int32_t display_referred = 0; display_referred < 2; display_referred++) {
        dpl_metrics_desc desc = desc_of_pair(&p);
        desc.display_referred = display_referred;
        desc.mask = mask;
        const dpl_metrics clean = compare(*state, &desc);
        pair soiled = p;
        for (int i = 0; i < VALUES; i++)
            if (mask[i / 3])
                soiled.test[i] = i % 2 ? 1e30f : -5.0f;
        desc.test.data = soiled.test;
        const dpl_metrics after = compare(*state, &desc);
        assert_same_metrics(&after, &clean);
        desc.mask = NULL;
        assert_true(compare(*state, &desc).flip > clean.flip);
    }
}

static void pictures_that_differ_only_under_the_mask_are_identical(void **state) {
    pair p;
    uint8_t mask[HEIGHT * WIDTH];
    fill_pair(&p);
    fill_mask(mask);
    for (int i = 0; i < VALUES; i++)
        if (!mask[i / 3])
            p.test[i] = p.reference[i];
    dpl_metrics_desc desc = desc_of_pair(&p);
    desc.mask = mask;
    const dpl_metrics metrics = compare(*state, &desc);
    assert_true(isinf(metrics.psnr_linear) && isinf(metrics.psnr_display));
    assert_true(metrics.rel_rmse == 0.0 && metrics.ssim == 1.0 && metrics.flip == 0.0);
}

static void strides_and_a_fourth_channel_change_nothing(void **state) {
    enum { PITCH = 4 * WIDTH + 7 };
    pair p;
    uint8_t mask[HEIGHT * WIDTH], padded_mask[HEIGHT][WIDTH + 9];
    static float wide[HEIGHT][PITCH], flipped[HEIGHT][3 * WIDTH];
    fill_pair(&p);
    fill_mask(mask);
    memset(padded_mask, 1, sizeof padded_mask);
    for (int y = 0; y < HEIGHT; y++) {
        for (int i = 0; i < PITCH; i++)
            wide[y][i] = NAN; /* alpha and padding are never looked at */
        for (int i = 0; i < 3 * WIDTH; i++)
            wide[y][i / 3 * 4 + i % 3] = p.test[3 * WIDTH * y + i];
        memcpy(flipped[HEIGHT - 1 - y], p.reference + 3 * WIDTH * y, sizeof flipped[0]);
        memcpy(padded_mask[HEIGHT - 1 - y], mask + y * WIDTH, WIDTH);
    }
    dpl_metrics_desc tight = desc_of_pair(&p), strided = tight;
    tight.mask = mask;
    strided.test.data = wide;
    strided.test.channels = 4;
    strided.test.row_stride = sizeof wide[0];
    strided.reference.data = flipped[HEIGHT - 1];
    strided.reference.row_stride = -(ptrdiff_t)sizeof flipped[0];
    strided.mask = padded_mask[HEIGHT - 1];
    strided.mask_stride = -(ptrdiff_t)sizeof padded_mask[0];
    const dpl_metrics a = compare(*state, &tight), b = compare(*state, &strided);
    assert_same_metrics(&a, &b);
}

static void results_do_not_depend_on_the_number_of_threads(void **state) {
    (void)state;
    static const int32_t thread_counts[] = {1, 2, 16};
    pair p;
    uint8_t mask[HEIGHT * WIDTH];
    fill_pair(&p);
    fill_mask(mask);
    dpl_metrics_desc desc = desc_of_pair(&p);
    desc.mask = mask;
    dpl_metrics first = {0};
    for (int i = 0; i < 3; i++) {
        dpl_context_desc context_desc = dpl_context_desc_default();
        context_desc.thread_count = thread_counts[i];
        dpl_context *context;
        assert_ok(dpl_context_create(&context_desc, &context));
        const dpl_metrics metrics = compare(context, &desc);
        if (i == 0)
            first = metrics;
        assert_same_metrics(&metrics, &first);
        dpl_context_destroy(context);
    }
}

static void pictures_smaller_than_any_window_are_compared(void **state) {
    static const int32_t sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 3}};
    pair p;
    fill_pair(&p);
    for (int i = 0; i < 4; i++) {
        dpl_metrics_desc desc = desc_of(p.test, p.reference, sizes[i][0], sizes[i][1]);
        const dpl_metrics metrics = compare(*state, &desc);
        assert_int_equal(metrics.pixels, sizes[i][0] * sizes[i][1]);
        assert_true(metrics.ssim > -1.0 && metrics.ssim < 1.0);
        assert_true(metrics.flip > 0.0 && metrics.flip < 1.0);
        assert_true(isfinite(metrics.psnr_linear) && isfinite(metrics.psnr_display));
    }
}

static void a_single_pixel_has_the_metrics_of_its_two_colours(void **state) {
    const float test[3] = {1.0f, 1.0f, 1.0f}, reference[3] = {0.0f, 0.0f, 0.0f};
    dpl_metrics_desc desc = desc_of(test, reference, 1, 1);
    desc.display_referred = 1;
    const dpl_metrics metrics = compare(*state, &desc);
    const double c1 = 2.55 * 2.55;
    assert_near(metrics.psnr_linear, 0.0, 1e-12);
    assert_near(metrics.psnr_display, 0.0, 1e-12);
    assert_near(metrics.ssim, c1 / (255.0 * 255.0 + c1), 1e-9);
    assert_near(metrics.flip, 0.9673797619, 1e-6);
}

/* A pixel so wide that no feature filter reaches a neighbour: colours alone are compared. */
static void the_coarsest_viewing_distance_still_gives_an_error_within_range(void **state) {
    pair p;
    fill_pair(&p);
    dpl_metrics_desc desc = desc_of_pair(&p);
    desc.pixels_per_degree = 1e-3;
    const dpl_metrics metrics = compare(*state, &desc);
    assert_true(metrics.flip > 0.0 && metrics.flip < 1.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_offset_has_the_psnr_and_rmse_of_its_formula),
        cmocka_unit_test(radiance_above_one_is_not_clamped_in_linear_metrics),
        cmocka_unit_test(identical_pictures_have_no_error_at_all),
        cmocka_unit_test(relative_error_against_black_is_infinite_unless_both_are_black),
        cmocka_unit_test(display_colours_are_rounded_for_display_and_decoded_for_light),
        cmocka_unit_test(flip_of_green_and_blue_is_one_and_of_black_and_white_as_published),
        cmocka_unit_test(every_metric_equals_an_independent_program),
        cmocka_unit_test(ssim_and_flip_do_not_care_which_picture_is_the_reference),
        cmocka_unit_test(more_noise_is_worse_in_every_metric),
        cmocka_unit_test(garbage_under_the_mask_changes_nothing),
        cmocka_unit_test(pictures_that_differ_only_under_the_mask_are_identical),
        cmocka_unit_test(strides_and_a_fourth_channel_change_nothing),
        cmocka_unit_test(results_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(pictures_smaller_than_any_window_are_compared),
        cmocka_unit_test(a_single_pixel_has_the_metrics_of_its_two_colours),
        cmocka_unit_test(the_coarsest_viewing_distance_still_gives_an_error_within_range),
    };
    return cmocka_run_group_tests(tests, make_context, end_context);
}
