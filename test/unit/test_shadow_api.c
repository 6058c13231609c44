/* The public face of shadows: light, media, bad input, memory, statistics. */
#include "shadow_world.h"
#include "world.h"

#include "shared_context.h"

#include <string.h>

enum { SIZE = 48 };

/* ---- light ---------------------------------------------------------------------------------------- */

static void light_is_visibility_times_the_arcsine(void **state) {
    (void)state;
    for (int method = 0; method < DPL_SHADOW_METHOD_COUNT; method++) {
        dpl_field *field = dpl_test_field(context, SIZE, SIZE);
        dpl_test_block(field, 20, 10, 24, 30, INFINITY);
        dpl_light light = dpl_test_light(8, 20, 4);
        dpl_shadow_desc desc = dpl_test_method((dpl_shadow_method)method);
        float rgb[SIZE * SIZE][4];
        dpl_output output = {.data = rgb[0], .width = SIZE, .height = SIZE, .channels = 4};
        dpl_shadow *shadow;
        assert_ok(dpl_shadow_create(context, &desc, &shadow));
        assert_ok(dpl_shadow_light(shadow, field, &light, 1, &output));
        dpl_shadow_destroy(shadow);
        float *v = dpl_test_visibility(context, field, &light, &desc);
        for (int i = 0; i < SIZE * SIZE; i++) {
            double d = hypot(i % SIZE + 0.5 - 8, i / SIZE + 0.5 - 20); /* NOLINT: whole rows */
            double share = d <= 4 ? 1.0 : asin(4 / d) / 3.14159265358979;
            for (int c = 0; c < 3; c++)
                assert_true(fabs((double)rgb[i][c] - (double)v[i] * 2.0 / (1 << c) * share) < 1e-6);
            assert_true(rgb[i][3] == 1.0f);
        }
        free(v);
        dpl_field_destroy(field);
    }
}

static void lights_add_up(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, SIZE, SIZE, 3, 0);
    dpl_light lights[2] = {dpl_test_light(10, 10, 3), dpl_test_light(40, 30, 6)};
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    static float rgb[3][SIZE * SIZE][3];
    dpl_shadow *shadow;
    dpl_shadow_stats stats;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    for (int k = 0; k < 3; k++) {
        dpl_output output = {.data = rgb[k][0], .width = SIZE, .height = SIZE, .channels = 3};
        assert_ok(dpl_shadow_light(shadow, field, k < 2 ? &lights[k] : lights, k < 2 ? 1 : 2, &output));
    }
    dpl_shadow_read_stats(shadow, &stats);
    assert_int_equal(stats.lights, 2);
    assert_true(stats.pixels == stats.lit + stats.dark + stats.worked && stats.memory_bytes > 0);
    for (int i = 0; i < SIZE * SIZE; i++)
        for (int c = 0; c < 3; c++)
            assert_true(fabsf(rgb[0][i][c] + rgb[1][i][c] - rgb[2][i][c]) < 1e-5f);
    dpl_output output = {.data = rgb[0][0], .width = SIZE, .height = SIZE, .channels = 3};
    assert_ok(dpl_shadow_light(shadow, field, NULL, 0, &output)); /* no lights: black */
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_true(rgb[0][i][0] == 0.0f);
    dpl_shadow_destroy(shadow);
    dpl_field_destroy(field);
}

static void one_light(dpl_field *field, const dpl_light *light, dpl_shadow_method method, float (*rgb)[3]) {
    dpl_shadow_desc desc = dpl_test_method(method);
    dpl_output output = {.data = rgb[0], .width = SIZE, .height = SIZE, .channels = 3};
    dpl_shadow *shadow;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_ok(dpl_shadow_light(shadow, field, light, 1, &output));
    dpl_shadow_destroy(shadow);
}

