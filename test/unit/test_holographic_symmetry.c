/* The holographic solver favours no direction: a world turned and mirrored in any of eight ways gives the
 * same light, turned and mirrored, up to the rounding of sums. */
#include "holographic.h"

#include "world.h"

enum { MOST = 70 };

/* Where pixel (x, y) of a square world goes. */
static size_t turned(int32_t size, int symmetry, int32_t x, int32_t y) {
    int32_t a = symmetry & 1 ? size - 1 - x : x, b = symmetry & 2 ? size - 1 - y : y;
    return (size_t)(symmetry & 4 ? a * size + b : b * size + a);
}

typedef struct square {
    float emission[MOST * MOST][3];
    float extinction[MOST * MOST];
} square;

static void fill(square *w, int32_t size, uint32_t seed) {
    memset(w, 0, sizeof *w);
    for (int i = 0; i < 24; i++) {
        int32_t x = (int32_t)dpl_test_random(&seed, 0, size), y = (int32_t)dpl_test_random(&seed, 0, size);
        int32_t right = x + 1 + i % 3, bottom = y + 1 + i % 7;
        for (int32_t v = y; v < bottom && v < size; v++)
            for (int32_t u = x; u < right && u < size; u++) {
                w->extinction[v * size + u] = i % 5 == 4 ? 0.2f : INFINITY;
                for (int c = 0; c < 3; c++)
                    w->emission[v * size + u][c] = i % 4 ? 0.0f : 1.0f + (float)c;
            }
    }
}

static float *light_of(const square *w, int32_t size) {
    dpl_field *field = truth_field(size, size, 0);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){w->emission, DPL_FORMAT_F32, size, size, 3, 0};
    layer.extinction = (dpl_pixels){w->extinction, DPL_FORMAT_F32, size, size, 1, 0};
    layer.extinction_is_opacity = 0;
    assert_ok(dpl_field_draw_layer(field, &layer));
    hrc_set_sky(field, 0.1);
    float *rgb = hrc_solve(field, DPL_STORAGE_FLOAT);
    dpl_field_destroy(field);
    return rgb;
}

static void a_turned_world_gives_the_same_light_turned(void **state) {
    (void)state;
    static square plain, other;
    static const int32_t sizes[] = {2, 7, 16, 31, 33, 64, MOST};
    for (size_t n = 0; n < sizeof sizes / sizeof sizes[0]; n++) {
        int32_t size = sizes[n];
        fill(&plain, size, (uint32_t)n + 3);
        float *expected = light_of(&plain, size);
        for (int symmetry = 1; symmetry < 8; symmetry++) {
            for (int32_t i = 0; i < size * size; i++) {
                size_t to = turned(size, symmetry, i % size, i / size);
                memcpy(other.emission[to], plain.emission[i], sizeof other.emission[to]);
                other.extinction[to] = plain.extinction[i];
            }
            float *found = light_of(&other, size);
            for (int32_t i = 0; i < size * size; i++)
                for (size_t c = 0; c < 3; c++)
                    truth_assert_close((double)found[3 * turned(size, symmetry, i % size, i / size) + c],
                                       (double)expected[3 * (size_t)i + c], 2e-6);
            free(found);
        }
        free(expected);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turned_world_gives_the_same_light_turned),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
