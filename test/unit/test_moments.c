/* Moments of depth: every formula against distributions whose answer is known. */
#include "testing.h"

#include "shadow/moment_table.h"
#include "shadow/moments.h"

#include <math.h>
#include <string.h>

static double random_between(uint32_t *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (*seed >> 8) / 16777216.0;
}

/* A few depths with weights, and the share of them that is not below a receiver. */
enum { MOST_DEPTHS = 8 };
typedef struct depths {
    int count;
    double z[MOST_DEPTHS];
    double weight[MOST_DEPTHS];
} depths;

static depths random_depths(uint32_t *seed, int count) {
    depths d = {.count = count};
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        d.z[i] = random_between(seed, -1.0, 1.0);
        sum += d.weight[i] = random_between(seed, 0.05, 1.0);
    }
    for (int i = 0; i < count; i++)
        d.weight[i] /= sum;
    return d;
}

static void moments_of(const depths *d, double b[4]) {
    memset(b, 0, 4 * sizeof *b);
    for (int i = 0; i < d->count; i++) {
        double one[4];
        dpl_moments_of(d->z[i], one);
        for (int k = 0; k < 4; k++)
            b[k] += d->weight[i] * one[k];
    }
}

static double lit_share(const depths *d, double depth) {
    double lit = 0.0;
    for (int i = 0; i < d->count; i++)
        lit += d->z[i] >= depth ? d->weight[i] : 0.0;
    return lit;
}

/* ---- two moments ---------------------------------------------------------------------------------- */

static void cantelli_is_exact_at_the_far_one_of_two_depths(void **state) {
    (void)state;
    for (int i = 1; i < 10; i++) {
        double lit = i / 10.0, near = 0.2, far = 0.7;
        double mean = (1 - lit) * near + lit * far, square = (1 - lit) * near * near + lit * far * far;
        assert_true(fabs(dpl_moments_cantelli(mean, square, far, 0.0) - lit) < 1e-12);
    }
}

static void cantelli_never_adds_shadow(void **state) {
    (void)state;
    uint32_t seed = 1;
    for (int i = 0; i < 20000; i++) {
        depths d = random_depths(&seed, 1 + i % MOST_DEPTHS);
        double b[4], depth = random_between(&seed, -1.2, 1.2);
        moments_of(&d, b);
        assert_true(dpl_moments_cantelli(b[0], b[1], depth, 0.0) >= lit_share(&d, depth) - 1e-9);
    }
}

static void cantelli_is_one_tailed_and_bleeds_where_the_paper_says(void **state) {
    (void)state;
    assert_true(dpl_moments_cantelli(0.5, 0.25, 0.5, 1e-5) == 1.0); /* at the mean: lit */
    assert_true(dpl_moments_cantelli(0.5, 0.25, 0.4, 1e-5) == 1.0); /* before it: lit */
    assert_true(dpl_moments_cantelli(0.5, 0.25, 0.6, 1e-5) < 2e-3); /* flat and behind: dark */
    assert_true(dpl_moments_cantelli(0.5, 0.25, 0.6, 0.0) < 1e-12); /* no variance at all: no 0/0 */
    double bleeding = dpl_moments_cantelli(0.6, 0.45, 1.0, 0.0);    /* {.3, .9} all before 1: should be 0 */
    assert_true(fabs(bleeding - 0.36) < 1e-12);
    assert_true(dpl_moments_reduce_bleeding(bleeding, 0.4) == 0.0);
    assert_true(dpl_moments_reduce_bleeding(1.0, 0.4) == 1.0);
    assert_true(fabs(dpl_moments_reduce_bleeding(0.7, 0.4) - 0.5) < 1e-12);
}

static void warped_moments_never_add_shadow_and_bleed_less(void **state) {
    (void)state;
    uint32_t seed = 2;
    double leak = 0.0, plain_leak = 0.0;
    for (int i = 0; i < 20000; i++) {
        depths d = random_depths(&seed, 2 + i % 3);
        double depth = random_between(&seed, -1.0, 1.0), warped[4] = {0}, b[4];
        for (int k = 0; k < d.count; k++) {
            double one[4];
            dpl_moments_warp(d.z[k], 10.0, one);
            for (int m = 0; m < 4; m++)
                warped[m] += d.weight[k] * one[m];
        }
        moments_of(&d, b);
        double v = dpl_moments_warped_visibility(warped, depth, 10.0, 0.0);
        assert_true(v >= lit_share(&d, depth) - 1e-7);
        leak += v - lit_share(&d, depth);
        plain_leak += dpl_moments_cantelli(b[0], b[1], depth, 0.0) - lit_share(&d, depth);
    }
    assert_true(leak < 0.7 * plain_leak);
}

