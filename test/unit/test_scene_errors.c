/* Every mistake in a scene file is one line that names file, line, column and key. */
#include "testing.h"

#include "../../scenes/scene_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Opens nothing: "two.png" is 2x2 px, "missing.png" is missing, anything else is 4x4 px. */
static bool read_stand_in(const char *path, dpl_picture_colour colour, dpl_picture *picture,
                          dpl_error *error) {
    (void)colour;
    if (strstr(path, "missing.png"))
        return dpl_error_set(error, "%s: No such file or directory", path);
    int32_t side = strstr(path, "two.png") ? 2 : 4;
    return dpl_picture_create(picture, side, side, 3, error);
}

typedef struct mistake {
    const char *text;
    const char *error; /* behind "dir/a.json" */
} mistake;

static void check(const char *text, size_t size, const char *expected) {
    dpl_scene scene;
    dpl_error error = {.text = ""};
    char line[1024];
    assert_false(dpl_scene_read_with(text, size, "dir/a.json", read_stand_in, &scene, &error));
    snprintf(line, sizeof line, "dir/a.json:%s", expected);
    assert_string_equal(error.text, line);
    assert_null(scene.shapes);
    assert_null(scene.images);
    assert_null(scene.lights);
}

static void check_all(const mistake *mistakes, size_t count) {
    for (size_t i = 0; i < count; i++)
        check(mistakes[i].text, strlen(mistakes[i].text), mistakes[i].error);
}

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define SCENE(rest) "{\"dapple\":1,\"size\":[8,8]," rest "}"
#define SHAPE(rest) "{\"dapple\":1,\"size\":[8,8],\n\"shapes\":[{" rest "}]}"
#define DISC(rest) SHAPE("\"disc\":{\"center\":[1,2],\"radius\":3}," rest)
#define IMAGE(rest) "{\"dapple\":1,\"size\":[8,8],\n\"images\":[{" rest "}]}"
#define LIGHT(rest) "{\"dapple\":1,\"size\":[8,8],\n\"lights\":[{" rest "}]}"

static void what_is_no_scene_is_refused(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {"", " is empty, not a scene"},
        {" \n ", "2:2: '[' or '{' expected near end of file"},
        {"[1]", "1:1: must be an object (is an array)"},
        {"7", "1:1: '[' or '{' expected near '7'"},
        {"hello", "1:1: '[' or '{' expected near 'hello'"},
        {"{", "1:2: string or '}' expected near end of file"},
        {"{} x", "1:4: end of file expected near 'x'"},
    };
    check_all(mistakes, COUNT(mistakes));
    check("{\0}", 3, " is neither JSON text nor a PNG picture");
    check("\xff\xff", 2, "1:1: unable to decode byte 0xff");
}