static void media_take_their_share_by_colour(void **state) {
    (void)state;
    static float clear[SIZE * SIZE][3], fog[2][SIZE * SIZE][3];
    dpl_light light = dpl_test_light(6, 24, 2);
    dpl_field *field = dpl_test_field(context, SIZE, SIZE);
    one_light(field, &light, DPL_SHADOW_EXACT, clear);
    dpl_shape slab = dpl_shape_default(DPL_SHAPE_BOX);
    slab.box = (dpl_box){{20, 24}, {5, 24}, 0};
    for (int c = 0; c < 3; c++)
        slab.material.extinction[c] = 0.05f * (float)c;
    assert_ok(dpl_field_draw_shapes(field, &slab, 1));
    one_light(field, &light, DPL_SHADOW_EXACT, fog[0]);
    one_light(field, &light, DPL_SHADOW_REFERENCE, fog[1]);
    for (int i = 0; i < SIZE * SIZE; i++)
        for (int c = 0; c < 3; c++)
            assert_true(fabsf(fog[0][i][c] - fog[1][i][c]) <= 0.01f * fog[1][i][c] + 1e-6f);
    int straight = 23 * SIZE + 40; /* crosses all of the slab, nearly straight */
    for (int c = 0; c < 3; c++)
        assert_true(fabs((double)(fog[0][straight][c] / clear[straight][c]) - exp(-0.5 * c)) < 0.01);
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    float *v = dpl_test_visibility(context, field, &light, &desc);
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_true(v[i] == 1.0f); /* a medium is not opaque */
    free(v);
    dpl_field_destroy(field);
}

static void inside_the_disc_all_is_light(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, SIZE, SIZE);
    dpl_test_block(field, 20, 20, 22, 22, INFINITY);
    dpl_light light = dpl_test_light(21, 21, 10);
    static float rgb[SIZE * SIZE][3];
    one_light(field, &light, DPL_SHADOW_EXACT, rgb);
    assert_true(rgb[24 * SIZE + 24][0] == 2.0f && rgb[24 * SIZE + 24][2] == 0.5f);
    assert_true(rgb[21 * SIZE + 21][0] == 0.0f); /* opaque */
    assert_true(fabsf(rgb[21 * SIZE + 40][0] - 2.0f * asinf(10 / 19.506f) / 3.14159265f) < 1e-3f);
    dpl_field_destroy(field);
}

/* ---- bad input ------------------------------------------------------------------------------------ */

static void bad_descs_are_refused(void **state) {
    (void)state;
    dpl_shadow *shadow = NULL;
    dpl_shadow_desc desc = {0};
    assert_int_equal(dpl_shadow_create(context, &desc, &shadow), DPL_ERROR_DESC);
    assert_int_equal(dpl_shadow_create(context, NULL, &shadow), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_shadow_create(NULL, &desc, &shadow), DPL_ERROR_ARGUMENT);
    for (int k = 0; k < 16; k++) {
        desc = dpl_shadow_desc_default();
        switch (k) {
        case 0:
            desc.method = (dpl_shadow_method)DPL_SHADOW_METHOD_COUNT;
            break;
        case 1:
            desc.method = (dpl_shadow_method)-1;
            break;
        case 2:
            desc.weight = (dpl_shadow_weight)DPL_WEIGHT_COUNT;
            break;
        case 3:
            desc.map_method = DPL_SHADOW_MOMENTS_4;
            break;
        case 4:
            desc.field_method = DPL_SHADOW_EXACT;
            break;
        case 5:
            desc.tau = 0.0f;
            break;
        case 6:
            desc.tau = NAN;
            break;
        case 7:
            desc.constant = 1.5f;
            break;
        case 8:
            desc.blend_distance = 0.0f;
            break;
        case 9:
            desc.map_resolution = 18;
            break;
        case 10:
            desc.map_resolution = 12;
            break;
        case 11:
            desc.field_level = 5;
            break;
        case 12:
            desc.sub_cones = 0;
            break;
        case 13:
            desc.sub_cones = 65;
            break;
        case 14:
            desc.samples = -1;
            break;
        default:
            desc.samples = 65537;
            break;
        }
        assert_int_equal(dpl_shadow_create(context, &desc, &shadow), DPL_ERROR_ARGUMENT);
        assert_null(shadow);
        assert_true(strlen(dpl_context_message(context)) > 0);
    }
    dpl_shadow_destroy(NULL);
    assert_string_equal(dpl_shadow_method_name(DPL_SHADOW_MRMA), "mrma");
    assert_string_equal(dpl_shadow_method_name((dpl_shadow_method)99), "?");
    assert_string_equal(dpl_shadow_weight_name(DPL_WEIGHT_GAP), "gap");
    assert_string_equal(dpl_shadow_weight_name((dpl_shadow_weight)99), "?");
}

