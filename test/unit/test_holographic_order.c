/* What of the holographic solver's work is too large for a cache is cut: strips are half as wide, wedges are
 * cut in two again and again. That is an order of work, and no bit of the light depends on it. */
#include "holographic.h"

#include "holographic/holographic.h"
#include "world.h"

/* Axes of 9 and of 6 levels, walls and lamps in fog. */
enum { WIDTH = 300, HEIGHT = 47, THINGS = 30 };

static dpl_field *make_field(void) {
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    uint32_t seed = 7;
    for (int i = 0; i < THINGS; i++) {
        double x = dpl_test_random(&seed, 0, WIDTH), y = dpl_test_random(&seed, 0, HEIGHT);
        dpl_material material = i % 3 == 0   ? truth_wall(2.0, 0.0)
                                : i % 3 == 1 ? truth_wall(0.0, 0.0)
                                             : hrc_fog(0.5, 0.1, 0.2, 0.05);
        truth_box(field, x, y, x + 1 + i % 7, y + 1 + i % 4, material);
    }
    hrc_set_sky(field, 0.1);
    return field;
}

/* The picture with wedges of at most so many bytes, and the level at which those along x are solved whole. */
static float *light_of(dpl_field *field, dpl_storage storage, size_t bytes, int32_t *level) {
    dpl_solver *solver = hrc_solver_in(context, storage);
    dpl_hrc *hrc = (dpl_hrc *)solver;
    hrc->layout.wedge_bytes = bytes;
    float *rgb = hrc_solve_with(solver, field);
    *level = hrc->layout.axes[0].wedge_level;
    dpl_solver_destroy(solver);
    return rgb;
}

static void cut_wedges_give_the_bits_of_whole_ones(void **state) {
    (void)state;
    dpl_field *field = make_field();
    static const size_t limits[] = {1 << 17, 1 << 16, 1 << 15, 0};
    for (int storage = DPL_STORAGE_FLOAT; storage <= DPL_STORAGE_HALF; storage++) {
        int32_t level, before = DPL_HRC_STRIP_LEVEL;
        float *whole = light_of(field, (dpl_storage)storage, SIZE_MAX, &level);
        assert_int_equal(level, DPL_HRC_STRIP_LEVEL);
        for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
            float *cut = light_of(field, (dpl_storage)storage, limits[i], &level);
            assert_true(level >= before);
            assert_memory_equal(cut, whole, hrc_values(field) * sizeof *whole);
            before = level;
            free(cut);
        }
        assert_int_equal(level, 8); /* the highest that has wedges */
        free(whole);
    }
    dpl_field_destroy(field);
}

/* The picture with strips as wide as `bytes` allow. */
static float *light_of_strips(dpl_field *field, dpl_storage storage, size_t bytes, int32_t level) {
    dpl_solver *solver = hrc_solver_in(context, storage);
    dpl_hrc *hrc = (dpl_hrc *)solver;
    hrc->layout.strip_bytes = bytes;
    float *rgb = hrc_solve_with(solver, field);
    assert_int_equal(hrc->layout.axes[0].strip_level, level);
    assert_int_equal(hrc->layout.axes[1].strip_level, level);
    dpl_solver_destroy(solver);
    return rgb;
}

static void narrow_strips_give_the_bits_of_wide_ones(void **state) {
    (void)state;
    dpl_field *field = make_field();
    for (int storage = DPL_STORAGE_FLOAT; storage <= DPL_STORAGE_HALF; storage++) {
        float *wide = light_of_strips(field, (dpl_storage)storage, SIZE_MAX, DPL_HRC_STRIP_LEVEL),
              *narrow = light_of_strips(field, (dpl_storage)storage, 0, DPL_HRC_STRIP_LEVEL - 1);
        assert_memory_equal(narrow, wide, hrc_values(field) * sizeof *wide);
        free(wide);
        free(narrow);
    }
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_wedges_give_the_bits_of_whole_ones),
        cmocka_unit_test(narrow_strips_give_the_bits_of_wide_ones),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
