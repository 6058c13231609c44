/* The solid world: bits, distances to the edges of squares, first hits; and the horizon, which must never
 * lie. */
#include "shadow_world.h"
#include "world.h"

#include "shadow/cover.h"
#include "shadow/horizon.h"
#include "shadow/mips.h"
#include "shadow/shadow.h"

#include "shared_context.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 77, HEIGHT = 53 };

static dpl_shadow_class classify(const dpl_horizon *horizon, double dx, double dy) {
    uint8_t class;
    dpl_horizon_table table = dpl_horizon_table_of(horizon);
    dpl_kernels_ref.look_round(&table, 1, &class, (float)dx, (float)dy);
    return (dpl_shadow_class) class;
}

/* Distance from a pixel's centre to the nearest square that is opaque, or is not; outside nothing is. */
static double nearest_square(const dpl_field *field, int32_t x, int32_t y, bool opaque) {
    double least = INFINITY;
    for (int32_t v = -1; v <= HEIGHT; v++)
        for (int32_t u = -1; u <= WIDTH; u++) {
            bool is_inside = u >= 0 && v >= 0 && u < WIDTH && v < HEIGHT;
            if ((is_inside && dpl_field_is_opaque(field, u, v)) != opaque)
                continue;
            double dx = fmax(abs(u - x) - 0.5, 0.0), dy = fmax(abs(v - y) - 0.5, 0.0);
            least = fmin(least, dx * dx + dy * dy);
        }
    return sqrt(least);
}

static void distances_are_those_of_brute_force(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed < 4; seed++) {
        dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, seed, 1);
        dpl_solid solid = {0};
        assert_ok(dpl_solid_update(&solid, field, true));
        const float *distance = solid.distance.data;
        for (int32_t y = 0; y < HEIGHT; y++)
            for (int32_t x = 0; x < WIDTH; x++) {
                bool opaque = dpl_field_is_opaque(field, x, y);
                double wanted = nearest_square(field, x, y, !opaque);
                assert_true(dpl_solid_contains(&solid, x, y) == opaque);
                assert_true(fabs((double)distance[y * WIDTH + x] - (opaque ? -wanted : wanted)) < 1e-4);
            }
        dpl_solid_free(context, &solid);
        dpl_field_destroy(field);
    }
}

static void an_empty_world_is_far_from_everything(void **state) {
    (void)state;
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = 5;
    desc.height = 3;
    dpl_field *field;
    dpl_solid solid = {0};
    assert_ok(dpl_field_create(context, &desc, &field));
    assert_ok(dpl_solid_update(&solid, field, true));
    assert_true(((const float *)solid.distance.data)[7] >= 8.0f);
    assert_true(isinf(dpl_solid_first_hit(&solid, -10.0, 1.5, 1.0, 0.0, 100.0)));
    dpl_solid_free(context, &solid);
    dpl_field_destroy(field);
}

/* Steps through the world a hundredth of a pixel at a time. */
static double slow_hit(const dpl_field *field, double x, double y, double dx, double dy, double limit) {
    for (double t = 0.0; t < limit; t += 0.01) {
        double u = floor(x + t * dx), v = floor(y + t * dy);
        if (u >= 0 && v >= 0 && u < WIDTH && v < HEIGHT && dpl_field_is_opaque(field, (int32_t)u, (int32_t)v))
            return t;
    }
    return INFINITY;
}

static void rays_hit_what_a_slow_walk_hits(void **state) {
    (void)state;
    uint32_t seed = 5;
    int differing = 0;
    dpl_field *field = dpl_test_world(context, WIDTH, HEIGHT, 2, 0);
    dpl_solid solid = {0};
    assert_ok(dpl_solid_update(&solid, field, false));
    for (int i = 0; i < 400; i++) {
        double x = dpl_test_random(&seed, -20, WIDTH + 20), y = dpl_test_random(&seed, -20, HEIGHT + 20);
        double angle = dpl_test_random(&seed, 0, 6.2831853), dx = cos(angle), dy = sin(angle);
        double hit = dpl_solid_first_hit(&solid, x, y, dx, dy, 120.0),
               slow = slow_hit(field, x, y, dx, dy, 120.0);
        /* A ray that only grazes a corner is what the slow walk may step over. */
        differing += !(hit == slow || fabs(hit - slow) < 0.02);
    }
    assert_true(differing <= 2);
    dpl_solid_free(context, &solid);
    dpl_field_destroy(field);
}

