/* The exact method and the reference: against closed forms, and against each other. */
#include "shadow/shadow.h"
#include "shadow_world.h"
#include "world.h"

#include "shared_context.h"

#include <string.h>

/* Angle of a point seen from a pixel's centre, from the line to the light's centre. */
static double angle_to(const dpl_light *l, int32_t x, int32_t y, double px, double py) {
    double ax = l->position[0] - x - 0.5, ay = l->position[1] - y - 0.5, bx = px - x - 0.5, by = py - y - 0.5;
    return atan2(ax * by - ay * bx, ax * bx + ay * by);
}

static double half_angle(const dpl_light *l, int32_t x, int32_t y) {
    return asin(l->radius / hypot(l->position[0] - x - 0.5, l->position[1] - y - 0.5));
}

static double clamp(double v, double limit) {
    return v > limit ? limit : v < -limit ? -limit : v;
}

/* ---- closed forms --------------------------------------------------------------------------------- */

static void a_half_plane_gives_the_exact_penumbra(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, 120, 100);
    dpl_test_block(field, 40, 50, 44, 100, INFINITY); /* a wall whose upper end is the edge of the shadow */
    dpl_light light = dpl_test_light(10.3, 52.1, 7);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
    float *v = dpl_test_visibility(context, field, &light, &desc);
    for (int32_t y = 20; y < 80; y++)
        for (int32_t x = 60; x < 120; x++) {
            double alpha = half_angle(&light, x, y);
            /* the wall lies below: on the side of negative angles when looking to the left */
            double upper = fmax(angle_to(&light, x, y, 40, 50), angle_to(&light, x, y, 44, 50));
            double wanted = 1.0 - (clamp(upper, alpha) + alpha) / (2.0 * alpha);
            if (fabs((double)v[y * 120 + x] - wanted) > 1e-5)
                fail_msg("(%d, %d): %g, wanted %g", x, y, (double)v[y * 120 + x], wanted);
        }
    free(v);
    dpl_field_destroy(field);
}

static void one_pixel_covers_the_angle_of_its_corners(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, 80, 60);
    dpl_test_block(field, 30, 30, 31, 31, INFINITY);
    dpl_light light = dpl_test_light(8.2, 30.9, 5);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
    float *v = dpl_test_visibility(context, field, &light, &desc);
    for (int32_t y = 22; y < 40; y++)
        for (int32_t x = 36; x < 80; x++) {
            double alpha = half_angle(&light, x, y), low = INFINITY, high = -INFINITY;
            for (int k = 0; k < 4; k++) {
                double angle = angle_to(&light, x, y, 30 + (k & 1), 30 + (k >> 1));
                low = fmin(low, angle);
                high = fmax(high, angle);
            }
            double wanted = 1.0 - (clamp(high, alpha) - clamp(low, alpha)) / (2.0 * alpha);
            assert_true(fabs((double)v[y * 80 + x] - wanted) < 1e-5);
        }
    free(v);
    dpl_field_destroy(field);
}

static void a_slit_lets_through_what_fits(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, 120, 80);
    dpl_test_block(field, 50, 0, 51, 38, INFINITY);
    dpl_test_block(field, 50, 42, 51, 80, INFINITY);
    dpl_light light = dpl_test_light(10.5, 40.0, 9);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
    float *v = dpl_test_visibility(context, field, &light, &desc);
    int32_t x = 100,
            y = 39; /* straight behind: limited by the slit's far side corners, (50|51, 38) and (.., 42) */
    double alpha = half_angle(&light, x, y);
    double upper = fmin(angle_to(&light, x, y, 50, 38), angle_to(&light, x, y, 51, 38));
    double lower = fmax(angle_to(&light, x, y, 50, 42), angle_to(&light, x, y, 51, 42));
    double wanted = (clamp(upper, alpha) - clamp(lower, alpha)) / (2.0 * alpha);
    assert_true(wanted > 0.2 && wanted < 0.6);
    assert_true(fabs((double)v[y * 120 + x] - wanted) < 1e-5);
    free(v);
    dpl_field_destroy(field);
}

