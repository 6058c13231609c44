/* The distance transform is exact: equal to brute force on every pixel of many small worlds. */
#include "testing.h"

#include <dapple/dapple.h>
#include <math.h>

enum { MOST = 80 };

/* Fills a field with `count` opaque or foggy pixels and compares every distance with the nearest of them. */
static void assert_exact(dpl_context *context, int32_t width, int32_t height, int32_t count, uint32_t seed) {
    static float distance[MOST * MOST];
    static double occupied[MOST * MOST][2];
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = width;
    desc.height = height;
    assert_ok(dpl_field_create(context, &desc, &field));
    for (int32_t i = 0; i < count; i++) {
        seed = seed * 1664525u + 1013904223u;
        int32_t x = (int32_t)(seed >> 8) % width, y = (int32_t)(seed >> 16) % height;
        dpl_shape dot = dpl_shape_default(DPL_SHAPE_DISC);
        dot.disc = (dpl_disc){{x + 0.5, y + 0.5}, 0.0};
        if (i % 3 == 0)
            dot.material.extinction[0] = 0.1f;
        assert_ok(dpl_field_draw_shapes(field, &dot, 1));
        occupied[i][0] = x;
        occupied[i][1] = y;
    }
    assert_ok(dpl_field_read_distance(field, distance, 0));
    for (int32_t y = 0; y < height; y++)
        for (int32_t x = 0; x < width; x++) {
            double nearest = INFINITY;
            for (int32_t i = 0; i < count; i++) {
                double dx = x - occupied[i][0], dy = y - occupied[i][1];
                nearest = fmin(nearest, dx * dx + dy * dy);
            }
            float expected = sqrtf((float)nearest);
            if (count > 0)
                assert_true(distance[y * width + x] == expected);
            else
                assert_true(distance[y * width + x] >= (float)(width + height));
        }
    dpl_field_destroy(field);
}

static void distances_equal_brute_force(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{1, 1},   {1, 80},  {80, 1},  {2, 3},
                                       {63, 65}, {64, 64}, {80, 33}, {17, 80}};
    static const int32_t counts[] = {0, 1, 2, 5, 40, 400};
    for (int32_t threads = 1; threads <= 3; threads += 2) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *context;
        desc.thread_count = threads;
        assert_ok(dpl_context_create(&desc, &context));
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
            for (size_t n = 0; n < sizeof counts / sizeof counts[0]; n++)
                assert_exact(context, sizes[s][0], sizes[s][1], counts[n], (uint32_t)(s * 10 + n));
        dpl_context_destroy(context);
    }
}

static void a_long_strip_does_not_overflow(void **state) {
    (void)state;
    static float distance[16384];
    dpl_context *context;
    dpl_field *field;
    assert_ok(dpl_context_create(NULL, &context));
    for (int turn = 0; turn < 2; turn++) {
        dpl_field_desc desc = dpl_field_desc_default();
        desc.width = turn ? 1 : 16384;
        desc.height = turn ? 16384 : 1;
        assert_ok(dpl_field_create(context, &desc, &field));
        assert_ok(dpl_field_read_distance(field, distance, 0));
        for (int i = 0; i < 16384; i++)
            assert_true(distance[i] >= 16385.0f && distance[i] < 50000.0f);
        dpl_shape dot = dpl_shape_default(DPL_SHAPE_DISC);
        dot.disc = (dpl_disc){{0.5, 0.5}, 0.0};
        assert_ok(dpl_field_draw_shapes(field, &dot, 1));
        assert_ok(dpl_field_read_distance(field, distance, 0));
        for (int i = 0; i < 16384; i++)
            assert_true(distance[i] == (float)i);
        dpl_field_destroy(field);
    }
    dpl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_equal_brute_force),
        cmocka_unit_test(a_long_strip_does_not_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
