/* The row kernels of the holographic solver: every instruction set equals the scalar reference bit for bit,
 * for every storage and colour. Lengths around a block and beyond one word of a mask, shifts of every kind,
 * masks that are full and masks that are true to sparse rows, output rows that still hold another frame, and
 * guard bands around every buffer. After each call a clear bit means a block of exactly <0, 1>. */
#include "kernel/guarded_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INPUTS = 4 };

/* ---- the kernels ---------------------------------------------------------------------------------- */

static dpl_tap random_tap(const setting *s, const row rows[INPUTS], const row faces[INPUTS]) {
    uint32_t first = random_below(INPUTS), other = random_below(INPUTS);
    dpl_tap tap = {.kind = (dpl_tap_kind)random_below(3),
                   .shift = shift_of(s, (int)random_below(SHIFTS)),
                   .row = rows[first].at};
    if (random_below(2))
        tap.face = faces[first].at;
    bool corner = tap.kind == DPL_TAP_CORNER;
    if (corner) {
        tap.other_row = rows[other].at;
        tap.other_shift = shift_of(s, (int)random_below(SHIFTS));
    }
    if (random_below(2))
        tap.other_face = faces[corner ? other : first].at;
    return tap;
}

static void assert_same_trace(const setting *s) {
    row rows[INPUTS], faces[INPUTS];
    int empty = 0;
    for (int i = 0; i < INPUTS; i++) {
        rows[i] = new_segment(s);
        faces[i] = new_radiance(s);
    }
    for (int round = 0; round < 24; round++) {
        filling how = (filling)(round % FILLINGS);
        for (int i = 0; i < INPUTS; i++) {
            fill_segment(s, &rows[i], i ? how : SPARSE);
            fill_face(s, &faces[i], &rows[i], how);
        }
        dpl_tap taps[9];
        int32_t count = (int32_t)random_below(10);
        for (int32_t i = 0; i < count; i++)
            taps[i] = random_tap(s, rows, faces);
        row expected = new_segment(s);
        fill_segment(s, &expected, (filling)random_below(FILLINGS));
        row found = copy_of(&expected);
        dpl_trace_into into = (dpl_trace_into)random_below(3);
        s->expected->trace(&s->shape, expected.at, taps, count, into);
        s->found->trace(&s->shape, found.at, taps, count, into);
        empty += assert_same_segment(s, &expected, &found);
    }
    assert_true(empty > 0);
    for (int i = 0; i < INPUTS; i++) {
        free(rows[i].memory);
        free(faces[i].memory);
    }
}

static void tracing_equals_the_reference(void **state) {
    (void)state;
    for_each_setting(assert_same_trace);
}

/* Walls that emit light, on one side of every corner of a diagonal: of its two ways one sees the first of
 * them, the other none, so it carries half of their light and half of what is behind them, however many there
 * are. */
static void assert_half_beside_a_staircase(const setting *s) {
    enum { CORNERS = 3, START = 4 };
    if (s->shape.length < START + CORNERS)
        return;
    row columns[CORNERS + 1], out = new_segment(s);
    dpl_tap taps[CORNERS];
    fill_segment(s, &out, EMPTY);
    for (int32_t x = 0; x <= CORNERS; x++) {
        columns[x] = new_segment(s);
        fill_segment(s, &columns[x], EMPTY);
        dpl_row_mask(&s->shape, columns[x].at, columns[x].element)[0] = 1;
        for (int p = 0; p < 3 + s->t_planes && x > 0; p++) /* column x at START + x - 1 */
            put(&columns[x], p * s->shape.stride + START + x - 1, p < 3 ? 1.0f : 0.0f);
    }
    for (int32_t i = 0; i < CORNERS; i++)
        taps[i] = (dpl_tap){.kind = DPL_TAP_CORNER,
                            .row = columns[i + 1].at,
                            .shift = i,
                            .other_row = columns[i].at,
                            .other_shift = i + 1};
    s->found->trace(&s->shape, out.at, taps, CORNERS, DPL_TRACE_TWO_WAYS);
    for (int p = 0; p < 3 + s->t_planes; p++)
        assert_true(get(&out, p * s->shape.stride + START) == 0.5f);
    for (int32_t x = 0; x <= CORNERS; x++)
        free(columns[x].memory);
    free(out.memory);
}

