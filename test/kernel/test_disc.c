/* The kernel that covers a disc with triangles: every instruction set equals the scalar reference bit for
 * bit, and that one says what geometry says. */
#include "testing.h"

#include "kernel/kernel.h"

#include <math.h>
#include <string.h>

static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
enum { ISA_COUNT = sizeof isas / sizeof isas[0], ROUNDS = 400 };

static uint32_t seed = 7;

static float random_between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(low + (high - low) * (seed >> 8) / 16777216.0);
}

/* Points all over the disc; the eye at 0, the disc's middle along z, its radius a fifth of the distance. */
static dpl_disc_points spread(int32_t count) {
    dpl_disc_points points = {.count = count};
    for (int32_t i = 0; i < count; i++) {
        float radius = sqrtf(((float)i + 0.5f) / (float)count), angle = 2.4f * (float)i;
        points.a[i] = radius * cosf(angle);
        points.b[i] = radius * sinf(angle);
    }
    return points;
}

static dpl_disc_view look_along_z(void) {
    return (dpl_disc_view){.axis = {{0.2f, 0.0f, 0.0f}, {0.0f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}},
                           .far = 10.0f};
}

static void set(dpl_disc_triangles *t, int32_t i, int corner, float x, float y, float z) {
    t->corner[corner][0][i] = x;
    t->corner[corner][1][i] = y;
    t->corner[corner][2][i] = z;
    t->count = i + 1;
}

/* Small ones around the disc at any depth, also behind the eye and beyond the end of the way. */
static void scatter(dpl_disc_triangles *t, int32_t count) {
    t->count = 0;
    for (int32_t i = 0; i < count; i++) {
        float z = random_between(-1.0, 12.0), x = random_between(-0.3, 0.3) * z,
              y = random_between(-0.3, 0.3) * z;
        for (int k = 0; k < 3; k++)
            set(t, i, k, x + random_between(-0.4, 0.4), y + random_between(-0.4, 0.4),
                z + random_between(-0.4, 0.4));
    }
}

static void every_instruction_set_covers_the_same_points(void **state) {
    (void)state;
    static dpl_disc_triangles triangles;
    int64_t covered = 0, open = 0;
    for (int round = 0; round < ROUNDS; round++) {
        dpl_disc_points points = spread(16 * (1 + round % 16));
        dpl_disc_view view = look_along_z();
        int32_t expected[DPL_DISC_MOST] = {0};
        view.ends = round % 3 == 0;
        triangles.exits_only = round % 2;
        scatter(&triangles, round % (DPL_DISC_TRIANGLES + 1));
        if (round % 10 == 9) /* so far away that sums overflow */
            view.eye[round % 3] = powf(10.0f, 10.0f + (float)(round % 9));
        expected[round % 16] = -1; /* something was covered before */
        bool some = dpl_kernels_ref.cover(&view, &points, &triangles, expected);
        for (int32_t k = 0; k < points.count; k++) {
            covered += expected[k] == -1;
            open += expected[k] == 0;
        }
        for (int i = 0; i < ISA_COUNT; i++) {
            const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
            int32_t found[DPL_DISC_MOST] = {0};
            found[round % 16] = -1;
            if (!kernels)
                continue;
            assert_int_equal(kernels->cover(&view, &points, &triangles, found), some);
            assert_memory_equal(found, expected, sizeof found);
        }
    }
    assert_true(covered > 1000 && open > 1000);
}

static int32_t count_covered(const dpl_disc_view *view, const dpl_disc_triangles *t) {
    dpl_disc_points points = spread(DPL_DISC_MOST);
    int32_t covered[DPL_DISC_MOST] = {0}, count = 0;
    bool open = dpl_kernels_ref.cover(view, &points, t, covered);
    for (int32_t i = 0; i < DPL_DISC_MOST; i++)
        count += covered[i] != 0;
    assert_int_equal(open, count < DPL_DISC_MOST);
    return count;
}

