/* The row pass of the distance transform: the scalar reference equals brute force, and every instruction set
 * equals the reference to the bit, in pictures of every density and shape, in place, writing nothing beside
 * its rows. */
#include "testing.h"

#include "kernel/kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 24, GUARD_BYTE = 0xa5 };

/* A band of rows, as the column pass leaves it. */
typedef struct picture {
    int32_t width, height, nowhere;
    uint8_t *kind;
    int32_t *runs;
} picture;

static uint32_t seed = 1;

static uint32_t random_bits(void) {
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

static void *checked(void *memory) {
    assert_non_null(memory);
    return memory;
}

static picture new_picture(int32_t width, int32_t height) {
    picture p = {.width = width, .height = height, .nowhere = width + height};
    p.kind = checked(calloc((size_t)(width * height), 1));
    p.runs = checked(calloc((size_t)(width * height), sizeof(int32_t)));
    return p;
}

static void free_picture(picture *p) {
    free(p->kind);
    free(p->runs);
}

/* Distances in columns; the nearest occupied pixel above the band is `above[x]` rows before its first. */
static void find_runs(picture *p, const int32_t *above) {
    for (int32_t x = 0; x < p->width; x++) {
        int32_t run = above ? above[x] - 1 : p->nowhere;
        for (int32_t y = 0; y < p->height; y++) {
            run = p->kind[y * p->width + x] ? 0 : run + 1;
            p->runs[y * p->width + x] = run;
        }
        for (int32_t y = p->height - 2; y >= 0; y--) {
            int32_t *at = &p->runs[y * p->width + x], below = at[p->width] + 1;
            *at = below < *at ? below : *at;
        }
    }
}

/* In place, as src/field/distance.c does it. The caller frees the clearances. */
static float *clearances_of(const dpl_kernels *kernels, const picture *p) {
    size_t bytes = (size_t)(p->width * p->height) * sizeof(float), scratch = dpl_distance_scratch(p->width);
    char *plane = checked(malloc(bytes + 2 * GUARD)), *work = checked(malloc(scratch + 2 * GUARD));
    memset(plane, GUARD_BYTE, bytes + 2 * GUARD);
    memset(work, GUARD_BYTE, scratch + 2 * GUARD);
    memcpy(plane + GUARD, p->runs, bytes);
    const dpl_distance_rows rows = {
        .width = p->width,
        .height = p->height,
        .nowhere = p->nowhere,
        .kind = p->kind,
        .runs = (const int32_t *)(const void *)(plane + GUARD),
        .clearance = (float *)(void *)(plane + GUARD),
    };
    kernels->distance_along(&rows, work + GUARD);
    for (size_t i = 0; i < GUARD; i++) {
        assert_int_equal((uint8_t)plane[i], GUARD_BYTE);
        assert_int_equal((uint8_t)plane[GUARD + bytes + i], GUARD_BYTE);
        assert_int_equal((uint8_t)work[i], GUARD_BYTE);
        assert_int_equal((uint8_t)work[GUARD + scratch + i], GUARD_BYTE);
    }
    float *clearance = checked(malloc(bytes));
    memcpy(clearance, plane + GUARD, bytes);
    free(plane);
    free(work);
    return clearance;
}

/* Every instruction set of this machine. */
static void assert_sets_equal(const picture *p) {
    static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    float *expected = clearances_of(&dpl_kernels_ref, p);
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
        if (!kernels)
            continue;
        float *found = clearances_of(kernels, p);
        for (int32_t at = 0; at < p->width * p->height; at++)
            if (memcmp(&found[at], &expected[at], sizeof found[at]) != 0)
                fail_msg("%s, %d x %d: pixel (%d, %d) is %.9g, not %.9g", dpl_isa_name(isas[i]), p->width,
                         p->height, at % p->width, at / p->width, (double)found[at], (double)expected[at]);
        free(found);
    }
    free(expected);
}

