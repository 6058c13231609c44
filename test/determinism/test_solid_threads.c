/* Meshes, distances and shadows in space: the same bytes and counters for every number of threads and every
 * instruction set, no memory asked for once a frame has been seen, and memory that runs out at any point. */
#include "counting.h"
#include "solid_world.h"

#include <stdlib.h>

enum { SIDE = 24, RECEIVERS = SIDE * SIDE, WIDTH = 20, HEIGHT = 12 };

typedef struct result {
    float visibility[3][RECEIVERS]; /* by kind of light */
    dpl_solid_shadow_stats stats[3];
    float seen[HEIGHT * WIDTH][3];
    float distance[4];
} result;

typedef struct objects {
    dpl_mesh *mesh;
    dpl_mesh_field *field;
    dpl_solid_shadow *shadow;
} objects;

/* The reference scene and, so that open meshes are part of it, a plane without a neighbour. */
static void make_data(dpl_mesh_data *data) {
    dpl_mesh_transform plane = solid_at(0.5, 0.9, 0.3, 0.3, 1.0, 0.3, 0.2);
    *data = (dpl_mesh_data){0};
    assert_true(dpl_solid_reference_mesh(DPL_SOLID_REFERENCE_SEED, 4, data, NULL));
    assert_true(dpl_mesh_data_add_plane(data, &plane, NULL));
}

static dpl_status create(dpl_context *in, const dpl_mesh_data *data, objects *o) {
    dpl_mesh_desc mesh = dpl_mesh_data_desc(data);
    dpl_mesh_field_desc field = dpl_mesh_field_desc_default();
    dpl_solid_shadow_desc shadow = dpl_solid_shadow_desc_default();
    field.resolution = 40;
    shadow.map_resolution = 64;
    dpl_status status = dpl_mesh_create(in, &mesh, &o->mesh);
    if (status == DPL_OK)
        status = dpl_mesh_field_create(in, &field, &o->field);
    if (status == DPL_OK)
        status = dpl_solid_shadow_create(in, &shadow, &o->shadow);
    return status;
}

static void destroy(objects *o) {
    dpl_solid_shadow_destroy(o->shadow);
    dpl_mesh_field_destroy(o->field);
    dpl_mesh_destroy(o->mesh);
    *o = (objects){0};
}

/* The mesh moves, is measured and casts the shadows of three lights. */
static dpl_status one_frame(objects *o, const dpl_mesh_data *data, result *r) {
    static float positions[RECEIVERS][3], normals[RECEIVERS][3], seen_normals[HEIGHT * WIDTH][3];
    static int32_t triangles[HEIGHT * WIDTH];
    dpl_mesh_desc desc = dpl_mesh_data_desc(data);
    dpl_solid_camera camera = dpl_solid_camera_default();
    camera.eye[1] = 2.0f;
    camera.eye[2] = 4.0f;
    camera.width = WIDTH;
    camera.height = HEIGHT;
    dpl_solid_reference_receivers(SIDE, positions, normals);
    dpl_status status = dpl_mesh_set(o->mesh, &desc);
    if (status == DPL_OK)
        status = dpl_mesh_field_measure(o->field, o->mesh);
    for (int kind = 0; kind < 3 && status == DPL_OK; kind++) {
        dpl_solid_light light = dpl_solid_reference_light(0.05f);
        light.kind = (dpl_solid_light_kind)kind;
        status = dpl_solid_shadow_set_light(o->shadow, o->mesh, o->field, &light);
        if (status == DPL_OK)
            status = dpl_solid_shadow_visibility(o->shadow, (const float(*)[3])positions,
                                                 (const float(*)[3])normals, RECEIVERS, r->visibility[kind]);
        dpl_solid_shadow_read_stats(o->shadow, &r->stats[kind]);
        r->stats[kind].memory_bytes = 0; /* counters are kept per worker */
    }
    if (status == DPL_OK)
        status = dpl_solid_camera_look(o->mesh, &camera, r->seen, seen_normals, triangles);
    for (int i = 0; i < 4 && status == DPL_OK; i++)
        r->distance[i] = dpl_mesh_field_distance(o->field, (const float[3]){0.3f * (float)i, 0.4f, 0.2f});
    return status;
}

