/* The holographic solver with half storage: what it costs in accuracy, what it saves in memory, and that
 * light which no half can hold does no harm. */
#include "holographic.h"
#include "world.h"

static void halves_are_as_good_as_floats(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= 6; seed++) {
        dpl_field *field = dpl_test_world(context, 120, 90, seed, seed % 2);
        float *floats = hrc_solve(field, DPL_STORAGE_FLOAT), *halves = hrc_solve(field, DPL_STORAGE_HALF);
        print_message("%g\n", hrc_error(field, halves, floats));
        free(floats);
        free(halves);
        dpl_field_destroy(field);
    }
}

/* Half a step below 1, which is what a half's transmittance can be wrong by, is 2^-12: fog that takes little
 * more than that on half of a pixel is rounded to take more or less, and gives light all the same. */
static void thin_fog(void **state) {
    (void)state;
    static const double extinctions[] = {0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.03, 0.1, 1.0};
    for (size_t i = 0; i < sizeof extinctions / sizeof extinctions[0]; i++) {
        dpl_field *field = truth_field(100, 100, 0);
        hrc_set_sky(field, 0.7);
        truth_box(field, 0, 0, 100, 100, hrc_fog(0.7, extinctions[i], extinctions[i], extinctions[i]));
        float *rgb = hrc_solve(field, DPL_STORAGE_HALF);
        double worst = 0.0;
        for (size_t k = 0; k < hrc_values(field); k++)
            worst = fmax(worst, fabs((double)rgb[k] / 0.7 - 1.0));
        print_message("%g: %g\n", extinctions[i], worst);
        free(rgb);
        dpl_field_destroy(field);
    }
}

static void lamps(void **state) {
    (void)state;
    static const double emissions[] = {1e-8, 5e-8,    1e-7,    1e-6, 1e-5, 1e-4,
                                       1.0,  60000.0, 65504.0, 1e9,  1e30, 3e38};
    for (size_t i = 0; i < sizeof emissions / sizeof emissions[0]; i++) {
        dpl_field *field = truth_field(50, 50, 0);
        truth_box(field, 20, 20, 30, 26, truth_wall(emissions[i], 0.0));
        truth_box(field, 5, 30, 45, 31, truth_wall(0, 0.0));
        float *floats = hrc_solve(field, DPL_STORAGE_FLOAT), *halves = hrc_solve(field, DPL_STORAGE_HALF);
        double most = 0, mostf = 0;
        int bad = 0, badf = 0;
        for (size_t k = 0; k < hrc_values(field); k++) {
            most = fmax(most, (double)halves[k]);
            mostf = fmax(mostf, (double)floats[k]);
            bad += !isfinite(halves[k]);
            badf += !isfinite(floats[k]);
        }
        print_message("%g: rel %g most %g %g bad %d %d\n", emissions[i], hrc_error(field, halves, floats),
                      most, mostf, bad, badf);
        free(floats);
        free(halves);
        dpl_field_destroy(field);
    }
}

static void memory(void **state) {
    (void)state;
    for (int media = 0; media < 2; media++) {
        dpl_solver_stats stats[2];
        for (int storage = 0; storage < 2; storage++) {
            dpl_field *field = dpl_test_world(context, 256, 200, 3, media);
            dpl_solver *solver = hrc_solver_in(context, (dpl_storage)storage);
            free(hrc_solve_with(solver, field));
            dpl_solver_read_stats(solver, &stats[storage]);
            dpl_solver_destroy(solver);
            dpl_field_destroy(field);
        }
        print_message("%g\n", (double)stats[1].memory_bytes / (double)stats[0].memory_bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(halves_are_as_good_as_floats),
        cmocka_unit_test(thin_fog),
        cmocka_unit_test(lamps),
        cmocka_unit_test(memory),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