/* A large triangle whose edge x = at * 0.2 * z covers what is to the right of it. */
static void half_plane(dpl_disc_triangles *t, float at, float z) {
    set(t, 0, 0, at * 0.2f * z, -100.0f, z);
    set(t, 0, 1, at * 0.2f * z, 100.0f, z);
    set(t, 0, 2, 100.0f, 0.0f, z);
}

static void a_straight_edge_covers_its_share_of_the_disc(void **state) {
    (void)state;
    static const double PI = 3.14159265358979323846;
    static dpl_disc_triangles t;
    dpl_disc_view view = look_along_z();
    for (float at = -1.2f; at < 1.2f; at += 0.05f) {
        double x = fmax(-1.0, fmin(1.0, (double)at));
        double share = 0.5 - (x * sqrt(1.0 - x * x) + asin(x)) / PI;
        half_plane(&t, at, 3.0f);
        assert_true(fabs(count_covered(&view, &t) / (double)DPL_DISC_MOST - share) < 0.02);
    }
}

static void only_what_is_on_the_way_covers(void **state) {
    (void)state;
    static dpl_disc_triangles t;
    dpl_disc_view view = look_along_z();
    view.ends = true;
    half_plane(&t, -2.0f, 9.9f);
    assert_int_equal(count_covered(&view, &t), DPL_DISC_MOST);
    half_plane(&t, -2.0f, 10.1f); /* beyond the end */
    assert_int_equal(count_covered(&view, &t), 0);
    half_plane(&t, -2.0f, 9.9f);
    for (int k = 0; k < 3; k++) /* behind the eye */
        t.corner[k][2][0] = -9.9f;
    assert_int_equal(count_covered(&view, &t), 0);
}

static void exits_only_leaves_out_what_is_met_from_the_front(void **state) {
    (void)state;
    static dpl_disc_triangles t;
    dpl_disc_view view = look_along_z();
    for (int turned = 0; turned < 2; turned++) {
        half_plane(&t, -2.0f, 3.0f);
        if (turned)
            for (int axis = 0; axis < 3; axis++) {
                float first = t.corner[0][axis][0];
                t.corner[0][axis][0] = t.corner[1][axis][0];
                t.corner[1][axis][0] = first;
            }
        t.exits_only = false;
        assert_int_equal(count_covered(&view, &t), DPL_DISC_MOST);
        t.exits_only = true;
        /* Its normal points to the eye, unless two corners have been swapped. */
        assert_int_equal(count_covered(&view, &t), turned ? DPL_DISC_MOST : 0);
    }
    t.exits_only = false;
}

/* Fans around a corner that lies somewhere on the disc, their rims outside of it: no point is missed. */
static void no_point_slips_between_triangles_that_share_edges(void **state) {
    (void)state;
    enum { BLADES = 23 };
    static const double PI = 3.14159265358979323846;
    static dpl_disc_triangles t;
    dpl_disc_view view = look_along_z();
    for (int round = 0; round < ROUNDS; round++) {
        float rim[BLADES][3];
        float middle[3] = {random_between(-0.5, 0.5), random_between(-0.5, 0.5), random_between(3.0, 5.0)};
        for (int i = 0; i < BLADES; i++) {
            double angle = 2.0 * PI * i / BLADES;
            rim[i][0] = (float)(5.0 * cos(angle));
            rim[i][1] = (float)(5.0 * sin(angle));
            rim[i][2] = random_between(3.0, 5.0);
        }
        for (int i = 0; i < BLADES; i++) {
            const float *one = rim[i], *other = rim[(i + 1) % BLADES];
            bool turned = round % 2 && i % 2;
            set(&t, i, 0, middle[0], middle[1], middle[2]);
            set(&t, i, turned ? 2 : 1, one[0], one[1], one[2]);
            set(&t, i, turned ? 1 : 2, other[0], other[1], other[2]);
        }
        assert_int_equal(count_covered(&view, &t), DPL_DISC_MOST);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_covers_the_same_points),
        cmocka_unit_test(a_straight_edge_covers_its_share_of_the_disc),
        cmocka_unit_test(only_what_is_on_the_way_covers),
        cmocka_unit_test(exits_only_leaves_out_what_is_met_from_the_front),
        cmocka_unit_test(no_point_slips_between_triangles_that_share_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
