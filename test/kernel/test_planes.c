/* The kernels that carry pictures into the holographic solver and out of it: every instruction set equals the
 * scalar reference bit for bit, the reference does what it says, and nothing is written beside the result. */
#include "testing.h"

#include "kernel/kernel.h"
#include "os/machine.h"

#include <math.h>
#include <string.h>

enum { MOST = 70, GUARD = 24 };

#define GUARD_VALUE (-12345.0f)
#define GUARD_HALF 0xdeadu

static uint32_t seed = 1;

static uint32_t random_bits(void) {
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

static float random_light(void) {
    static const float odd[] = {0.0f, 1.0f, 1e-45f, 1e-39f, 65504.0f, 1e30f, 3e38f, 0.1f};
    return random_bits() % 3 ? (float)random_bits() / 4194304.0f : odd[random_bits() % 8];
}

static void for_each_isa(void (*test)(const dpl_kernels *kernels)) {
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
        if (!kernels)
            continue;
        print_message("%s\n", dpl_isa_name(isas[i]));
        test(kernels);
    }
}

/* Rows and columns of every kind around a tile, and steps longer than them. */
static const int32_t sizes[][2] = {{1, 1},   {1, 40},  {40, 1}, {3, 17},  {15, 16}, {16, 15},
                                   {16, 16}, {17, 33}, {31, 5}, {33, 48}, {2, 64}};
enum { SIZES = sizeof sizes / sizeof sizes[0], STEP = 53, CELLS = 70 * STEP };

static void assert_transposes(const dpl_kernels *kernels) {
    static float in[CELLS], out[CELLS];
    static uint16_t halves[CELLS], half_out[CELLS];
    for (int n = 0; n < SIZES; n++) {
        int32_t rows = sizes[n][0], columns = sizes[n][1], in_step = columns + n, out_step = STEP;
        for (int i = 0; i < CELLS; i++) {
            in[i] = (float)i;
            halves[i] = (uint16_t)i;
            out[i] = GUARD_VALUE;
            half_out[i] = GUARD_HALF;
        }
        kernels->transpose(rows, columns, out, (size_t)out_step, in, (size_t)in_step);
        kernels->transpose_halves(rows, columns, half_out, (size_t)out_step, halves, (size_t)in_step);
        for (int i = 0; i < CELLS; i++) {
            int column = i / out_step, row = i % out_step;
            bool written = column < columns && row < rows;
            assert_true(out[i] == (written ? in[row * in_step + column] : GUARD_VALUE));
            assert_int_equal(half_out[i], written ? halves[row * in_step + column] : GUARD_HALF);
        }
    }
}

static void rows_become_columns(void **state) {
    (void)state;
    for_each_isa(assert_transposes);
}

static void assert_opaque_planes(const dpl_kernels *kernels) {
    static float emission[MOST][4], found[4 * (MOST + GUARD)];
    static uint8_t kind[MOST];
    for (int32_t count = 0; count <= MOST; count++) {
        size_t stride = (size_t)count + (size_t)count % 5;
        for (int i = 0; i < MOST; i++) {
            kind[i] = (uint8_t)(random_bits() % 2 * 2);
            for (int c = 0; c < 4; c++)
                emission[i][c] = random_light();
        }
        for (int i = 0; i < 4 * (MOST + GUARD); i++)
            found[i] = GUARD_VALUE;
        kernels->opaque_planes(count, found, stride, kind, (const float(*)[4])emission);
        for (int i = 0; i < 4 * (MOST + GUARD); i++) {
            float expected = GUARD_VALUE;
            if (count && (size_t)i < 4 * stride && (size_t)i % stride < (size_t)count) {
                size_t p = (size_t)i / stride, x = (size_t)i % stride;
                bool solid = kind[x] == 2;
                expected =
                    p == 3 ? (solid ? 0.0f : 1.0f) : (solid ? fminf(emission[x][p], DPL_RADIANCE_MAX) : 0.0f);
            }
            assert_memory_equal(&found[i], &expected, sizeof expected);
        }
    }
}

static void opaque_pixels_are_their_emission_and_others_nothing(void **state) {
    (void)state;
    for_each_isa(assert_opaque_planes);
}

