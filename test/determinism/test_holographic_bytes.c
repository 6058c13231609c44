/* One world, one picture of the holographic solver: the same bytes for every instruction set and thread
 * count, with each storage, without media, with grey and with coloured ones, whatever was solved before. */
#include "holographic.h"
#include "world.h"

static dpl_context *context_with(dpl_isa isa, int32_t threads) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *owner;
    desc.isa_mask = (uint32_t)isa;
    desc.thread_count = threads;
    return dpl_context_create(&desc, &owner) == DPL_OK ? owner : NULL;
}

/* A world as arrays, so that every context gets the same. */
enum { MOST = 70 };

typedef struct world {
    int32_t width, height;
    float emission[MOST * MOST][3];
    float extinction[MOST * MOST][3];
} world;

typedef enum media { NONE, GREY, COLOURED, MEDIA } media;

static float extinction_of(uint32_t *seed, int channel, float before, media kind) {
    if (kind == NONE || dpl_test_random(seed, 0, 1) < 0.5)
        return INFINITY;
    return kind == GREY && channel > 0 ? before : (float)dpl_test_random(seed, 0.001, 0.5);
}

/* `density` of the pixels are walls, lamps or media. */
static void fill(world *w, uint32_t *seed, double density, media kind) {
    for (int32_t i = 0; i < w->width * w->height; i++) {
        bool used = dpl_test_random(seed, 0, 1) < density, lamp = dpl_test_random(seed, 0, 1) < 0.3;
        float first = used ? extinction_of(seed, 0, 0.0f, kind) : 0.0f;
        for (int c = 0; c < 3; c++) {
            w->emission[i][c] = used && lamp ? (float)dpl_test_random(seed, 0, 3) : 0.0f;
            w->extinction[i][c] =
                used && kind == COLOURED && isfinite(first) ? (float)dpl_test_random(seed, 0.001, 2) : first;
        }
    }
}

static dpl_field *field_of(dpl_context *owner, const world *w) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = w->width;
    desc.height = w->height;
    assert_ok(dpl_field_create(owner, &desc, &field));
    hrc_set_sky(field, 0.1);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){w->emission, DPL_FORMAT_F32, w->width, w->height, 3, 0};
    layer.extinction = (dpl_pixels){w->extinction, DPL_FORMAT_F32, w->width, w->height, 3, 0};
    layer.extinction_is_opacity = 0;
    assert_ok(dpl_field_draw_layer(field, &layer));
    return field;
}

static float *light_of(dpl_context *owner, const world *w, dpl_storage storage) {
    dpl_field *field = field_of(owner, w);
    float *rgb = hrc_solve_in(owner, field, storage);
    dpl_field_destroy(field);
    return rgb;
}

static void assert_same_light(dpl_context *one, dpl_context *other, const world *w, dpl_storage storage) {
    float *expected = light_of(one, w, storage), *found = light_of(other, w, storage);
    size_t values = 3 * (size_t)(w->width * w->height);
    for (size_t i = 0; i < values; i++)
        if (memcmp(&expected[i], &found[i], sizeof *found) != 0)
            fail_msg("%dx%d: value %zu is %.9g and %.9g", w->width, w->height, i, (double)expected[i],
                     (double)found[i]);
    free(expected);
    free(found);
}

/* From empty to full, every size up to 70, all media; each with one of the instruction sets in turn. */
static void random_worlds_are_the_same_on_every_instruction_set(void **state) {
    (void)state;
    static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    static world w;
    uint32_t seed = 7;
    dpl_context *scalar = context_with(DPL_ISA_SCALAR, 1), *vectors[3];
    for (int i = 0; i < 3; i++)
        vectors[i] = context_with(isas[i], 1);
    for (int n = 0; n < 240; n++) {
        w.width = 1 + (int32_t)dpl_test_random(&seed, 0, MOST);
        w.height = 1 + (int32_t)dpl_test_random(&seed, 0, MOST);
        double density = n % 10 == 0 ? (double)(n / 10 % 2) : pow(dpl_test_random(&seed, 0, 1), 3.0);
        fill(&w, &seed, density, (media)(n % MEDIA));
        if (vectors[n / 6 % 3])
            assert_same_light(scalar, vectors[n / 6 % 3], &w, (dpl_storage)(n / 3 % 2));
    }
    dpl_context_destroy(scalar);
    for (int i = 0; i < 3; i++)
        dpl_context_destroy(vectors[i]);
}

static void every_thread_count_gives_the_same_bytes(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{210, 67}, {33, 190}, {129, 129}}, threads[] = {2, 3, 7, 16};
    dpl_context *one = context_with((dpl_isa)DPL_ISA_ALL, 1);
    for (int t = 0; t < 4; t++) {
        dpl_context *many = context_with((dpl_isa)DPL_ISA_ALL, threads[t]);
        for (int n = 0; n < 3 * 2 * 2; n++) {
            dpl_field *fields[2];
            float *light[2];
            for (int i = 0; i < 2; i++) {
                dpl_context *owner = i ? many : one;
                fields[i] = dpl_test_world(owner, sizes[n % 3][0], sizes[n % 3][1], (uint32_t)n, n / 6);
                light[i] = hrc_solve_in(owner, fields[i], (dpl_storage)(n / 3 % 2));
            }
            assert_memory_equal(light[0], light[1], hrc_values(fields[0]) * sizeof(float));
            for (int i = 0; i < 2; i++) {
                dpl_field_destroy(fields[i]);
                free(light[i]);
            }
        }
        dpl_context_destroy(many);
    }
    dpl_context_destroy(one);
}

/* What the last world left must be gone: one solver for all, beside a new one for each. */
static void what_was_solved_before_leaves_nothing(void **state) {
    (void)state;
    static const double densities[] = {0.02, 1.0, 0.0, 0.3, 0.001, 0.0};
    static world w = {.width = 67, .height = 53};
    uint32_t seed = 11;
    for (int storage = 0; storage < 2; storage++)
        for (int kind = 0; kind < MEDIA; kind++) {
            dpl_solver *solver = hrc_solver_in(context, (dpl_storage)storage);
            for (int n = 0; n < 18; n++) {
                fill(&w, &seed, densities[n % 6], (media)kind);
                dpl_field *field = field_of(context, &w);
                float *found = hrc_solve_with(solver, field),
                      *expected = hrc_solve(field, (dpl_storage)storage);
                assert_memory_equal(expected, found, hrc_values(field) * sizeof(float));
                dpl_field_destroy(field);
                free(found);
                free(expected);
            }
            dpl_solver_destroy(solver);
        }
}

/* So large that sums and radiance go past the caches. */
static void a_large_world_is_the_same_on_every_instruction_set(void **state) {
    (void)state;
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    float *expected = NULL;
    for (int i = 0; i < 4; i++) {
        dpl_context *owner = context_with(isas[i], 1 + i % 2);
        if (!owner)
            continue;
        dpl_field *field = dpl_test_world(owner, 1203, 1201, 5, false);
        float *found = hrc_solve_in(owner, field, DPL_STORAGE_FLOAT);
        if (expected)
            assert_memory_equal(expected, found, hrc_values(field) * sizeof(float));
        dpl_field_destroy(field);
        dpl_context_destroy(owner);
        free(expected);
        expected = found;
    }
    free(expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_worlds_are_the_same_on_every_instruction_set),
        cmocka_unit_test(every_thread_count_gives_the_same_bytes),
        cmocka_unit_test(what_was_solved_before_leaves_nothing),
        cmocka_unit_test(a_large_world_is_the_same_on_every_instruction_set),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
