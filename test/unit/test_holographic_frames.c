/* Frame after frame with one holographic solver: whatever was solved before, the bytes are those of a new
 * solver. Scenes, skies, media and sizes change, memory runs out, solves are cancelled; and every kind of
 * output tells the same. */
#include "counting.h"
#include "holographic.h"
#include "world.h"

#include "kernel/half.h"

/* ---- frames --------------------------------------------------------------------------------------- */

/* What is drawn, so that each frame leaves other blocks occupied than the one before. */
typedef enum scene { FULL, BARE, CORNER, FOG, TINTED, RING, SCENES } scene;

static void draw(dpl_field *field, scene what) {
    int32_t width = dpl_field_width(field), height = dpl_field_height(field);
    static const float ring[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    dpl_field_clear(field);
    hrc_set_sky(field, 0.1);
    for (int i = 0; i < 40 && what == FULL; i++)
        truth_box(field, 7 * i % width, 11 * i % height, 7 * i % width + 3, 11 * i % height + 2,
                  truth_wall(i % 3, 0.0));
    if (what != BARE)
        truth_box(field, width - 4, 0, width, 3, truth_wall(2.0, 0.0));
    if (what == FOG)
        truth_box(field, 0.25 * width, 0, 0.75 * width, height, hrc_fog(0.1, 0.02, 0.02, 0.02));
    if (what == TINTED)
        truth_box(field, 0, 0.5 * height, width, height, hrc_fog(0.0, 0.01, 0.1, 1.0));
    if (what == RING)
        assert_ok(dpl_field_set_sky_ring(field, ring, 3));
}

static const int32_t sizes[][2] = {{70, 50}, {20, 130}, {50, 70}, {64, 64}};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static void assert_same_picture(const dpl_field *field, float *found, float *expected) {
    assert_memory_equal(found, expected, hrc_values(field) * sizeof *found);
    free(found);
    free(expected);
}

/* One solver through scenes and sizes in an order that makes every change of scene. */
static void frames_with_one_solver_equal_those_of_new_ones(void **state) {
    (void)state;
    dpl_field *fields[SIZES];
    for (int i = 0; i < SIZES; i++)
        fields[i] = truth_field(sizes[i][0], sizes[i][1], 0);
    for (int storage = 0; storage < 2; storage++) {
        dpl_solver *solver = hrc_solver_in(context, (dpl_storage)storage);
        for (int frame = 0; frame < SCENES * SCENES * 2; frame++) {
            dpl_field *field = fields[frame / 5 % SIZES];
            draw(field, (scene)(frame % 2 ? frame / 2 % SCENES : frame / (2 * SCENES)));
            assert_same_picture(field, hrc_solve_with(solver, field), hrc_solve(field, (dpl_storage)storage));
        }
        dpl_solver_destroy(solver);
    }
    for (int i = 0; i < SIZES; i++)
        dpl_field_destroy(fields[i]);
}

/* ---- trouble -------------------------------------------------------------------------------------- */

/* A solver holds what its largest frame took. */
static void what_was_solved_once_allocates_nothing_again(void **state) {
    (void)state;
    counting counter = {0};
    dpl_context_desc desc = dpl_context_desc_default();
    desc.allocator = (dpl_allocator){count_allocate, count_release, &counter};
    dpl_context *owner;
    assert_ok(dpl_context_create(&desc, &owner));
    dpl_field *field = dpl_test_world(owner, 70, 50, 1, 1);
    dpl_solver *solver = hrc_solver_in(owner, DPL_STORAGE_FLOAT);
    int after_first = 0;
    for (int frame = 0; frame < 2 * SCENES; frame++) {
        draw(field, (scene)(frame % SCENES));
        free(hrc_solve_with(solver, field));
        if (frame < SCENES)
            after_first = counter.allocations;
        assert_int_equal(counter.allocations, after_first);
    }
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(owner);
}

static void assert_untouched(const float *rgb, size_t values) {
    for (size_t i = 0; i < values; i++)
        assert_true(rgb[i] == -1.0f);
}

/* A solver that has lit a small world is handed a large one while memory fails, at its every allocation. */
static void a_solver_that_ran_out_of_memory_goes_on(void **state) {
    (void)state;
    counting counter = {0};
    dpl_context_desc desc = dpl_context_desc_default();
    desc.allocator = (dpl_allocator){count_allocate, count_release, &counter};
    dpl_context *owner;
    assert_ok(dpl_context_create(&desc, &owner));
    dpl_field *small = dpl_test_world(owner, 30, 40, 1, 0), *large = dpl_test_world(owner, 150, 90, 2, 1);
    static float rgb[150 * 90 * 3];
    int failed = 0;
    for (int n = 1;; n++) {
        dpl_solver *solver = hrc_solver_in(owner, DPL_STORAGE_FLOAT);
        free(hrc_solve_with(solver, small));
        for (size_t i = 0; i < hrc_values(large); i++)
            rgb[i] = -1.0f;
        dpl_output output = hrc_output(large, rgb);
        counter = (counting){.fail_at = n};
        dpl_status status = dpl_solver_solve(solver, large, &output);
        bool reached = counter.allocations >= n;
        counter.fail_at = 0;
        assert_int_equal(status, reached ? DPL_ERROR_MEMORY : DPL_OK);
        if (reached)
            assert_untouched(rgb, hrc_values(large));
        assert_same_picture(small, hrc_solve_with(solver, small),
                            hrc_solve_in(owner, small, DPL_STORAGE_FLOAT));
        assert_same_picture(large, hrc_solve_with(solver, large),
                            hrc_solve_in(owner, large, DPL_STORAGE_FLOAT));
        dpl_solver_destroy(solver);
        failed += reached;
        if (!reached)
            break;
    }
    assert_true(failed > 0);
    dpl_field_destroy(small);
    dpl_field_destroy(large);
    dpl_context_destroy(owner);
}

/* `user`: how many more calls go on. */
static int count_down(double done, void *user) {
    (void)done;
    return (*(int *)user)-- != 0;
}

/* Cancelled in another scene, at the first call, the second, .. until none is left. */
static void a_solver_that_was_cancelled_goes_on(void **state) {
    (void)state;
    static float rgb[70 * 50 * 3];
    dpl_field *field = truth_field(70, 50, 0);
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    int left = -1, cancelled = 0;
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.progress = count_down;
    desc.progress_user = &left;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = hrc_output(field, rgb);
    for (int calls = 0;; calls++) {
        draw(field, FULL);
        for (size_t i = 0; i < hrc_values(field); i++)
            rgb[i] = -1.0f;
        left = calls;
        dpl_status status = dpl_solver_solve(solver, field, &output);
        left = -1;
        if (status == DPL_OK)
            break;
        assert_int_equal(status, DPL_ERROR_CANCELLED);
        assert_untouched(rgb, hrc_values(field));
        cancelled++;
        draw(field, (scene)(calls % SCENES));
        assert_same_picture(field, hrc_solve_with(solver, field), hrc_solve(field, DPL_STORAGE_FLOAT));
    }
    assert_true(cancelled > 5);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

/* ---- outputs -------------------------------------------------------------------------------------- */

static void every_output_format_holds_the_same_light(void **state) {
    (void)state;
    enum { W = 45, H = 37, PADDING = 5 };
    static uint16_t halves[H][4 * W + PADDING];
    static float upright[H][4 * W];
    dpl_field *field = dpl_test_world(context, W, H, 5, 1);
    dpl_solver *solver = hrc_solver_in(context, DPL_STORAGE_FLOAT);
    float *plain = hrc_solve_with(solver, field);
    /* From the last row upwards. */
    const dpl_output outputs[] = {{.data = halves[H - 1],
                                   .format = DPL_FORMAT_F16,
                                   .width = W,
                                   .height = H,
                                   .channels = 4,
                                   .row_stride = -(ptrdiff_t)sizeof halves[0]},
                                  {.data = upright, .width = W, .height = H, .channels = 4}};
    assert_ok(dpl_solver_solve(solver, field, &outputs[0]));
    assert_ok(dpl_solver_solve(solver, field, &outputs[1]));
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            for (int c = 0; c < 3; c++) {
                float value = plain[3 * (y * W + x) + c];
                assert_true(upright[y][4 * x + c] == value);
                assert_int_equal(halves[H - 1 - y][4 * x + c], dpl_half_from_float(value));
            }
            assert_true(upright[y][4 * x + 3] == 1.0f);
            assert_int_equal(halves[H - 1 - y][4 * x + 3], dpl_half_from_float(1.0f));
        }
    for (int y = 0; y < H; y++)
        for (int i = 4 * W; i < 4 * W + PADDING; i++)
            assert_int_equal(halves[y][i], 0);
    free(plain);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

/* The picture is cut out of a larger world: the margin acts and is not shown. */
static void a_margin_is_part_of_the_world_and_not_of_the_picture(void **state) {
    (void)state;
    enum { W = 40, H = 23, MARGIN = 9, WORLD_W = W + 2 * MARGIN, WORLD_H = H + 2 * MARGIN };
    dpl_field *cut = truth_field(W, H, MARGIN), *whole = truth_field(WORLD_W, WORLD_H, 0);
    truth_box(cut, -6, 3, -2, 12, truth_wall(2.0, 0.0));
    truth_box(whole, MARGIN - 6, MARGIN + 3, MARGIN - 2, MARGIN + 12, truth_wall(2.0, 0.0));
    float *found = hrc_solve(cut, DPL_STORAGE_FLOAT), *expected = hrc_solve(whole, DPL_STORAGE_FLOAT);
    for (int y = 0; y < H; y++)
        assert_memory_equal(found + (size_t)(3 * y * W),
                            expected + (size_t)(3 * ((y + MARGIN) * WORLD_W + MARGIN)),
                            3 * W * sizeof *found);
    assert_true(found[3 * 7 * W] > 0.1f);
    free(found);
    free(expected);
    dpl_field_destroy(cut);
    dpl_field_destroy(whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_with_one_solver_equal_those_of_new_ones),
        cmocka_unit_test(what_was_solved_once_allocates_nothing_again),
        cmocka_unit_test(a_solver_that_ran_out_of_memory_goes_on),
        cmocka_unit_test(a_solver_that_was_cancelled_goes_on),
        cmocka_unit_test(every_output_format_holds_the_same_light),
        cmocka_unit_test(a_margin_is_part_of_the_world_and_not_of_the_picture),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
