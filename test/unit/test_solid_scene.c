/* Scenes in space and the mesh files in them: what is read, and errors that name file, line, column and key.
 */
#include "testing.h"

#include "../../meshes/mesh_file.h"
#include "../../scenes/solid_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define HEAD "{ \"dapple3d\": 1,\n  \"camera\": { \"eye\": [0, 1, 3], \"target\": [0, 0, 0] },\n"

static bool read_text(const char *text, dpl_solid_scene *scene, dpl_error *error) {
    return dpl_solid_scene_read_memory(text, strlen(text), "s.json", scene, error);
}

static void a_scene_is_read_with_all_that_it_says(void **state) {
    (void)state;
    dpl_solid_scene scene;
    dpl_error error;
    assert_true(read_text(
        HEAD "  \"size\": [64, 48], \"background\": 0.5, \"ambient\": [0.1, 0.2, 0.3],\n"
             "  \"lights\": [ { \"spot\": { \"position\": [0, 4, 0], \"direction\": [0, -2, 0] } },\n"
             "    { \"point\": { \"position\": [1, 2, 3], \"radius\": 0.5 }, \"intensity\": 3 },\n"
             "    { \"directional\": { \"direction\": [1, -1, 0] }, \"color\": [1, 0.5, 0] } ],\n"
             "  \"meshes\": [ { \"plane\": { \"half\": [2, 1, 3] }, \"casts\": 0, \"albedo\": 0.25 },\n"
             "    { \"box\": { \"half\": [1, 2, 3] }, \"scale\": 2, \"move\": [10, 0, 0] },\n"
             "    { \"sphere\": { \"center\": [1, 0, 0], \"radius\": 0.5, \"rings\": 8 },\n"
             "      \"rotate\": [0, 0, 1.5707963267948966] } ] }",
        &scene, &error));
    assert_true(scene.camera.width == 64 && scene.camera.height == 48);
    assert_true(scene.light_count == 3 && scene.part_count == 3);
    assert_true(scene.lights[1].kind == DPL_SOLID_LIGHT_POINT && scene.lights[1].radius == 0.5f);
    assert_true(scene.lights[2].color[1] == 0.5f && scene.lights[1].intensity == 3.0f);
    assert_true(scene.others.triangle_count == 2 && scene.casting.triangle_count == 12 + 4 * 7 * 8);
    assert_true(scene.casting.vertices[7][0] == 12.0f && scene.casting.vertices[7][2] == 6.0f);
    /* The ball's middle, (1, 0, 0), is turned a quarter around z to (0, 1, 0). */
    assert_true(fabsf(scene.casting.vertices[8][0] + 0.5f) < 1e-5f);
    assert_true(fabsf(scene.casting.vertices[8][1] - 1.0f) < 1e-5f);
    assert_ptr_equal(dpl_solid_scene_part(&scene, 11), &scene.parts[1]);
    assert_ptr_equal(dpl_solid_scene_part(&scene, 12), &scene.parts[2]);
    assert_ptr_equal(dpl_solid_scene_part(&scene, scene.casting.triangle_count), &scene.parts[0]);
    assert_null(dpl_solid_scene_part(&scene, scene.casting.triangle_count + 2));
    assert_true(scene.parts[0].albedo[2] == 0.25f && scene.ambient[2] == 0.3f);
    dpl_solid_scene_free(&scene);
}