static void a_diagonal_along_a_staircase_sees_half_of_it(void **state) {
    (void)state;
    for_each_setting(assert_half_beside_a_staircase);
}

/* A wall that emits light, in front of one pixel: only there, and only for its part, what was there is
 * replaced. */
static void assert_part_of_a_wall(const setting *s) {
    enum { AT = 2 };
    if (s->shape.length <= AT)
        return;
    row wall = new_segment(s), out = new_segment(s);
    fill_segment(s, &wall, EMPTY);
    fill_segment(s, &out, EMPTY);
    dpl_row_mask(&s->shape, wall.at, wall.element)[0] = 1;
    for (int p = 0; p < 3 + s->t_planes; p++)
        put(&wall, p * s->shape.stride + AT, p < 3 ? 1.0f : 0.0f);
    const dpl_tap tap = {.kind = DPL_TAP_HALF, .row = wall.at};
    s->found->trace(&s->shape, out.at, &tap, 1, DPL_TRACE_A_PART);
    for (int p = 0; p < 3 + s->t_planes; p++) {
        assert_true(get(&out, p * s->shape.stride + AT) == (p < 3 ? 0.3125f : 0.6875f));
        assert_true(get(&out, p * s->shape.stride + AT - 1) == (p < 3 ? 0.0f : 1.0f));
    }
    free(wall.memory);
    free(out.memory);
}

static void a_part_of_a_traced_segment_joins_what_was_there(void **state) {
    (void)state;
    for_each_setting(assert_part_of_a_wall);
}

static dpl_fork_cell random_cell(const row rows[INPUTS], const row faces[INPUTS]) {
    uint32_t chosen = random_below(INPUTS);
    return (dpl_fork_cell){rows[chosen].at, random_below(2) ? faces[chosen].at : NULL};
}

static void assert_same_fork(const setting *s) {
    row rows[INPUTS], faces[INPUTS];
    int empty = 0;
    for (int i = 0; i < INPUTS; i++) {
        rows[i] = new_segment(s);
        faces[i] = new_radiance(s);
    }
    for (int round = 0; round < 2 * SHIFTS; round++) {
        filling how = (filling)(round % FILLINGS);
        for (int i = 0; i < INPUTS; i++) {
            fill_segment(s, &rows[i], i ? how : SPARSE);
            fill_face(s, &faces[i], &rows[i], how);
        }
        const dpl_fork from = {random_cell(rows, faces),      random_cell(rows, faces),
                               random_cell(rows, faces),      random_cell(rows, faces),
                               rows[random_below(INPUTS)].at, shift_of(s, round / 2)};
        row expected[2], found[2];
        for (int i = 0; i < 2; i++) {
            expected[i] = new_segment(s);
            fill_segment(s, &expected[i], (filling)random_below(FILLINGS));
            found[i] = copy_of(&expected[i]);
        }
        s->expected->fork(&s->shape, expected[0].at, expected[1].at, &from);
        s->found->fork(&s->shape, found[0].at, found[1].at, &from);
        for (int i = 0; i < 2; i++)
            empty += assert_same_segment(s, &expected[i], &found[i]);
    }
    assert_true(empty > 0);
    for (int i = 0; i < INPUTS; i++) {
        free(rows[i].memory);
        free(faces[i].memory);
    }
}

static void forking_equals_the_reference(void **state) {
    (void)state;
    for_each_setting(assert_same_fork);
}

enum { FORK_AT = 4 };

/* A wall that emits 1 at one place of one row. */
static row lone_lamp(const setting *s, int32_t at) {
    row r = new_segment(s);
    fill_segment(s, &r, EMPTY);
    for (int p = 0; p < 3 + s->t_planes && at >= 0; p++)
        put(&r, p * s->shape.stride + at, p < 3 ? 1.0f : 0.0f);
    if (at >= 0)
        dpl_row_mask(&s->shape, r.at, r.element)[0] = 1;
    return r;
}

/* What a fork at FORK_AT says of a lamp ahead, aside or behind both: light, what goes on to the end, and what
 * passes beside it. */
