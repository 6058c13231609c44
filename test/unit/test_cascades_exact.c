/* Ray skipping without loss: --skip exact gives the picture of --skip off, bit for bit, over every scene
 * family, random sizes and settings, every instruction set and thread count; and it saves what the
 * documentation says. */
#include "testing.h"
#include "world.h"

#include "../../scenes/families.h"
#include "cascade/cascades.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static dpl_context *context_with(uint32_t isa_mask, int32_t threads) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    desc.isa_mask = isa_mask;
    desc.thread_count = threads;
    assert_ok(dpl_context_create(&desc, &context));
    return context;
}

static dpl_solver_stats solve(dpl_context *context, dpl_field *field, const dpl_cascades_desc *cascades,
                              dpl_skip_mode mode, float *rgb) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    dpl_solver *solver;
    dpl_solver_stats stats;
    desc.cascades = *cascades;
    desc.cascades.skip.mode = mode;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {
        .data = rgb, .width = dpl_field_width(field), .height = dpl_field_height(field), .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &stats);
    dpl_solver_destroy(solver);
    return stats;
}

/* Solves without and with skipping, and compares every bit. Returns the share of rays that were saved. */
static double assert_exact(dpl_context *context, dpl_field *field, const dpl_cascades_desc *cascades) {
    size_t bytes = (size_t)dpl_field_width(field) * (size_t)dpl_field_height(field) * 3 * sizeof(float);
    float *off = malloc(bytes), *exact = malloc(bytes);
    assert_true(off && exact);
    solve(context, field, cascades, DPL_SKIP_OFF, off);
    dpl_solver_stats stats = solve(context, field, cascades, DPL_SKIP_EXACT, exact);
    assert_memory_equal(off, exact, bytes);
    int64_t traced = 0;
    for (int32_t n = 0; n < stats.level_count; n++)
        traced += stats.levels[n].traced;
    assert_int_equal(traced, stats.rays_traced);
    assert_int_equal(stats.skip.mode, DPL_SKIP_EXACT);
    free(off);
    free(exact);
    return 1.0 - (double)stats.rays_traced / (double)stats.rays_full;
}

static dpl_field *family_field(dpl_context *context, const dpl_scene_family *family, uint64_t seed,
                               int32_t index, int32_t size) {
    dpl_scene scene = {0};
    dpl_error error = {""};
    dpl_field *field;
    assert_true(family->make(seed, index, size, &scene, &error));
    assert_true(dpl_scene_build_field(&scene, context, false, &field, &error));
    dpl_scene_free(&scene);
    return field;
}

static void every_family_and_merge_keeps_every_bit_at_random_sizes(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    uint32_t seed = 20;
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    for (int32_t f = 0; f < count; f++)
        for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
            int32_t size = (int32_t)dpl_test_random(&seed, 30, 120), scenes = families[f].count;
            dpl_field *field = family_field(context, &families[f], 3 + (uint64_t)merge,
                                            (int32_t)dpl_test_random(&seed, 0, scenes), size);
            dpl_cascades_desc cascades = {.merge = (dpl_merge)merge, .interval = 1.0 + merge % 2};
            assert_true(assert_exact(context, field, &cascades) > 0.0);
            dpl_field_destroy(field);
        }
    dpl_context_destroy(context);
}

/* Settings of every kind by chance, some of them absurd. */
static dpl_cascades_desc random_settings(uint32_t *seed) {
    static const double intervals[] = {0.0, 0.25, 0.7, 1.0, 3.3, 40.0};
    dpl_cascades_desc cascades = {
        .spacing = (int32_t)dpl_test_random(seed, 0, 6),
        .directions = 4 * (int32_t)dpl_test_random(seed, 1, 6),
        .interval = intervals[(int32_t)dpl_test_random(seed, 0, 6)],
        .levels = (int32_t)dpl_test_random(seed, 0, 7),
        .merge = (dpl_merge)dpl_test_random(seed, 0, 3),
    };
    return cascades;
}

static void random_worlds_and_settings_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    uint32_t seed = 7;
    for (uint32_t i = 0; i < 40; i++) {
        int32_t width = (int32_t)dpl_test_random(&seed, 1, i % 3 ? 110 : 20);
        int32_t height = (int32_t)dpl_test_random(&seed, 1, i % 4 ? 110 : 9);
        dpl_field *field = dpl_test_world(context, width, height, i, i % 5 == 0);
        dpl_cascades_desc cascades = random_settings(&seed);
        assert_exact(context, field, &cascades);
        dpl_field_destroy(field);
    }
    dpl_context_destroy(context);
}