static void assert_interleave(const dpl_kernels *kernels) {
    enum { SHIFTED = 16 }; /* a pixel begins where a vector does once in so many */
    static float planes[3][MOST], room[SHIFTED + MOST + GUARD][3];
    const float *const from[3] = {planes[0], planes[1], planes[2]};
    for (int32_t n = 0; n <= 2 * SHIFTED * MOST; n++) {
        int32_t count = n % (MOST + 1);
        float(*found)[3] = room + n / 2 % SHIFTED;
        for (int i = 0; i < MOST + GUARD; i++)
            for (int c = 0; c < 3; c++) {
                found[i][c] = GUARD_VALUE;
                if (i < MOST)
                    planes[c][i] = random_light();
            }
        kernels->interleave(count, found, from, n % 2);
        for (int i = 0; i < MOST + GUARD; i++)
            for (int c = 0; c < 3; c++)
                assert_true(found[i][c] == (i < count ? planes[c][i] : GUARD_VALUE));
    }
}

static void planes_become_pixels(void **state) {
    (void)state;
    for_each_isa(assert_interleave);
}

static void assert_add_scaled(const dpl_kernels *kernels) {
    static float in[MOST], expected[MOST + GUARD], found[MOST + GUARD];
    for (int32_t count = 0; count <= MOST; count++) {
        for (int i = 0; i < MOST + GUARD; i++)
            expected[i] = found[i] = i < count ? random_light() : GUARD_VALUE;
        for (int i = 0; i < MOST; i++)
            in[i] = random_light();
        bool add = count % 2 == 1;
        for (int i = 0; i < count; i++)
            expected[i] = add ? expected[i] + in[i] * -0.25f : in[i] * -0.25f;
        kernels->add_scaled(count, found, in, -0.25f, add);
        assert_memory_equal(expected, found, sizeof expected);
    }
}

static void weighed_planes_are_set_or_added(void **state) {
    (void)state;
    for_each_isa(assert_add_scaled);
}

/* Rows with an element before and one behind. */
static float values[3][MOST + 2], is_free[3][MOST + 2];

static void fill_cross(float light) {
    for (int r = 0; r < 3; r++)
        for (int i = 0; i < MOST + 2; i++) {
            values[r][i] = light >= 0.0f ? light : (float)random_bits() / 65536.0f;
            is_free[r][i] = (float)(random_bits() % 2);
        }
}

static void assert_cross(const dpl_kernels *kernels) {
    static float expected[MOST + GUARD], found[MOST + GUARD];
    const float *const rows[3] = {values[0] + 1, values[1] + 1, values[2] + 1};
    const float *const free_rows[3] = {is_free[0] + 1, is_free[1] + 1, is_free[2] + 1};
    for (int32_t count = 0; count <= MOST; count++) {
        fill_cross(-1.0f);
        for (int i = 0; i < MOST + GUARD; i++)
            expected[i] = found[i] = GUARD_VALUE;
        dpl_kernels_ref.filter_cross(count, expected, rows, free_rows);
        kernels->filter_cross(count, found, rows, free_rows);
        assert_memory_equal(expected, found, sizeof expected);
        for (int i = 0; i < count; i++) {
            double sum = 4.0 * rows[1][i], weight = 4.0;
            const int pairs[2][2][2] = {{{0, i}, {2, i}}, {{1, i - 1}, {1, i + 1}}};
            for (int k = 0; k < 2; k++) {
                const int *a = pairs[k][0], *b = pairs[k][1];
                double both = (double)free_rows[a[0]][a[1]] * (double)free_rows[b[0]][b[1]];
                sum += both * ((double)rows[a[0]][a[1]] + (double)rows[b[0]][b[1]]);
                weight += 2.0 * both;
            }
            assert_true(found[i] >= sum / weight * (1 - 1e-6) && found[i] <= sum / weight * (1 + 1e-6));
        }
        fill_cross(0.5f); /* the same light everywhere stays what it is, wherever walls are */
        kernels->filter_cross(count, found, rows, free_rows);
        for (int i = 0; i < count; i++)
            assert_true(found[i] == 0.5f);
    }
}

static void the_cross_filter_takes_neighbours_by_free_pairs(void **state) {
    (void)state;
    for_each_isa(assert_cross);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_become_columns),
        cmocka_unit_test(opaque_pixels_are_their_emission_and_others_nothing),
        cmocka_unit_test(planes_become_pixels),
        cmocka_unit_test(weighed_planes_are_set_or_added),
        cmocka_unit_test(the_cross_filter_takes_neighbours_by_free_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
