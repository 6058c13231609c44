/* Drawing into a field: who owns a pixel, what lies over what, and what is refused. */
#include "testing.h"

#include <dapple/dapple.h>
#include <math.h>
#include <stdbool.h>

enum { WIDTH = 61, HEIGHT = 47 };

typedef struct fixture {
    dpl_context *context;
    dpl_field *field;
} fixture;

static fixture open_field(void) {
    fixture f;
    assert_ok(dpl_context_create(NULL, &f.context));
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = WIDTH;
    desc.height = HEIGHT;
    assert_ok(dpl_field_create(f.context, &desc, &f.field));
    return f;
}

static void close_field(fixture *f) {
    dpl_field_destroy(f->field);
    dpl_context_destroy(f->context);
}

static uint32_t seed = 1;

static double random_between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed >> 8) / 16777216.0;
}

/* ---- an independent test of whether a point is inside --------------------------------------------- */

static bool inside_disc(const dpl_shape *s, double x, double y) {
    return hypot(x - s->disc.center[0], y - s->disc.center[1]) <= s->disc.radius;
}

static bool inside_box(const dpl_shape *s, double x, double y) {
    double dx = x - s->box.center[0], dy = y - s->box.center[1], c = cos(-s->box.angle),
           t = sin(-s->box.angle);
    return fabs(dx * c - dy * t) <= s->box.half[0] && fabs(dx * t + dy * c) <= s->box.half[1];
}

static bool inside_segment(const dpl_shape *s, double x, double y) {
    double ax = s->segment.from[0], ay = s->segment.from[1];
    double bx = s->segment.to[0] - ax, by = s->segment.to[1] - ay, length2 = bx * bx + by * by;
    double t = length2 > 0.0 ? fmin(1.0, fmax(0.0, ((x - ax) * bx + (y - ay) * by) / length2)) : 0.0;
    return hypot(x - ax - t * bx, y - ay - t * by) <= 0.5 * s->segment.width;
}

/* Even-odd by the winding angle's parity: counts edges to the left of the point. */
static bool inside_polygon(const dpl_shape *s, double x, double y) {
    bool inside = false;
    for (int32_t i = 0, j = s->polygon.count - 1; i < s->polygon.count; j = i++) {
        const double *a = s->polygon.points[i], *b = s->polygon.points[j];
        if ((a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0])
            inside = !inside;
    }
    return inside;
}

static void assert_owns_exactly(bool (*inside)(const dpl_shape *, double, double), const dpl_shape *shape) {
    static uint8_t opaque[HEIGHT][WIDTH];
    fixture f = open_field();
    assert_ok(dpl_field_draw_shapes(f.field, shape, 1));
    assert_ok(dpl_field_read_opaque(f.field, &opaque[0][0], 0));
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if (opaque[y][x] != inside(shape, x + 0.5, y + 0.5))
                fail_msg("pixel (%d, %d) of shape kind %d is %d", x, y, (int)shape->kind, opaque[y][x]);
    close_field(&f);
}

static void a_shape_owns_the_pixels_whose_centres_it_holds(void **state) {
    (void)state;
    double points[7][2];
    for (int i = 0; i < 60; i++) {
        dpl_shape disc = dpl_shape_default(DPL_SHAPE_DISC), box = dpl_shape_default(DPL_SHAPE_BOX);
        dpl_shape segment = dpl_shape_default(DPL_SHAPE_SEGMENT),
                  polygon = dpl_shape_default(DPL_SHAPE_POLYGON);
        disc.disc = (dpl_disc){{random_between(-9, 70), random_between(-9, 56)}, random_between(0, 30)};
        box.box = (dpl_box){{random_between(-9, 70), random_between(-9, 56)},
                            {random_between(0, 25), random_between(0, 25)},
                            random_between(-4, 4)};
        segment.segment = (dpl_segment){{random_between(-9, 70), random_between(-9, 56)},
                                        {random_between(-9, 70), random_between(-9, 56)},
                                        random_between(0, 12)};
        int32_t corners = 3 + i % 5;
        for (int k = 0; k < corners; k++) {
            points[k][0] = random_between(-9, 70);
            points[k][1] = random_between(-9, 56);
        }
        polygon.polygon.points = (const double(*)[2])points;
        polygon.polygon.count = corners;
        assert_owns_exactly(inside_disc, &disc);
        assert_owns_exactly(inside_box, &box);
        assert_owns_exactly(inside_segment, &segment);
        assert_owns_exactly(inside_polygon, &polygon);
    }
}

