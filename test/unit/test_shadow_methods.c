/* Every approximate method against closed forms and the exact one, each held to what it is known to reach. */
#include "shadow_world.h"
#include "world.h"

#include "shadow/blend.h"
#include "shadow/coverage.h"

#include "shared_context.h"

#include <string.h>

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

static double rms(const float *a, const float *b) {
    double sum = 0.0;
    for (int i = 0; i < PIXELS; i++)
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sqrt(sum / PIXELS);
}

/* Root mean square error of a desc against the exact method. */
static double error_of(dpl_field *field, const dpl_light *light, const dpl_shadow_desc *desc) {
    dpl_shadow_desc exact = dpl_test_method(DPL_SHADOW_EXACT);
    float *a = dpl_test_visibility(context, field, light, desc);
    float *b = dpl_test_visibility(context, field, light, &exact);
    double error = rms(a, b);
    for (int i = 0; i < PIXELS; i++)
        assert_true(a[i] >= 0.0f && a[i] <= 1.0f);
    free(a);
    free(b);
    return error;
}

static void coverages_are_those_of_their_shapes(void **state) {
    (void)state;
    for (int i = -12; i <= 12; i++) {
        double x = i / 10.0, area = 0.0, length = 0.0, half = 0.0;
        for (int k = 0; k < 20000; k++) { /* chords of a disc */
            double at = (k + 0.5) / 10000.0 - 1.0, chord = sqrt(1.0 - at * at);
            area += chord;
            half += at < x ? chord : 0.0;
            length += at < x;
        }
        assert_true(fabs(dpl_coverage_disc(x) - half / area) < 1e-4);
        assert_true(fabs(dpl_coverage_interval(x) - length / 20000.0) < 1e-4);
        assert_true(fabs(dpl_coverage_quilez(x) - dpl_coverage_disc(x)) < 0.0395);
    }
}

static void a_penumbra_begins_where_the_rim_disappears(void **state) {
    (void)state;
    /* A point at distance 50 from a light of radius 10 shadows, at distance 100, the receivers from which it
     * is seen before the rim: between them and it the angle at the light's centre is this. */
    double half = dpl_penumbra_half_angle(10, 50, 100), px = 100 * cos(half), py = 100 * sin(half);
    double to_point = atan2(-py, 50 - px), to_centre = atan2(-py, -px), apart = fabs(to_point - to_centre);
    apart = apart > 3.14159265358979 ? 6.28318530717959 - apart : apart;
    assert_true(fabs(apart - asin(10.0 / 100.0)) < 1e-9);
    assert_true(dpl_penumbra_half_angle(10, 100, 100) == 0.0 && dpl_penumbra_half_angle(10, 120, 100) == 0.0);
}

/* A corner that shadows a quarter of the picture: one edge, the case that single cones are exact in. */
static void one_straight_edge_is_right_for_signed_marches(void **state) {
    (void)state;
    static const struct {
        dpl_shadow_method method;
        double least, most;
    } expected[] = {{DPL_SHADOW_DISTANCE_SIGNED, 0, 0.03},
                    {DPL_SHADOW_DISTANCE_TWO_SIDED, 0, 0.03},
                    {DPL_SHADOW_DISTANCE_CONES, 0, 0.012},
                    {DPL_SHADOW_MOMENTS_SOFT, 0, 0.03},
                    {DPL_SHADOW_PCSS, 0, 0.03},
                    {DPL_SHADOW_MRMA, 0, 0.012},
                    {DPL_SHADOW_DISTANCE_HARD, 0.05, 0.2},
                    {DPL_SHADOW_DISTANCE_QUILEZ, 0.05, 0.2},
                    {DPL_SHADOW_DISTANCE_AALTONEN, 0.05, 0.2},
                    {DPL_SHADOW_MOMENTS_2, 0.02, 0.3},
                    {DPL_SHADOW_MOMENTS_4, 0.005, 0.2},
                    {DPL_SHADOW_MOMENTS_EXPONENTIAL, 0.01, 0.25}};
    dpl_field *field = dpl_test_field(context, WIDTH, HEIGHT);
    dpl_test_block(field, 60, 60, WIDTH, HEIGHT, INFINITY);
    dpl_test_block(field, 50, 60, 60, HEIGHT, INFINITY);
    dpl_light light = dpl_test_light(20, 90, 10);
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        dpl_shadow_desc desc = dpl_test_method(expected[i].method);
        double error = error_of(field, &light, &desc);
        if (!(error >= expected[i].least && error <= expected[i].most))
            fail_msg("%s: %g is not in %g .. %g", dpl_shadow_method_name(expected[i].method), error,
                     expected[i].least, expected[i].most);
    }
    dpl_field_destroy(field);
}

