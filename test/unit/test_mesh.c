/* Meshes: parts are told apart as closed, unoriented and open; what is no mesh is refused with one clear
 * error. */
#include "solid_world.h"

static dpl_mesh_facts facts_of(dpl_mesh *mesh) {
    dpl_mesh_facts facts;
    dpl_mesh_read_facts(mesh, &facts);
    dpl_mesh_destroy(mesh);
    return facts;
}

static void built_in_shapes_are_closed_and_of_one_part(void **state) {
    (void)state;
    dpl_mesh_facts box = facts_of(solid_box(context, 1, 2, 3, 1, 2, 3, 0.0));
    dpl_mesh_facts sphere = facts_of(solid_sphere(context, 0, 0, 0, 1, 16));
    assert_int_equal(box.triangles, 12);
    assert_int_equal(box.corners, 8);
    assert_int_equal(box.closed_parts, 1);
    assert_true(box.low[2] == 0.0f && box.high[1] == 4.0f);
    assert_int_equal(sphere.triangles, 4 * 15 * 16);
    assert_true(sphere.closed_parts == 1 && sphere.parts == 1 && sphere.degenerate == 0);
}

/* A box whose triangles have corners of their own, as files have them, with some turned around or away. */
static dpl_mesh_facts split_box(int32_t turned, int32_t left_out) {
    dpl_mesh_data box = {0}, split = {0};
    dpl_mesh_transform none = dpl_mesh_transform_none();
    assert_true(dpl_mesh_data_add_box(&box, &none, NULL));
    assert_true(dpl_mesh_data_reserve(&split, 36, 12, NULL));
    for (int32_t i = left_out; i < 12; i++) {
        int32_t at[3];
        for (int k = 0; k < 3; k++) {
            const float *v = box.vertices[box.indices[i][k]];
            at[k] = dpl_mesh_data_add_vertex(&split, &none, (double)v[0], (double)v[1], (double)v[2]);
        }
        dpl_mesh_data_add_triangle(&split, at[0], at[i < turned ? 2 : 1], at[i < turned ? 1 : 2]);
    }
    dpl_mesh_data_free(&box);
    return facts_of(solid_mesh(context, &split));
}

static void corners_at_one_place_are_one_corner(void **state) {
    (void)state;
    dpl_mesh_facts whole = split_box(0, 0), turned = split_box(5, 0), open = split_box(0, 1);
    assert_true(whole.corners == 8 && whole.parts == 1 && whole.closed_parts == 1);
    assert_true(turned.parts == 1 && turned.unoriented_parts == 1);
    assert_true(open.parts == 1 && open.open_parts == 1 && open.triangles == 11);
}

static void parts_are_counted_apart(void **state) {
    (void)state;
    dpl_mesh_data data = {0};
    assert_true(dpl_solid_reference_mesh(DPL_SOLID_REFERENCE_SEED, 8, &data, NULL));
    dpl_mesh_facts facts = facts_of(solid_mesh(context, &data));
    assert_true(facts.parts == 25 && facts.closed_parts == 25);
}

/* ---- what is refused ------------------------------------------------------------------------------ */

static float vertices[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
static int32_t indices[2][3] = {{0, 1, 2}, {0, 1, 3}};

static dpl_mesh_desc two_triangles(void) {
    dpl_mesh_desc desc = dpl_mesh_desc_default();
    desc.vertices = (const float(*)[3])vertices;
    desc.vertex_count = 4;
    desc.indices = (const int32_t(*)[3])indices;
    desc.triangle_count = 2;
    return desc;
}

static void refused(const dpl_mesh_desc *desc, dpl_status expected, const char *message) {
    dpl_mesh *mesh = (dpl_mesh *)(uintptr_t)1;
    assert_int_equal(dpl_mesh_create(context, desc, &mesh), expected);
    assert_null(mesh);
    assert_string_equal(dpl_context_message(context), message);
}

static void bad_meshes_are_refused_by_name(void **state) {
    (void)state;
    dpl_mesh_desc desc = two_triangles();
    desc.triangle_count = 0;
    refused(&desc, DPL_ERROR_SIZE, "a mesh has 1 .. 67108864 triangles, not 0");
    desc = two_triangles();
    desc.vertex_count = 3;
    refused(&desc, DPL_ERROR_ARGUMENT, "triangle 1: there is no corner 3 among 3");
    desc = two_triangles();
    vertices[2][1] = NAN;
    refused(&desc, DPL_ERROR_ARGUMENT, "corner 2: coordinates must be finite and within 1e9");
    vertices[2][1] = INFINITY;
    refused(&desc, DPL_ERROR_ARGUMENT, "corner 2: coordinates must be finite and within 1e9");
    vertices[2][1] = 0.0f;
    refused(&desc, DPL_ERROR_ARGUMENT, "no triangle of the mesh has an area");
    vertices[2][1] = 1.0f;
    desc.cookie = 0;
    refused(&desc, DPL_ERROR_DESC, "the mesh desc was not made by dpl_mesh_desc_default()");
}

static void triangles_without_area_are_counted_and_kept(void **state) {
    (void)state;
    dpl_mesh_desc desc = two_triangles();
    dpl_mesh *mesh;
    assert_ok(dpl_mesh_create(context, &desc, &mesh));
    dpl_mesh_facts facts = facts_of(mesh);
    assert_true(facts.triangles == 2 && facts.degenerate == 1 && facts.open_parts == 1);
}

static void a_mesh_that_could_not_be_set_is_without_triangles(void **state) {
    (void)state;
    dpl_mesh_desc desc = two_triangles();
    dpl_mesh_facts facts;
    dpl_mesh *mesh;
    assert_ok(dpl_mesh_create(context, &desc, &mesh));
    dpl_mesh_field *field = solid_field(context, mesh, 16);
    desc.vertex_count = 0;
    assert_int_equal(dpl_mesh_set(mesh, &desc), DPL_ERROR_ARGUMENT);
    dpl_mesh_read_facts(mesh, &facts);
    assert_int_equal(facts.triangles, 0);
    assert_int_equal(dpl_mesh_field_measure(field, mesh), DPL_ERROR_ARGUMENT);
    assert_null(dpl_mesh_field_samples(field));
    assert_int_equal(dpl_mesh_field_grid(field).size[0], 0);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

static void bad_field_descs_are_refused(void **state) {
    (void)state;
    dpl_mesh_field *field;
    dpl_mesh_field_desc desc = dpl_mesh_field_desc_default();
    desc.resolution = 7;
    assert_int_equal(dpl_mesh_field_create(context, &desc, &field), DPL_ERROR_ARGUMENT);
    desc = dpl_mesh_field_desc_default();
    desc.margin = 33;
    assert_int_equal(dpl_mesh_field_create(context, &desc, &field), DPL_ERROR_ARGUMENT);
    desc = dpl_mesh_field_desc_default();
    desc.band = 0;
    assert_int_equal(dpl_mesh_field_create(context, &desc, &field), DPL_ERROR_ARGUMENT);
    assert_null(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_in_shapes_are_closed_and_of_one_part),
        cmocka_unit_test(corners_at_one_place_are_one_corner),
        cmocka_unit_test(parts_are_counted_apart),
        cmocka_unit_test(bad_meshes_are_refused_by_name),
        cmocka_unit_test(triangles_without_area_are_counted_and_kept),
        cmocka_unit_test(a_mesh_that_could_not_be_set_is_without_triangles),
        cmocka_unit_test(bad_field_descs_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