static void a_union_of_intervals_keeps_its_length(void **state) {
    (void)state;
    uint32_t seed = 6;
    for (int round = 0; round < 200; round++) {
        dpl_cover cover = {.limit = 1.0};
        bool covered[1000] = {false};
        for (int i = 0; i < 1 + round % 40; i++) {
            int from = (int)dpl_test_random(&seed, -100, 1000),
                to = from + (int)dpl_test_random(&seed, 0, 60);
            dpl_cover_add(&cover, from / 500.0 - 1.0, to / 500.0 - 1.0);
            for (int k = from < 0 ? 0 : from; k < to && k < 1000; k++)
                covered[k] = true;
        }
        double sum = 0.0, wanted = 0.0;
        for (int k = 0; k < 1000; k++)
            wanted += covered[k] ? 0.002 : 0.0;
        for (int k = 0; k < cover.count; k++) {
            sum += cover.high[k] - cover.low[k];
            assert_true(cover.low[k] < cover.high[k] && (k == 0 || cover.high[k - 1] < cover.low[k]));
        }
        assert_true(fabs(sum - wanted) < 1e-9);
    }
}

static void a_cover_with_no_room_closes_gaps(void **state) {
    (void)state;
    static dpl_cover cover = {.limit = 1.0};
    for (int i = 0; i < 2 * DPL_COVER_MOST; i++)
        dpl_cover_add(&cover, -1.0 + i / 400.0, -1.0 + (i + 0.5) / 400.0);
    assert_int_equal(cover.count, DPL_COVER_MOST);
    assert_true(cover.high[DPL_COVER_MOST - 1] >= -1.0 + (2 * DPL_COVER_MOST - 1) / 400.0);
    dpl_cover_add(&cover, -1.0, 1.0);
    assert_true(dpl_cover_is_full(&cover));
}

/* ---- horizon -------------------------------------------------------------------------------------- */

static void check_horizon(const dpl_field *field, const dpl_solid *solid, const double position[2],
                          double radius, int64_t classes[3]) {
    dpl_horizon horizon = {0};
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_shadow_counts counts = {0};
    assert_ok(dpl_horizon_make(&horizon, context, solid, position, radius));
    dpl_shadow_view view = {.desc = &desc,
                            .field = field,
                            .solid = solid,
                            .position = {position[0], position[1]},
                            .radius = radius};
    for (int32_t y = 0; y < field->height; y++)
        for (int32_t x = 0; x < field->width; x++) {
            dpl_receiver r;
            if (dpl_field_is_opaque(field, x, y) || !dpl_receiver_at(&view, x, y, &r))
                continue;
            dpl_shadow_class class = classify(&horizon, -r.dx * r.distance, -r.dy * r.distance);
            classes[class]++;
            if (class != DPL_SHADOW_OPEN)
                assert_true(dpl_shadow_exact(&view, &r, &counts) == (class == DPL_SHADOW_LIT ? 1.0 : 0.0));
        }
    dpl_horizon_free(context, &horizon);
}

static void the_horizon_never_lies(void **state) {
    (void)state;
    static const double lights[][3] = {{60.3, 50.2, 4}, {20, 90, 0},     {-30, 40, 15},
                                       {64, 64, 40},    {100.5, 5.5, 1}, {200, 300, 60}};
    int64_t classes[3] = {0, 0, 0};
    for (uint32_t seed = 1; seed < 9; seed++) {
        dpl_field *field = dpl_test_world(context, 128, 110, seed, 0);
        dpl_solid solid = {0};
        assert_ok(dpl_solid_update(&solid, field, false));
        for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++)
            check_horizon(field, &solid, lights[i], lights[i][2], classes);
        dpl_solid_free(context, &solid);
        dpl_field_destroy(field);
    }
    assert_true(classes[DPL_SHADOW_LIT] > 0 && classes[DPL_SHADOW_DARK] > 0 && classes[DPL_SHADOW_OPEN] > 0);
}