/* ---- against the reference ------------------------------------------------------------------------ */

static void compare_with_reference(dpl_field *field, const dpl_light *light) {
    dpl_shadow_desc exact = dpl_test_method(DPL_SHADOW_EXACT),
                    reference = dpl_test_method(DPL_SHADOW_REFERENCE);
    reference.samples = 256;
    size_t pixels = (size_t)dpl_field_width(field) * (size_t)dpl_field_height(field);
    float *a = dpl_test_visibility(context, field, light, &exact);
    float *b = dpl_test_visibility(context, field, light, &reference);
    double square = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        double error = (double)a[i] - (double)b[i];
        square += error * error;
        /* one ray's share for each end of a covered stretch, and a few stretches */
        if (fabs(error) > 12.0 / 256.0)
            fail_msg("pixel (%d, %d): exact %g, reference %g", (int)(i % (size_t)dpl_field_width(field)),
                     (int)(i / (size_t)dpl_field_width(field)), (double)a[i], (double)b[i]);
    }
    assert_true(sqrt(square / (double)pixels) < 0.004);
    free(a);
    free(b);
}

static void exact_is_the_reference_wherever_the_light_stands(void **state) {
    (void)state;
    static const double lights[][3] = {{30.3, 31.7, 3}, {48, 20, 12}, {-20, 30, 8},   {12.5, 12.5, 0.3},
                                       {120, -40, 30},  {32, 40, 40}, {60, 0.5, 1.5}, {32, 32, 2.5}};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        dpl_field *field = dpl_test_world(context, 64, 56, (uint32_t)i + 1, 1);
        dpl_light light = dpl_test_light(lights[i][0], lights[i][1], lights[i][2]);
        compare_with_reference(field, &light);
        dpl_field_destroy(field);
    }
}

static void lights_in_walls_and_at_walls_are_defined(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, 60, 60);
    dpl_test_block(field, 20, 20, 40, 40, INFINITY);
    static const double lights[][3] = {{30, 30, 3},  /* deep inside: dark everywhere */
                                       {30, 30, 12}, /* comes out at the sides only */
                                       {20, 30, 5},  /* half in */
                                       {15, 30, 5},  /* touches */
                                       {30, 30, 16}};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        dpl_light light = dpl_test_light(lights[i][0], lights[i][1], lights[i][2]);
        compare_with_reference(field, &light);
    }
    dpl_light light = dpl_test_light(30, 30, 3);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
    float *v = dpl_test_visibility(context, field, &light, &desc);
    for (int i = 0; i < 3600; i++)
        assert_true(v[i] == 0.0f);
    free(v);
    dpl_field_destroy(field);
}

/* ---- lines of receivers --------------------------------------------------------------------------- */

/* Every pixel as the method gives it, most of them by lines of receivers, against each by itself. */
static void compare_with_single_receivers(dpl_field *field, const dpl_light *light) {
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
    int32_t width = dpl_field_width(field), margin = dpl_field_margin(field);
    dpl_solid solid = {0};
    desc.classify = 0;
    float *v = dpl_test_visibility(context, field, light, &desc);
    assert_ok(dpl_solid_fill_bits(&solid, field));
    dpl_shadow_view view = {.field = field,
                            .solid = &solid,
                            .position = {light->position[0] + margin, light->position[1] + margin},
                            .radius = light->radius};
    for (int32_t i = 0; i < width * dpl_field_height(field); i++) {
        int32_t x = i % width + margin, y = i / width + margin;
        dpl_receiver r;
        dpl_shadow_counts counts = {0};
        if (dpl_field_is_opaque(field, x, y) || !dpl_receiver_at(&view, x, y, &r))
            continue;
        double alone = dpl_shadow_exact(&view, &r, &counts);
        if (fabs((double)v[i] - alone) > 1e-4)
            fail_msg("(%d, %d): %g in a line, %g alone", x, y, (double)v[i], alone);
    }
    dpl_solid_free(context, &solid);
    free(v);
}