static void assert_fork(const setting *s, int32_t ahead, int32_t aside, float light, float on, float beside) {
    row near = lone_lamp(s, aside), far = lone_lamp(s, ahead), out[2] = {new_segment(s), new_segment(s)};
    fill_segment(s, &out[0], DENSE);
    fill_segment(s, &out[1], DENSE);
    const dpl_fork from = {.start = {near.at, NULL},
                           .ahead = {far.at, NULL},
                           .aside = {near.at, NULL},
                           .end = {far.at, NULL},
                           .end_corner = far.at,
                           .shift = 1};
    s->found->fork(&s->shape, out[0].at, out[1].at, &from);
    float accuracy = s->half ? 5e-4f : 3e-6f; /* DPL_FORK_AHEAD is a fraction */
    for (int p = 0; p < 3 + s->t_planes; p++) {
        int32_t at = p * s->shape.stride + FORK_AT;
        assert_float_equal(get(&out[0], at), p < 3 ? light : on, accuracy);
        assert_float_equal(get(&out[1], at), p < 3 ? 0.0f : 1.0f - beside, accuracy);
    }
    row *const rows[] = {&near, &far, &out[0], &out[1]};
    for (int i = 0; i < 4; i++)
        free(rows[i]->memory);
}

/* Seen from the pixel before the fork, in half a quadrant: the angles of a pixel two steps ahead, of the one
 * aside and of the one behind both, which hides behind the former. */
static void assert_true_angles(const setting *s) {
    if (s->shape.length <= FORK_AT + 1)
        return;
    const float ahead = atanf(1.0f / 3.0f) / atanf(1.0f), aside = 1.0f - ahead;
    assert_fork(s, -1, -1, 0.0f, 1.0f, 0.0f);
    assert_fork(s, FORK_AT, -1, ahead, aside, 0.0f);
    assert_fork(s, -1, FORK_AT + 1, aside, ahead, 0.0f);
    assert_fork(s, FORK_AT + 1, -1, aside, 0.0f, ahead);
    assert_fork(s, FORK_AT, FORK_AT + 1, 1.0f, 0.0f, 0.0f);
    assert_fork(s, -1, FORK_AT, 1.0f, 0.0f, 0.0f);
}

static void a_pixel_of_a_fork_fills_the_angle_that_it_is_seen_under(void **state) {
    (void)state;
    for_each_setting(assert_true_angles);
}

static int compare_extension(const setting *s, const row in[INPUTS], int32_t shift, bool pair) {
    row expected[2], found[2];
    for (int i = 0; i < 2; i++) {
        expected[i] = new_segment(s);
        fill_segment(s, &expected[i], (filling)random_below(FILLINGS));
        found[i] = copy_of(&expected[i]);
    }
    /* Of a single ray the second ones are not there. */
    const void *const near[2] = {in[0].at, pair ? in[1].at : NULL};
    const void *const far[2] = {in[2].at, pair ? in[3].at : NULL};
    s->expected->extend(&s->shape, expected[0].at, pair ? expected[1].at : NULL, near, far, shift);
    s->found->extend(&s->shape, found[0].at, pair ? found[1].at : NULL, near, far, shift);
    return assert_same_segment(s, &expected[0], &found[0]) + assert_same_segment(s, &expected[1], &found[1]);
}

static void assert_same_extend(const setting *s) {
    row in[INPUTS];
    int empty = 0;
    for (int i = 0; i < INPUTS; i++)
        in[i] = new_segment(s);
    for (int round = 0; round < 2 * SHIFTS; round++) {
        for (int i = 0; i < INPUTS; i++)
            fill_segment(s, &in[i], (filling)((round + i * (round / FILLINGS % 2)) % FILLINGS));
        empty += compare_extension(s, in, shift_of(s, round / 2), round % 2 == 0);
    }
    assert_true(empty > 0);
    for (int i = 0; i < INPUTS; i++)
        free(in[i].memory);
}

static void extension_equals_the_reference(void **state) {
    (void)state;
    for_each_setting(assert_same_extend);
}

static float weight(void) {
    return random_below(8) == 0 ? 0.0f : random_unit();
}

