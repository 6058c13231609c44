/* Pictures lit by tracers: closed forms, static layers that are traced once, counters, errors. */
#include "world.h"

#include "shared_context.h"

enum { SIZE = 24, DIRECTIONS = 48, STATICS = 60, DYNAMICS = 9 };

typedef float picture[SIZE][SIZE][3];

static dpl_tracer *make(dpl_tracer_method method) {
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    dpl_tracer *tracer;
    desc.method = method;
    assert_ok(dpl_tracer_create(context, &desc, &tracer));
    return tracer;
}

static dpl_tracer_light_desc light_desc(int keep) {
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    desc.directions = DIRECTIONS;
    desc.sky[2] = 0.25f;
    desc.keep_static = keep;
    return desc;
}

static dpl_output output_of(picture pixels) {
    return (dpl_output){.data = &pixels[0][0][0], .width = SIZE, .height = SIZE, .channels = 3};
}

static void light(dpl_tracer *tracer, int keep, picture pixels) {
    dpl_tracer_light_desc desc = light_desc(keep);
    dpl_output output = output_of(pixels);
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
}

static void random_shapes(dpl_shape *shapes, int32_t count, uint32_t *seed) {
    for (int32_t i = 0; i < count; i++) {
        double x = dpl_test_random(seed, 0, SIZE), y = dpl_test_random(seed, 0, SIZE);
        shapes[i] = dpl_shape_default(i % 2 ? DPL_SHAPE_DISC : DPL_SHAPE_BOX);
        if (i % 2)
            shapes[i].disc = (dpl_disc){{x, y}, dpl_test_random(seed, 0.1, 1)};
        else
            shapes[i].box = (dpl_box){{x, y}, {0.2, 1}, dpl_test_random(seed, 0, 3)};
        for (int c = 0; c < 3; c++)
            shapes[i].material.emission[c] = (float)dpl_test_random(seed, 0, 2);
    }
}

static void set(dpl_tracer *tracer, dpl_tracer_layer layer, const dpl_shape *shapes, int32_t count) {
    assert_ok(dpl_tracer_set_shapes(tracer, layer, shapes, count));
}

/* A disc of radiance 1 and radius R at distance d covers the angle 2 asin(R/d). */
static void a_disc_in_the_open_shines_as_on_paper(void **state) {
    (void)state;
    dpl_tracer *tracer = make(DPL_TRACER_BVH);
    dpl_shape lamp = dpl_shape_default(DPL_SHAPE_DISC);
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    static picture pixels;
    dpl_output output = output_of(pixels);
    lamp.disc = (dpl_disc){{12, 12}, 3};
    lamp.material.emission[0] = 1.0f;
    desc.directions = 4096;
    desc.sky[1] = 1.0f;
    set(tracer, DPL_TRACER_STATIC, &lamp, 1);
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double d = hypot(x + 0.5 - 12, y + 0.5 - 12);
            double share = d <= 3 ? 1.0 : asin(3 / d) / 3.14159265358979;
            assert_true(fabs((double)pixels[y][x][0] - share) <= 2.0 / 4096);
            assert_true(fabs((double)pixels[y][x][1] - (1.0 - share)) <= 2.0 / 4096);
            assert_true(pixels[y][x][2] == 0.0f);
        }
    dpl_tracer_destroy(tracer);
}

/* Fine pixels see what shapes are: 20 of the field's pixels to one of the picture. */
static void pictures_are_the_limit_of_fine_fields(void **state) {
    (void)state;
    enum { FINER = 21 };
    dpl_tracer *tracer = make(DPL_TRACER_BVH);
    dpl_shape shapes[8];
    uint32_t seed = 3;
    static picture pixels;
    random_shapes(shapes, 8, &seed);
    set(tracer, DPL_TRACER_STATIC, shapes, 8);
    light(tracer, 0, pixels);
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    dpl_solver_desc solver_desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.width = desc.height = SIZE * FINER;
    desc.sky[2] = 0.25f;
    for (int i = 0; i < 8; i++) {
        dpl_shape *shape = &shapes[i];
        double *center = i % 2 ? shape->disc.center : shape->box.center;
        double *size = i % 2 ? &shape->disc.radius : &shape->box.half[0];
        center[0] *= FINER;
        center[1] *= FINER;
        *size *= FINER;
        if (i % 2 == 0)
            shape->box.half[1] *= FINER;
    }
    assert_ok(dpl_field_create(context, &desc, &field));
    assert_ok(dpl_field_draw_shapes(field, shapes, 8));
    solver_desc.kind = DPL_SOLVER_REFERENCE;
    solver_desc.reference.directions = DIRECTIONS;
    assert_ok(dpl_solver_create(context, &solver_desc, &solver));
    int32_t differ = 0;
    for (int32_t i = 0; i < SIZE * SIZE; i++) {
        const int32_t at[1][2] = {{i % SIZE * FINER + FINER / 2, i / SIZE * FINER + FINER / 2}};
        float rgb[1][3];
        assert_ok(dpl_reference_solve_pixels(solver, field, at, 1, rgb));
        double off = fabs((double)rgb[0][0] - (double)pixels[i / SIZE][i % SIZE][0]);
        assert_true(off <= 4.0 / DIRECTIONS);
        differ += off > 1e-6;
    }
    /* Every difference is a direction or two that graze a pixel's stair. */
    assert_true(differ < SIZE * SIZE / 4);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_tracer_destroy(tracer);
}