static void receivers_in_lines_see_what_each_sees_alone(void **state) {
    (void)state;
    static const double lights[][3] = {{60.3, 51.7, 3}, {70, 20, 12}, {-20, 50, 8},   {22.5, 12.5, 0.3},
                                       {150, -40, 30},  {32, 60, 40}, {60, 0.5, 1.5}, {900, 700, 50}};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        dpl_field *field = dpl_test_world(context, 134, 117, (uint32_t)i + 1, 0);
        dpl_light light = dpl_test_light(lights[i][0], lights[i][1], lights[i][2]);
        compare_with_single_receivers(field, &light);
        dpl_field_destroy(field);
    }
}

static void slits_and_noise_in_lines_are_exact_too(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, 150, 140);
    for (int i = 0; i < 12; i++) { /* more slits than a line keeps spans, and walls that touch at corners */
        dpl_test_block(field, 60, 10 + 10 * i, 63, 14 + 10 * i, INFINITY);
        dpl_test_block(field, 80 + 2 * i, 30 + 2 * i, 82 + 2 * i, 32 + 2 * i, INFINITY);
    }
    uint32_t seed = 3;
    for (int i = 0; i < 150; i++) {
        double x = floor(dpl_test_random(&seed, 5, 145)), y = floor(dpl_test_random(&seed, 100, 139));
        dpl_test_block(field, x, y, x + 1, y + 1, INFINITY);
    }
    static const double lights[][3] = {{20.3, 70, 18}, {75, 5.5, 6}, {140, 70, 14}};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        dpl_light light = dpl_test_light(lights[i][0], lights[i][1], lights[i][2]);
        compare_with_single_receivers(field, &light);
    }
    dpl_field_destroy(field);
}

static void a_light_of_no_size_is_a_hard_shadow(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, 64, 64, 4, 0);
    dpl_light light = dpl_test_light(33.21, 30.77, 0);
    for (int method = 0; method < DPL_SHADOW_METHOD_COUNT; method++) {
        dpl_shadow_desc desc = dpl_test_method((dpl_shadow_method)method);
        bool is_map = method >= DPL_SHADOW_MOMENTS_2 && method <= DPL_SHADOW_PCSS;
        float *v = dpl_test_visibility(context, field, &light, &desc);
        for (int i = 0; i < 64 * 64; i++)
            assert_true(is_map ? v[i] >= 0.0f && v[i] <= 1.0f : v[i] == 0.0f || v[i] == 1.0f);
        free(v);
    }
    dpl_shadow_desc exact = dpl_test_method(DPL_SHADOW_EXACT),
                    reference = dpl_test_method(DPL_SHADOW_REFERENCE);
    float *a = dpl_test_visibility(context, field, &light, &exact);
    float *b = dpl_test_visibility(context, field, &light, &reference);
    int differing = 0;
    for (int i = 0; i < 64 * 64; i++)
        differing += a[i] != b[i];
    assert_true(differing <= 1); /* a ray through a corner */
    free(a);
    free(b);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_half_plane_gives_the_exact_penumbra),
        cmocka_unit_test(one_pixel_covers_the_angle_of_its_corners),
        cmocka_unit_test(a_slit_lets_through_what_fits),
        cmocka_unit_test(exact_is_the_reference_wherever_the_light_stands),
        cmocka_unit_test(lights_in_walls_and_at_walls_are_defined),
        cmocka_unit_test(receivers_in_lines_see_what_each_sees_alone),
        cmocka_unit_test(slits_and_noise_in_lines_are_exact_too),
        cmocka_unit_test(a_light_of_no_size_is_a_hard_shadow),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
