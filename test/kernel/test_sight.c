/* The kernels of ray maps and horizons: every instruction set equals the scalar reference bit for bit, and
 * that one says what geometry says. */
#include "testing.h"

#include "kernel/kernel.h"

#include <math.h>
#include <string.h>

enum { RAYS = 22, BINS = 1024, MOST = 70, PIXELS = 300 };

static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0] };

static uint32_t seed = 7;

static float random_between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(low + (high - low) * (seed >> 8) / 16777216.0);
}

static float offsets[RAYS], reach[ISA_COUNT][RAYS][BINS];

static dpl_ray_map map_of(int which) {
    for (int k = 0; k < RAYS; k++)
        offsets[k] = (2.0f * (float)k + 1.0f) / RAYS - 1.0f;
    return (dpl_ray_map){RAYS, BINS, 5.0f, offsets, reach[which][0]};
}

static void clear(int which) {
    for (int k = 0; k < RAYS; k++)
        for (int bin = 0; bin < BINS; bin++)
            reach[which][k][bin] = INFINITY;
}

/* Pixels around the disc, some at its rim, in rows of every length up to MOST; all rays, then only some. */
static void draw(const dpl_kernels *kernels, int which) {
    dpl_ray_map map = map_of(which);
    clear(which);
    seed = 7;
    for (int row = 0; row < PIXELS; row++) {
        float x[MOST], y = random_between(-90, 90);
        int32_t count = row % 5;
        for (int i = 0; i < count; i++) {
            x[i] = random_between(-90, 90);
            float near = hypotf(x[i], y);
            x[i] += near < 5.0f ? 10.0f : 0.0f;
        }
        if (row == 0) { /* on the axes, and at the rim */
            x[0] = 5.01f;
            y = 0.0f;
            count = 1;
        }
        kernels->draw_rays(&map, 0, row % 2 ? RAYS : 7, count, x, y);
        kernels->draw_rays(&map, row % 2 ? 0 : 7, row % 2 ? 0 : RAYS - 7, count, x, y);
    }
}

static void see(const dpl_kernels *kernels, int which, int32_t count, float visible[MOST]) {
    dpl_ray_map map = map_of(which);
    float dx[MOST], dy[MOST];
    seed = 99;
    for (int i = 0; i < count; i++) {
        dx[i] = random_between(-120, 120);
        dy[i] = i % 9 == 3 ? 0.0f : random_between(-120, 120);
        dx[i] += fabsf(dx[i]) < 8.0f ? 30.0f : 0.0f;
    }
    kernels->see_rays(&map, count, visible, dx, dy);
}

static void rays_equal_the_reference(void **state) {
    (void)state;
    draw(&dpl_kernels_ref, 0);
    for (int k = 1; k < ISA_COUNT; k++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[k]);
        if (!kernels)
            continue;
        print_message("%s\n", dpl_isa_name(isas[k]));
        draw(kernels, k);
        assert_memory_equal(reach[0], reach[k], sizeof reach[0]);
        for (int32_t count = 0; count <= MOST; count++) {
            float expected[MOST], visible[MOST + 1];
            visible[count] = -7.0f;
            see(&dpl_kernels_ref, 0, count, expected);
            see(kernels, k, count, visible);
            assert_memory_equal(expected, visible, (size_t)count * sizeof *visible);
            assert_true(visible[count] == -7.0f); /* nothing behind the end */
        }
    }
}

static void classes_equal_the_reference(void **state) {
    (void)state;
    static float bins[64][3];
    for (int i = 0; i < 64; i++) {
        bins[i][0] = random_between(0, 2000);
        bins[i][1] = random_between(0, 2000);
        bins[i][2] = random_between(0, 4000);
    }
    dpl_horizon_table table = {(const float(*)[3])bins, 64};
    int found[3] = {0};
    for (int k = 1; k < ISA_COUNT; k++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[k]);
        for (int32_t count = 0; kernels && count <= MOST; count++) {
            uint8_t expected[MOST], classes[MOST + 1];
            float dx = random_between(-60, 60), dy = count % 7 ? random_between(-60, 60) : 0.0f;
            dx = count % 11 ? dx : -(float)(count / 2); /* over the light itself */
            classes[count] = 77;
            dpl_kernels_ref.look_round(&table, count, expected, dx, dy);
            kernels->look_round(&table, count, classes, dx, dy);
            assert_memory_equal(expected, classes, (size_t)count);
            assert_int_equal(classes[count], 77);
            for (int i = 0; i < count; i++)
                found[expected[i]]++;
        }
    }
    assert_true(found[0] > 100 && found[1] > 100 && found[2] > 100);
}

/* One pixel, 40 to the right: what rays meet it, by the distance of its centre from them. */
static void a_pixel_is_met_by_the_rays_that_cross_it(void **state) {
    (void)state;
    dpl_ray_map map = map_of(0);
    float x = 40.0f;
    clear(0);
    dpl_kernels_ref.draw_rays(&map, 0, RAYS, 1, &x, 0.0f);
    int met = 0;
    for (int k = 0; k < RAYS; k++)
        for (int bin = 0; bin < BINS; bin++) {
            double c = (bin + 0.5) * 2.0 * 3.14159265358979 / BINS, p = 5.0 * (double)offsets[k];
            double away = fabs(40.0 * sin(-c) - p), half = 0.5 * (fabs(cos(c)) + fabs(sin(c)));
            bool meets = cos(c) > 0.0 && away < half;
            if (fabs(away - half) > 0.02)
                assert_true((reach[0][k][bin] == 1600.0f) == meets);
            met += meets;
        }
    assert_true(met > RAYS);
    /* Behind it a receiver sees what passes on both sides: 1 - 0.5 / 5 * 80 / 40 .. of its half angle. */
    float visible, dx = 80.0f, dy = 0.0f;
    dpl_kernels_ref.see_rays(&map, 1, &visible, &dx, &dy);
    assert_true(fabs((double)visible - (1.0 - 0.5 / 40.0 * 80.0 / 5.0)) < 1.0 / RAYS);
    dx = 39.0f;
    dpl_kernels_ref.see_rays(&map, 1, &visible, &dx, &dy);
    assert_true(visible == 1.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_equal_the_reference),
        cmocka_unit_test(classes_equal_the_reference),
        cmocka_unit_test(a_pixel_is_met_by_the_rays_that_cross_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