/* ---- layers --------------------------------------------------------------------------------------- */

/* Three frames in which the dynamic shapes move, and one in which a static shape has changed. */
static void static_hits_that_are_kept_change_nothing(void **state) {
    (void)state;
    static dpl_shape all[STATICS + DYNAMICS];
    static picture kept_pixels, full_pixels, one_layer_pixels;
    uint32_t seed = 1;
    dpl_tracer *kept = make(DPL_TRACER_BVH), *full = make(DPL_TRACER_BVH), *naive = make(DPL_TRACER_NAIVE);
    random_shapes(all, STATICS + DYNAMICS, &seed);
    for (int frame = 0; frame < 4; frame++) {
        if (frame == 3)
            all[7].disc.radius += 1.0;
        if (frame == 0 || frame == 3) {
            set(kept, DPL_TRACER_STATIC, all, STATICS);
            set(full, DPL_TRACER_STATIC, all, STATICS);
        }
        random_shapes(all + STATICS, DYNAMICS, &seed);
        set(kept, DPL_TRACER_DYNAMIC, all + STATICS, DYNAMICS);
        set(full, DPL_TRACER_DYNAMIC, all + STATICS, DYNAMICS);
        set(naive, DPL_TRACER_STATIC, all, STATICS + DYNAMICS);
        dpl_tracer_reset_stats(kept);
        light(kept, 1, kept_pixels);
        light(full, 0, full_pixels);
        light(naive, 0, one_layer_pixels);
        assert_memory_equal(kept_pixels, full_pixels, sizeof(picture));
        assert_memory_equal(kept_pixels, one_layer_pixels, sizeof(picture));
        dpl_tracer_stats stats;
        dpl_tracer_read_stats(kept, &stats);
        assert_int_equal(stats.rays, SIZE * SIZE * DIRECTIONS);
        assert_int_equal(stats.static_rays, frame == 0 || frame == 3 ? SIZE * SIZE * DIRECTIONS : 0);
        assert_int_equal(stats.kept_bytes, SIZE * SIZE * DIRECTIONS * 8);
        assert_true(stats.object_tests > 0);
    }
    dpl_tracer_destroy(kept);
    dpl_tracer_destroy(full);
    dpl_tracer_destroy(naive);
}

/* Another number of directions, or of pixels, is another picture: nothing old is used for it. */
static void kept_hits_are_of_one_picture_only(void **state) {
    (void)state;
    static dpl_shape shapes[STATICS];
    static picture pixels, fresh;
    uint32_t seed = 4;
    dpl_tracer *tracer = make(DPL_TRACER_BVH);
    dpl_tracer_light_desc desc = light_desc(1);
    dpl_output output = output_of(pixels);
    random_shapes(shapes, STATICS, &seed);
    set(tracer, DPL_TRACER_STATIC, shapes, STATICS);
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
    output.height = SIZE / 2;
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
    desc.directions = DIRECTIONS / 2;
    output = output_of(pixels);
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
    desc.keep_static = 0;
    output = output_of(fresh);
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
    assert_memory_equal(pixels, fresh, sizeof pixels);
    dpl_tracer_destroy(tracer);
}

/* Small moves keep the tree; objects thrown together anew do not. Answers are those of a fresh tracer. */
static void moving_shapes_keep_their_hierarchy(void **state) {
    (void)state;
    static dpl_shape shapes[STATICS];
    static picture moved, fresh;
    uint32_t seed = 8;
    dpl_tracer *tracer = make(DPL_TRACER_BVH);
    dpl_tracer_stats stats;
    random_shapes(shapes, STATICS, &seed);
    for (int frame = 0; frame < 3; frame++) {
        for (int i = 0; i < STATICS; i++)
            *(i % 2 ? &shapes[i].disc.center[0] : &shapes[i].box.center[0]) += 0.05;
        set(tracer, DPL_TRACER_DYNAMIC, shapes, STATICS);
    }
    dpl_tracer_read_stats(tracer, &stats);
    assert_int_equal(stats.builds[DPL_TRACER_DYNAMIC], 1);
    assert_int_equal(stats.refits[DPL_TRACER_DYNAMIC], 2);
    random_shapes(shapes, STATICS, &seed);
    set(tracer, DPL_TRACER_DYNAMIC, shapes, STATICS);
    dpl_tracer_read_stats(tracer, &stats);
    assert_int_equal(stats.builds[DPL_TRACER_DYNAMIC], 2);
    light(tracer, 0, moved);
    dpl_tracer *other = make(DPL_TRACER_NAIVE);
    set(other, DPL_TRACER_STATIC, shapes, STATICS);
    light(other, 0, fresh);
    assert_memory_equal(moved, fresh, sizeof moved);
    dpl_tracer_destroy(other);
    dpl_tracer_destroy(tracer);
}