/* Wide enough for rows of several words of 64 probes and several chunks of 128. */
static void rows_of_many_words_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
        dpl_cascades_desc cascades = {.merge = (dpl_merge)merge, .levels = 4};
        for (int32_t width = 511; width <= 513; width++) {
            dpl_field *field = dpl_test_world(context, width, 24, (uint32_t)width, 0);
            assert_exact(context, field, &cascades);
            dpl_field_destroy(field);
        }
    }
    dpl_context_destroy(context);
}

/* One pixel in `one_in` opaque and bright, by chance. */
static dpl_field *noise_field(dpl_context *context, int32_t size, uint32_t one_in) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    float *emission = calloc((size_t)size * (size_t)size * 3, sizeof *emission);
    uint32_t seed = 11;
    assert_non_null(emission);
    desc.width = desc.height = size;
    assert_ok(dpl_field_create(context, &desc, &field));
    for (int32_t i = 0; i < size * size; i++)
        if (dpl_test_random(&seed, 0, one_in) < 1.0)
            for (int c = 0; c < 3; c++)
                emission[3 * i + c] = (float)dpl_test_random(&seed, 0, 3);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){emission, DPL_FORMAT_F32, size, size, 3, 0};
    assert_ok(dpl_field_draw_layer(field, &layer));
    free(emission);
    return field;
}

static void empty_full_and_noisy_worlds_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    for (int merge = DPL_MERGE_BILINEAR; merge <= DPL_MERGE_NEAREST_FIX; merge++) {
        dpl_cascades_desc cascades = {.merge = (dpl_merge)merge};
        static const uint32_t one_in[] = {1, 2, 6, 30, 400, 1u << 24};
        for (size_t i = 0; i < sizeof one_in / sizeof one_in[0]; i++) {
            dpl_field *field = noise_field(context, 61, one_in[i]);
            double saved = assert_exact(context, field, &cascades);
            if (one_in[i] == 1 || one_in[i] == 1u << 24)
                assert_float_equal(saved, 1.0, 0.0); /* all walls, or nothing: no ray at all */
            dpl_field_destroy(field);
        }
    }
    dpl_context_destroy(context);
}

static dpl_field *lone_pixel_field(dpl_context *context, int32_t width, int32_t height, int32_t x,
                                   int32_t y) {
    const float white[3] = {1.0f, 1.0f, 1.0f};
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_layer layer = dpl_layer_default();
    dpl_field *field;
    desc.width = width;
    desc.height = height;
    assert_ok(dpl_field_create(context, &desc, &field));
    layer.emission = (dpl_pixels){white, DPL_FORMAT_F32, 1, 1, 3, 0};
    layer.x = x;
    layer.y = y;
    assert_ok(dpl_field_draw_layer(field, &layer));
    return field;
}

/* Probes of upper levels stand outside a picture that their spacing does not divide, and their rays come back
 * and pass its corners as near as chance will have it. Short intervals with many directions have the
 * narrowest cones. */
static void lone_pixels_at_corners_and_edges_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 1);
    uint32_t seed = 41;
    for (int i = 0; i < 240; i++) {
        int32_t width = (int32_t)dpl_test_random(&seed, 3, 30),
                height = (int32_t)dpl_test_random(&seed, 3, 30);
        int32_t place = i % 8 + (i % 8 >= 4); /* of 3 x 3 but for the middle */
        dpl_field *field = lone_pixel_field(context, width, height, place % 3 * (width - 1) / 2,
                                            place / 3 * (height - 1) / 2);
        dpl_cascades_desc cascades = {
            .spacing = (int32_t)dpl_test_random(&seed, 2, 8),
            .directions = 4 * (int32_t)dpl_test_random(&seed, 3, 9),
            .interval = dpl_test_random(&seed, 0.25, 5),
            .levels = (int32_t)dpl_test_random(&seed, 2, 5),
            .merge = (dpl_merge)dpl_test_random(&seed, 0, 3),
        };
        assert_exact(context, field, &cascades);
        dpl_field_destroy(field);
    }
    dpl_context_destroy(context);
}

/* Where intervals are short for the spacing, a fix makes rays end behind their beginning. */
static void rays_that_a_fix_turns_round_keep_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 1);
    dpl_field *field = lone_pixel_field(context, 23, 18, 22, 8);
    dpl_cascades_desc cascades = {
        .spacing = 4, .directions = 20, .interval = 0.327177536, .merge = DPL_MERGE_BILINEAR_FIX};
    assert_exact(context, field, &cascades);
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

static void the_paper_profile_keeps_every_bit(void **state) {
    (void)state;
    dpl_context *context = context_with(DPL_ISA_ALL, 2);
    const dpl_scene_family *family = dpl_scene_family_find("arc");
    for (int32_t index = 0; index < 50; index += 16) {
        dpl_scene scene = {0};
        dpl_error error = {""};
        dpl_field *field;
        assert_true(family->make(5, index, 100 + index, &scene, &error));
        assert_true(dpl_scene_build_field(&scene, context, true, &field, &error));
        dpl_cascades_desc cascades = {.profile = DPL_PROFILE_PAPER, .skip.measure = 1};
        assert_true(assert_exact(context, field, &cascades) > 0.2);
        dpl_scene_free(&scene);
        dpl_field_destroy(field);
    }
    dpl_context_destroy(context);
}