static int count_opaque(const dpl_shape *shape) {
    static uint8_t opaque[HEIGHT * WIDTH];
    fixture f = open_field();
    int count = 0;
    assert_ok(dpl_field_draw_shapes(f.field, shape, 1));
    assert_ok(dpl_field_read_opaque(f.field, opaque, 0));
    for (int i = 0; i < HEIGHT * WIDTH; i++)
        count += opaque[i];
    close_field(&f);
    return count;
}

static void boundaries_belong_to_the_shape(void **state) {
    (void)state;
    dpl_shape point = dpl_shape_default(DPL_SHAPE_DISC);
    point.disc = (dpl_disc){{10.5, 10.5}, 0.0};
    assert_int_equal(count_opaque(&point), 1);
    dpl_shape box = dpl_shape_default(DPL_SHAPE_BOX);
    box.box = (dpl_box){{10.5, 10.5}, {2.0, 1.0}, 0.0};
    assert_int_equal(count_opaque(&box), 5 * 3);
    dpl_shape line = dpl_shape_default(DPL_SHAPE_SEGMENT);
    line.segment = (dpl_segment){{3.5, 8.5}, {9.5, 8.5}, 0.0};
    assert_int_equal(count_opaque(&line), 7);
    /* Edges and corners on pixel centres; the diagonal through (5.5, 2.5) as well. */
    static const double triangle[3][2] = {{2.5, 2.5}, {8.5, 2.5}, {2.5, 8.5}};
    dpl_shape polygon = dpl_shape_default(DPL_SHAPE_POLYGON);
    polygon.polygon = (dpl_polygon){triangle, 3};
    assert_int_equal(count_opaque(&polygon), 7 + 6 + 5 + 4 + 3 + 2 + 1);
}

static void a_material_is_stored_as_given(void **state) {
    (void)state;
    fixture f = open_field();
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    shape.disc = (dpl_disc){{20, 20}, 5};
    shape.material = (dpl_material){{1, 2, 3}, {0.5f, 0, INFINITY}, {0.25f, 0.5f, 1}};
    assert_ok(dpl_field_draw_shapes(f.field, &shape, 1));
    dpl_material m;
    assert_ok(dpl_field_read_pixel(f.field, 20, 20, &m));
    assert_memory_equal(&m, &shape.material, sizeof m);
    assert_ok(dpl_field_read_pixel(f.field, 40, 40, &m));
    assert_true(m.extinction[0] == 0 && m.emission[0] == 0 && m.albedo[0] == 0);
    assert_int_equal(dpl_field_read_pixel(f.field, WIDTH, 0, &m), DPL_ERROR_ARGUMENT);
    close_field(&f);
}

static void later_shapes_paint_over_earlier_ones_and_nothing_erases(void **state) {
    (void)state;
    fixture f = open_field();
    dpl_shape shapes[3];
    for (int i = 0; i < 3; i++) {
        shapes[i] = dpl_shape_default(DPL_SHAPE_DISC);
        shapes[i].disc = (dpl_disc){{30, 20}, 15.0 - 5.0 * i};
        shapes[i].material.emission[0] = (float)i;
    }
    memset(shapes[2].material.extinction, 0, sizeof shapes[2].material.extinction);
    assert_ok(dpl_field_draw_shapes(f.field, shapes, 3));
    dpl_material m;
    assert_ok(dpl_field_read_pixel(f.field, 42, 20, &m));
    assert_true(m.emission[0] == 0.0f && isinf(m.extinction[0]));
    assert_ok(dpl_field_read_pixel(f.field, 37, 20, &m));
    assert_true(m.emission[0] == 1.0f);
    assert_ok(dpl_field_read_pixel(f.field, 30, 20, &m));
    assert_true(m.emission[0] == 0.0f && m.extinction[0] == 0.0f); /* a hole, and holes do not shine */
    close_field(&f);
}