static void syntax_errors_name_the_key(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {DISC("\"emission\": NaN"), "2:59: shapes[0].emission: invalid token near 'NaN'"},
        {SCENE("\"sky\":[0,0,1e999]"), "1:37: sky[2]: real number overflow near '1e999'"},
        {SCENE("\"sky\":[0,\n 0,,1]"), "2:4: sky[2]: unexpected token near ','"},
        {SCENE("\"sky\":Infinity"), "1:32: sky: invalid token near 'Infinity'"},
        {SCENE("\"sky\":[0,0,1"), "1:38: sky[2]: ']' expected near '}'"},
        {SCENE("\"sky\":1,\"sky\":2"), "1:34: sky: duplicate object key near '\"sky\"'"},
        {SCENE("\"shapes\":[{\"disc\"}]"), "1:43: shapes[0].disc: ':' expected near '}'"},
        {SCENE("\"sky\":\"a\nb\""), "1:32: sky: unexpected newline near '\"a'"},
        {"{\"dapple\":1,\n\"size\":[\"\\u0000\"]}",
         "2:9: size[0]: \\u0000 is not allowed without JSON_ALLOW_NUL near '\"\\u0000\"'"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void the_top_level_is_checked(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {"{\"size\":[8,8]}", "1:1: dapple: is required but missing"},
        {"{\"dapple\":2,\"size\":[8,8]}", "1:11: dapple: must be 1, the only version of the format there is"},
        {"{\"dapple\":\"1\",\"size\":[8,8]}", "1:11: dapple: must be a number (is a string)"},
        {"\n {\"dapple\":1}", "2:2: size: is required but missing"},
        {"{\"dapple\":1,\"size\":[8,0]}", "1:23: size[1]: must be at least 1 (is 0)"},
        {"{\"dapple\":1,\"size\":[1e9,8]}", "1:21: size[0]: must be at most 16384 (is 1e+09)"},
        {"{\"dapple\":1,\"size\":[16385,8]}", "1:21: size[0]: must be at most 16384 (is 16385)"},
        {"{\"dapple\":1,\"size\":[8.5,8]}", "1:21: size[0]: must be a whole number (is 8.5)"},
        {"{\"dapple\":1,\"size\":[8]}", "1:20: size: must have 2 numbers (has 1)"},
        {"{\"dapple\":1,\"size\":8}", "1:20: size: must be an array of 2 numbers (is a number)"},
        {"{\"dapple\":1,\"size\":[8,null]}", "1:23: size[1]: must be a number (is null)"},
        {SCENE("\"sky\":[0,0]"), "1:32: sky: must have 3 numbers (has 2)"},
        {SCENE("\"sky\":-1"), "1:32: sky: must not be negative (is -1)"},
        {SCENE("\"sky\":[0,2e9,0]"), "1:35: sky[1]: must be at most 1e+09 (is 2e+09)"},
        {SCENE("\"sky\":true"), "1:32: sky: must be a number or [r, g, b] (is true)"},
        {SCENE("\"sky\":[[0,0,1],[0,0]]"), "1:41: sky[1]: must have 3 numbers (has 2)"},
        {SCENE("\"sky\":[[0,0,1],0.5]"), "1:41: sky[1]: must be an array of 3 numbers (is a number)"},
        {SCENE("\"sky\":[[0,0,1],[0,\n-1,0]]"), "2:1: sky[1][1]: must not be negative (is -1)"},
        {SCENE("\"sky\":[[]]"), "1:33: sky[0]: must have 3 numbers (has 0)"},
        {SCENE("\"sky\":[0.5,[0,0,1],0]"), "1:37: sky[1]: must be a number (is an array)"},
        {SCENE("\"margin\":-1"), "1:35: margin: must not be negative (is -1)"},
        {SCENE("\"margin\":4097"), "1:35: margin: must be at most 4096 (is 4097)"},
        {SCENE("\"margin\":2.5"), "1:35: margin: must be a whole number (is 2.5)"},
        {SCENE("\"margin\":[3]"), "1:35: margin: must be a number (is an array)"},
        {"{\"dapple\":1,\"size\":[9,16384],\n\"margin\":1}",
         "2:10: margin: makes a world of 11 x 16386 px, more than 16384 a side"},
        {SCENE("\"shapes\":{}"), "1:35: shapes: must be an array (is an object)"},
        {SCENE("\"lights\":[3]"), "1:36: lights[0]: must be an object (is a number)"},
        {SCENE("\n  \"Sky\": 1"),
         "2:3: Sky: unknown key; allowed here: dapple, size, margin, sky, shapes, images, lights"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void shapes_are_checked(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {SHAPE(""), "2:11: shapes[0]: needs exactly one of disc, box, polygon, segment (has none)"},
        {DISC("\"box\":{}"),
         "2:47: shapes[0].box: a shape is exactly one of disc, box, polygon, segment (has disc as well)"},
        {SHAPE("\"disc\":{\"center\":[1,2],\"radius\":-3}"),
         "2:44: shapes[0].disc.radius: must not be negative (is -3)"},
        {SHAPE("\"disc\":{\"center\":[1,2]}"), "2:19: shapes[0].disc.radius: is required but missing"},
        {SHAPE("\"disc\":{\"center\":[1,2e9],\"radius\":3}"),
         "2:32: shapes[0].disc.center[1]: must be at most 1e+09 (is 2e+09)"},
        {SHAPE("\"disc\":{\"center\":[-1e300,2],\"radius\":3}"),
         "2:30: shapes[0].disc.center[0]: must be at least -1e+09 (is -1e+300)"},
        {SHAPE("\"disc\":{\"center\":[1,2],\"r\":3}"),
         "2:35: shapes[0].disc.r: unknown key; allowed here: center, radius"},
        {SHAPE("\"box\":{\"center\":[1,2],\"half\":[3,-4]}"),
         "2:44: shapes[0].box.half[1]: must not be negative (is -4)"},
        {SHAPE("\"box\":{\"center\":[1,2],\"half\":[3,4],\"angle\":\"x\"}"),
         "2:55: shapes[0].box.angle: must be a number (is a string)"},
        {SHAPE("\"polygon\":{\"points\":[[1,2],[3,4]]}"),
         "2:32: shapes[0].polygon.points: needs at least 3 items (has 2)"},
        {SHAPE("\"polygon\":{\"points\":[[1,2],[3,4],[5]]}"),
         "2:45: shapes[0].polygon.points[2]: must have 2 numbers (has 1)"},
        {SHAPE("\"polygon\":{\"points\":[[1,2],[3,4],[5,\"6\"]]}"),
         "2:48: shapes[0].polygon.points[2][1]: must be a number (is a string)"},
        {SHAPE("\"polygon\":[]"), "2:22: shapes[0].polygon: must be an object (is an array)"},
        {SHAPE("\"segment\":{\"from\":[1,2],\"to\":[3,4],\"width\":-0.5}"),
         "2:55: shapes[0].segment.width: must not be negative (is -0.5)"},
        {SHAPE("\"segment\":{\"from\":[1,2]}"), "2:22: shapes[0].segment.to: is required but missing"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void materials_are_checked(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {DISC("\"colour\":1"), "2:47: shapes[0].colour: unknown key; allowed here: disc, box, polygon, "
                               "segment, emission, extinction, albedo"},
        {DISC("\"emission\":[1,-2,3]"), "2:61: shapes[0].emission[1]: must not be negative (is -2)"},
        {DISC("\"emission\":99999999999999999999"),
         "2:58: shapes[0].emission: must be at most 1e+09 (is 1e+20)"},
        {DISC("\"extinction\":-0.1"), "2:60: shapes[0].extinction: must not be negative (is -0.1)"},
        {DISC("\"extinction\":\"Opaque\""),
         "2:60: shapes[0].extinction: must be a number, [r, g, b] or \"opaque\""},
        {DISC("\"extinction\":{}"),
         "2:60: shapes[0].extinction: must be a number or [r, g, b] (is an object)"},
        {DISC("\"albedo\":[0,0.5,1.5]"), "2:63: shapes[0].albedo[2]: must be at most 1 (is 1.5)"},
        {DISC("\"albedo\":-1"), "2:56: shapes[0].albedo: must not be negative (is -1)"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void images_are_checked(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {IMAGE(""), "2:11: images[0]: needs an emission or an extinction picture (has none)"},
        {IMAGE("\"albedo\":\"a.png\""),
         "2:11: images[0]: needs an emission or an extinction picture (has none)"},
        {IMAGE("\"emission\":\"missing.png\""),
         "2:23: images[0].emission: dir/missing.png: No such file or directory"},
        {IMAGE("\"emission\":\"/missing.png\""),
         "2:23: images[0].emission: /missing.png: No such file or directory"},
        {IMAGE("\"emission\":\"\""), "2:23: images[0].emission: must not be empty"},
        {IMAGE("\"emission\":3"), "2:23: images[0].emission: must be a string (is a number)"},
        {IMAGE("\"emission\":\"a.png\",\"extinction\":\"two.png\""),
         "2:44: images[0].extinction: is 2x2 px, but emission is 4x4 px"},
        {IMAGE("\"extinction\":\"two.png\",\"albedo\":\"a.png\""),
         "2:44: images[0].albedo: is 4x4 px, but extinction is 2x2 px"},
        {IMAGE("\"emission\":\"a.png\",\"at\":[0,0.5]"),
         "2:39: images[0].at[1]: must be a whole number (is 0.5)"},
        {IMAGE("\"emission\":\"a.png\",\"intensity\":-1"),
         "2:43: images[0].intensity: must not be negative (is -1)"},
        {IMAGE("\"emision\":\"a.png\""),
         "2:12: images[0].emision: unknown key; allowed here: emission, extinction, albedo, at, intensity"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void lights_are_checked(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        {LIGHT("\"radius\":3"), "2:11: lights[0].position: is required but missing"},
        {LIGHT("\"position\":[1,2]"), "2:11: lights[0].radius: is required but missing"},
        {LIGHT("\"position\":[1,2],\"radius\":-1"), "2:38: lights[0].radius: must not be negative (is -1)"},
        {LIGHT("\"position\":[1,2],\"radius\":1,\"color\":[1,1]"),
         "2:48: lights[0].color: must have 3 numbers (has 2)"},
        {LIGHT("\"position\":[1,2],\"radius\":1,\"intensity\":-3"),
         "2:52: lights[0].intensity: must not be negative (is -3)"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void columns_count_characters_and_keys_are_decoded(void **state) {
    (void)state;
    static const mistake mistakes[] = {
        /* an escaped key is the same key; two-byte characters are one column each */
        {"{\"d\\u0061pple\":1,\"size\":[8,8],\"\xc3\xa9\xc3\xa9\":1}",
         "1:31: \xc3\xa9\xc3\xa9: unknown key; allowed here: dapple, size, margin, sky, shapes, images, "
         "lights"},
        {"{\"d\\u0061pple\":2}", "1:16: dapple: must be 1, the only version of the format there is"},
        {"{\"dapple\":1,\"\\ud83d\\ude00\":[\"}\"],\"size\":2}",
         "1:13: \xf0\x9f\x98\x80: unknown key; allowed here: dapple, size, margin, sky, shapes, images, "
         "lights"},
        {"\xef\xbb\xbf{\"dapple\":3}", "1:11: dapple: must be 1, the only version of the format there is"},
        {"{\"a\\nb\":1}",
         "1:2: a?b: unknown key; allowed here: dapple, size, margin, sky, shapes, images, lights"},
        {"{\"12345678901234567890123456789012345678901234567890\":1}",
         "1:2: 123456789012345678901234567890123456789012345678...: unknown key; allowed here: dapple, size, "
         "margin, sky, shapes, images, lights"},
    };
    check_all(mistakes, COUNT(mistakes));
}

static void deep_nesting_is_refused_without_recursion(void **state) {
    (void)state;
    size_t depth = 100000;
    char *text = malloc(depth);
    dpl_scene scene;
    dpl_error error;
    assert_non_null(text);
    memset(text, '[', depth);
    assert_false(dpl_scene_read_with(text, depth, "deep.json", read_stand_in, &scene, &error));
    assert_non_null(strstr(error.text, "maximum parsing depth reached"));
    free(text);
}

static void unreadable_files_are_refused(void **state) {
    (void)state;
    dpl_scene scene;
    dpl_error error = {.text = ""};
    assert_false(dpl_scene_read("no-such-folder/a.json", &scene, &error));
    assert_string_equal(error.text, "no-such-folder/a.json: No such file or directory");
    error.text[0] = '\0';
    assert_false(dpl_scene_read(".", &scene, &error));
    assert_int_equal(strncmp(error.text, ".: ", 3), 0);
    error.text[0] = '\0';
    assert_false(dpl_scene_read(DPL_TEST_DATA "/scene/missing-image.json", &scene, &error));
    assert_non_null(strstr(error.text, "missing-image.json:3:29: images[0].emission: "));
    assert_non_null(strstr(error.text, "/scene/not-there.png: No such file or directory"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_scene_is_refused),
        cmocka_unit_test(syntax_errors_name_the_key),
        cmocka_unit_test(the_top_level_is_checked),
        cmocka_unit_test(shapes_are_checked),
        cmocka_unit_test(materials_are_checked),
        cmocka_unit_test(images_are_checked),
        cmocka_unit_test(lights_are_checked),
        cmocka_unit_test(columns_count_characters_and_keys_are_decoded),
        cmocka_unit_test(deep_nesting_is_refused_without_recursion),
        cmocka_unit_test(unreadable_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
