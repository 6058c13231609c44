/* Rows between guard bands (guarded_rows.h). */
#include "kernel/guarded_rows.h"

#include "kernel/half.h"
#include "os/machine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 256, GUARD_BYTE = 0xa5 };

static uint32_t seed = 1;

uint32_t random_below(uint32_t count) {
    seed = seed * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)(seed >> 8) * count >> 24);
}

float random_unit(void) {
    return (float)random_below(1u << 24) / 16777216.0f;
}

/* ---- rows ----------------------------------------------------------------------------------------- */

/* From the start of a line of the cache on, as rows that can be stored past it. */
static unsigned char *memory_of(size_t bytes) {
    unsigned char *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    assert_non_null(memory);
    return memory;
}

row new_row(const setting *s, int planes, size_t mask_bytes, size_t element) {
    row r = {.element = element};
    r.bytes = 2 * GUARD + mask_bytes + (size_t)(planes * s->shape.stride) * element;
    r.memory = memory_of(r.bytes);
    memset(r.memory, GUARD_BYTE, r.bytes);
    r.at = r.memory + GUARD + mask_bytes + DPL_ROW_PAD * element;
    return r;
}

row new_segment(const setting *s) {
    return new_row(s, 3 + s->t_planes, (size_t)s->shape.words * sizeof(uint64_t), s->half ? 2 : 4);
}

row new_radiance(const setting *s) {
    return new_row(s, 3, 0, s->half ? 2 : 4);
}

row copy_of(const row *r) {
    row copy = *r;
    copy.memory = memory_of(r->bytes);
    memcpy(copy.memory, r->memory, r->bytes);
    copy.at = copy.memory + ((unsigned char *)r->at - r->memory);
    return copy;
}

void put(const row *r, int32_t at, float value) {
    if (r->element == 2)
        ((uint16_t *)r->at)[at] = dpl_half_from_float(value);
    else
        ((float *)r->at)[at] = value;
}

float get(const row *r, int32_t at) {
    return r->element == 2 ? dpl_float_from_half(((uint16_t *)r->at)[at]) : ((float *)r->at)[at];
}

float radiance_value(filling how) {
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

void fill_segment(const setting *s, const row *r, filling how) {
    uint64_t *mask = dpl_row_mask(&s->shape, r->at, r->element);
    int32_t blocks = dpl_row_padded(s->shape.length) / DPL_ROW_BLOCK;
    memset(mask, 0, (size_t)s->shape.words * sizeof *mask);
    for (int32_t b = 0; b < blocks && how != EMPTY; b++)
        mask[b / 64] |= (uint64_t)(how != SPARSE || random_below(6) == 0) << (b & 63);
    fill_planes(s, r, 3 + s->t_planes, how, mask);
}

void fill_radiance(const setting *s, const row *r, filling how) {
    int32_t padded = dpl_row_padded(s->shape.length);
    for (int p = 0; p < 3; p++) {
        float sky = radiance_value(how);
        for (int32_t y = -DPL_ROW_PAD; y < padded + DPL_ROW_PAD; y++)
            put(r, p * s->shape.stride + y, y >= 0 && y < s->shape.length ? radiance_value(how) : sky);
    }
}

void fill_face(const setting *s, const row *r, const row *wall, filling how) {
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

int assert_same_segment(const setting *s, row *expected, row *found) {
    int empty = count_empty_blocks(s, found);
    assert_guards(found);
    memcpy(dpl_row_mask(&s->shape, expected->at, expected->element),
           dpl_row_mask(&s->shape, found->at, found->element), (size_t)s->shape.words * sizeof(uint64_t));
    assert_memory_equal(expected->memory, found->memory, expected->bytes);
    free(expected->memory);
    free(found->memory);
    return empty;
}

void assert_same_radiance(row *expected, row *found) {
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
                           .words = tight ? words : (words + 7) / 8 * 8,
                           .streams = random_below(2) == 0};
}

void for_each_setting(void (*test)(const setting *s)) {
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

int32_t shift_of(const setting *s, int index) {
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
