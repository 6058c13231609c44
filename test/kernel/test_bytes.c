/* Linear light to bytes: sRGB codes begin where their definition says, and every instruction set equals the
 * scalar reference bit for bit, for plain bytes too. */
#include "testing.h"

#include "kernel/kernel.h"

#include <math.h>
#include <string.h>

enum { MOST = 2000, GUARD = 40 };

static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0] };

static dpl_srgb_steps steps;

static double encoded(double v) {
    return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055);
}

static void every_code_begins_half_a_code_below_its_value(void **state) {
    (void)state;
    for (int k = 1; k < 256; k++) {
        float begin = (float)dpl_srgb_decode((k - 0.5) / 255.0);
        assert_true(fabs(encoded((double)begin) - (k - 0.5)) < 2e-5 * k + 1e-4);
        assert_int_equal(dpl_srgb_encode(&steps, begin), k);
        assert_int_equal(dpl_srgb_encode(&steps, nextafterf(begin, 0.0f)), k - 1);
        assert_int_equal(dpl_srgb_encode(&steps, (float)dpl_srgb_decode(k / 255.0)), k);
    }
}

/* With the test above this says that no step holds the beginnings of two codes. */
static void codes_never_fall_and_rise_by_one(void **state) {
    (void)state;
    int before = 0;
    for (int32_t bits = SRGB_LOWEST_BITS; bits <= 0x3f800000; bits += 1 << 10) {
        float v;
        memcpy(&v, &bits, sizeof v);
        int code = dpl_srgb_encode(&steps, v);
        assert_true(code == before || code == before + 1);
        before = code;
    }
    assert_int_equal(before, 255);
}

static void what_is_outside_is_clamped(void **state) {
    (void)state;
    static const float dark[] = {0.0f, -0.0f, -1.0f, -INFINITY, NAN, 1e-40f, 1e-5f};
    static const float bright[] = {1.0f, 1.0000001f, 2.0f, 3e38f, INFINITY};
    for (size_t i = 0; i < sizeof dark / sizeof dark[0]; i++)
        assert_int_equal(dpl_srgb_encode(&steps, dark[i]), 0);
    for (size_t i = 0; i < sizeof bright / sizeof bright[0]; i++)
        assert_int_equal(dpl_srgb_encode(&steps, bright[i]), 255);
}

static void fill(float in[MOST]) {
    static const float odd[] = {0.0f,      -0.0f, -1.0f, 1e-30f,       1e30f, INFINITY,
                                -INFINITY, NAN,   1.0f,  0.99999994f,  2.0f,  0x1p-13f,
                                0x1p-14f,  0.5f,  1e-4f, 0.5f / 255.0f};
    enum { ODD = sizeof odd / sizeof odd[0] };
    uint32_t seed = 3;
    for (int i = 0; i < MOST; i++) {
        seed = seed * 1664525u + 1013904223u;
        float v = (float)(seed >> 8) / 16777216.0f;
        in[i] = i < ODD ? odd[i] : i % 3 ? v : i % 2 ? v * v * v * v : 1.5f * v;
    }
    for (int k = 1; k < 256; k++) /* where codes begin, and just below */
        in[ODD + 2 * k] = nextafterf(in[ODD + 2 * k + 1] = (float)dpl_srgb_decode((k - 0.5) / 255.0), 0.0f);
}

static void every_instruction_set_equals_the_scalar_reference(void **state) {
    (void)state;
    static float in[MOST];
    static uint8_t expected[MOST + GUARD], found[MOST + GUARD];
    fill(in);
    for (int isa = 0; isa < ISA_COUNT; isa++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[isa]);
        if (!kernels)
            continue;
        print_message("%s\n", dpl_isa_name(isas[isa]));
        for (int32_t count = 0; count <= MOST; count += count < 70 ? 1 : 193) {
            memset(expected, 99, sizeof expected);
            memset(found, 99, sizeof found);
            for (int32_t i = 0; i < count; i++)
                expected[i] = dpl_srgb_encode(&steps, in[i]);
            kernels->srgb_from_linear(count, found, in, &steps);
            assert_memory_equal(expected, found, sizeof expected);
            memset(expected, 99, sizeof expected);
            memset(found, 99, sizeof found);
            dpl_kernels_ref.bytes_from_linear(count, expected, in);
            kernels->bytes_from_linear(count, found, in);
            assert_memory_equal(expected, found, sizeof expected);
        }
    }
}

static int fill_steps(void **state) {
    (void)state;
    dpl_srgb_steps_fill(&steps);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_code_begins_half_a_code_below_its_value),
        cmocka_unit_test(codes_never_fall_and_rise_by_one),
        cmocka_unit_test(what_is_outside_is_clamped),
        cmocka_unit_test(every_instruction_set_equals_the_scalar_reference),
    };
    return cmocka_run_group_tests(tests, fill_steps, NULL);
}
