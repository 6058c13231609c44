/* Frames with reuse: where nothing changes nothing is traced, what changes costs what it reaches, nothing is
 * allocated after the first frame; and a solver goes on after trouble, other fields and other sizes. That
 * every frame has the bits of a new solver is test_reuse_frames.c's. */
#include "counting.h"
#include "moving_world.h"
#include "shared_context.h"

#include "kernel/half.h"

#include <math.h>
#include <stdbool.h>

enum { MOST_VALUES = 140 * 140 * 3 };
static float found[MOST_VALUES], expected[MOST_VALUES], extra[2][MOST_VALUES];

static dpl_solver_desc desc_of(int kind) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = (dpl_solver_kind)kind;
    desc.reference.directions = 16;
    desc.reuse = 1;
    return desc;
}

static dpl_solver *solver_of(dpl_context *owner, int kind) {
    dpl_solver_desc desc = desc_of(kind);
    dpl_solver *solver;
    assert_ok(dpl_solver_create(owner, &desc, &solver));
    return solver;
}

static int64_t rays_of(const dpl_solver *solver) {
    dpl_solver_stats stats;
    dpl_solver_read_stats(solver, &stats);
    int64_t sum = 0;
    for (int32_t n = 0; n < stats.level_count; n++)
        sum += stats.levels[n].traced;
    assert_int_equal(sum, stats.rays_traced);
    assert_true(stats.rays_full > 0);
    return sum;
}

/* The picture of a solver that has had other frames is that of a new one. */
static void assert_as_new(const moving_world *w, dpl_context *owner, dpl_solver *solver, int kind) {
    dpl_solver_desc desc = desc_of(kind);
    memset(found, 0, sizeof found);
    moving_solve(w, solver, found);
    moving_solve_anew(w, owner, &desc, expected);
    assert_memory_equal(found, expected, moving_values(w) * sizeof *found);
}

static void where_nothing_changes_nothing_is_traced(void **state) {
    (void)state;
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_HOLOGRAPHIC; kind++) {
        moving_world w;
        moving_start(&w, context, 60, 45, 3, 1);
        dpl_solver *solver = solver_of(context, kind);
        moving_draw(&w);
        assert_as_new(&w, context, solver, kind);
        assert_true(rays_of(solver) > 0);
        assert_as_new(&w, context, solver, kind);
        assert_int_equal(rays_of(solver), 0);
        moving_draw(&w);
        assert_as_new(&w, context, solver, kind);
        assert_int_equal(rays_of(solver), 0);
        moving_colour(&w, &w.shapes[MOVING_SHAPES - 1]);
        moving_draw(&w);
        assert_as_new(&w, context, solver, kind);
        assert_true(rays_of(solver) > 0);
        dpl_solver_destroy(solver);
        dpl_field_destroy(w.field);
    }
}

static void a_kept_picture_is_handed_out_in_any_format(void **state) {
    (void)state;
    enum { W = 31, H = 23 };
    static uint16_t halves[H][4 * W];
    moving_world w;
    moving_start(&w, context, W, H, 5, 0);
    dpl_solver *solver = solver_of(context, DPL_SOLVER_HOLOGRAPHIC);
    moving_draw(&w);
    moving_solve(&w, solver, found);
    const dpl_output upside_down = {.data = halves[H - 1],
                                    .format = DPL_FORMAT_F16,
                                    .width = W,
                                    .height = H,
                                    .channels = 4,
                                    .row_stride = -(ptrdiff_t)sizeof halves[0]};
    assert_ok(dpl_solver_solve(solver, w.field, &upside_down));
    assert_int_equal(rays_of(solver), 0);
    for (int y = 0; y < H; y++)
        for (int i = 0; i < 4 * W; i++) {
            float value = i % 4 == 3 ? 1.0f : found[3 * (y * W + i / 4) + i % 4];
            assert_int_equal(halves[H - 1 - y][i], dpl_half_from_float(value));
        }
    dpl_solver_destroy(solver);
    dpl_field_destroy(w.field);
}