/* ---- four moments --------------------------------------------------------------------------------- */

static void three_points_reproduce_the_moments(void **state) {
    (void)state;
    uint32_t seed = 3;
    for (int i = 0; i < 20000; i++) {
        depths d = random_depths(&seed, 3 + i % (MOST_DEPTHS - 2));
        double b[4], depth = random_between(&seed, -1.0, 1.0);
        dpl_moments_points p;
        moments_of(&d, b);
        dpl_moments_add_bias(b, 1e-3, DPL_MOMENTS_TARGET_FLOAT);
        assert_true(dpl_moments_solve(b, depth, &p));
        assert_true(p.z[0] == depth);
        double sum = 0.0, back[4] = {0};
        for (int k = 0; k < 3; k++) {
            double one[4];
            dpl_moments_of(p.z[k], one);
            assert_true(p.weight[k] > -1e-9);
            sum += p.weight[k];
            for (int m = 0; m < 4; m++)
                back[m] += p.weight[k] * one[m];
        }
        assert_true(fabs(sum - 1.0) < 1e-7);
        for (int m = 0; m < 4; m++)
            assert_true(fabs(back[m] - b[m]) < 1e-5);
    }
}

static void four_moments_never_add_shadow(void **state) {
    (void)state;
    uint32_t seed = 4;
    for (int i = 0; i < 50000; i++) {
        depths d = random_depths(&seed, 3 + i % (MOST_DEPTHS - 2));
        double b[4], depth = random_between(&seed, -1.0, 1.0);
        moments_of(&d, b);
        assert_true(dpl_moments_visibility(b, depth) >= lit_share(&d, depth) - 1e-6);
    }
}

/* Biased moments are those of a mixture with a share `bias` of something else. */
static void bias_adds_at_most_its_own_share_of_shadow(void **state) {
    (void)state;
    uint32_t seed = 5;
    for (int i = 0; i < 50000; i++) {
        depths d = random_depths(&seed, 1 + i % MOST_DEPTHS); /* one and two depths too: singular without */
        double b[4], depth = random_between(&seed, -1.0, 1.0);
        moments_of(&d, b);
        dpl_moments_add_bias(b, DPL_MOMENTS_BIAS_SUMS, DPL_MOMENTS_TARGET_FLOAT);
        double v = dpl_moments_visibility(b, depth);
        assert_true(v <= 1.0 && v >= lit_share(&d, depth) - DPL_MOMENTS_BIAS_SUMS - 1e-5);
    }
}

static void two_depths_are_told_apart_without_bleeding(void **state) {
    (void)state;
    depths d = {.count = 2, .z = {-0.4, 0.5}, .weight = {0.5, 0.5}};
    double b[4];
    moments_of(&d, b);
    dpl_moments_add_bias(b, DPL_MOMENTS_BIAS_FLOAT, DPL_MOMENTS_TARGET_FLOAT);
    assert_true(dpl_moments_visibility(b, 0.9) < 1e-3);             /* behind both: Cantelli gives 0.16 */
    assert_true(fabs(dpl_moments_visibility(b, 0.2) - 0.5) < 1e-2); /* between */
    assert_true(dpl_moments_visibility(b, -0.8) > 0.999);           /* before both */
    double share, blocker = dpl_moments_blocker(b, 0.2, &share);
    assert_true(fabs(blocker + 0.4) < 5e-3 && fabs(share - 0.5) < 1e-2);
    assert_true(dpl_moments_blocker(b, -0.8, &share) < -0.7 && share < 1e-3); /* nothing before it */
}

static void impossible_moments_fall_back_to_two(void **state) {
    (void)state;
    const double flat[4] = {0.5, 0.25, 0.125, 0.0625}, nonsense[4] = {0.5, 0.5, 0.5, -1.0};
    dpl_moments_points p;
    assert_false(dpl_moments_solve(flat, 0.7, &p));
    assert_false(dpl_moments_solve(nonsense, 0.7, &p));
    assert_true(dpl_moments_visibility(flat, 0.4) == 1.0 && dpl_moments_visibility(flat, 0.7) < 1e-3);
    double v = dpl_moments_visibility(nonsense, 0.7);
    assert_true(v >= 0.0 && v <= 1.0);
}

/* ---- packing and sums ----------------------------------------------------------------------------- */