/* Only the outer half of a penumbra: at the hard shadow's edge half the light is seen, and they say none. */
static void marches_of_gaps_alone_are_dark_at_the_hard_edge(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, WIDTH, HEIGHT);
    dpl_test_block(field, 60, 60, 64, HEIGHT, INFINITY);
    dpl_light light = dpl_test_light(20, 60, 8);
    dpl_shadow_desc quilez = dpl_test_method(DPL_SHADOW_DISTANCE_QUILEZ),
                    exact = dpl_test_method(DPL_SHADOW_EXACT);
    float *a = dpl_test_visibility(context, field, &light, &quilez);
    float *b = dpl_test_visibility(context, field, &light, &exact);
    int at = 60 * WIDTH + 140;
    assert_true(b[at] > 0.4f && b[at] < 0.6f);
    assert_true(a[at] < 0.1f);
    free(a);
    free(b);
    dpl_field_destroy(field);
}

/* Thin pillars before one another: more cones come closer, and the minimum of map and march beats both. */
static dpl_field *pillars(void) {
    dpl_field *field = dpl_test_field(context, WIDTH, HEIGHT);
    uint32_t seed = 7;
    for (int i = 0; i < 20; i++) {
        double x = floor(dpl_test_random(&seed, 45, 150)), y = floor(dpl_test_random(&seed, 5, 110));
        dpl_test_block(field, x, y, x + 4, y + 4, INFINITY);
    }
    return field;
}

static void more_cones_come_closer(void **state) {
    (void)state;
    dpl_field *field = pillars();
    dpl_light light = dpl_test_light(20, 60, 9);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_DISTANCE_CONES);
    double errors[3];
    for (int k = 0; k < 3; k++) {
        desc.sub_cones = 1 << 2 * k;
        errors[k] = error_of(field, &light, &desc);
    }
    if (!(errors[1] < 0.5 * errors[0] && errors[2] < errors[1] && errors[2] < 0.02))
        fail_msg("%g, %g, %g", errors[0], errors[1], errors[2]);
    dpl_field_destroy(field);
}

static void the_minimum_is_better_than_both(void **state) {
    (void)state;
    dpl_field *field = pillars();
    dpl_light light = dpl_test_light(20, 60, 9);
    dpl_shadow_desc map = dpl_test_method(DPL_SHADOW_MOMENTS_SOFT),
                    march = dpl_test_method(DPL_SHADOW_DISTANCE_SIGNED);
    dpl_shadow_desc blend = dpl_test_method(DPL_SHADOW_MRMA), literal = dpl_test_method(DPL_SHADOW_MRMA);
    blend.map_method = DPL_SHADOW_MOMENTS_SOFT;
    blend.field_method = DPL_SHADOW_DISTANCE_SIGNED;
    literal.weight = DPL_WEIGHT_LITERAL;
    double smooth = error_of(field, &light, &blend);
    blend.weight = DPL_WEIGHT_MIN;
    double hard = error_of(field, &light, &blend), of_map = error_of(field, &light, &map);
    double of_march = error_of(field, &light, &march);
    assert_true(smooth < of_map && smooth < of_march && hard < of_map && hard < of_march);
    assert_true(error_of(field, &light, &literal) > 2.0 * of_map);
    dpl_field_destroy(field);
}