static void counts_and_bits_do_not_depend_on_threads_or_instruction_set(void **state) {
    (void)state;
    enum { SIZE = 90 };
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    static float first[SIZE * SIZE * 3], other[SIZE * SIZE * 3];
    int64_t traced = -1;
    for (int i = 0; i < 4; i++)
        for (int32_t threads = 1; threads <= 3; threads += 2) {
            dpl_context *context = context_with((uint32_t)isas[i] | DPL_ISA_SCALAR, threads);
            dpl_field *field = family_field(context, dpl_scene_family_find("clutter"), 2, 1, SIZE);
            dpl_cascades_desc cascades = {.merge = DPL_MERGE_BILINEAR};
            dpl_solver_stats stats =
                solve(context, field, &cascades, DPL_SKIP_EXACT, traced < 0 ? first : other);
            if (traced >= 0)
                assert_memory_equal(first, other, sizeof first);
            if (traced >= 0)
                assert_int_equal(stats.rays_traced, traced);
            traced = stats.rays_traced;
            dpl_field_destroy(field);
            dpl_context_destroy(context);
        }
}

/* The survey has room for the hits of any scene that we know; so it is given too little here. */
static void hits_that_find_no_room_are_traced_again(void **state) {
    (void)state;
    enum { SIZE = 80 };
    static float off[SIZE * SIZE * 3], exact[SIZE * SIZE * 3];
    dpl_context *context = context_with(DPL_ISA_ALL, 3);
    dpl_field *field = family_field(context, dpl_scene_family_find("clutter"), 4, 2, SIZE);
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    dpl_solver *solver;
    dpl_solver_stats enough, short_of_room;
    solve(context, field, &desc.cascades, DPL_SKIP_OFF, off);
    desc.cascades.skip.mode = DPL_SKIP_EXACT;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {.data = exact, .width = SIZE, .height = SIZE, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &enough);
    ((dpl_cascades *)solver)->survey.capacity = 3000;
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &short_of_room);
    assert_memory_equal(off, exact, sizeof off);
    assert_true(short_of_room.rays_traced > enough.rays_traced); /* and counted again */
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

/* ---- allocations ---------------------------------------------------------------------------------- */

static int64_t allocations;

static void *count_allocate(size_t size, size_t alignment, void *user) {
    (void)user;
    allocations++;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void count_free(void *memory, size_t size, void *user) {
    (void)size;
    (void)user;
    free(memory);
}

static void later_frames_allocate_nothing_even_in_a_harder_scene(void **state) {
    (void)state;
    enum { SIZE = 96 };
    static float rgb[SIZE * SIZE * 3];
    dpl_context_desc context_desc = dpl_context_desc_default();
    dpl_context *context;
    context_desc.allocator = (dpl_allocator){count_allocate, count_free, NULL};
    assert_ok(dpl_context_create(&context_desc, &context));
    dpl_field *easy = noise_field(context, SIZE, 1u << 24), *hard = noise_field(context, SIZE, 40);
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    dpl_solver *solver;
    desc.cascades.skip.mode = DPL_SKIP_EXACT;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {.data = rgb, .width = SIZE, .height = SIZE, .channels = 3};
    float distance[SIZE * SIZE];
    assert_ok(dpl_field_read_distance(hard, distance, 0)); /* the field's own memory */
    assert_ok(dpl_solver_solve(solver, easy, &output));
    int64_t before = allocations;
    assert_ok(dpl_solver_solve(solver, hard, &output));
    assert_int_equal(allocations, before);
    dpl_solver_destroy(solver);
    dpl_field_destroy(easy);
    dpl_field_destroy(hard);
    dpl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_family_and_merge_keeps_every_bit_at_random_sizes),
        cmocka_unit_test(random_worlds_and_settings_keep_every_bit),
        cmocka_unit_test(rows_of_many_words_keep_every_bit),
        cmocka_unit_test(empty_full_and_noisy_worlds_keep_every_bit),
        cmocka_unit_test(lone_pixels_at_corners_and_edges_keep_every_bit),
        cmocka_unit_test(rays_that_a_fix_turns_round_keep_every_bit),
        cmocka_unit_test(the_paper_profile_keeps_every_bit),
        cmocka_unit_test(counts_and_bits_do_not_depend_on_threads_or_instruction_set),
        cmocka_unit_test(hits_that_find_no_room_are_traced_again),
        cmocka_unit_test(later_frames_allocate_nothing_even_in_a_harder_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
