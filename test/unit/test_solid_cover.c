/* Rays of refinement, many at once, say what the same rays say one by one: past meshes that are solid, open
 * or inside out, and from lights outside and inside of them. */
#include "solid_world.h"

#include <stdlib.h>

enum { SIDE = 56, RECEIVERS = SIDE * SIDE, RAYS = 32 };

static float positions[RECEIVERS][3], normals[RECEIVERS][3], by_one[RECEIVERS], at_once[RECEIVERS];

static void cast(const dpl_mesh *mesh, const dpl_mesh_field *field, const dpl_solid_light *light,
                 const dpl_solid_shadow_desc *desc, bool has_normals, float *visibility) {
    dpl_solid_shadow *shadow;
    assert_ok(dpl_solid_shadow_create(context, desc, &shadow));
    assert_ok(dpl_solid_shadow_set_light(shadow, mesh, field, light));
    assert_ok(dpl_solid_shadow_visibility(shadow, (const float(*)[3])positions,
                                          has_normals ? (const float(*)[3])normals : NULL, RECEIVERS,
                                          visibility));
    dpl_solid_shadow_destroy(shadow);
}

/* Every receiver by both ways; a ray in ten thousand may graze an edge and be decided by rounding. */
static void both_ways_agree(dpl_mesh_data *data, const dpl_solid_light *light, bool has_normals) {
    dpl_mesh *mesh = solid_mesh(context, data);
    dpl_mesh_field *field = solid_field(context, mesh, 48);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    desc.classify = 0;
    desc.refine_rays = RAYS;
    cast(mesh, field, light, &desc, has_normals, at_once);
    desc.method = DPL_SOLID_REFERENCE;
    desc.samples = RAYS;
    cast(mesh, field, light, &desc, has_normals, by_one);
    int apart = 0, partly = 0;
    for (int i = 0; i < RECEIVERS; i++) {
        apart += (int)(fabsf(at_once[i] - by_one[i]) * RAYS + 0.5f);
        partly += by_one[i] > 0.0f && by_one[i] < 1.0f;
    }
    assert_true(partly > 5);
    assert_true(apart <= RECEIVERS * RAYS / 10000);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

static dpl_mesh_data reference_mesh(void) {
    dpl_mesh_data data = {0};
    assert_true(dpl_solid_reference_mesh(DPL_SOLID_REFERENCE_SEED, 8, &data, NULL));
    return data;
}

static void turn_inside_out(dpl_mesh_data *data, int32_t first, int32_t end) {
    for (int32_t i = first; i < end; i++) {
        int32_t corner = data->indices[i][0];
        data->indices[i][0] = data->indices[i][1];
        data->indices[i][1] = corner;
    }
}

static dpl_solid_light light_of(dpl_solid_light_kind kind, float radius) {
    dpl_solid_light light = dpl_solid_reference_light(radius);
    light.kind = kind;
    return light;
}

static void past_solid_meshes(void **state) {
    (void)state;
    static const float radii[] = {0.3f, 0.3f, 0.06f};
    for (int kind = 0; kind < 3; kind++)
        for (int has_normals = 0; has_normals < 2; has_normals++) {
            dpl_mesh_data data = reference_mesh();
            dpl_solid_light light = light_of((dpl_solid_light_kind)kind, radii[kind]);
            both_ways_agree(&data, &light, has_normals);
        }
}

static void past_open_meshes(void **state) {
    (void)state;
    dpl_mesh_data data = reference_mesh();
    dpl_mesh_transform plane = solid_at(0.5, 0.9, 0.3, 0.5, 1.0, 0.4, 0.2);
    dpl_solid_light light = light_of(DPL_SOLID_LIGHT_SPOT, 0.3f);
    assert_true(dpl_mesh_data_add_plane(&data, &plane, NULL));
    both_ways_agree(&data, &light, true);
}

/* All of it, and a part alone: receivers below parts that stand on the ground are inside of them. */
static void past_meshes_that_are_inside_out(void **state) {
    (void)state;
    for (int some = 0; some < 2; some++) {
        dpl_mesh_data data = reference_mesh();
        dpl_solid_light light = light_of(DPL_SOLID_LIGHT_SPOT, 0.3f);
        turn_inside_out(&data, some ? data.triangle_count / 2 : 0, data.triangle_count);
        both_ways_agree(&data, &light, true);
    }
}

/* A lamp in a closed shade shines on nothing outside; in one without a lid, past its rim. Half of it is below
 * the ground, so some receivers are inside. */
static void from_within_a_shade(void **state) {
    (void)state;
    for (int closed = 0; closed < 2; closed++) {
        dpl_mesh_data data = {0};
        dpl_mesh_transform shade = solid_at(0.2, 0.3, 0.1, 0.5, 0.6, 0.4, 0.3);
        dpl_mesh_transform ball = solid_at(0.3, 0.1, 0.3, 0.1, 0.1, 0.1, 0.0);
        dpl_solid_light light = light_of(DPL_SOLID_LIGHT_POINT, 0.1f);
        assert_true(dpl_mesh_data_add_box(&data, &shade, NULL));
        if (!closed)
            data.triangle_count -= 5;
        assert_true(dpl_mesh_data_add_sphere(&data, &ball, 12, NULL));
        light.position[0] = 0.2f, light.position[1] = 0.5f, light.position[2] = 0.1f;
        both_ways_agree(&data, &light, true);
        for (int i = 0; i < RECEIVERS && closed; i++)
            assert_true(fabsf(positions[i][0]) < 1.0f || at_once[i] == 0.0f);
    }
}

/* Blockers behind the light do not count, and those through which its disc stands do in part. */
static void past_blockers_around_the_light(void **state) {
    (void)state;
    dpl_mesh_data data = reference_mesh();
    dpl_solid_light light = light_of(DPL_SOLID_LIGHT_POINT, 0.2f);
    light.position[0] = 0.3f, light.position[1] = 0.9f, light.position[2] = -0.2f;
    both_ways_agree(&data, &light, true);
}

static int place(void **state) {
    dpl_solid_reference_receivers(SIDE, positions, normals);
    return open_context(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(past_solid_meshes),
        cmocka_unit_test(past_open_meshes),
        cmocka_unit_test(past_meshes_that_are_inside_out),
        cmocka_unit_test(from_within_a_shade),
        cmocka_unit_test(past_blockers_around_the_light),
    };
    return cmocka_run_group_tests(tests, place, close_context);
}