static void assert_same_merge(const setting *s) {
    row segments[4], radiance[4];
    for (int i = 0; i < 4; i++) {
        radiance[i] = new_radiance(s);
        segments[i] = new_segment(s);
    }
    for (int round = 0; round < 3 * SHIFTS; round++) {
        dpl_merge_ray rays[2];
        const float sky[3] = {radiance_value(DENSE), radiance_value(ODD_VALUES), 0.0f};
        for (int i = 0; i < 4; i++)
            fill_radiance(s, &radiance[i], round % 3 ? DENSE : ODD_VALUES);
        for (int i = 0; i < 4; i++)
            fill_segment(s, &segments[i], (filling)((round + i * (round / FILLINGS % 2)) % FILLINGS));
        for (int i = 0; i < 2; i++) {
            rays[i] = (dpl_merge_ray){.segment = segments[i].at,
                                      .far = radiance[i].at,
                                      .near = round % 3 == 1 ? radiance[2 + i].at : NULL,
                                      .straight = round % 3 == 2 ? segments[2 + i].at : NULL,
                                      .shift = shift_of(s, (round / 3 + 7 * i) % SHIFTS),
                                      .emitted = weight(),
                                      .passed = weight()};
        }
        row expected = new_radiance(s);
        row found = copy_of(&expected);
        s->expected->merge(&s->shape, expected.at, rays, sky);
        s->found->merge(&s->shape, found.at, rays, sky);
        assert_same_radiance(&expected, &found);
    }
    for (int i = 0; i < 4; i++) {
        free(radiance[i].memory);
        free(segments[i].memory);
    }
}

static void merging_equals_the_reference(void **state) {
    (void)state;
    for_each_setting(assert_same_merge);
}

static void assert_same_fill(const setting *s) {
    for (int round = 0; round < 8; round++) {
        const float light[3] = {radiance_value(ODD_VALUES), radiance_value(DENSE),
                                radiance_value(ODD_VALUES)};
        row expected = new_radiance(s);
        fill_radiance(s, &expected, DENSE);
        row found = copy_of(&expected);
        if (round % 2) {
            s->expected->fill(&s->shape, expected.at, light);
            s->found->fill(&s->shape, found.at, light);
        } else {
            s->expected->fill_pads(&s->shape, expected.at, light);
            s->found->fill_pads(&s->shape, found.at, light);
        }
        assert_same_radiance(&expected, &found);
    }
}

static void filling_equals_the_reference(void **state) {
    (void)state;
    for_each_setting(assert_same_fill);
}

/* Sums are floats whatever the storage. Vectors may write up to the end of the last block. */
static void assert_same_collect(const setting *s) {
    row segment = new_segment(s), radiance = new_radiance(s);
    for (int round = 0; round < 24; round++) {
        fill_segment(s, &segment, (filling)(round % FILLINGS));
        fill_radiance(s, &radiance, round % 3 ? DENSE : ODD_VALUES);
        row expected = new_row(s, 3, 0, sizeof(float));
        fill_radiance(s, &expected, DENSE);
        row found = copy_of(&expected);
        const void *step = round % 5 ? segment.at : NULL;
        float emitted = round % 4 ? 0.25f * (float)(round % 4) : 1.0f;
        s->expected->collect(&s->shape, expected.at, step, emitted, radiance.at, round % 2);
        s->found->collect(&s->shape, found.at, step, emitted, radiance.at, round % 2);
        for (int p = 0; p < 3; p++)
            for (int32_t y = s->shape.length; y < dpl_row_padded(s->shape.length); y++)
                put(&found, p * s->shape.stride + y, get(&expected, p * s->shape.stride + y));
        assert_same_radiance(&expected, &found);
    }
    free(segment.memory);
    free(radiance.memory);
}

static void collecting_equals_the_reference(void **state) {
    (void)state;
    for_each_setting(assert_same_collect);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tracing_equals_the_reference),
        cmocka_unit_test(a_diagonal_along_a_staircase_sees_half_of_it),
        cmocka_unit_test(a_part_of_a_traced_segment_joins_what_was_there),
        cmocka_unit_test(forking_equals_the_reference),
        cmocka_unit_test(a_pixel_of_a_fork_fills_the_angle_that_it_is_seen_under),
        cmocka_unit_test(extension_equals_the_reference),
        cmocka_unit_test(merging_equals_the_reference),
        cmocka_unit_test(filling_equals_the_reference),
        cmocka_unit_test(collecting_equals_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
