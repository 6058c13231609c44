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

/* ---- closed forms --------------------------------------------------------------------------------- */

static void a_hit_is_where_paper_says(void **state) {
    (void)state;
    static const float one[3][3] = {{0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
    memcpy(vertices, one, sizeof one);
    dpl_triangles set = make(1, true);
    dpl_walk_counts counts = {0};
    dpl_ray ray = {.origin = {1, 2, 0}, .direction = {0, 0, 0.5f}, .far = INFINITY};
    dpl_hit hit = dpl_hit_none();
    dpl_triangles_closest(&set, &ray, &hit, &counts);
    assert_int_equal(hit.object, 0);
    assert_true(hit.t == 4.0f && hit.u == 0.25f && hit.v == 0.5f);
    ray = (dpl_ray){.origin = {1, 2, 5}, .direction = {0, 0, -1}, .far = 3}; /* from behind, far included */
    hit = dpl_hit_none();
    dpl_triangles_closest(&set, &ray, &hit, &counts);
    assert_true(hit.object == 0 && hit.t == 3.0f);
    ray.far = 2.99f;
    assert_false(dpl_triangles_occluded(&set, &ray, &counts));
    ray = (dpl_ray){.origin = {-1, 1, 2}, .direction = {1, 0, 0}, .far = INFINITY}; /* edge on */
    assert_false(dpl_triangles_occluded(&set, &ray, &counts));
    const float from[3] = {1, 1, 0}, to[3] = {1, 1, 4};
    ray = dpl_ray_between(from, to);
    hit = dpl_hit_none();
    dpl_triangles_closest(&set, &ray, &hit, &counts);
    assert_true(hit.t == 0.5f);
    dpl_triangles_free(context, &set);
}

/* A closed surface of 2 * RINGS * SIDES triangles around the origin, bumpy, every corner shared by six. */
enum { RINGS = 12, SIDES = 24, BALL = 2 * RINGS * SIDES };

static void ball_corner(int ring, int side, float corner[3]) {
    double down = 3.14159265358979 * ring / RINGS, around = 2 * 3.14159265358979 * (side % SIDES) / SIDES;
    double radius = 1.0 + 0.2 * sin(5 * down) * cos(3 * around);
    corner[0] = (float)(ring % RINGS ? radius * sin(down) * cos(around) : 0.0);
    corner[1] = (float)(ring % RINGS ? radius * sin(down) * sin(around) : 0.0);
    corner[2] = (float)(radius * cos(down));
}

static void place_ball(void) {
    for (int i = 0; i < RINGS * SIDES; i++) {
        int ring = i / SIDES, side = i % SIDES;
        float(*v)[3] = &vertices[6 * i];
        ball_corner(ring, side, v[0]);
        ball_corner(ring, side + 1, v[1]);
        ball_corner(ring + 1, side, v[2]);
        ball_corner(ring, side + 1, v[3]);
        ball_corner(ring + 1, side + 1, v[4]);
        ball_corner(ring + 1, side, v[5]);
    }
}

/* From inside a closed surface there is no way out: not through corners, not along edges. */
static void no_ray_leaks_through_a_closed_surface(void **state) {
    (void)state;
    uint32_t seed = 11;
    place_ball();
    dpl_triangles set = make(BALL, true);
    dpl_walk_counts counts = {0};
    for (int i = 0; i < 200000; i++) {
        const float *a = vertices[(int)dpl_test_random(&seed, 0, 3 * BALL - 1)];
        const float *b = vertices[(int)dpl_test_random(&seed, 0, 3 * BALL - 1) / 3 * 3 + i % 3];
        float share = i % 2 ? 0.0f : between(&seed, 0, 1);
        dpl_ray ray = {.far = INFINITY};
        for (int k = 0; k < 3; k++) {
            ray.origin[k] = between(&seed, -0.3, 0.3);
            ray.direction[k] = a[k] + share * (b[k] - a[k]) - ray.origin[k];
        }
        assert_true(dpl_triangles_occluded(&set, &ray, &counts));
    }
    dpl_triangles_free(context, &set);
}

static void moved_triangles_answer_as_fresh_ones(void **state) {
    (void)state;
    uint32_t seed = 6;
    place(ANYWHERE, MOST, &seed);
    dpl_triangles moved = make(MOST, true);
    for (int i = 0; i < 3 * MOST; i++)
        vertices[i][i % 3] += between(&seed, -0.2, 0.2);
    dpl_triangles_source source = {.vertices = (const float(*)[3])vertices, .count = MOST};
    assert_ok(dpl_triangles_set(context, &moved, &source, true));
    assert_int_equal(moved.bvh.refits, 1);
    dpl_triangles fresh = make(MOST, true);
    dpl_walk_counts counts = {0};
    for (int i = 0; i < RAYS; i++) {
        dpl_ray ray = random_ray(i, MOST, &seed);
        dpl_hit a = dpl_hit_none(), b = a;
        dpl_triangles_closest(&moved, &ray, &a, &counts);
        dpl_triangles_closest(&fresh, &ray, &b, &counts);
        assert_memory_equal(&a, &b, sizeof a);
    }
    dpl_triangles_free(context, &moved);
    dpl_triangles_free(context, &fresh);
}

/* Distances that double from box to box, and a thousand boxes in one place: the worst for a tree. */
static void hierarchies_stay_shallow(void **state) {
    (void)state;
    enum { COUNT = 4000 };
    static dpl_bounds bounds[COUNT];
    dpl_bvh bvh = {0};
    for (int i = 0; i < COUNT; i++) {
        float at = i < 1000 ? 1.0f : ldexpf(1.0f + (float)(i % 23) / 32.0f, i % 120 - 60);
        bounds[i] = dpl_bounds_empty();
        const float point[3] = {at, i % 2 ? at : -at, 0.0f};
        dpl_bounds_add_point(&bounds[i], point);
    }
    assert_ok(dpl_bvh_build(context, &bvh, 3, bounds, COUNT));
    assert_true(bvh.depth <= DPL_BVH_MAX_DEPTH);
    assert_true(bvh.depth <= 48);
    dpl_bvh_free(context, &bvh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(naive_and_hierarchy_agree_bit_for_bit),
        cmocka_unit_test(a_hit_is_where_paper_says),
        cmocka_unit_test(no_ray_leaks_through_a_closed_surface),
        cmocka_unit_test(moved_triangles_answer_as_fresh_ones),
        cmocka_unit_test(hierarchies_stay_shallow),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
