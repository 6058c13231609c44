/* Half precision: the scalar reference against the definition of the format, and every instruction set
 * against the scalar reference bit for bit. */
#include "testing.h"

#include "kernel/half.h"
#include "kernel/kernel.h"

#include <math.h>
#include <stdlib.h>

enum { GUARD = 40, HALVES = 65536, FLOATS = 1 << 17 };

static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0] };

static float float_of_bits(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* What the format's definition says a finite half is worth. */
static double worth(uint16_t half) {
    int exponent = half >> 10 & 31, mantissa = half & 0x3ff;
    double value = exponent ? ldexp(1024 + mantissa, exponent - 25) : ldexp(mantissa, -24);
    return half & 0x8000 ? -value : value;
}

static void every_half_becomes_the_float_it_is_worth(void **state) {
    (void)state;
    for (int h = 0; h < HALVES; h++) {
        float f = dpl_float_from_half((uint16_t)h);
        if ((h & 0x7fff) == 0x7c00)
            assert_true(isinf(f));
        else if ((h & 0x7fff) > 0x7c00)
            assert_true(isnan(f));
        else
            assert_true((double)f == worth((uint16_t)h));
        assert_int_equal(signbit(f) != 0, h >> 15);
    }
}

static void every_finite_half_comes_back_from_its_float(void **state) {
    (void)state;
    for (int h = 0; h < HALVES; h++)
        if ((h & 0x7fff) < 0x7c00)
            assert_int_equal(dpl_half_from_float(dpl_float_from_half((uint16_t)h)), h);
}

/* Between every two neighbours: their middle goes to the even one, and the floats beside it to the nearer. */
static void ties_go_to_even_and_the_rest_to_the_nearest(void **state) {
    (void)state;
    for (int h = 0; h < 0x7bff; h++) {
        float middle = (float)((worth((uint16_t)h) + worth((uint16_t)(h + 1))) / 2);
        assert_int_equal(dpl_half_from_float(middle), h + h % 2);
        assert_int_equal(dpl_half_from_float(nextafterf(middle, 0.0f)), h);
        assert_int_equal(dpl_half_from_float(nextafterf(middle, INFINITY)), h + 1);
        assert_int_equal(dpl_half_from_float(-middle), 0x8000 + h + h % 2);
    }
}

static void what_no_half_can_hold_becomes_the_nearest_that_it_can(void **state) {
    (void)state;
    static const float large[] = {65504.0f, 65504.004f, 65519.996f, 65520.0f, 1e6f, 3.4e38f, INFINITY};
    for (size_t i = 0; i < sizeof large / sizeof large[0]; i++) {
        assert_int_equal(dpl_half_from_float(large[i]), 0x7bff);
        assert_int_equal(dpl_half_from_float(-large[i]), 0xfbff);
    }
    assert_int_equal(dpl_half_from_float(NAN), 0);
    assert_int_equal(dpl_half_from_float(-NAN), 0);
    assert_int_equal(dpl_half_from_float(0x1p-25f), 0); /* a tie, and 0 is even */
    assert_int_equal(dpl_half_from_float(1e-40f), 0);
    assert_int_equal(dpl_half_from_float(-1e-40f), 0x8000);
}

/* Floats of every sign and exponent with mantissas that round down, up, are ties or nearly so, and random. */
static void fill_floats(float floats[FLOATS]) {
    static const uint32_t mantissas[] = {0,        1,        0xfff,    0x1000,   0x1001,   0x1fff,
                                         0x2000,   0x2fff,   0x3000,   0x3001,   0x7fe000, 0x7fefff,
                                         0x7ff000, 0x7ff001, 0x7fffff, 0x400000, 0x400001, 0x3fffff};
    uint32_t count = 0, seed = 7;
    for (uint32_t high = 0; high < 512; high++)
        for (size_t m = 0; m < sizeof mantissas / sizeof mantissas[0]; m++)
            floats[count++] = float_of_bits(high << 23 | mantissas[m]);
    while (count < FLOATS) {
        seed = seed * 1664525u + 1013904223u;
        uint32_t bits = seed ^ seed >> 15;
        if (count % 2) /* half of them near what halves can hold: exponents 96 .. 159 */
            bits = (bits & 0x807fffff) | (96 + (seed >> 20) % 64) << 23;
        floats[count++] = float_of_bits(bits);
    }
}

static void assert_same_to_half(const dpl_kernels *kernels, const float *in, int32_t count) {
    static uint16_t expected[FLOATS + GUARD], found[FLOATS + GUARD];
    memset(expected, 0x5a, ((size_t)count + GUARD) * sizeof *expected);
    memset(found, 0x5a, ((size_t)count + GUARD) * sizeof *found);
    for (int32_t i = 0; i < count; i++)
        expected[i] = dpl_half_from_float(in[i]);
    kernels->half_from_float(count, found, in);
    assert_memory_equal(expected, found, ((size_t)count + GUARD) * sizeof *found);
}

static void assert_same_from_half(const dpl_kernels *kernels, const uint16_t *in, int32_t count) {
    static float expected[HALVES + GUARD], found[HALVES + GUARD];
    memset(expected, 0x5a, ((size_t)count + GUARD) * sizeof *expected);
    memset(found, 0x5a, ((size_t)count + GUARD) * sizeof *found);
    for (int32_t i = 0; i < count; i++)
        expected[i] = dpl_float_from_half(in[i]);
    kernels->float_from_half(count, found, in);
    assert_memory_equal(expected, found, ((size_t)count + GUARD) * sizeof *found);
}

static void every_instruction_set_equals_the_scalar_reference(void **state) {
    (void)state;
    static float floats[FLOATS];
    static uint16_t halves[HALVES];
    fill_floats(floats);
    for (int h = 0; h < HALVES; h++)
        halves[h] = (uint16_t)h;
    for (int i = 0; i < ISA_COUNT; i++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
        if (!kernels)
            continue;
        print_message("%s\n", dpl_isa_name(isas[i]));
        assert_same_to_half(kernels, floats, FLOATS);
        assert_same_from_half(kernels, halves, HALVES);
        for (int32_t count = 0; count < 70; count++) { /* every end, from addresses of every alignment */
            assert_same_to_half(kernels, floats + 9000 + count % 5, count);
            assert_same_from_half(kernels, halves + 1000 * (count % 40) + count % 7, count);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_becomes_the_float_it_is_worth),
        cmocka_unit_test(every_finite_half_comes_back_from_its_float),
        cmocka_unit_test(ties_go_to_even_and_the_rest_to_the_nearest),
        cmocka_unit_test(what_no_half_can_hold_becomes_the_nearest_that_it_can),
        cmocka_unit_test(every_instruction_set_equals_the_scalar_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
