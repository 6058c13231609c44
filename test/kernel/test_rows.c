/* The row kernels of the holographic solver: every instruction set equals the scalar reference bit for bit,
 * for every storage and colour. Lengths around a block and beyond one word of a mask, shifts of every kind,
 * masks that are full and masks that are true to sparse rows, output rows that still hold another frame, and
 * guard bands around every buffer. After each call a clear bit means a block of exactly <0, 1>. */
#include "testing.h"

#include "kernel/half.h"
#include "kernel/kernel.h"
#include "os/machine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 256, GUARD_BYTE = 0xa5, INPUTS = 4 };

/* One instruction set, storage, colour and length. */
typedef struct setting {
    const dpl_row_kernels *expected;
    const dpl_row_kernels *found;
    bool half;
    int t_planes;
    dpl_row_shape shape;
} setting;

/* How a row of T is filled. */
typedef enum filling { DENSE, SPARSE, EMPTY, ODD_VALUES, FILLINGS } filling;

static uint32_t seed = 1;

static uint32_t random_below(uint32_t count) {
    seed = seed * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)(seed >> 8) * count >> 24);
}

static float random_unit(void) {
    return (float)random_below(1u << 24) / 16777216.0f;
}

/* ---- rows ----------------------------------------------------------------------------------------- */

/* A row between guard bands; `at` is element 0 of its first plane. */
typedef struct row {
    unsigned char *memory;
    size_t bytes;
    size_t element;
    void *at;
} row;

static row new_row(const setting *s, int planes, size_t mask_bytes, size_t element) {
    row r = {.element = element};
    r.bytes = 2 * GUARD + mask_bytes + (size_t)(planes * s->shape.stride) * element;
    r.memory = malloc(r.bytes);
    assert_non_null(r.memory);
    memset(r.memory, GUARD_BYTE, r.bytes);
    r.at = r.memory + GUARD + mask_bytes + DPL_ROW_PAD * element;
    return r;
}

static row new_segment(const setting *s) {
    return new_row(s, 3 + s->t_planes, (size_t)s->shape.words * sizeof(uint64_t), s->half ? 2 : 4);
}

static row new_radiance(const setting *s) {
    return new_row(s, 3, 0, s->half ? 2 : 4);
}

static row copy_of(const row *r) {
    row copy = *r;
    copy.memory = malloc(r->bytes);
    assert_non_null(copy.memory);
    memcpy(copy.memory, r->memory, r->bytes);
    copy.at = copy.memory + ((unsigned char *)r->at - r->memory);
    return copy;
}

static void put(const row *r, int32_t at, float value) {
    if (r->element == 2)
        ((uint16_t *)r->at)[at] = dpl_half_from_float(value);
    else
        ((float *)r->at)[at] = value;
}

static float get(const row *r, int32_t at) {
    return r->element == 2 ? dpl_float_from_half(((uint16_t *)r->at)[at]) : ((float *)r->at)[at];
}

static float radiance_value(filling how) {
    static const float odd[] = {0.0f,    1.0f,     1e-45f,   1e-39f, 6e-8f, 2.9e-8f, 1e-7f,  6.1e-5f,
                                2049.0f, 65504.0f, 65519.0f, 1e9f,   1e30f, 3.0e-5f, 0.333f, 1.0f};
    return how == ODD_VALUES ? odd[random_below(16)] : 4.0f * random_unit();
}

static float transmittance_value(filling how) {
    static const float odd[] = {0.0f, 1.0f, 1e-45f, 1e-39f, 6e-8f, 0.99999994f, 0.5f, 1e-7f};
    if (how == ODD_VALUES)
        return odd[random_below(8)];
    return random_below(3) == 0 ? 0.0f : random_unit();
}

/* Planes filled with values in some blocks, <0, 1> elsewhere, behind the end and in the pads. */
static void fill_planes(const setting *s, const row *r, int planes, filling how, const uint64_t *mask) {
    int32_t padded = dpl_row_padded(s->shape.length);
    for (int p = 0; p < planes; p++)
        for (int32_t y = -DPL_ROW_PAD; y < padded + DPL_ROW_PAD; y++) {
            int32_t block = y / DPL_ROW_BLOCK;
            bool used = y >= 0 && y < s->shape.length && (mask[block / 64] >> (block & 63) & 1);
            float value = p < 3 ? 0.0f : 1.0f;
            if (used)
                value = p < 3 ? radiance_value(how) : transmittance_value(how);
            put(r, p * s->shape.stride + y, value);
        }
}

static void fill_segment(const setting *s, const row *r, filling how) {
    uint64_t *mask = dpl_row_mask(&s->shape, r->at, r->element);
    int32_t blocks = dpl_row_padded(s->shape.length) / DPL_ROW_BLOCK;
    memset(mask, 0, (size_t)s->shape.words * sizeof *mask);
    for (int32_t b = 0; b < blocks && how != EMPTY; b++)
        mask[b / 64] |= (uint64_t)(how != SPARSE || random_below(6) == 0) << (b & 63);
    fill_planes(s, r, 3 + s->t_planes, how, mask);
}

/* Radiance: anything inside, the same light in both pads and behind the end. */
static void fill_radiance(const setting *s, const row *r, filling how) {
    int32_t padded = dpl_row_padded(s->shape.length);
    for (int p = 0; p < 3; p++) {
        float sky = radiance_value(how);
        for (int32_t y = -DPL_ROW_PAD; y < padded + DPL_ROW_PAD; y++)
            put(r, p * s->shape.stride + y, y >= 0 && y < s->shape.length ? radiance_value(how) : sky);
    }
}