static void mistakes_are_named_by_line_column_and_key(void **state) {
    (void)state;
    static const struct {
        const char *text;
        const char *error;
    } cases[] = {
        {"", "s.json: is empty, not a scene"},
        {"{ \"dapple3d\": 2 }", "s.json:1:15: dapple3d: must be 1, the only version of the format there is"},
        {"{ \"dapple3d\": 1 }", "s.json:1:1: camera: is required but missing"},
        {HEAD "  \"meshes\": [] }", "s.json:3:13: meshes: needs at least one mesh that casts shadows"},
        {HEAD "  \"meshes\": [ { \"box\": {}, \"sphere\": {} } ] }",
         "s.json:3:17: meshes[0].box: is a second kind beside sphere"},
        {HEAD "  \"meshes\": [ { \"box\": { \"half\": [1, 2] } } ] }",
         "s.json:3:34: meshes[0].box.half: must have 3 numbers (has 2)"},
        {HEAD "  \"meshes\": [ { \"move\": [1, 2, 3] } ] }",
         "s.json:3:15: meshes[0]: must have one of file, sphere, box, plane"},
        {HEAD "  \"lights\": [ { \"spot\": { \"position\": [0, 1, 0], \"direction\": [0, 0, 0] } } ],\n"
              "  \"meshes\": [ { \"box\": {} } ] }",
         "s.json:3:50: lights[0].spot.direction: must not be nothing"},
        {HEAD "  \"lights\": [ { \"point\": { \"position\": [0, 1, 0], \"radius\": 0 } } ] }",
         "s.json:3:61: lights[0].point.radius: must be at least 1e-06 (is 0)"},
        {HEAD "  \"meshes\": [ { \"file\": \"a.stl\" } ] }",
         "s.json:3:25: meshes[0].file: a.stl: is no mesh file; those end in .gltf, .glb, .obj or .ply"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dpl_solid_scene scene;
        dpl_error error = {""};
        assert_false(read_text(cases[i].text, &scene, &error));
        if (dpl_mesh_file_is_built_in() || !strstr(cases[i].text, "a.stl"))
            assert_string_equal(error.text, cases[i].error);
        assert_null(scene.parts);
    }
}

static void a_scene_in_space_is_told_from_a_flat_one(void **state) {
    (void)state;
    static const char solid[] = "{ \"dapple3d\": 1 }", flat[] = "{ \"dapple\": 1 }";
    assert_true(dpl_solid_scene_is_one(solid, sizeof solid - 1));
    assert_false(dpl_solid_scene_is_one(flat, sizeof flat - 1));
    assert_false(dpl_solid_scene_is_one(solid, 8));
}

/* ---- mesh files ----------------------------------------------------------------------------------- */

static void write_file(const char *name, const char *text) {
    FILE *stream = fopen(name, "wb");
    assert_non_null(stream);
    assert_true(fputs(text, stream) >= 0);
    assert_int_equal(fclose(stream), 0);
}

/* A square of 2 x 2 at z = 1, as a polygon or as two triangles. */
#define OBJ "v 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nf 1 2 3 4\n"
#define PLY                                                                                                  \
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"        \
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"                                   \
    "0 0 1\n2 0 1\n2 2 1\n0 2 1\n3 0 1 2\n3 0 2 3\n"
/* The node moves its mesh by 1 along z; the buffer holds four corners at z = 0 and six numbers of them. */
#define GLTF                                                                                                 \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"                             \
    "\"nodes\":[{\"mesh\":0,\"translation\":[0,0,1]}],"                                                      \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"                       \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\","                 \
    "\"min\":[0,0,0],\"max\":[2,2,0]},{\"bufferView\":1,\"componentType\":5123,\"count\":6,"                 \
    "\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                               \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}],\"buffers\":[{\"byteLength\":60,\"uri\":"           \
    "\"data:application/octet-stream;base64,"                                                                \
    "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAQAAAAEAAAAAAAAAAAAAAAEAAAAAAAAABAAIAAAACAAMA\"}]}"

static void files_of_each_format_hold_the_same_square(void **state) {
    (void)state;
    static const char *const names[] = {"square.obj", "square.ply", "square.gltf"};
    static const char *const texts[] = {OBJ, PLY, GLTF};
    if (!dpl_mesh_file_is_built_in())
        skip();
    for (int i = 0; i < 3; i++) {
        dpl_mesh_data data = {0};
        dpl_error error = {""};
        const double scale[3] = {3, 3, 3}, angles[3] = {0}, move[3] = {0, 0, 5};
        dpl_mesh_transform transform = dpl_mesh_transform_of(scale, angles, move);
        double area = 0.0;
        write_file(names[i], texts[i]);
        if (!dpl_mesh_file_read(names[i], &transform, &data, &error))
            fail_msg("%s", error.text);
        assert_int_equal(data.triangle_count, 2);
        for (int32_t k = 0; k < 2; k++) {
            const float *a = data.vertices[data.indices[k][0]], *b = data.vertices[data.indices[k][1]],
                        *c = data.vertices[data.indices[k][2]];
            area += 0.5 * (double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            assert_true(fabsf(a[2] - 8.0f) < 1e-5f);
        }
        assert_true(fabs(area - 36.0) < 1e-4);
        dpl_mesh_data_free(&data);
        assert_int_equal(remove(names[i]), 0);
    }
}

static void bad_files_are_named(void **state) {
    (void)state;
    static const struct {
        const char *name;
        const char *text; /* NULL: there is none */
        const char *error;
    } cases[] = {
        {"missing.obj", NULL, "missing.obj: "},
        {"broken.glb", "glTF but not really", "broken.glb: "},
        {"points.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "end_header\n0 0 1\n",
         "points.ply: "},
        {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
         "nan.obj: corner 0 is not finite or beyond 1e9"},
    };
    if (!dpl_mesh_file_is_built_in())
        skip();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dpl_mesh_data data = {0};
        dpl_error error = {""};
        dpl_mesh_transform none = dpl_mesh_transform_none();
        if (cases[i].text)
            write_file(cases[i].name, cases[i].text);
        assert_false(dpl_mesh_file_read(cases[i].name, &none, &data, &error));
        assert_memory_equal(error.text, cases[i].error, strlen(cases[i].error));
        dpl_mesh_data_free(&data);
        if (cases[i].text)
            assert_int_equal(remove(cases[i].name), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_is_read_with_all_that_it_says),
        cmocka_unit_test(mistakes_are_named_by_line_column_and_key),
        cmocka_unit_test(a_scene_in_space_is_told_from_a_flat_one),
        cmocka_unit_test(files_of_each_format_hold_the_same_square),
        cmocka_unit_test(bad_files_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
