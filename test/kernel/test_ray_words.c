/* The kernels that turn bits into rays and what rays hit into bits: every instruction set equals the scalar
 * reference bit for bit, and that one says what aim.h and the lists of the survey say. */
#include "testing.h"

#include "cascade/aim.h"
#include "kernel/bits.h"
#include "kernel/kernel.h"

#include <math.h>
#include <string.h>

enum { WORDS = 40, RAYS = 64 * WORDS, ROOM = RAYS + DPL_RAY_WORDS_PAD, PARENTS = 700 };

static uint32_t seed = 5;

static uint64_t random_bits(void) {
    uint64_t bits = 0;
    for (int i = 0; i < 4; i++) {
        seed = seed * 1664525u + 1013904223u;
        bits = bits << 16 | seed >> 16;
    }
    return bits;
}

/* None, all, few, most, half of 64. */
static uint64_t random_set(void) {
    switch (random_bits() % 5) {
    case 0:
        return 0;
    case 1:
        return ~(uint64_t)0;
    case 2:
        return random_bits() & random_bits() & random_bits();
    case 3:
        return random_bits() | random_bits() | random_bits();
    default:
        return random_bits();
    }
}

typedef struct batch {
    dpl_ray_word words[WORDS];
    uint64_t hits[WORDS];
    int32_t ends[WORDS][64]; /* -1 where nothing is hit */
    int32_t cell[ROOM], list[ROOM];
    float segments[4][ROOM];
} batch;

static int32_t random_end(void) {
    return random_bits() % 3 ? (int32_t)(random_bits() % 100000) : -1;
}

/* Probes 64 i to 64 i + 63; steps and shifts are those of the three merges. */
static void fill(batch *b) {
    static const int32_t targets[][2] = {{0, 0}, {0, 1}, {-1, 1}, {1, 1}};
    memset(b, 0, sizeof *b);
    for (int i = 0; i < WORDS; i++) {
        uint64_t rays = random_set(), known = random_bits() % 2 ? random_set() & ~rays : 0;
        const int32_t *target = targets[random_bits() % 4];
        b->words[i] = (dpl_ray_word){.rays = rays,
                                     .known = known,
                                     .hits = &b->hits[i],
                                     .ends = known ? b->ends[i] : NULL,
                                     .first = 64 * i,
                                     .step = target[0],
                                     .shift = target[1],
                                     .start_x = (float)i * 0.37f,
                                     .end_x = -(float)i * 1.7f,
                                     .y0 = (float)i,
                                     .y1 = (float)i + 0.5f};
        b->hits[i] = 77;
        for (int k = 0; k < 64; k++)
            b->ends[i][k] = random_end();
    }
    for (int i = 0; i < RAYS; i++)
        b->cell[i] = random_end();
}

static int32_t aim(const dpl_kernels *kernels, batch *b) {
    const dpl_ray_axis axis = {1.0f, 2.0f, PARENTS};
    float *ends[4] = {b->segments[0], b->segments[1], b->segments[2], b->segments[3]};
    return kernels->aim(&axis, WORDS, b->words, ends);
}

static void every_isa_aims_and_lists_as_the_reference(void **state) {
    static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    static batch expected, found;
    (void)state;
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[i]);
        for (int round = 0; kernels && round < 300; round++) {
            uint32_t began = seed;
            fill(&expected);
            seed = began;
            fill(&found);
            int32_t rays = aim(&dpl_kernels_ref, &expected);
            assert_int_equal(aim(kernels, &found), rays);
            for (int k = 0; k < 4; k++)
                assert_memory_equal(expected.segments[k], found.segments[k], (size_t)rays * sizeof(float));
            int32_t hits = dpl_kernels_ref.list_hits(WORDS, expected.words, expected.cell, expected.list);
            assert_int_equal(kernels->list_hits(WORDS, found.words, found.cell, found.list), hits);
            assert_memory_equal(expected.list, found.list, (size_t)hits * sizeof(int32_t));
            assert_memory_equal(expected.hits, found.hits, sizeof expected.hits);
            for (int w = 0; w < WORDS; w++)
                assert_int_equal(expected.words[w].at, found.words[w].at);
        }
    }
}

/* By the way that aim.h has for probes and their parents. */
static void rays_begin_and_end_where_probes_and_parents_stand(void **state) {
    static batch b;
    (void)state;
    for (int round = 0; round < 30; round++) {
        int32_t ray = 0;
        fill(&b);
        int32_t rays = aim(&dpl_kernels_ref, &b);
        for (int w = 0; w < WORDS; w++)
            for (int32_t k = 0; k < 64; k++) {
                const dpl_ray_word *word = &b.words[w];
                if (!(word->rays >> k & 1))
                    continue;
                int32_t probe = 64 * w + k, target = probe;
                if (word->shift == 1) {
                    int32_t parent = word->step == 0   ? probe / 2
                                     : word->step == 1 ? dpl_lower_parent(probe) + 1
                                                       : dpl_lower_parent(probe);
                    target = dpl_clamp_index(parent, PARENTS);
                } else {
                    target = dpl_clamp_index(probe, PARENTS);
                }
                assert_float_equal(b.segments[0][ray], (float)probe + 0.5f + word->start_x, 0.0f);
                assert_float_equal(b.segments[1][ray], word->y0, 0.0f);
                assert_float_equal(b.segments[2][ray], 2.0f * ((float)target + 0.5f) + word->end_x, 0.0f);
                assert_float_equal(b.segments[3][ray], word->y1, 0.0f);
                ray++;
            }
        assert_int_equal(ray, rays);
    }
}

static void hits_are_listed_word_by_word_and_probe_by_probe(void **state) {
    static batch b;
    (void)state;
    for (int round = 0; round < 30; round++) {
        int32_t marched = 0, listed = 0;
        fill(&b);
        int32_t count = dpl_kernels_ref.list_hits(WORDS, b.words, b.cell, b.list);
        for (int w = 0; w < WORDS; w++) {
            assert_int_equal(b.words[w].at, listed);
            for (int32_t k = 0; k < 64; k++) {
                bool is_marched = b.words[w].rays >> k & 1, is_known = b.words[w].known >> k & 1;
                int32_t end = is_marched ? b.cell[marched++] : is_known ? b.ends[w][k] : -1;
                assert_int_equal(b.hits[w] >> k & 1, end >= 0);
                if (end >= 0)
                    assert_int_equal(b.list[listed++], end);
            }
        }
        assert_int_equal(count, listed);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_isa_aims_and_lists_as_the_reference),
        cmocka_unit_test(rays_begin_and_end_where_probes_and_parents_stand),
        cmocka_unit_test(hits_are_listed_word_by_word_and_probe_by_probe),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