static void counters_repeat(void **state) {
    (void)state;
    static dpl_shape shapes[STATICS];
    static picture pixels;
    dpl_tracer_stats stats[2];
    for (int run = 0; run < 2; run++) {
        uint32_t seed = 2;
        dpl_tracer *tracer = make(DPL_TRACER_BVH);
        random_shapes(shapes, STATICS, &seed);
        set(tracer, DPL_TRACER_STATIC, shapes, STATICS);
        light(tracer, 0, pixels);
        dpl_tracer_read_stats(tracer, &stats[run]);
        dpl_tracer_reset_stats(tracer);
        light(tracer, 0, pixels);
        dpl_tracer_stats again;
        dpl_tracer_read_stats(tracer, &again);
        assert_int_equal(again.node_visits, stats[run].node_visits);
        assert_int_equal(again.object_tests, stats[run].object_tests);
        dpl_tracer_destroy(tracer);
    }
    assert_memory_equal(&stats[0], &stats[1], sizeof stats[0]);
    assert_true(stats[0].object_tests < stats[0].rays * STATICS / 4);
}

/* ---- errors --------------------------------------------------------------------------------------- */

static void shapes_that_let_light_through_are_refused(void **state) {
    (void)state;
    dpl_tracer *tracer = make(DPL_TRACER_BVH);
    dpl_shape shapes[2] = {dpl_shape_default(DPL_SHAPE_DISC), dpl_shape_default(DPL_SHAPE_DISC)};
    static picture pixels;
    dpl_tracer_light_desc desc = light_desc(0);
    dpl_output output = output_of(pixels);
    shapes[1].material.extinction[1] = 0.1f;
    set(tracer, DPL_TRACER_DYNAMIC, shapes, 2);
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_ARGUMENT);
    assert_non_null(strstr(dpl_context_message(context), "dynamic shape 1 is not opaque"));
    set(tracer, DPL_TRACER_DYNAMIC, shapes, 1);
    assert_ok(dpl_tracer_light(tracer, &desc, &output));
    dpl_tracer_destroy(tracer);
}

static void wrong_arguments_are_named(void **state) {
    (void)state;
    dpl_tracer *tracer = make(DPL_TRACER_BVH);
    static picture pixels;
    dpl_tracer_light_desc desc = light_desc(0);
    dpl_output output = output_of(pixels);
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    const float corner[1][3] = {{0, 0, 0}};
    const int32_t triangle[1][3] = {{0, 0, 0}};
    shape.disc.radius = -1;
    assert_int_equal(dpl_tracer_set_shapes(tracer, DPL_TRACER_STATIC, &shape, 1), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tracer_set_shapes(tracer, (dpl_tracer_layer)2, NULL, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tracer_set_shapes(tracer, DPL_TRACER_STATIC, NULL, 1), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tracer_set_triangles(tracer, DPL_TRACER_STATIC, corner, 1, triangle, 1),
                     DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tracer_trace(tracer, NULL, 1, NULL), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tracer_occluded(tracer, NULL, -1, NULL), DPL_ERROR_ARGUMENT);
    desc.directions = 0;
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_ARGUMENT);
    desc = light_desc(0);
    desc.sky[0] = -1;
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_ARGUMENT);
    desc = light_desc(0);
    desc.cookie = 0;
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_DESC);
    desc = light_desc(0);
    output.width = 0;
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_SIZE);
    output = output_of(pixels);
    output.channels = 2;
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_ARGUMENT);
    output.channels = 3;
    output.row_stride = 4;
    assert_int_equal(dpl_tracer_light(tracer, &desc, &output), DPL_ERROR_ARGUMENT);
    dpl_tracer_destroy(tracer);
    dpl_tracer_desc bad = dpl_tracer_desc_default();
    bad.method = (dpl_tracer_method)7;
    assert_int_equal(dpl_tracer_create(context, &bad, &tracer), DPL_ERROR_ARGUMENT);
    assert_null(tracer);
    assert_string_equal(dpl_tracer_method_name(DPL_TRACER_NAIVE), "naive");
    assert_string_equal(dpl_tracer_method_name((dpl_tracer_method)7), "?");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disc_in_the_open_shines_as_on_paper),
        cmocka_unit_test(pictures_are_the_limit_of_fine_fields),
        cmocka_unit_test(static_hits_that_are_kept_change_nothing),
        cmocka_unit_test(kept_hits_are_of_one_picture_only),
        cmocka_unit_test(moving_shapes_keep_their_hierarchy),
        cmocka_unit_test(counters_repeat),
        cmocka_unit_test(shapes_that_let_light_through_are_refused),
        cmocka_unit_test(wrong_arguments_are_named),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