static void bad_lights_and_outputs_are_refused_and_nothing_is_written(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, SIZE, SIZE);
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_shadow *shadow;
    float v[SIZE * SIZE], untouched = -3.0f;
    v[0] = untouched;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    for (int k = 0; k < 6; k++) {
        dpl_light lights[2] = {dpl_test_light(5, 5, 2), dpl_test_light(5, 5, 2)};
        double bad[6] = {NAN, INFINITY, 2e6, -1.0, NAN, -1.0};
        if (k < 3)
            lights[1].position[k % 2] = bad[k];
        else if (k == 3)
            lights[1].radius = bad[k];
        else if (k == 4)
            lights[1].color[1] = (float)bad[k];
        else
            lights[1].intensity = (float)bad[k];
        float rgb[SIZE * SIZE * 3];
        dpl_output output = {.data = rgb, .width = SIZE, .height = SIZE, .channels = 3};
        assert_int_equal(dpl_shadow_visibility(shadow, field, &lights[1], v, 0), DPL_ERROR_ARGUMENT);
        assert_int_equal(dpl_shadow_light(shadow, field, lights, 2, &output), DPL_ERROR_ARGUMENT);
        assert_non_null(strstr(dpl_context_message(context), "light 1"));
    }
    dpl_light light = dpl_test_light(5, 5, 2);
    dpl_output wrong[4] = {{.data = v, .width = SIZE - 1, .height = SIZE, .channels = 3, .row_stride = 0},
                           {.data = v, .width = SIZE, .height = SIZE, .channels = 2, .row_stride = 0},
                           {.data = v, .width = SIZE, .height = SIZE, .channels = 3, .row_stride = 8},
                           {.data = NULL, .width = SIZE, .height = SIZE, .channels = 3, .row_stride = 0}};
    for (int k = 0; k < 4; k++)
        assert_true(dpl_shadow_light(shadow, field, &light, 1, &wrong[k]) != DPL_OK);
    assert_int_equal(dpl_shadow_visibility(shadow, field, &light, v, 4), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_shadow_visibility(shadow, field, &light, NULL, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_shadow_visibility(shadow, NULL, &light, v, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_shadow_light(shadow, field, NULL, 1, &wrong[0]), DPL_ERROR_ARGUMENT);
    dpl_context *other;
    assert_ok(dpl_context_create(NULL, &other));
    dpl_field *foreign = dpl_test_field(other, SIZE, SIZE);
    assert_int_equal(dpl_shadow_visibility(shadow, foreign, &light, v, 0), DPL_ERROR_ARGUMENT);
    assert_true(v[0] == untouched);
    dpl_field_destroy(foreign);
    dpl_context_destroy(other);
    dpl_shadow_destroy(shadow);
    dpl_field_destroy(field);
}

static int cancel(double done, void *user) {
    *(double *)user = done;
    return done < 0.5;
}

static void a_cancelled_shadow_leaves_the_output_alone(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, SIZE, SIZE, 1, 0);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_REFERENCE);
    double done = 0.0;
    desc.samples = 4;
    desc.progress = cancel;
    desc.progress_user = &done;
    dpl_light light = dpl_test_light(5, 5, 2);
    dpl_shadow *shadow;
    float v[SIZE * SIZE] = {-3.0f};
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_int_equal(dpl_shadow_visibility(shadow, field, &light, v, 0), DPL_ERROR_CANCELLED);
    assert_true(v[0] == -3.0f && done >= 0.5 && done < 0.6);
    dpl_shadow_destroy(shadow);
    dpl_field_destroy(field);
}

/* ---- memory and strides --------------------------------------------------------------------------- */

typedef struct heap {
    int64_t calls;
    int64_t left; /* allocations until one fails; below 0: none does */
} heap;

static void *count_allocation(size_t bytes, size_t alignment, void *user) {
    heap *h = user;
    h->calls++;
    if (h->left == 0)
        return NULL;
    h->left -= h->left > 0;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void free_memory(void *memory, size_t bytes, void *user) {
    (void)bytes;
    (void)user;
    free(memory);
}

static dpl_context *counting_context(heap *h) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *made;
    desc.allocator = (dpl_allocator){count_allocation, free_memory, h};
    desc.thread_count = 1;
    assert_ok(dpl_context_create(&desc, &made));
    return made;
}