static void packing_comes_back_and_stays_within_one(void **state) {
    (void)state;
    uint32_t seed = 6;
    for (int i = 0; i < 20000; i++) {
        depths d = random_depths(&seed, 1 + i % MOST_DEPTHS);
        double b[4], packed[4], back[4];
        uint16_t coarse[4];
        moments_of(&d, b);
        dpl_moments_pack(b, packed);
        dpl_moments_unpack(packed, back);
        for (int k = 0; k < 4; k++) {
            assert_true(packed[k] > -1e-12 && packed[k] < 1.0 + 1e-12);
            assert_true(fabs(back[k] - b[k]) < 1e-14);
        }
        dpl_moments_pack_16(b, coarse);
        dpl_moments_unpack_16(coarse, back);
        for (int k = 0; k < 4; k++)
            assert_true(fabs(back[k] - b[k]) < 3e-5);
    }
}

static void sixteen_bits_with_their_bias_stay_possible(void **state) {
    (void)state;
    uint32_t seed = 7;
    for (int i = 0; i < 20000; i++) {
        depths d = random_depths(&seed, 1 + i % MOST_DEPTHS);
        double b[4], depth = random_between(&seed, -1.0, 1.0);
        uint16_t coarse[4];
        dpl_moments_points p;
        moments_of(&d, b);
        dpl_moments_pack_16(b, coarse);
        dpl_moments_unpack_16(coarse, b);
        dpl_moments_add_bias(b, DPL_MOMENTS_BIAS_16, DPL_MOMENTS_TARGET_16);
        assert_true(dpl_moments_solve(b, depth, &p));
    }
}

/* A table whose whole sum wraps around 32 bits many times. */
static void sums_over_any_box_are_means(void **state) {
    (void)state;
    enum { WIDTH = 60, HEIGHT = 40, BOX = 12 };
    static double z[HEIGHT][WIDTH];
    static uint32_t sums[(HEIGHT + 1) * (WIDTH + 1)][4];
    dpl_moment_table table = {WIDTH, HEIGHT, BOX * BOX, sums};
    uint32_t seed = 8;
    assert_true(sizeof sums / sizeof sums[0] == dpl_moment_table_entries(WIDTH, HEIGHT));
    for (int y = 0; y < HEIGHT; y++) {
        double packed[WIDTH][4], b[4];
        for (int x = 0; x < WIDTH; x++) {
            z[y][x] = random_between(&seed, -1.0, 1.0);
            dpl_moments_of(z[y][x], b);
            dpl_moments_pack(b, packed[x]);
        }
        dpl_moment_table_add_row(&table, y, (const double(*)[4])packed);
    }
    for (int i = 0; i < 500; i++) {
        double x0 = random_between(&seed, 0, WIDTH - 10), y0 = random_between(&seed, 0, HEIGHT - 10);
        double x1 = x0 + random_between(&seed, 0.1, 10), y1 = y0 + random_between(&seed, 0.1, 10);
        double mean[4], wanted[4] = {0}, area = (x1 - x0) * (y1 - y0);
        dpl_moment_table_mean(&table, x0, y0, x1, y1, mean);
        for (int y = (int)y0; y < HEIGHT && y < y1; y++)
            for (int x = (int)x0; x < WIDTH && x < x1; x++) {
                double wide = fmin(x1, x + 1) - fmax(x0, x), high = fmin(y1, y + 1) - fmax(y0, y), b[4];
                dpl_moments_of(z[y][x], b);
                for (int k = 0; k < 4; k++)
                    wanted[k] += b[k] * wide * high / area;
            }
        for (int k = 0; k < 4; k++)
            assert_true(fabs(mean[k] - wanted[k]) < 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cantelli_is_exact_at_the_far_one_of_two_depths),
        cmocka_unit_test(cantelli_never_adds_shadow),
        cmocka_unit_test(cantelli_is_one_tailed_and_bleeds_where_the_paper_says),
        cmocka_unit_test(warped_moments_never_add_shadow_and_bleed_less),
        cmocka_unit_test(three_points_reproduce_the_moments),
        cmocka_unit_test(four_moments_never_add_shadow),
        cmocka_unit_test(bias_adds_at_most_its_own_share_of_shadow),
        cmocka_unit_test(two_depths_are_told_apart_without_bleeding),
        cmocka_unit_test(impossible_moments_fall_back_to_two),
        cmocka_unit_test(packing_comes_back_and_stays_within_one),
        cmocka_unit_test(sixteen_bits_with_their_bias_stay_possible),
        cmocka_unit_test(sums_over_any_box_are_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
