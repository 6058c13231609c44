/* Triangles: rays through a hierarchy find what rays that ask every triangle find, bit for bit, and both find
 * what paper says. */
#include "bvh/triangle.h"
#include "world.h"

#include "shared_context.h"

#include <stdlib.h>

enum { MOST = 700, RAYS = 400 };

static float vertices[3 * MOST][3];

static float between(uint32_t *seed, double low, double high) {
    return (float)dpl_test_random(seed, low, high);
}

/* How a set of triangles is laid out. Half of each are as the name says, the rest anywhere. */
typedef enum layout {
    ANYWHERE,
    DUPLICATES, /* the same few triangles again and again */
    COPLANAR,   /* overlapping in the plane z = 0 */
    GRID,       /* corners on whole numbers, so rays meet edges and corners */
    SCALES,     /* from 1e-6 to 1e6 */
    DEGENERATE, /* points and lines */
    LAYOUTS
} layout;

static void place(layout how, int32_t count, uint32_t *seed) {
    for (int32_t i = 0; i < count; i++) {
        float(*v)[3] = &vertices[3 * i];
        double size = how == SCALES ? pow(10.0, dpl_test_random(seed, -6, 6)) : 1.0;
        double at[3] = {dpl_test_random(seed, -5, 5), dpl_test_random(seed, -5, 5),
                        dpl_test_random(seed, -5, 5)};
        for (int k = 0; k < 9; k++)
            v[k / 3][k % 3] = (float)(at[k % 3] + size * dpl_test_random(seed, -1, 1));
        if (i % 2 == 0)
            continue;
        if (how == DUPLICATES && i > 4)
            memcpy(v, vertices[3 * (i % 4)], sizeof(float[3][3]));
        for (int k = 0; k < 9 && how == GRID; k++)
            v[k / 3][k % 3] = roundf(v[k / 3][k % 3]);
        for (int k = 0; k < 3 && how == COPLANAR; k++)
            v[k][2] = 0.0f;
        if (how == DEGENERATE)
            memcpy(v[1], v[i % 4 == 1 ? 0 : 2], sizeof v[1]);
    }
}

/* Rays anywhere, along axes, through corners, from corners, and short ones. */
static dpl_ray random_ray(int32_t i, int32_t count, uint32_t *seed) {
    dpl_ray ray = {.far = i % 7 == 0 ? between(seed, 0, 5) : INFINITY};
    const float *corner = vertices[(int32_t)dpl_test_random(seed, 0, 3 * count - 1)];
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = between(seed, -8, 8);
        ray.direction[k] = i % 3 == 0 ? between(seed, -1, 1) : corner[k] - ray.origin[k];
        if (i % 5 == 0)
            ray.origin[k] = i % 10 == 0 ? roundf(ray.origin[k]) : corner[k];
        if (i % 4 == 1 && k != i / 4 % 3)
            ray.direction[k] = 0.0f;
    }
    return ray;
}

static dpl_triangles make(int32_t count, bool tree) {
    dpl_triangles set = {0};
    dpl_triangles_source source = {.vertices = (const float(*)[3])vertices, .count = count};
    assert_ok(dpl_triangles_set(context, &set, &source, tree));
    return set;
}

static int64_t compare_ways(int32_t count, uint32_t *seed) {
    dpl_triangles naive = make(count, false), sorted = make(count, true);
    dpl_walk_counts by_asking = {0}, by_walking = {0};
    int64_t hits = 0;
    for (int32_t i = 0; i < RAYS; i++) {
        dpl_ray ray = random_ray(i, count, seed);
        dpl_hit a = dpl_hit_none(), b = a;
        dpl_triangles_closest(&naive, &ray, &a, &by_asking);
        dpl_triangles_closest(&sorted, &ray, &b, &by_walking);
        assert_memory_equal(&a, &b, sizeof a);
        assert_int_equal(dpl_triangles_occluded(&naive, &ray, &by_asking), a.object >= 0);
        assert_int_equal(dpl_triangles_occluded(&sorted, &ray, &by_walking), a.object >= 0);
        hits += a.object >= 0;
    }
    assert_true(by_walking.object_tests <= by_asking.object_tests);
    dpl_triangles_free(context, &naive);
    dpl_triangles_free(context, &sorted);
    return hits;
}

static void naive_and_hierarchy_agree_bit_for_bit(void **state) {
    (void)state;
    static const int32_t counts[] = {1, 2, 3, 17, MOST};
    uint32_t seed = 1;
    for (layout how = ANYWHERE; how < LAYOUTS; how++)
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
            place(how, counts[i], &seed);
            int64_t hits = compare_ways(counts[i], &seed);
            assert_true(hits > 0 || counts[i] < 17);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(naive_and_hierarchy_agree_bit_for_bit),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