static void bad_shapes_are_refused_and_nothing_is_drawn(void **state) {
    (void)state;
    fixture f = open_field();
    dpl_shape good = dpl_shape_default(DPL_SHAPE_DISC);
    good.disc = (dpl_disc){{20, 20}, 5};
    dpl_shape bad[10];
    for (int i = 0; i < 10; i++)
        bad[i] = good;
    static const double points[3][2] = {{0, 0}, {1, (double)NAN}, {2, 2}};
    bad[0].disc.radius = -1;
    bad[1].disc.center[0] = (double)NAN;
    bad[2].disc.radius = (double)INFINITY;
    bad[3].disc.center[1] = 1e10;
    bad[4].kind = DPL_SHAPE_POLYGON;
    bad[4].polygon = (dpl_polygon){points, 2};
    bad[5].kind = DPL_SHAPE_POLYGON;
    bad[5].polygon = (dpl_polygon){points, 3};
    bad[6].kind = (dpl_shape_kind)77;
    bad[7].material.emission[1] = -0.5f;
    bad[8].material.extinction[2] = NAN;
    bad[9].material.albedo[0] = 1.5f;
    for (int i = 0; i < 10; i++) {
        dpl_shape both[2] = {good, bad[i]};
        assert_int_equal(dpl_field_draw_shapes(f.field, both, 2), DPL_ERROR_ARGUMENT);
        assert_non_null(strstr(dpl_context_message(f.context), "shape 1: "));
    }
    dpl_material m;
    assert_ok(dpl_field_read_pixel(f.field, 20, 20, &m));
    assert_true(m.extinction[0] == 0.0f);
    close_field(&f);
}

static void bad_sizes_and_skies_are_refused(void **state) {
    (void)state;
    fixture f = open_field();
    static const int32_t sizes[][2] = {{0, 5}, {5, 0}, {-1, 5}, {16385, 5}, {5, 1000000000}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        dpl_field_desc desc = dpl_field_desc_default();
        dpl_field *field;
        desc.width = sizes[i][0];
        desc.height = sizes[i][1];
        assert_int_equal(dpl_field_create(f.context, &desc, &field), DPL_ERROR_SIZE);
        assert_null(field);
    }
    const float bad_sky[3] = {0, NAN, 0};
    assert_int_equal(dpl_field_set_sky(f.field, bad_sky), DPL_ERROR_ARGUMENT);
    close_field(&f);
}

/* ---- layers --------------------------------------------------------------------------------------- */

static void an_opacity_picture_becomes_extinction(void **state) {
    (void)state;
    fixture f = open_field();
    static const uint8_t alpha[2][4] = {{0, 51, 255, 9},
                                        {0, 0, 0, 9}}; /* the last column is not part of it */
    static const float emission[2][3][3] = {{{1, 1, 1}, {2, 2, 2}, {3, 4, 5}}, {{0}}};
    dpl_layer layer = dpl_layer_default();
    layer.extinction = (dpl_pixels){alpha, DPL_FORMAT_UNORM8, 3, 2, 1, 4};
    layer.emission = (dpl_pixels){emission, DPL_FORMAT_F32, 3, 2, 3, 0};
    layer.x = 10;
    layer.y = 20;
    layer.intensity = 2.0f;
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    dpl_material m;
    assert_ok(dpl_field_read_pixel(f.field, 10, 20, &m));
    assert_true(m.extinction[0] == 0.0f && m.emission[0] == 0.0f);
    assert_ok(dpl_field_read_pixel(f.field, 11, 20, &m));
    assert_float_equal(m.extinction[1], -log(0.8), 1e-6);
    assert_true(m.emission[1] == 4.0f);
    assert_ok(dpl_field_read_pixel(f.field, 12, 20, &m));
    assert_true(isinf(m.extinction[0]) && m.emission[0] == 6.0f && m.emission[2] == 10.0f);
    close_field(&f);
}

static void without_an_extinction_picture_the_lamps_decide(void **state) {
    (void)state;
    fixture f = open_field();
    static const uint8_t rgba[3][4] = {{255, 255, 255, 0}, {255, 0, 0, 255}, {0, 0, 0, 255}};
    static const uint8_t rgb[2][3] = {{0, 0, 0}, {0, 188, 0}};
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){rgba, DPL_FORMAT_SRGB8, 3, 1, 4, 0};
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    layer.emission = (dpl_pixels){rgb, DPL_FORMAT_SRGB8, 2, 1, 3, 0};
    layer.y = 1;
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    uint8_t opaque[HEIGHT][WIDTH];
    assert_ok(dpl_field_read_opaque(f.field, &opaque[0][0], 0));
    assert_int_equal(opaque[0][0], 0);
    assert_int_equal(opaque[0][1], 1);
    assert_int_equal(opaque[0][2], 1);
    assert_int_equal(opaque[1][0], 0);
    assert_int_equal(opaque[1][1], 1);
    dpl_material m;
    assert_ok(dpl_field_read_pixel(f.field, 1, 1, &m));
    assert_float_equal(m.emission[1], 0.5028865, 1e-5); /* sRGB 188 */
    close_field(&f);
}