/* The mean alone was kept; then all three are; then the mean is one of them. */
static void directions_that_were_not_kept_are_solved(void **state) {
    (void)state;
    enum { W = 26, H = 33 };
    moving_world w;
    moving_start(&w, context, W, H, 8, 0);
    dpl_solver *solver = solver_of(context, DPL_SOLVER_REFERENCE);
    moving_draw(&w);
    moving_solve(&w, solver, expected);
    dpl_output outputs[3];
    for (int i = 0; i < 3; i++)
        outputs[i] = (dpl_output){.data = i ? extra[i - 1] : found, .width = W, .height = H, .channels = 3};
    for (int frame = 0; frame < 2; frame++) {
        memset(extra, 0, sizeof extra);
        assert_ok(dpl_solver_solve_directional(solver, w.field, &outputs[0], &outputs[1], &outputs[2]));
        assert_true(frame == 0 ? rays_of(solver) > 0 : rays_of(solver) == 0);
        assert_memory_equal(found, expected, moving_values(&w) * sizeof *found);
        double light = 0.0;
        for (size_t i = 0; i < moving_values(&w); i++)
            light += (double)(extra[0][i] * extra[0][i] + extra[1][i] * extra[1][i]);
        assert_true(light > 0.0);
    }
    assert_as_new(&w, context, solver, DPL_SOLVER_REFERENCE);
    assert_int_equal(rays_of(solver), 0);
    dpl_solver_destroy(solver);
    dpl_field_destroy(w.field);
}

/* ---- what a change costs -------------------------------------------------------------------------- */

static void draw_box(dpl_field *field, double x0, double y0, double x1, double y1, float emission) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    shape.box = (dpl_box){{0.5 * (x0 + x1), 0.5 * (y0 + y1)}, {0.5 * (x1 - x0), 0.5 * (y1 - y0)}, 0.0};
    for (int c = 0; c < 3; c++)
        shape.material.emission[c] = emission;
    assert_ok(dpl_field_draw_shapes(field, &shape, 1));
}

/* A grid of closed rooms, 20 pixels wide, each with a lamp; that of one room is moved. */
static void draw_rooms(dpl_field *field, int moved) {
    dpl_field_clear(field);
    for (int i = 0; i <= 140; i += 20) {
        draw_box(field, i - 2, 0, i + 2, 140, 0.0f);
        draw_box(field, 0, i - 2, 140, i + 2, 0.0f);
    }
    for (int room = 0; room < 49; room++) {
        int x = 20 * (room % 7) + 9 + (room == 24 ? moved : 0), y = 20 * (room / 7) + 9;
        draw_box(field, x, y, x + 2, y + 2, 2.0f);
    }
}

static void walls_stop_what_a_moved_lamp_costs(void **state) {
    (void)state;
    dpl_field_desc size = dpl_field_desc_default();
    size.width = size.height = 140;
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
        dpl_solver_desc desc = desc_of(DPL_SOLVER_CASCADES);
        desc.cascades.merge = (dpl_merge)merge;
        moving_world w = {.width = 140, .height = 140};
        dpl_solver *solver;
        assert_ok(dpl_field_create(context, &size, &w.field));
        assert_ok(dpl_solver_create(context, &desc, &solver));
        for (int frame = 0; frame < 4; frame++) {
            draw_rooms(w.field, frame);
            moving_solve(&w, solver, found);
            int64_t anew = moving_solve_anew(&w, context, &desc, expected).rays_traced;
            assert_memory_equal(found, expected, moving_values(&w) * sizeof *found);
            /* 1 of 49 rooms, the tiles of 16 pixels that it touches, and rays of levels above that cross it
             */
            assert_true(frame == 0 ? rays_of(solver) == anew : (double)rays_of(solver) < 0.25 * (double)anew);
        }
        dpl_solver_destroy(solver);
        dpl_field_destroy(w.field);
    }
}

/* ---- memory and trouble --------------------------------------------------------------------------- */

static dpl_context *counting_context(counting *counter) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *owner;
    desc.thread_count = 1;
    desc.allocator = (dpl_allocator){count_allocate, count_release, counter};
    assert_ok(dpl_context_create(&desc, &owner));
    return owner;
}

static void later_frames_allocate_nothing(void **state) {
    (void)state;
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_HOLOGRAPHIC; kind++) {
        counting counter = {0};
        dpl_context *owner = counting_context(&counter);
        moving_world w;
        moving_start(&w, owner, 70, 50, 2, 1);
        dpl_solver *solver = solver_of(owner, kind);
        int after_first = 0;
        for (int frame = 0; frame < 12; frame++) {
            moving_draw(&w);
            moving_solve(&w, solver, found);
            if (frame == 0)
                after_first = counter.allocations;
            assert_int_equal(counter.allocations, after_first);
            moving_colour(&w, &w.shapes[frame % MOVING_SHAPES]);
            moving_place(&w, &w.shapes[frame % MOVING_SHAPES]);
        }
        dpl_solver_destroy(solver);
        dpl_field_destroy(w.field);
        dpl_context_destroy(owner);
        assert_int_equal(counter.live, 0);
    }
}