static void every_thread_count_gives_the_same_bytes_and_counters(void **state) {
    (void)state;
    static const int32_t thread_counts[] = {1, 2, 3, 8};
    static result first, other;
    dpl_mesh_data data;
    make_data(&data);
    for (size_t i = 0; i < sizeof thread_counts / sizeof thread_counts[0]; i++) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *in;
        objects o = {0};
        desc.thread_count = thread_counts[i];
        assert_ok(dpl_context_create(&desc, &in));
        assert_ok(create(in, &data, &o));
        assert_ok(one_frame(&o, &data, i == 0 ? &first : &other));
        if (i > 0)
            assert_memory_equal(&first, &other, sizeof first);
        destroy(&o);
        dpl_context_destroy(in);
    }
    for (int kind = 0; kind < 3; kind++) {
        assert_int_equal(first.stats[kind].receivers, RECEIVERS);
        assert_true(first.stats[kind].refined > 0 && first.stats[kind].lit > 0);
    }
    dpl_mesh_data_free(&data);
}

static void every_instruction_set_gives_the_same_bytes_and_counters(void **state) {
    (void)state;
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    static result first, other;
    dpl_mesh_data data;
    make_data(&data);
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        dpl_context_desc desc = dpl_context_desc_default();
        dpl_context *in;
        objects o = {0};
        desc.isa_mask = (uint32_t)isas[i];
        desc.thread_count = 1;
        if (!(dpl_isa_available() & desc.isa_mask))
            continue;
        assert_ok(dpl_context_create(&desc, &in));
        assert_ok(create(in, &data, &o));
        assert_ok(one_frame(&o, &data, i == 0 ? &first : &other));
        if (i > 0)
            assert_memory_equal(&first, &other, sizeof first);
        destroy(&o);
        dpl_context_destroy(in);
    }
    dpl_mesh_data_free(&data);
}

/* ---- memory --------------------------------------------------------------------------------------- */

static dpl_context *counted_context(counting *c) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *in;
    desc.thread_count = 1;
    desc.allocator = (dpl_allocator){count_allocate, count_release, c};
    assert_ok(dpl_context_create(&desc, &in));
    return in;
}

static void a_second_frame_allocates_nothing(void **state) {
    (void)state;
    static result r;
    counting c = {0};
    dpl_mesh_data data;
    objects o = {0};
    make_data(&data);
    dpl_context *in = counted_context(&c);
    assert_ok(create(in, &data, &o));
    assert_ok(one_frame(&o, &data, &r));
    int before = c.allocations;
    for (int i = 0; i < data.vertex_count; i++)
        data.vertices[i][0] += 0.1f;
    assert_ok(one_frame(&o, &data, &r));
    assert_int_equal(c.allocations, before);
    destroy(&o);
    dpl_context_destroy(in);
    assert_int_equal(c.live, 0);
    dpl_mesh_data_free(&data);
}

static void memory_that_runs_out_anywhere_is_an_error_and_leaks_nothing(void **state) {
    (void)state;
    static result r, again;
    dpl_mesh_data data;
    make_data(&data);
    bool failed = true;
    for (int nth = 1; failed; nth++) {
        counting c = {0};
        objects o = {0};
        dpl_context *in = counted_context(&c);
        c.fail_at = c.allocations + nth;
        dpl_status status = create(in, &data, &o);
        if (status == DPL_OK) {
            status = one_frame(&o, &data, &r);
            failed = status != DPL_OK;
            if (failed) { /* and the objects can be used again */
                assert_int_equal(status, DPL_ERROR_MEMORY);
                assert_ok(one_frame(&o, &data, &again));
            }
        } else {
            assert_int_equal(status, DPL_ERROR_MEMORY);
        }
        assert_true(nth < 100);
        destroy(&o);
        dpl_context_destroy(in);
        assert_int_equal(c.live, 0);
    }
    assert_memory_equal(&r, &again, sizeof r);
    dpl_mesh_data_free(&data);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_thread_count_gives_the_same_bytes_and_counters),
        cmocka_unit_test(every_instruction_set_gives_the_same_bytes_and_counters),
        cmocka_unit_test(a_second_frame_allocates_nothing),
        cmocka_unit_test(memory_that_runs_out_anywhere_is_an_error_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