static void the_second_frame_allocates_nothing(void **state) {
    (void)state;
    for (int method = 0; method < DPL_SHADOW_METHOD_COUNT; method++) {
        heap h = {0, -1};
        dpl_context *own = counting_context(&h);
        dpl_field *field = dpl_test_world(own, SIZE, SIZE, 2, 0);
        dpl_shadow_desc desc = dpl_test_method((dpl_shadow_method)method);
        dpl_light light = dpl_test_light(5, 5, 2);
        dpl_shadow *shadow;
        float v[SIZE * SIZE];
        desc.samples = 8;
        desc.field_level = 1;
        assert_ok(dpl_shadow_create(own, &desc, &shadow));
        assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
        int64_t before = h.calls;
        dpl_test_block(field, 30, 30, 35, 35, INFINITY);
        light.position[0] = 8;
        assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
        assert_true(h.calls == before);
        dpl_shadow_destroy(shadow);
        dpl_field_destroy(field);
        dpl_context_destroy(own);
    }
}

static void no_memory_is_an_error_wherever_it_runs_out(void **state) {
    (void)state;
    heap h = {0, -1};
    dpl_context *own = counting_context(&h);
    dpl_field *field = dpl_test_world(own, SIZE, SIZE, 2, 0);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_MRMA);
    dpl_light light = dpl_test_light(5, 5, 2);
    float v[SIZE * SIZE];
    desc.field_level = 2;
    dpl_status status = DPL_ERROR_MEMORY;
    for (int64_t most = 0; status != DPL_OK; most++) {
        dpl_shadow *shadow;
        assert_true(most < 60);
        h.left = most;
        status = dpl_shadow_create(own, &desc, &shadow);
        if (status == DPL_OK) {
            status = dpl_shadow_visibility(shadow, field, &light, v, 0);
            h.left = -1; /* and then there is enough again */
            if (status != DPL_OK)
                assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
            dpl_shadow_destroy(shadow);
        }
        assert_true(status == DPL_OK || status == DPL_ERROR_MEMORY);
    }
    h.left = -1;
    dpl_field_destroy(field);
    dpl_context_destroy(own);
}

static void strides_flip_and_pad(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, SIZE, SIZE, 2, 0);
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_light light = dpl_test_light(5, 5, 2);
    float *v = dpl_test_visibility(context, field, &light, &desc);
    float flipped[SIZE][SIZE + 3];
    dpl_shadow *shadow;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_ok(dpl_shadow_visibility(shadow, field, &light, flipped[SIZE - 1], -(ptrdiff_t)sizeof flipped[0]));
    for (int y = 0; y < SIZE; y++)
        assert_memory_equal(v + y * SIZE, flipped[SIZE - 1 - y], SIZE * sizeof *v);
    dpl_shadow_destroy(shadow);
    free(v);
    dpl_field_destroy(field);
}

static void a_drawn_field_is_looked_at_again(void **state) {
    (void)state;
    dpl_field *field = dpl_test_field(context, SIZE, SIZE);
    dpl_shadow_desc desc = dpl_test_method(DPL_SHADOW_MRMA);
    dpl_light light = dpl_test_light(5, 24, 2);
    dpl_shadow *shadow;
    float v[SIZE * SIZE];
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
    assert_true(v[24 * SIZE + 40] == 1.0f); /* an empty world is lit */
    dpl_test_block(field, 20, 10, 24, 40, INFINITY);
    assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
    assert_true(v[24 * SIZE + 40] == 0.0f);
    dpl_field_clear(field);
    assert_ok(dpl_shadow_visibility(shadow, field, &light, v, 0));
    assert_true(v[24 * SIZE + 40] == 1.0f);
    dpl_shadow_destroy(shadow);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_visibility_times_the_arcsine),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(media_take_their_share_by_colour),
        cmocka_unit_test(inside_the_disc_all_is_light),
        cmocka_unit_test(bad_descs_are_refused),
        cmocka_unit_test(bad_lights_and_outputs_are_refused_and_nothing_is_written),
        cmocka_unit_test(a_cancelled_shadow_leaves_the_output_alone),
        cmocka_unit_test(the_second_frame_allocates_nothing),
        cmocka_unit_test(no_memory_is_an_error_wherever_it_runs_out),
        cmocka_unit_test(strides_flip_and_pad),
        cmocka_unit_test(a_drawn_field_is_looked_at_again),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
