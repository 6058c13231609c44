/* Every instruction set equals the scalar reference bit for bit: random and adversarial inputs, every count
 * around a vector's width, guard bands behind the end. Sets that this machine lacks are not tested here; the
 * names of those that were are printed. */
#include "testing.h"

#include "kernel/kernel.h"
#include "os/machine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 70, GUARD = 24, WIDTH = 53, HEIGHT = 37 };

#define GUARD_VALUE (-12345.0f)

static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0] };

static uint32_t seed = 1;

static float random_between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(low + (high - low) * (seed >> 8) / 16777216.0);
}

/* Calls `test` with the table of every instruction set that can run here. */
static void for_each_isa(void (*test)(const dpl_kernels *kernels)) {
    for (int i = 0; i < ISA_COUNT; i++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
        if (!kernels)
            continue;
        assert_int_equal(kernels->isa, isas[i]);
        print_message("%s\n", dpl_isa_name(isas[i]));
        test(kernels);
    }
}

/* ---- marches -------------------------------------------------------------------------------------- */

typedef struct world {
    float clearance[HEIGHT * WIDTH];
    float emission[HEIGHT * WIDTH][4];
    float extinction[HEIGHT * WIDTH][4];
    float surface[HEIGHT * WIDTH][4];
} world;

static int nearest_squared(const uint8_t *kind, int x, int y) {
    int nearest = 100000;
    for (int i = 0; i < HEIGHT * WIDTH; i++) {
        int dx = i % WIDTH - x, dy = i / WIDTH - y;
        if (kind[i] && dx * dx + dy * dy < nearest)
            nearest = dx * dx + dy * dy;
    }
    return nearest;
}

/* Walls, lamps and media by chance, with clearances that are true; and a surface of a few discs. */
static void fill_world(world *w, double density) {
    static uint8_t kind[HEIGHT * WIDTH];
    for (int i = 0; i < HEIGHT * WIDTH; i++) {
        float chance = random_between(0, 1);
        kind[i] = chance < (float)density ? 2 : chance < 1.5f * (float)density ? 1 : 0;
    }
    for (int i = 0; i < HEIGHT * WIDTH; i++) {
        int x = i % WIDTH, y = i / WIDTH;
        w->clearance[i] = kind[i] == 2   ? -1.0f
                          : kind[i] == 1 ? 0.0f
                                         : sqrtf((float)nearest_squared(kind, x, y));
        for (int c = 0; c < 3; c++) {
            w->emission[i][c] = random_between(0, 3);
            w->extinction[i][c] = c == 2 && i % 5 == 0 ? DPL_EXTINCTION_MAX : random_between(0, 2);
            w->surface[i][1 + c] = random_between(0, 2);
        }
        float near = 1000.0f;
        for (int d = 0; d < 4; d++)
            near = fminf(near, hypotf((float)(x - 11 * d), (float)(y - 8 * d)) - 3.0f);
        w->surface[i][0] = near;
    }
}

/* Segments of every awkward kind: none, along an axis, through corners, from outside, past the picture, long.
 * Every other time they all begin in the picture, some on its edge: kernels have a short way for those. */
static void fill_segments(float ends[4][MOST]) {
    static int calls;
    bool all_inside = calls++ % 2 == 1;
    for (int i = 0; i < MOST; i++) {
        float x = random_between(-20, WIDTH + 20), y = random_between(-20, HEIGHT + 20);
        float dx = random_between(-80, 80), dy = random_between(-80, 80);
        int kind = i % 8;
        if (kind == 0)
            dx = 0.0f;
        if (kind == 1)
            dy = 0.0f;
        if (kind == 2)
            dx = dy = 0.0f;
        if (kind == 3) { /* from a pixel's centre along the diagonal, through corners */
            x = floorf(x) + 0.5f;
            y = floorf(y) + 0.5f;
            dy = i % 16 < 8 ? dx : -dx;
        }
        if (kind == 4) { /* from a corner along a grid line */
            x = floorf(x);
            y = floorf(y);
            dx = 0.0f;
        }
        if (kind == 5) {
            dx *= 0.01f;
            dy *= 0.01f;
        }
        if (kind == 6)
            dx *= 300.0f;
        if (all_inside) {
            x = fminf(fmaxf(x, 0.0f), WIDTH);
            y = fminf(fmaxf(y, 0.0f), HEIGHT);
        }
        ends[0][i] = x;
        ends[1][i] = y;
        ends[2][i] = x + dx;
        ends[3][i] = y + dy;
    }
}