/* Lit a small world, then handed a larger one while memory fails, at every allocation. */
static void a_solver_that_ran_out_of_memory_goes_on(void **state) {
    (void)state;
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_HOLOGRAPHIC; kind++) {
        counting counter = {0};
        dpl_context *owner = counting_context(&counter);
        moving_world small, large;
        moving_start(&small, owner, 20, 30, 1, 0);
        moving_start(&large, owner, 50, 44, 2, 1);
        moving_draw(&small);
        moving_draw(&large);
        dpl_output output = {.data = found, .width = 50, .height = 44, .channels = 3};
        bool reached = true;
        for (int n = 1; reached; n++) {
            dpl_solver *solver = solver_of(owner, kind);
            moving_solve(&small, solver, found);
            counter = (counting){.fail_at = n, .live = counter.live};
            dpl_status status = dpl_solver_solve(solver, large.field, &output);
            reached = counter.allocations >= n;
            counter.fail_at = 0;
            assert_int_equal(status, reached ? DPL_ERROR_MEMORY : DPL_OK);
            assert_as_new(&large, owner, solver, kind);
            assert_as_new(&small, owner, solver, kind);
            dpl_solver_destroy(solver);
        }
        dpl_field_destroy(small.field);
        dpl_field_destroy(large.field);
        dpl_context_destroy(owner);
        assert_int_equal(counter.live, 0);
    }
}

/* `user`: how many more calls go on. */
static int count_down(double done, void *user) {
    (void)done;
    return (*(int *)user)-- != 0;
}

static void a_solver_that_was_cancelled_goes_on(void **state) {
    (void)state;
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_HOLOGRAPHIC; kind++) {
        moving_world w;
        dpl_solver_desc desc = desc_of(kind);
        dpl_solver *solver;
        int left = -1, cancelled = 0;
        desc.progress = count_down;
        desc.progress_user = &left;
        assert_ok(dpl_solver_create(context, &desc, &solver));
        moving_start(&w, context, 60, 50, 4, 0);
        dpl_output output = {.data = extra[0], .width = 60, .height = 50, .channels = 3};
        for (int calls = 0; calls < 40; calls += 1 + calls / 6) {
            moving_edit(&w);
            moving_draw(&w);
            memset(extra[0], 0xff, sizeof extra[0]);
            left = calls;
            dpl_status status = dpl_solver_solve(solver, w.field, &output);
            left = -1;
            if (status != DPL_OK) {
                assert_int_equal(status, DPL_ERROR_CANCELLED);
                for (size_t i = 0; i < moving_values(&w); i++)
                    assert_true(isnan(extra[0][i])); /* written only on success */
                cancelled++;
            }
            if (calls % 2)
                moving_edit(&w);
            moving_draw(&w);
            assert_as_new(&w, context, solver, kind);
        }
        assert_true(cancelled > 3);
        dpl_solver_destroy(solver);
        dpl_field_destroy(w.field);
    }
}

static void fields_and_sizes_may_take_turns(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{60, 40}, {60, 40}, {40, 60}, {33, 20}};
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_HOLOGRAPHIC; kind++) {
        moving_world worlds[4];
        dpl_solver *solver = solver_of(context, kind);
        for (int i = 0; i < 4; i++)
            moving_start(&worlds[i], context, sizes[i][0], sizes[i][1], (uint32_t)i, i % 2);
        for (int frame = 0; frame < 16; frame++) {
            moving_world *w = &worlds[frame / 2 * 3 % 4];
            moving_draw(w);
            assert_as_new(w, context, solver, kind);
            moving_edit(w);
        }
        for (int i = 0; i < 4; i++)
            dpl_field_destroy(worlds[i].field);
        dpl_solver_destroy(solver);
    }
}

static void reuse_is_on_or_off(void **state) {
    (void)state;
    for (int32_t reuse = -1; reuse <= 2; reuse += 3) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        dpl_solver *solver;
        desc.reuse = reuse;
        assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
        assert_null(solver);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(where_nothing_changes_nothing_is_traced),
        cmocka_unit_test(a_kept_picture_is_handed_out_in_any_format),
        cmocka_unit_test(directions_that_were_not_kept_are_solved),
        cmocka_unit_test(walls_stop_what_a_moved_lamp_costs),
        cmocka_unit_test(later_frames_allocate_nothing),
        cmocka_unit_test(a_solver_that_ran_out_of_memory_goes_on),
        cmocka_unit_test(a_solver_that_was_cancelled_goes_on),
        cmocka_unit_test(fields_and_sizes_may_take_turns),
        cmocka_unit_test(reuse_is_on_or_off),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