static void behind_one_wall_the_horizon_leaves_little_but_the_penumbra(void **state) {
    (void)state;
    int64_t classes[3] = {0, 0, 0}, penumbra = 0;
    dpl_field *field = dpl_test_field(context, 200, 200);
    dpl_solid solid = {0};
    dpl_test_block(field, 80, 60, 90, 130, INFINITY);
    dpl_light light = dpl_test_light(40.2, 100.9, 8);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_EXACT);
    float *v = dpl_test_visibility(context, field, &light, &desc);
    for (int i = 0; i < 200 * 200; i++)
        penumbra += v[i] > 0.0f && v[i] < 1.0f;
    assert_ok(dpl_solid_update(&solid, field, false));
    check_horizon(field, &solid, light.position, light.radius, classes);
    assert_true(classes[DPL_SHADOW_OPEN] < penumbra + penumbra / 3);
    free(v);
    dpl_solid_free(context, &solid);
    dpl_field_destroy(field);
}

static void a_light_too_far_away_leaves_all_open(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, 32, 32, 3, 0);
    dpl_solid solid = {0};
    dpl_horizon horizon = {0};
    assert_ok(dpl_solid_update(&solid, field, false));
    assert_ok(dpl_horizon_make(&horizon, context, &solid, (double[2]){9e5, 16}, 100));
    assert_int_equal(classify(&horizon, -9e5, 3), DPL_SHADOW_OPEN);
    dpl_horizon_free(context, &horizon);
    dpl_solid_free(context, &solid);
    dpl_field_destroy(field);
}

/* ---- coarser levels ------------------------------------------------------------------------------- */

static void coarser_levels_hold_means_and_the_edge_stays(void **state) {
    (void)state;
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = 65;
    dpl_field *field;
    dpl_shape wall = dpl_shape_default(DPL_SHAPE_BOX);
    wall.box = (dpl_box){{8, 32.5}, {8, 40}, 0};
    assert_ok(dpl_field_create(context, &desc, &field));
    assert_ok(dpl_field_draw_shapes(field, &wall, 1));
    dpl_solid solid = {0};
    dpl_mips mips = {0};
    assert_ok(dpl_solid_update(&solid, field, true));
    assert_ok(dpl_mips_update(&mips, context, &solid, DPL_MIPS_MOST));
    for (int32_t level = 0; level <= DPL_MIPS_MOST; level++) {
        dpl_distances d = dpl_mips_level(&mips, &solid, level);
        float slope[2], spacing = (float)(1 << level);
        assert_true(fabsf(dpl_distances_at(&d, 16.0f, 32.5f) + DPL_CORNER_LOSS * spacing) < 0.26f * spacing);
        assert_true(fabsf(dpl_distances_slope(&d, 36.0f, 32.5f, slope) + DPL_CORNER_LOSS * spacing - 20.0f) <
                    0.6f * spacing);
        assert_true(slope[0] > 0.0f && fabsf(slope[1]) < 0.2f * slope[0]);
    }
    dpl_mips_free(context, &mips);
    dpl_solid_free(context, &solid);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_brute_force),
        cmocka_unit_test(an_empty_world_is_far_from_everything),
        cmocka_unit_test(rays_hit_what_a_slow_walk_hits),
        cmocka_unit_test(a_union_of_intervals_keeps_its_length),
        cmocka_unit_test(a_cover_with_no_room_closes_gaps),
        cmocka_unit_test(the_horizon_never_lies),
        cmocka_unit_test(behind_one_wall_the_horizon_leaves_little_but_the_penumbra),
        cmocka_unit_test(a_light_too_far_away_leaves_all_open),
        cmocka_unit_test(coarser_levels_hold_means_and_the_edge_stays),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
