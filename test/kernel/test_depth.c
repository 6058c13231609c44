/* The kernel that classifies receivers by a map of depths: every instruction set equals the scalar reference
 * bit for bit, and that one says what a step in depth says. */
#include "testing.h"

#include "kernel/kernel.h"

#include <math.h>
#include <string.h>

static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0], SIZE = 100, PAIRS = 2 * SIZE * SIZE, ROUNDS = 130 };

static uint32_t seed = 7;

static float random_between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(low + (high - low) * (seed >> 8) / 16777216.0);
}

static float ranges[PAIRS][2];

static float least(float a, float b) {
    return a < b ? a : b;
}

static float most(float a, float b) {
    return a > b ? a : b;
}

/* From the depths in level 0 to all other levels. */
static void build_levels(dpl_depth_view *view) {
    int32_t first = 0, side = SIZE;
    for (int level = 0;; level++) {
        view->first[level] = first;
        view->side[level] = side;
        if (side == 1)
            return;
        int32_t next = first + side * side, half = (side + 1) / 2;
        for (int32_t i = 0; i < half * half; i++) {
            ranges[next + i][0] = INFINITY;
            ranges[next + i][1] = -INFINITY;
        }
        for (int32_t y = 0; y < side; y++)
            for (int32_t x = 0; x < side; x++) {
                const float *from = ranges[first + y * side + x];
                float *to = ranges[next + y / 2 * half + x / 2];
                to[0] = least(to[0], from[0]);
                to[1] = most(to[1], from[1]);
            }
        first = next;
        side = half;
    }
}

/* From 10 above the origin down: 50 texels are a tangent of 1/2, or a length of 5. */
static dpl_depth_view view_down(bool parallel) {
    dpl_depth_view view = {.eye = {0.0f, 10.0f, 0.0f},
                           .axis = {{1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, -1.0f, 0.0f}},
                           .parallel = parallel,
                           .scale = parallel ? 10.0f : 100.0f,
                           .near = 4.0f,
                           .steepest = 0.75f,
                           .cone_cosine = 0.9f,
                           .light = parallel ? 0.05f : 0.5f,
                           .size = SIZE,
                           .ranges = ranges[0]};
    return view;
}

/* A blocker at depth 6 over x < 0, nothing elsewhere. */
static void fill_step(dpl_depth_view *view) {
    for (int32_t i = 0; i < SIZE * SIZE; i++)
        ranges[i][0] = ranges[i][1] = i % SIZE < SIZE / 2 ? 6.0f : INFINITY;
    build_levels(view);
}

/* Pieces of all sizes. */
static void fill_by_chance(dpl_depth_view *view) {
    for (int32_t i = 0; i < SIZE * SIZE; i++)
        ranges[i][0] = ranges[i][1] = INFINITY;
    for (int k = 0; k < 12; k++) {
        int32_t x = (int32_t)random_between(0, SIZE), y = (int32_t)random_between(0, SIZE);
        int32_t wide = (int32_t)random_between(1, 40), high = (int32_t)random_between(1, 40);
        float depth = random_between(4.5, 9.9), slope = random_between(0.0, 0.01);
        for (int32_t j = y; j < y + high && j < SIZE; j++)
            for (int32_t i = x; i < x + wide && i < SIZE; i++)
                ranges[j * SIZE + i][0] = ranges[j * SIZE + i][1] = depth + slope * (float)(i - x);
    }
    build_levels(view);
}

static void place(dpl_depth_receivers *r, int32_t i, float x, float y, float z) {
    float position[3] = {x, y, z}, normal[3] = {0.0f, 1.0f, 0.0f};
    for (int axis = 0; axis < 3; axis++) {
        r->position[axis][i] = position[axis];
        r->normal[axis][i] = normal[axis];
    }
    r->count = i + 1;
}

static void scatter(dpl_depth_receivers *r, int32_t count) {
    memset(r, 0, sizeof *r);
    for (int32_t i = 0; i < count; i++) {
        place(r, i, random_between(-7, 7), random_between(-1, 7), random_between(-7, 7));
        if (i % 5 == 1) /* tilted, some turned away, some without a normal */
            for (int axis = 0; axis < 3; axis++)
                r->normal[axis][i] = i % 10 == 1 ? 0.0f : random_between(-0.577, 0.577);
        if (i % 31 == 7)
            r->position[i % 3][i] = NAN;
        if (i % 31 == 9)
            r->position[1][i] = 10.0f; /* where the light is */
        if (i % 31 == 11)
            r->position[2][i] = 1e30f;
    }
}

/* Results of receivers that are in view. */
static void assert_same(const dpl_depth_receivers *a, const dpl_depth_receivers *b) {
    assert_memory_equal(a->class, b->class, (size_t)a->count * sizeof a->class[0]);
    for (int32_t i = 0; i < a->count; i++) {
        if (a->class[i] == DPL_DEPTH_OUTSIDE)
            continue;
        assert_int_equal(a->rising[i], b->rising[i]);
        const float *of_a[] = {a->u, a->v, a->depth, a->stretch, a->slope, a->near};
        const float *of_b[] = {b->u, b->v, b->depth, b->stretch, b->slope, b->near};
        for (int k = 0; k < 6; k++)
            assert_memory_equal(&of_a[k][i], &of_b[k][i], sizeof(float));
    }
}

static void every_instruction_set_finds_the_same_classes(void **state) {
    (void)state;
    static dpl_depth_receivers expected, found;
    int64_t counts[4] = {0};
    for (int round = 0; round < ROUNDS; round++) {
        dpl_depth_view view = view_down(round % 2);
        fill_by_chance(&view);
        scatter(&expected, round % (DPL_DEPTH_MOST + 1));
        found = expected;
        dpl_kernels_ref.classify(&view, &expected);
        for (int32_t i = 0; i < expected.count; i++)
            counts[expected.class[i]]++;
        for (int i = 0; i < ISA_COUNT; i++) {
            const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
            if (!kernels)
                continue;
            kernels->classify(&view, &found);
            assert_same(&expected, &found);
        }
    }
    for (int kind = 0; kind < 4; kind++)
        assert_true(counts[kind] > 20);
}

/* At y = 0 under a light of radius 1/2 at 10, behind an edge at 4: the penumbra is 2/3 * 1/2 to both sides.
 */
static void a_step_leaves_only_its_penumbra_open(void **state) {
    (void)state;
    static dpl_depth_receivers r;
    dpl_depth_view view = view_down(false);
    fill_step(&view);
    for (int32_t i = 0; i < DPL_DEPTH_MOST; i++)
        place(&r, i, -3.0f + 6.0f * (float)i / (float)(DPL_DEPTH_MOST - 1), 0.0f, 0.03f);
    dpl_kernels_ref.classify(&view, &r);
    for (int32_t i = 0; i < DPL_DEPTH_MOST; i++) {
        float x = r.position[0][i];
        if (fabsf(x) < 0.33f)
            assert_int_equal(r.class[i], DPL_DEPTH_OPEN);
        if (fabsf(x) > 0.9f) /* texels of 1/10 are read by fours */
            assert_int_equal(r.class[i], x < 0.0f ? DPL_DEPTH_DARK : DPL_DEPTH_LIT);
        assert_int_equal(r.rising[i], -1);
        assert_true(fabsf(r.depth[i] - 10.0f) < 1e-5f && fabsf(r.u[i] - (50.0f + 10.0f * x)) < 1e-3f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_finds_the_same_classes),
        cmocka_unit_test(a_step_leaves_only_its_penumbra_open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