static void the_guard_leaves_out_what_is_too_coarse_and_says_so(void **state) {
    (void)state;
    dpl_field *field = pillars();
    dpl_light light = dpl_test_light(20, 60, 2);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_MRMA);
    dpl_shadow_stats stats;
    dpl_shadow *shadow;
    float *v = malloc(PIXELS * sizeof *v);
    assert_non_null(v);
    desc.map_method = DPL_SHADOW_MOMENTS_SOFT;
    desc.field_method = DPL_SHADOW_DISTANCE_SIGNED;
    for (int k = 0; k < 3; k++) { /* a coarse map, a coarse field, cones that need no map */
        desc.map_resolution = k == 0 ? 64 : 4096;
        desc.field_level = k == 1 ? 4 : 0;
        desc.field_method = k == 2 ? DPL_SHADOW_DISTANCE_CONES : DPL_SHADOW_DISTANCE_SIGNED;
        assert_ok(dpl_shadow_create(context, &desc, &shadow));
        assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
        dpl_shadow_read_stats(shadow, &stats);
        assert_true(k == 1 ? stats.map_only > 0 && stats.field_only == 0
                           : stats.field_only > 0 && stats.map_only == 0);
        assert_true(k != 2 || stats.field_only == stats.worked);
        dpl_shadow_destroy(shadow);
    }
    double guarded, bare;
    desc.field_level = 4;
    desc.field_method = DPL_SHADOW_DISTANCE_SIGNED;
    desc.weight = DPL_WEIGHT_CONSTANT;
    guarded = error_of(field, &light, &desc);
    desc.guard = 0;
    bare = error_of(field, &light, &desc);
    assert_true(guarded < bare);
    free(v);
    dpl_field_destroy(field);
}

/* Against the exact method, which has no steps: more rays come closer, and none makes light where there is
 * none. */
static void rays_are_the_exact_method_in_steps(void **state) {
    (void)state;
    dpl_field *field = pillars();
    double errors[3];
    for (int k = 0; k < 3; k++) {
        dpl_light light = dpl_test_light(20, 60, 9);
        dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_RAYS);
        desc.samples = 8 << 2 * k;
        errors[k] = error_of(field, &light, &desc);
    }
    if (!(errors[0] < 0.05 && errors[1] < 0.5 * errors[0] && errors[2] < errors[1] && errors[2] < 0.01))
        fail_msg("%g, %g, %g", errors[0], errors[1], errors[2]);
    dpl_field_destroy(field);
}

/* Where the map errs less the field is left out, near the light the map has no answer. */
static void rays_serve_where_they_can(void **state) {
    (void)state;
    dpl_field *field = pillars();
    dpl_light light = dpl_test_light(20, 60, 9);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_MRMA);
    dpl_shadow_stats stats;
    dpl_shadow *shadow;
    float *v = malloc(PIXELS * sizeof *v);
    assert_non_null(v);
    desc.classify = 0;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
    dpl_shadow_read_stats(shadow, &stats);
    assert_true(stats.map_only > 1000 && stats.field_only > 0);
    assert_true(stats.map_only + stats.field_only == stats.worked);
    dpl_shadow_destroy(shadow);
    desc.weight = DPL_WEIGHT_CONSTANT; /* of both terms: between what they give alone */
    assert_true(error_of(field, &light, &desc) < 0.03);
    free(v);
    dpl_field_destroy(field);
}

static void weights_follow_their_rules(void **state) {
    (void)state;
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_blend_terms terms = {
        .map = 0.4, .field = 0.6, .distance = 96, .gap = 32, .map_variance = 3, .field_variance = 1};
    static const struct {
        dpl_shadow_weight weight;
        double a;
    } expected[] = {{DPL_WEIGHT_MIN, 1},
                    {DPL_WEIGHT_CONSTANT, 0.5},
                    {DPL_WEIGHT_DISTANCE, 0.75},
                    {DPL_WEIGHT_GAP, 0.5},
                    {DPL_WEIGHT_VARIANCE, 0.25},
                    {DPL_WEIGHT_LITERAL, 0},
                    {DPL_WEIGHT_SMOOTH_MIN, 0.99872}};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        desc.weight = expected[i].weight;
        assert_true(fabs(dpl_blend_weight(&desc, &terms) - expected[i].a) < 1e-4);
    }
    terms.map = terms.field;
    desc.weight = DPL_WEIGHT_SMOOTH_MIN;
    assert_true(dpl_blend_weight(&desc, &terms) == 0.5);
    terms.map = 1.0;
    terms.field = 0.0;
    desc.tau = 1e-4f; /* the exponential overflows: all to the field */
    assert_true(dpl_blend_weight(&desc, &terms) == 0.0);
}