static void assert_equals_brute_force(const picture *p) {
    float *found = clearances_of(&dpl_kernels_ref, p);
    for (int32_t y = 0; y < p->height; y++)
        for (int32_t x = 0; x < p->width; x++) {
            int32_t squared = INT32_MAX;
            for (int32_t i = 0; i < p->width; i++) {
                int32_t run = p->runs[y * p->width + i], known = run < p->nowhere ? run : p->nowhere;
                int32_t there = (x - i) * (x - i) + known * known;
                squared = there < squared ? there : squared;
            }
            uint8_t kind = p->kind[y * p->width + x];
            float expected = kind == 2 ? -1.0f : kind == 1 ? 0.0f : sqrtf((float)squared);
            assert_true(found[y * p->width + x] == expected);
        }
    free(found);
}

/* One pixel in `every` is opaque or a medium; none where that is 0. */
static picture noise(int32_t width, int32_t height, uint32_t every) {
    picture p = new_picture(width, height);
    for (int32_t i = 0; i < width * height; i++)
        p.kind[i] = every && random_bits() % every == 0 ? (uint8_t)(1 + random_bits() % 2) : 0;
    find_runs(&p, NULL);
    return p;
}

static const uint32_t densities[] = {0, 1, 2, 8, 30, 100, 1000, 10000};
enum { DENSITIES = sizeof densities / sizeof densities[0] };

static void the_reference_equals_brute_force(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{1, 1}, {1, 9}, {2, 5}, {17, 20}, {130, 30}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (int d = 0; d < DENSITIES; d++) {
            picture p = noise(sizes[s][0], sizes[s][1], densities[d]);
            assert_equals_brute_force(&p);
            free_picture(&p);
        }
}

static void noise_of_every_density_at_every_width_around_a_vector(void **state) {
    (void)state;
    for (int32_t width = 1; width <= 70; width++)
        for (int d = 0; d < DENSITIES; d++) {
            picture p = noise(width, 12, densities[d]);
            assert_sets_equal(&p);
            free_picture(&p);
        }
}

static void wide_noise_where_groups_are_skipped(void **state) {
    (void)state;
    static const int32_t widths[] = {500, 777, 2048};
    for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++)
        for (int d = 0; d < DENSITIES; d++) {
            picture p = noise(widths[w], 40, densities[d]);
            assert_sets_equal(&p);
            free_picture(&p);
        }
}

/* A wall that crosses columns at a slope: the nearest pixel is as far along a row as it is along a column. */
static void walls_at_every_slope(void **state) {
    (void)state;
    for (int32_t slope = -4; slope <= 4; slope++)
        for (int32_t flat = 1; flat <= 5; flat += 2) {
            picture p = new_picture(420, 90);
            for (int32_t x = 0; x < p.width; x++) {
                int32_t y = 45 + (x - 210) * slope / flat;
                if (y >= 0 && y < p.height)
                    p.kind[y * p.width + x] = 2;
            }
            find_runs(&p, NULL);
            assert_sets_equal(&p);
            free_picture(&p);
        }
}

/* One pixel far from everything, at each end of the row and in the middle. */
static void single_pixels(void **state) {
    (void)state;
    for (int32_t x = 0; x < 300; x += 23) {
        picture p = new_picture(300, 40);
        p.kind[(x % 40) * p.width + x] = 2;
        find_runs(&p, NULL);
        assert_sets_equal(&p);
        free_picture(&p);
    }
}

/* Squares above 2^24 are not whole numbers in floats, nor are all of their sums. */
static void distances_whose_squares_do_not_fit_a_float(void **state) {
    (void)state;
    static const int32_t distances[] = {4080, 4095, 5000, 12000};
    static int32_t above[3001];
    for (size_t d = 0; d < sizeof distances / sizeof distances[0]; d++)
        for (uint32_t spread = 1; spread <= 1000; spread *= 10) {
            picture p = new_picture(3001, 20);
            p.nowhere = 2 * 16384;
            for (int32_t x = 0; x < p.width; x++)
                above[x] = distances[d] + (int32_t)(random_bits() % spread);
            find_runs(&p, above);
            assert_sets_equal(&p);
            free_picture(&p);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_equals_brute_force),
        cmocka_unit_test(noise_of_every_density_at_every_width_around_a_vector),
        cmocka_unit_test(wide_noise_where_groups_are_skipped),
        cmocka_unit_test(walls_at_every_slope),
        cmocka_unit_test(single_pixels),
        cmocka_unit_test(distances_whose_squares_do_not_fit_a_float),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