typedef float march_result[6][MOST + GUARD];

static void run_march(void (*march)(const dpl_grid *, const dpl_segments *, const dpl_intervals *),
                      const dpl_grid *grid, float ends[4][MOST], int32_t count, march_result out) {
    for (int p = 0; p < 6; p++)
        for (int i = 0; i < MOST + GUARD; i++)
            out[p][i] = GUARD_VALUE;
    dpl_segments segments = {count, ends[0], ends[1], ends[2], ends[3]};
    dpl_intervals intervals = {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
    march(grid, &segments, &intervals);
}

static void assert_same_march(const dpl_kernels *kernels) {
    static world w;
    static float ends[4][MOST];
    static march_result expected, found;
    const dpl_kernels *ref = &dpl_kernels_ref;
    const dpl_grid grid = {WIDTH,
                           HEIGHT,
                           w.clearance,
                           (const float(*)[4])w.emission,
                           (const float(*)[4])w.extinction,
                           (const float(*)[4])w.surface};
    static const double densities[] = {0.0, 0.002, 0.02, 0.2, 0.6};
    int hits = 0, misses = 0;
    for (int round = 0; round < 40; round++) {
        fill_world(&w, densities[round % 5]);
        fill_segments(ends);
        int32_t count = round < 8 ? MOST : round + 1;
        run_march(ref->march, &grid, ends, count, expected);
        run_march(kernels->march, &grid, ends, count, found);
        assert_memory_equal(expected, found, sizeof expected);
        for (int32_t i = 0; i < count; i++) {
            hits += expected[3][i] == 0.0f;
            misses += expected[3][i] == 1.0f;
        }
        run_march(ref->march_surface, &grid, ends, count, expected);
        run_march(kernels->march_surface, &grid, ends, count, found);
        assert_memory_equal(expected, found, sizeof expected);
    }
    assert_true(hits > 100 && misses > 100); /* both were there to compare */
}

static void every_march_equals_the_reference(void **state) {
    (void)state;
    for_each_isa(assert_same_march);
}

/* More rays than fly together, and no whole number of vectors. */
enum { MANY = 1301 };

static void assert_same_march_of_many(const dpl_kernels *kernels) {
    static world w;
    static float ends[4][MANY], expected[6][MANY], found[6][MANY];
    fill_world(&w, 0.05);
    for (int i = 0; i < MANY; i++)
        for (int e = 0; e < 4; e++)
            ends[e][i] = random_between(-10, e % 2 == 0 ? WIDTH + 10 : HEIGHT + 10);
    dpl_segments segments = {MANY, ends[0], ends[1], ends[2], ends[3]};
    for (int media = 0; media < 2; media++) {
        dpl_grid grid = {.width = WIDTH,
                         .height = HEIGHT,
                         .clearance = w.clearance,
                         .emission = (const float(*)[4])w.emission,
                         .extinction = media ? (const float(*)[4])w.extinction : NULL};
        for (int i = 0; i < HEIGHT * WIDTH && !media; i++)
            w.clearance[i] = w.clearance[i] == 0.0f ? -1.0f : w.clearance[i];
        dpl_kernels_ref.march(&grid, &segments,
                              &(dpl_intervals){{expected[0], expected[1], expected[2]},
                                               {expected[3], expected[4], expected[5]}});
        kernels->march(&grid, &segments,
                       &(dpl_intervals){{found[0], found[1], found[2]}, {found[3], found[4], found[5]}});
        assert_memory_equal(expected, found, sizeof expected);
        fill_world(&w, 0.05); /* with media, for the second time */
    }
}

static void a_march_of_many_rays_equals_the_reference(void **state) {
    (void)state;
    for_each_isa(assert_same_march_of_many);
}

/* Walls alone: what march_to_cell() is for. */
static void remove_media(world *w) {
    for (int i = 0; i < HEIGHT * WIDTH; i++)
        if (w->clearance[i] == 0.0f)
            w->clearance[i] = -1.0f;
}

static void assert_same_cells(const dpl_kernels *kernels) {
    static world w;
    static float ends[4][MOST];
    static march_result light;
    static int32_t expected[MOST + GUARD], found[MOST + GUARD];
    const dpl_grid grid = {.width = WIDTH,
                           .height = HEIGHT,
                           .clearance = w.clearance,
                           .emission = (const float(*)[4])w.emission};
    static const double densities[] = {0.0, 0.002, 0.02, 0.2, 0.6};
    for (int round = 0; round < MOST + 10; round++) {
        fill_world(&w, densities[round % 5]);
        remove_media(&w);
        fill_segments(ends);
        int32_t count = round < 10 ? MOST : round - 9;
        for (int i = 0; i < MOST + GUARD; i++)
            expected[i] = found[i] = -7;
        dpl_segments segments = {count, ends[0], ends[1], ends[2], ends[3]};
        dpl_kernels_ref.march_to_cell(&grid, &segments, expected);
        kernels->march_to_cell(&grid, &segments, found);
        assert_memory_equal(expected, found, sizeof expected);
        run_march(dpl_kernels_ref.march, &grid, ends, count, light);
        for (int32_t i = 0; i < count; i++) { /* the light of march() is that of the cell */
            assert_true((light[3][i] == 0.0f) == (found[i] >= 0));
            assert_true(light[0][i] == (found[i] >= 0 ? w.emission[found[i]][0] : 0.0f));
        }
    }
}

static void marching_to_a_cell_equals_the_reference_and_march(void **state) {
    (void)state;
    for_each_isa(assert_same_cells);
}

/* No march within a strip that is swept empty hits anything: neither along it nor between any of its sides.
 */
static void assert_nothing_in_strip(const dpl_grid *grid, const dpl_strips *strips, int32_t i) {
    float x0 = strips->axis.x0[i], y0 = strips->axis.y0[i], x1 = strips->axis.x1[i], y1 = strips->axis.y1[i];
    float length = hypotf(x1 - x0, y1 - y0), nx = length > 0 ? (y0 - y1) / length : 0.0f,
          ny = length > 0 ? (x1 - x0) / length : 0.0f;
    for (int k = 0; k < 12; k++) {
        float a = random_between(-1, 1) * strips->width0[i], b = random_between(-1, 1) * strips->width1[i];
        float ends[4] = {x0 + a * nx, y0 + a * ny, x1 + b * nx, y1 + b * ny};
        dpl_segments ray = {1, &ends[0], &ends[1], &ends[2], &ends[3]};
        int32_t cell;
        dpl_kernels_ref.march_to_cell(grid, &ray, &cell);
        assert_int_equal(cell, -1);
    }
}

static void assert_same_sweep(const dpl_kernels *kernels) {
    static world w;
    static float ends[4][MOST], width[2][MOST], expected[MOST + GUARD], found[MOST + GUARD];
    const dpl_grid grid = {.width = WIDTH, .height = HEIGHT, .clearance = w.clearance};
    const dpl_clearances planes[] = {{WIDTH, HEIGHT, w.clearance, 1, 0.8f},
                                     {WIDTH, HEIGHT, &w.surface[0][0], 4, 4.0f}};
    static const double densities[] = {0.0, 0.002, 0.02};
    int empty = 0, blocked = 0;
    for (int round = 0; round < MOST + 10; round++) {
        fill_world(&w, densities[round % 3]);
        remove_media(&w);
        fill_segments(ends);
        for (int i = 0; i < MOST; i++)
            for (int p = 0; p < 2; p++)
                width[p][i] = random_between(0, i % 3 ? 2 : 9);
        int32_t count = round < 10 ? MOST : round - 9;
        dpl_strips strips = {{count, ends[0], ends[1], ends[2], ends[3]}, width[0], width[1]};
        for (int p = 0; p < 2; p++) {
            for (int i = 0; i < MOST + GUARD; i++)
                expected[i] = found[i] = GUARD_VALUE;
            dpl_kernels_ref.sweep(&planes[p], &strips, expected);
            kernels->sweep(&planes[p], &strips, found);
            assert_memory_equal(expected, found, sizeof expected);
            for (int32_t i = 0; i < count && p == 0; i++) {
                assert_true(found[i] >= 0.0f && found[i] <= 1.0f);
                empty += found[i] == 1.0f;
                blocked += found[i] < 1.0f;
                if (found[i] == 1.0f && round % 4 == 0)
                    assert_nothing_in_strip(&grid, &strips, i);
            }
        }
    }
    assert_true(empty > 100 && blocked > 100);
}

static void sweeping_equals_the_reference_and_never_finds_more_than_there_is(void **state) {
    (void)state;
    for_each_isa(assert_same_sweep);
}

/* ---- loops ---------------------------------------------------------------------------------------- */

/* Adds light of rays in a row to sums of three channels, as `sums` says, behind which nothing may change. */
static void add_to_rows(const dpl_kernels *kernels, dpl_probe_sums sums, const dpl_parents *parents,
                        const dpl_intervals *intervals, const uint64_t *hits, float rows[3][MOST + GUARD]) {
    for (int c = 0; c < 3; c++) {
        sums.sum[c] = rows[c];
        for (int i = 0; i < MOST + GUARD; i++)
            rows[c][i] = i < sums.count ? (float)(i % 11) : GUARD_VALUE;
    }
    if (intervals)
        kernels->merge(&sums, parents, intervals);
    else
        kernels->merge_hits(&sums, parents, hits);
}

static void assert_same_merge(const dpl_kernels *kernels) {
    enum { PARENTS = MOST / 2 + 3 + DPL_PARENTS_SPARE };
    static float in[6][MOST], rows[2][3][PARENTS], expected[3][MOST + GUARD], found[3][MOST + GUARD];
    uint64_t hits[MOST / 64 + 1] = {0};
    for (int i = 0; i < MOST; i++)
        for (int p = 0; p < 6; p++)
            in[p][i] = i % 7 == p ? 0.0f : random_between(0, p < 3 ? 1e6 : 1.0);
    for (int i = 0; i < PARENTS; i++)
        for (int c = 0; c < 3; c++)
            for (int r = 0; r < 2; r++)
                rows[r][c][i] = i % 5 == r ? 0.0f : random_between(0, 1e6);
    for (int i = 0; i < MOST; i++)
        if (random_between(0, 1) < 0.25f)
            hits[i / 64] |= (uint64_t)1 << i % 64;
    const dpl_intervals intervals = {{in[0], in[1], in[2]}, {in[3], in[4], in[5]}};
    for (dpl_parents_seen seen = DPL_PARENTS_FOUR; seen <= DPL_PARENT_SAME; seen++)
        for (int32_t count = 0; count <= MOST; count++) {
            const dpl_parents parents = {seen, 0.25f, rows[0][0], rows[1][0], PARENTS};
            const dpl_probe_sums sums = {.count = count, .weight = {0.1875f, 0.0625f}};
            for (int known = 0; known < 2; known++) {
                const dpl_intervals *met = known ? NULL : &intervals;
                add_to_rows(&dpl_kernels_ref, sums, &parents, met, hits, expected);
                add_to_rows(kernels, sums, &parents, met, hits, found);
                assert_memory_equal(expected, found, sizeof expected);
            }
        }
}

static void merging_equals_the_reference(void **state) {
    (void)state;
    for_each_isa(assert_same_merge);
}

/* Rows of parents end with the last that is read: nothing behind it may be touched. */
static void assert_same_spread(const dpl_kernels *kernels) {
    static float expected[MOST + GUARD], found[MOST + GUARD];
    for (int32_t count = 1; count <= MOST; count++) {
        int32_t parents = count / 2 + 2;
        float *rows[2] = {malloc((size_t)parents * sizeof(float)), malloc((size_t)parents * sizeof(float))};
        assert_true(rows[0] && rows[1]);
        for (int i = 0; i < parents; i++)
            for (int r = 0; r < 2; r++)
                rows[r][i] = i % 5 == r ? 0.0f : random_between(0, 1e6);
        for (int i = 0; i < MOST + GUARD; i++)
            expected[i] = found[i] = GUARD_VALUE;
        dpl_kernels_ref.spread(count, expected, rows[0], rows[1], 0.25f);
        kernels->spread(count, found, rows[0], rows[1], 0.25f);
        assert_memory_equal(expected, found, sizeof expected);
        free(rows[0]);
        free(rows[1]);
    }
}

static void spreading_equals_the_reference(void **state) {
    (void)state;
    for_each_isa(assert_same_spread);
}

static void assert_same_distance(const dpl_kernels *kernels) {
    static int32_t before[MOST], expected[MOST + GUARD], found[MOST + GUARD];
    static uint8_t occupied[MOST];
    for (int32_t count = 0; count <= MOST; count++) {
        for (int i = 0; i < MOST; i++) {
            before[i] = (int32_t)random_between(0, 40000);
            occupied[i] = (uint8_t)(random_between(0, 1) < 0.3f ? 1 + i % 2 : 0);
        }
        for (int i = 0; i < MOST + GUARD; i++)
            expected[i] = found[i] = -7;
        dpl_kernels_ref.distance_down(count, expected, occupied, before);
        kernels->distance_down(count, found, occupied, before);
        assert_memory_equal(expected, found, sizeof expected);
        for (int i = 0; i < MOST; i++)
            before[i] = (int32_t)random_between(0, 40000);
        dpl_kernels_ref.distance_up(count, expected, before);
        kernels->distance_up(count, found, before);
        assert_memory_equal(expected, found, sizeof expected);
    }
}

static void distances_equal_the_reference(void **state) {
    (void)state;
    for_each_isa(assert_same_distance);
}

static void assert_same_tonemap(const dpl_kernels *kernels) {
    static const float odd[] = {0.0f, -0.0f, -1.0f, 1e-30f, 1e30f, 3e38f, INFINITY, -INFINITY, NAN, 65504.0f};
    static float in[MOST];
    static uint8_t expected[MOST + GUARD], found[MOST + GUARD];
    for (int32_t count = 0; count <= MOST; count++) {
        for (int i = 0; i < MOST; i++)
            in[i] = i < 10 ? odd[i] : random_between(0, i % 3 ? 1.0 : 20.0);
        memset(expected, 99, sizeof expected);
        memset(found, 99, sizeof found);
        dpl_kernels_ref.tonemap(count, expected, in);
        kernels->tonemap(count, found, in);
        assert_memory_equal(expected, found, sizeof expected);
    }
}

static void tone_mapping_equals_the_reference(void **state) {
    (void)state;
    for_each_isa(assert_same_tonemap);
}

static void assert_same_range(const dpl_kernels *kernels) {
    static const float odd[] = {-1.0f, -1e-40f, 1.0000001f, INFINITY, -INFINITY, NAN};
    static float in[MOST];
    for (int32_t count = 0; count < MOST; count++) {
        for (int i = 0; i < MOST; i++)
            in[i] = i >= count ? NAN : i % 5 == 0 ? -0.0f : i % 5 == 1 ? 1.0f : random_between(0, 1);
        assert_true(dpl_kernels_ref.all_within(count, in, 1.0f));
        assert_true(kernels->all_within(count, in, 1.0f));
        for (int k = 0; k < 6 * count; k++) { /* one value at one place */
            float kept = in[k / 6];
            in[k / 6] = odd[k % 6];
            assert_false(dpl_kernels_ref.all_within(count, in, 1.0f));
            assert_false(kernels->all_within(count, in, 1.0f));
            assert_int_equal(kernels->all_within(count, in, INFINITY), k % 6 == 2 || k % 6 == 3);
            in[k / 6] = kept;
        }
    }
}

static void a_value_out_of_range_is_found_wherever_it_is(void **state) {
    (void)state;
    for_each_isa(assert_same_range);
}

static void the_best_set_of_a_mask_is_chosen(void **state) {
    (void)state;
    uint32_t available = dpl_kernels_available();
    assert_true(available & DPL_ISA_SCALAR);
    assert_int_equal(dpl_kernels_select(DPL_ISA_SCALAR)->isa, DPL_ISA_SCALAR);
    assert_null(dpl_kernels_select(0));
    dpl_isa best = DPL_ISA_SCALAR;
    for (int i = 0; i < ISA_COUNT; i++)
        if (available & (uint32_t)isas[i])
            best = isas[i];
    assert_int_equal(dpl_kernels_select(DPL_ISA_ALL)->isa, best);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_march_equals_the_reference),
        cmocka_unit_test(a_march_of_many_rays_equals_the_reference),
        cmocka_unit_test(marching_to_a_cell_equals_the_reference_and_march),
        cmocka_unit_test(sweeping_equals_the_reference_and_never_finds_more_than_there_is),
        cmocka_unit_test(merging_equals_the_reference),
        cmocka_unit_test(spreading_equals_the_reference),
        cmocka_unit_test(distances_equal_the_reference),
        cmocka_unit_test(tone_mapping_equals_the_reference),
        cmocka_unit_test(a_value_out_of_range_is_found_wherever_it_is),
        cmocka_unit_test(the_best_set_of_a_mask_is_chosen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
