/* A shaft's walk: whatever a ray of the shaft meets is among the triangles that it hands over. */
#include "bvh/shaft.h"
#include "world.h"

#include "shared_context.h"

#include <stdlib.h>

enum { COUNT = 500, SHAFTS = 200, RAYS = 100 };

static float vertices[3 * COUNT][3];

static float between(uint32_t *seed, double low, double high) {
    return (float)dpl_test_random(seed, low, high);
}

/* Small triangles anywhere; some lie flat across an axis. */
static dpl_triangles make(uint32_t *seed) {
    dpl_triangles set = {0};
    for (int32_t i = 0; i < COUNT; i++)
        for (int axis = 0; axis < 3; axis++) {
            float at = between(seed, -5, 5);
            for (int k = 0; k < 3; k++)
                vertices[3 * i + k][axis] = i % 4 == axis ? at : at + between(seed, -1, 1);
        }
    dpl_triangles_source source = {.vertices = (const float(*)[3])vertices, .count = COUNT};
    assert_ok(dpl_triangles_set(context, &set, &source, true));
    return set;
}

/* Narrow and wide, along axes and both ways across them, from points and from boxes. */
static dpl_shaft random_shaft(int32_t i, uint32_t *seed) {
    dpl_shaft shaft = {.far = i % 5 == 0 ? 1e30f : between(seed, 0.2, 8.0)};
    for (int axis = 0; axis < 3; axis++) {
        float width = i % 2 == 0 ? 0.0f : between(seed, 0.0, 0.5);
        float direction = i % 7 == axis ? 0.0f : between(seed, -1.0, 1.0);
        float spread = i % 11 == 0 ? 0.0f : between(seed, 0.0, i % 3 == 0 ? 0.5 : 0.05);
        shaft.low[axis] = between(seed, -6, 6);
        shaft.high[axis] = shaft.low[axis] + width;
        shaft.least[axis] = direction - spread;
        shaft.most[axis] = direction + spread;
    }
    return shaft;
}

typedef struct found {
    bool object[COUNT];
    const dpl_triangles *set;
    int32_t count;
    int32_t visits;
    int32_t end_after; /* visits; 0: never */
} found;

static bool note(void *visitor, const int32_t *slots, int32_t count) {
    found *f = visitor;
    const dpl_triangle *packed = f->set->packed.data;
    assert_in_range(count, 1, DPL_SHAFT_BATCH);
    for (int32_t i = 0; i < count; i++) {
        assert_false(f->object[packed[slots[i]].object]); /* none twice */
        f->object[packed[slots[i]].object] = true;
    }
    f->count += count;
    return ++f->visits == f->end_after;
}

static void every_triangle_that_a_ray_meets_is_handed_over(void **state) {
    (void)state;
    uint32_t seed = 5;
    int64_t hits = 0, handed = 0;
    dpl_triangles set = make(&seed);
    for (int32_t i = 0; i < SHAFTS; i++) {
        dpl_shaft shaft = random_shaft(i, &seed);
        dpl_walk_counts counts = {0};
        found f = {.set = &set};
        dpl_shaft_walk(&set, &shaft, note, &f, &counts);
        assert_int_equal(counts.object_tests, f.count);
        handed += f.count;
        for (int32_t k = 0; k < RAYS; k++) {
            dpl_ray ray = {.far = shaft.far};
            dpl_hit hit = dpl_hit_none();
            for (int axis = 0; axis < 3; axis++) {
                ray.origin[axis] = between(&seed, (double)shaft.low[axis], (double)shaft.high[axis]);
                ray.direction[axis] = between(&seed, (double)shaft.least[axis], (double)shaft.most[axis]);
            }
            dpl_triangles_closest(&set, &ray, &hit, &counts);
            hits += hit.object >= 0;
            assert_true(hit.object < 0 || f.object[hit.object]);
        }
    }
    assert_true(hits > 1000);
    assert_true(handed < (int64_t)SHAFTS * COUNT / 4); /* and most others are not */
    dpl_triangles_free(context, &set);
}

static void a_walk_ends_when_it_is_told_to(void **state) {
    (void)state;
    uint32_t seed = 6;
    dpl_triangles set = make(&seed);
    dpl_walk_counts counts = {0};
    dpl_shaft all = {
        .low = {-9, -9, -9}, .high = {9, 9, 9}, .least = {-1, -1, -1}, .most = {1, 1, 1}, .far = 1};
    found whole = {.set = &set}, part = {.set = &set, .end_after = 2};
    dpl_shaft_walk(&set, &all, note, &whole, &counts);
    dpl_shaft_walk(&set, &all, note, &part, &counts);
    assert_int_equal(whole.count, COUNT);
    assert_int_equal(part.visits, 2);
    assert_in_range(part.count, 2, 2 * DPL_SHAFT_BATCH);
    dpl_triangles_free(context, &set);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_triangle_that_a_ray_meets_is_handed_over),
        cmocka_unit_test(a_walk_ends_when_it_is_told_to),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