/* What faces reflect: like the radiance of a segment, with light only where `wall` has its bits. */
static void fill_face(const setting *s, const row *r, const row *wall, filling how) {
    fill_planes(s, r, 3, how, dpl_row_mask(&s->shape, wall->at, wall->element));
}

/* ---- comparing ------------------------------------------------------------------------------------ */

static void assert_guards(const row *r) {
    for (size_t i = 0; i < GUARD; i++) {
        assert_int_equal(r->memory[i], GUARD_BYTE);
        assert_int_equal(r->memory[r->bytes - 1 - i], GUARD_BYTE);
    }
}

/* Blocks that the mask calls empty; they have to be. */
static int count_empty_blocks(const setting *s, const row *r) {
    const uint64_t *mask = dpl_row_mask(&s->shape, r->at, r->element);
    int32_t blocks = dpl_row_padded(s->shape.length) / DPL_ROW_BLOCK;
    int empty = 0;
    for (int32_t b = 0; b < 64 * s->shape.words; b++) {
        if (mask[b / 64] >> (b & 63) & 1) {
            assert_true(b < blocks);
            continue;
        }
        for (int p = 0; b < blocks && p < 3 + s->t_planes; p++)
            for (int32_t y = b * DPL_ROW_BLOCK; y < (b + 1) * DPL_ROW_BLOCK; y++)
                if (get(r, p * s->shape.stride + y) != (p < 3 ? 0.0f : 1.0f))
                    fail_msg("length %d: block %d is clear and not empty", s->shape.length, b);
        empty += b < blocks;
    }
    return empty;
}

/* Frees both. The reference keeps no masks: those of `found` have been looked at. */
static int assert_same_segment(const setting *s, row *expected, row *found) {
    int empty = count_empty_blocks(s, found);
    assert_guards(found);
    memcpy(dpl_row_mask(&s->shape, expected->at, expected->element),
           dpl_row_mask(&s->shape, found->at, found->element), (size_t)s->shape.words * sizeof(uint64_t));
    assert_memory_equal(expected->memory, found->memory, expected->bytes);
    free(expected->memory);
    free(found->memory);
    return empty;
}

static void assert_same_radiance(row *expected, row *found) {
    assert_guards(found);
    assert_memory_equal(expected->memory, found->memory, expected->bytes);
    free(expected->memory);
    free(found->memory);
}

/* ---- settings ------------------------------------------------------------------------------------- */

/* Shapes with masks and planes as short as they may be, and with room to spare. */
static dpl_row_shape shape_of(int32_t length) {
    int32_t words = (dpl_row_padded(length) / DPL_ROW_BLOCK + 63) / 64;
    bool tight = random_below(2) == 0;
    return (dpl_row_shape){.length = length,
                           .stride = dpl_row_padded(length) + 2 * DPL_ROW_PAD + (tight ? 0 : 16),
                           .words = tight ? words : (words + 7) / 8 * 8};
}

static void for_each_setting(void (*test)(const setting *s)) {
    static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    static const int32_t lengths[] = {1, 15, 16, 17, 33, 530, 1024, 1100};
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
        if (!kernels)
            continue;
        print_message("%s\n", dpl_isa_name(isas[i]));
        for (int storage = 0; storage < DPL_ROWS_STORAGES; storage++)
            for (int colour = 0; colour < DPL_ROWS_COLOURS; colour++)
                for (size_t n = 0; n < sizeof lengths / sizeof lengths[0]; n++) {
                    const setting s = {&dpl_kernels_ref.rows[storage][colour],
                                       &kernels->rows[storage][colour], storage == DPL_ROWS_HALF,
                                       colour == DPL_ROWS_RGB ? 3 : 1, shape_of(lengths[n])};
                    test(&s);
                }
    }
}

enum { SHIFTS = 32 };

/* Shifts inside a row, across its ends, and far outside. */
static int32_t shift_of(const setting *s, int index) {
    static const int32_t fixed[] = {0,  1,   2,   3,    7,    14,   15,    16,    17,    18,     30,
                                    63, 254, 512, 1023, 1024, 1026, 16384, 32768, 65536, 1 << 20};
    enum { FIXED = sizeof fixed / sizeof fixed[0] };
    int32_t padded = dpl_row_padded(s->shape.length);
    const int32_t ends[] = {s->shape.length - 1, s->shape.length, s->shape.length + 1, padded,
                            padded + 15,         padded + 16,     padded + 17};
    enum { ENDS = sizeof ends / sizeof ends[0] };
    if (index == 0)
        return DPL_ROW_OUTSIDE;
    index += (int)random_below(2) * 64;
    int32_t shift = index % 64 <= FIXED          ? fixed[index % 64 - 1]
                    : index % 64 <= FIXED + ENDS ? ends[index % 64 - 1 - FIXED]
                                                 : (int32_t)random_below(1200);
    return index < 64 ? shift : -shift;
}

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
        bool two_ways = random_below(2) == 1;
        s->expected->trace(&s->shape, expected.at, taps, count, two_ways);
        s->found->trace(&s->shape, found.at, taps, count, two_ways);
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
    s->found->trace(&s->shape, out.at, taps, CORNERS, true);
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
        cmocka_unit_test(forking_equals_the_reference),
        cmocka_unit_test(a_pixel_of_a_fork_fills_the_angle_that_it_is_seen_under),
        cmocka_unit_test(extension_equals_the_reference),
        cmocka_unit_test(merging_equals_the_reference),
        cmocka_unit_test(filling_equals_the_reference),
        cmocka_unit_test(collecting_equals_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