static void a_coarser_field_errs_more_and_not_wildly(void **state) {
    (void)state;
    dpl_field *field = pillars();
    dpl_light light = dpl_test_light(20, 60, 9);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_DISTANCE_CONES);
    double fine = error_of(field, &light, &desc);
    desc.field_level = 1;
    double half = error_of(field, &light, &desc);
    assert_true(half > fine && half < 0.15);
    dpl_field_destroy(field);
}

/* Rays end where the picture does: nothing is outside, and a light a million pixels away takes no longer. */
static void lights_outside_shine_in(void **state) {
    (void)state;
    static const dpl_light lights[2] = {{{-60, 60}, 20, {1, 1, 1}, 1}, {{-9e5, 60}, 2e4, {1, 1, 1}, 1}};
    dpl_field *field = dpl_test_field(context, WIDTH, HEIGHT);
    dpl_test_block(field, 0, 50, 3, 70, INFINITY); /* at the border that they shine over */
    dpl_test_block(field, 80, 30, 90, 50, INFINITY);
    for (int k = 0; k < 2; k++)
        for (int method = DPL_SHADOW_DISTANCE_SIGNED; method < DPL_SHADOW_METHOD_COUNT; method++) {
            dpl_shadow_desc desc = dpl_test_method((dpl_shadow_method)method);
            double error = error_of(field, &lights[k], &desc);
            bool is_fine = method >= DPL_SHADOW_DISTANCE_CONES; /* single cones leak past so thin a wall */
            if (!(error < (is_fine ? 0.04 : 0.2)))
                fail_msg("%s, light %d: %g", dpl_shadow_method_name(desc.method), k, error);
        }
    dpl_shadow_desc literal = dpl_test_method(DPL_SHADOW_MRMA);
    literal.weight = DPL_WEIGHT_LITERAL;
    free(dpl_test_visibility(context, field, &lights[1], &literal));
    dpl_field_destroy(field);
}

/* What the horizon settles, methods would have said too; so the exact method gives the same with it and
 * without. */
static void classes_change_nothing_for_the_exact_method(void **state) {
    (void)state;
    dpl_field *field = pillars();
    for (int k = 0; k < 4; k++) {
        dpl_light light = dpl_test_light(20 + 30 * k, 60 - 10 * k, 3 + 9 * k);
        dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
        float *a = dpl_test_visibility(context, field, &light, &desc);
        desc.classify = 0;
        float *b = dpl_test_visibility(context, field, &light, &desc);
        assert_memory_equal(a, b, PIXELS * sizeof *a);
        free(a);
        free(b);
    }
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverages_are_those_of_their_shapes),
        cmocka_unit_test(a_penumbra_begins_where_the_rim_disappears),
        cmocka_unit_test(one_straight_edge_is_right_for_signed_marches),
        cmocka_unit_test(marches_of_gaps_alone_are_dark_at_the_hard_edge),
        cmocka_unit_test(more_cones_come_closer),
        cmocka_unit_test(the_minimum_is_better_than_both),
        cmocka_unit_test(the_guard_leaves_out_what_is_too_coarse_and_says_so),
        cmocka_unit_test(rays_are_the_exact_method_in_steps),
        cmocka_unit_test(rays_serve_where_they_can),
        cmocka_unit_test(weights_follow_their_rules),
        cmocka_unit_test(a_coarser_field_errs_more_and_not_wildly),
        cmocka_unit_test(lights_outside_shine_in),
        cmocka_unit_test(classes_change_nothing_for_the_exact_method),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