static void a_layer_is_cut_at_the_edges_and_may_be_flipped(void **state) {
    (void)state;
    fixture f = open_field();
    static const float opacity[3][3] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    dpl_layer layer = dpl_layer_default();
    layer.extinction = (dpl_pixels){opacity[2], DPL_FORMAT_F32, 3, 3, 1, -(ptrdiff_t)sizeof opacity[0]};
    layer.x = WIDTH - 2; /* upside down: set at (2, 0) and (0, 2) */
    layer.y = HEIGHT - 3;
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    layer.x = layer.y = -2;
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    layer.x = INT32_MIN;
    layer.y = INT32_MAX;
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    uint8_t opaque[HEIGHT][WIDTH];
    int count = 0;
    assert_ok(dpl_field_read_opaque(f.field, &opaque[0][0], 0));
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        count += (&opaque[0][0])[i];
    assert_int_equal(count, 1);
    assert_int_equal(opaque[HEIGHT - 1][WIDTH - 2], 1);
    close_field(&f);
}

static void bad_layers_are_refused_with_the_pixel_named(void **state) {
    (void)state;
    fixture f = open_field();
    float values[4][5];
    for (int i = 0; i < 20; i++)
        (&values[0][0])[i] = 1.0f;
    static const float bad[] = {NAN, -1.0f, INFINITY};
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){values, DPL_FORMAT_F32, 5, 4, 1, 0};
    for (int i = 0; i < 3; i++) {
        values[2][3] = bad[i];
        assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
        assert_non_null(strstr(dpl_context_message(f.context), "emission of pixel (3, 2)"));
    }
    values[2][3] = 1.0f;
    layer.extinction = layer.emission;
    layer.extinction.width = 4;
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_SIZE);
    layer.extinction = layer.emission;
    layer.extinction.channels = 5;
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
    layer.extinction = layer.emission;
    values[1][1] = 1.5f; /* fine as emission, not as opacity */
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
    layer.emission.row_stride = 8;
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
    layer = dpl_layer_default();
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
    layer.cookie = 0;
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_DESC);
    dpl_material m;
    assert_ok(dpl_field_read_pixel(f.field, 0, 0, &m));
    assert_true(m.extinction[0] == 0.0f);
    close_field(&f);
}

/* Channels that do not count may hold anything; alpha counts where there is no extinction picture. */
static void only_channels_that_count_are_checked(void **state) {
    (void)state;
    fixture f = open_field();
    float rgba[2][3][4];
    static const uint8_t solid[2][3] = {{255, 255, 255}, {255, 255, 255}};
    for (int i = 0; i < 24; i++)
        (&rgba[0][0][0])[i] = i % 4 == 3 ? 1.0f : 7.0f; /* brighter than 1 is fine */
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){rgba, DPL_FORMAT_F32, 3, 2, 4, 0};
    assert_ok(dpl_field_draw_layer(f.field, &layer));
    static const float bad[] = {1.5f, -0.5f, NAN};
    for (int i = 0; i < 3; i++) {
        rgba[1][2][3] = bad[i];
        layer.extinction.data = NULL;
        assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
        assert_non_null(strstr(dpl_context_message(f.context), "emission of pixel (2, 1)"));
        layer.extinction = (dpl_pixels){solid, DPL_FORMAT_UNORM8, 3, 2, 1, 0};
        assert_ok(dpl_field_draw_layer(f.field, &layer));
    }
    rgba[1][0][2] = NAN;
    assert_int_equal(dpl_field_draw_layer(f.field, &layer), DPL_ERROR_ARGUMENT);
    assert_non_null(strstr(dpl_context_message(f.context), "emission of pixel (0, 1)"));
    close_field(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_owns_the_pixels_whose_centres_it_holds),
        cmocka_unit_test(boundaries_belong_to_the_shape),
        cmocka_unit_test(a_material_is_stored_as_given),
        cmocka_unit_test(later_shapes_paint_over_earlier_ones_and_nothing_erases),
        cmocka_unit_test(bad_shapes_are_refused_and_nothing_is_drawn),
        cmocka_unit_test(bad_sizes_and_skies_are_refused),
        cmocka_unit_test(an_opacity_picture_becomes_extinction),
        cmocka_unit_test(without_an_extinction_picture_the_lamps_decide),
        cmocka_unit_test(a_layer_is_cut_at_the_edges_and_may_be_flipped),
        cmocka_unit_test(bad_layers_are_refused_with_the_pixel_named),
        cmocka_unit_test(only_channels_that_count_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
