/* Applying light: its formula, that light 1 changes no byte, layouts, in place, halves, and what is refused.
 */
#include "kernel/half.h"
#include "testing.h"

#include "shared_context.h"

#include <dapple/dapple.h>

#include <math.h>
#include <string.h>

enum { W = 256, H = 3, WIDE = 300 };

static uint8_t albedo[H][W][4], lit[H][W][4];
static float light[H][W][3];

/* Every byte in every channel, alpha too. */
static void fill_albedo(void) {
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int c = 0; c < 4; c++)
                albedo[y][x][c] = (uint8_t)(x * (c == 1 ? 7 : 1) + 50 * c + y);
}

static void fill_light(float value) {
    for (int i = 0; i < H * W * 3; i++)
        (&light[0][0][0])[i] = value;
}

static dpl_pixels light_view(void) {
    return (dpl_pixels){light, DPL_FORMAT_F32, W, H, 3, 0};
}

static dpl_pixels albedo_view(dpl_format format) {
    return (dpl_pixels){albedo, format, W, H, 4, 0};
}

static dpl_output output_view(dpl_format format) {
    return (dpl_output){.data = lit, .format = format, .width = W, .height = H, .channels = 4};
}

static void apply(dpl_format format, float exposure, dpl_lightmap_curve curve) {
    dpl_lightmap_desc desc = dpl_lightmap_desc_default();
    desc.exposure = exposure;
    desc.curve = curve;
    const dpl_pixels l = light_view(), a = albedo_view(format);
    const dpl_output o = output_view(format);
    memset(lit, 0x5a, sizeof lit);
    assert_ok(dpl_lightmap_apply(context, &l, &a, &desc, &o));
}

static const dpl_format formats[] = {DPL_FORMAT_UNORM8, DPL_FORMAT_SRGB8};

static void light_of_one_changes_no_byte(void **state) {
    (void)state;
    fill_albedo();
    for (int f = 0; f < 2; f++) {
        fill_light(1.0f);
        apply(formats[f], 1.0f, DPL_LIGHTMAP_CLAMP);
        assert_memory_equal(lit, albedo, sizeof lit);
        fill_light(0.25f);
        apply(formats[f], 4.0f, DPL_LIGHTMAP_CLAMP);
        assert_memory_equal(lit, albedo, sizeof lit);
    }
}

static void without_light_all_is_black_and_alpha_stays(void **state) {
    (void)state;
    static const float none[] = {0.0f, -0.0f, -5.0f, NAN, -INFINITY};
    fill_albedo();
    for (size_t i = 0; i < 2 * sizeof none / sizeof none[0]; i++)
        for (int f = 0; f < 2; f++) {
            fill_light(none[i / 2]);
            apply(formats[f], 1.0f, i % 2 ? DPL_LIGHTMAP_DISPLAY : DPL_LIGHTMAP_CLAMP);
            for (int p = 0; p < H * W * 4; p++)
                assert_int_equal((&lit[0][0][0])[p], p % 4 == 3 ? (&albedo[0][0][0])[p] : 0);
        }
    fill_light(1.0f);
    apply(DPL_FORMAT_SRGB8, 0.0f, DPL_LIGHTMAP_CLAMP);
    assert_int_equal(lit[0][255][0], 0);
}

static void a_plain_multiply_doubles_bytes_and_clamps_them(void **state) {
    (void)state;
    fill_albedo();
    fill_light(2.0f);
    apply(DPL_FORMAT_UNORM8, 1.0f, DPL_LIGHTMAP_CLAMP);
    for (int p = 0; p < H * W * 4; p++) {
        int byte = (&albedo[0][0][0])[p], twice = 2 * byte < 255 ? 2 * byte : 255;
        assert_int_equal((&lit[0][0][0])[p], p % 4 == 3 ? byte : twice);
    }
    fill_light(INFINITY);
    for (int f = 0; f < 2; f++) {
        apply(formats[f], 1.0f, DPL_LIGHTMAP_CLAMP);
        for (int x = 0; x < W; x++)
            assert_int_equal(lit[0][x][0], albedo[0][x][0] ? 255 : 0); /* black paint stays black */
    }
}

static double decode(double v) {
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double encode(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055;
}

/* The whole in double precision, 0 .. 255. */
static double truth(double byte, double m, dpl_format format, dpl_lightmap_curve curve) {
    double v = (format == DPL_FORMAT_SRGB8 ? decode(byte / 255.0) : byte / 255.0) * m;
    if (curve == DPL_LIGHTMAP_DISPLAY)
        return 255.0 * (1.0 - pow(1.0 + 2.0 * 3.14159265358979323846 * v, -2.5));
    v = fmin(v, 1.0);
    return 255.0 * (format == DPL_FORMAT_SRGB8 ? encode(v) : v);
}

static void every_byte_is_the_formula_rounded(void **state) {
    (void)state;
    fill_albedo();
    for (int i = 0; i < H * W * 3; i++)
        (&light[0][0][0])[i] = (float)((i * 37) % 1009) / 400.0f;
    for (int i = 0; i < 4; i++) {
        dpl_format format = formats[i % 2];
        dpl_lightmap_curve curve = i / 2 ? DPL_LIGHTMAP_DISPLAY : DPL_LIGHTMAP_CLAMP;
        apply(format, 1.3f, curve);
        for (int y = 0; y < H; y++)
            for (int x = 0; x < W; x++)
                for (int c = 0; c < 3; c++) {
                    double m = (double)light[y][x][c] * 1.3f;
                    double exact = truth(albedo[y][x][c], m, format, curve);
                    assert_true(fabs((double)lit[y][x][c] - exact) <= 0.5 + 2e-4);
                }
    }
}

static void strides_flips_and_channels_are_honoured(void **state) {
    (void)state;
    enum { PITCH = 3 * W + 7 };
    static float flipped[H][W * 4 + 3];
    static uint8_t narrow[H][PITCH], wide[H][PITCH], rgba[H][W][4];
    fill_albedo();
    for (int i = 0; i < H * W * 3; i++)
        (&light[0][0][0])[i] = (float)((i * 37) % 1009) / 400.0f;
    apply(DPL_FORMAT_SRGB8, 1.0f, DPL_LIGHTMAP_CLAMP);
    memset(wide, 0xa5, sizeof wide);
    for (int i = 0; i < H * W; i++) {
        int y = i / W, x = i % W;
        memcpy(&flipped[H - 1 - y][4 * x], light[y][x], sizeof light[y][x]);
        flipped[H - 1 - y][4 * x + 3] = NAN;
        memcpy(&narrow[H - 1 - y][3 * x], albedo[y][x], 3);
    }
    const dpl_pixels l = {flipped[H - 1], DPL_FORMAT_F32, W, H, 4, -(ptrdiff_t)sizeof flipped[0]};
    const dpl_pixels a = {narrow[H - 1], DPL_FORMAT_SRGB8, W, H, 3, -PITCH};
    dpl_output o = {.data = wide,
                    .format = DPL_FORMAT_SRGB8,
                    .width = W,
                    .height = H,
                    .channels = 3,
                    .row_stride = PITCH};
    assert_ok(dpl_lightmap_apply(context, &l, &a, NULL, &o));
    o.data = rgba;
    o.channels = 4;
    o.row_stride = 0;
    assert_ok(dpl_lightmap_apply(context, &l, &a, NULL, &o));
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            assert_memory_equal(&wide[y][3 * x], lit[y][x], 3);
            assert_memory_equal(rgba[y][x], lit[y][x], 3);
            assert_int_equal(rgba[y][x][3], 255); /* this albedo has no alpha */
        }
        for (int i = 3 * W; i < PITCH; i++)
            assert_int_equal(wide[y][i], 0xa5); /* padding is not written */
    }
}

static void the_albedo_may_be_overwritten_and_parts_of_one_picture_lit(void **state) {
    (void)state;
    static uint8_t both[H][2][W][4];
    fill_albedo();
    fill_light(0.6f);
    apply(DPL_FORMAT_SRGB8, 1.0f, DPL_LIGHTMAP_CLAMP);
    for (int y = 0; y < H; y++)
        memcpy(both[y][0], albedo[y], sizeof albedo[y]);
    const dpl_pixels l = light_view(), a = albedo_view(DPL_FORMAT_SRGB8);
    const dpl_pixels left = {both, DPL_FORMAT_SRGB8, W, H, 4, sizeof both[0]};
    dpl_output right = output_view(DPL_FORMAT_SRGB8), place = right;
    right.data = both[0][1];
    right.row_stride = sizeof both[0];
    assert_ok(dpl_lightmap_apply(context, &l, &left, NULL, &right));
    for (int y = 0; y < H; y++) {
        assert_memory_equal(both[y][0], albedo[y], sizeof albedo[y]);
        assert_memory_equal(both[y][1], lit[y], sizeof lit[y]);
    }
    place.data = albedo;
    assert_ok(dpl_lightmap_apply(context, &l, &a, NULL, &place));
    assert_memory_equal(albedo, lit, sizeof lit);
}

static void light_in_halves_is_light_in_floats(void **state) {
    (void)state;
    static uint16_t halves[H][W][4];
    static uint8_t from_halves[H][W][4];
    fill_albedo();
    for (int i = 0; i < H * W; i++)
        for (int c = 0; c < 3; c++) {
            float v = (float)((i * 37 + c) % 1009) / 400.0f;
            halves[i / W][i % W][c] = dpl_half_from_float(v);
            light[i / W][i % W][c] = dpl_float_from_half(dpl_half_from_float(v));
        }
    const dpl_pixels l = {halves, DPL_FORMAT_F16, W, H, 4, 0};
    for (int f = 0; f < 2; f++) {
        apply(formats[f], 1.0f, DPL_LIGHTMAP_CLAMP);
        const dpl_pixels a = albedo_view(formats[f]);
        dpl_output o = output_view(formats[f]);
        o.data = from_halves;
        assert_ok(dpl_lightmap_apply(context, &l, &a, NULL, &o));
        assert_memory_equal(from_halves, lit, sizeof lit);
    }
}

static void every_instruction_set_and_thread_count_gives_the_same_bytes(void **state) {
    (void)state;
    static float lamps[40][WIDE][3];
    static uint8_t sprites[40][WIDE][4], expected[40][WIDE][4], found[40][WIDE][4];
    for (int i = 0; i < 40 * WIDE * 3; i++)
        (&lamps[0][0][0])[i] = (float)((i * 37) % 1009) / 500.0f;
    for (int i = 0; i < 40 * WIDE * 4; i++)
        (&sprites[0][0][0])[i] = (uint8_t)((uint32_t)i * 2654435761u >> 11);
    const dpl_pixels l = {lamps, DPL_FORMAT_F32, WIDE, 40, 3, 0};
    for (int form = 0; form < 4; form++) {
        const dpl_pixels a = {sprites, formats[form % 2], WIDE, 40, 4, 0};
        for (int32_t i = 0; i < 8; i++) {
            dpl_context_desc desc = dpl_context_desc_default();
            desc.isa_mask = 1u << i % 4;
            desc.thread_count = i < 4 ? 1 : 3;
            if (!(dpl_isa_available() & desc.isa_mask))
                continue;
            dpl_context *other;
            assert_ok(dpl_context_create(&desc, &other));
            dpl_lightmap_desc how = dpl_lightmap_desc_default();
            how.curve = form / 2 ? DPL_LIGHTMAP_DISPLAY : DPL_LIGHTMAP_CLAMP;
            const dpl_output o = {.data = i == 0 ? expected : found,
                                  .format = a.format,
                                  .width = WIDE,
                                  .height = 40,
                                  .channels = 4};
            assert_ok(dpl_lightmap_apply(other, &l, &a, &how, &o));
            if (i > 0)
                assert_memory_equal(expected, found, sizeof found);
            dpl_context_destroy(other);
        }
    }
}

/* ---- refusals ------------------------------------------------------------------------------------- */

typedef struct call {
    dpl_pixels light, albedo;
    dpl_lightmap_desc desc;
    dpl_output output;
} call;

static void no_light(call *c) {
    c->light.data = NULL;
}
static void no_output(call *c) {
    c->output.data = NULL;
}
static void bytes_as_light(call *c) {
    c->light.format = DPL_FORMAT_UNORM8;
}
static void floats_as_albedo(call *c) {
    c->albedo.format = DPL_FORMAT_F32;
}
static void other_format(call *c) {
    c->output.format = DPL_FORMAT_UNORM8;
}
static void grey_albedo(call *c) {
    c->albedo.channels = 1;
}
static void empty_albedo(call *c) {
    c->albedo.width = 0;
}
static void small_light(call *c) {
    c->light.width = W / 2;
}
static void small_output(call *c) {
    c->output.height = H - 1;
}
static void short_stride(call *c) {
    c->output.row_stride = -(4 * W - 1);
}
static void odd_light(call *c) {
    c->light.row_stride = 3 * W * 4 + 2;
}
static void odd_address(call *c) {
    c->light.data = (char *)light + 2;
}
static void negative_exposure(call *c) {
    c->desc.exposure = -1.0f;
}
static void no_exposure(call *c) {
    c->desc.exposure = NAN;
}
static void no_curve(call *c) {
    c->desc.curve = (dpl_lightmap_curve)7;
}
static void no_default(call *c) {
    c->desc.cookie = 0;
}
static void flipped_in_place(call *c) {
    c->output.data = albedo[H - 1];
    c->output.row_stride = -4 * W;
}
static void other_channels_in_place(call *c) {
    c->output.data = albedo;
    c->output.channels = 3;
}
static void over_the_light(call *c) {
    c->output.data = light;
}

static const struct {
    void (*spoil)(call *c);
    dpl_status status;
    const char *message;
} refusals[] = {
    {no_light, DPL_ERROR_ARGUMENT, "light: data is NULL"},
    {no_output, DPL_ERROR_ARGUMENT, "output: data is NULL"},
    {bytes_as_light, DPL_ERROR_ARGUMENT, "light: format is 1, not DPL_FORMAT_F32 or DPL_FORMAT_F16"},
    {floats_as_albedo, DPL_ERROR_ARGUMENT, "albedo: format is 0, not DPL_FORMAT_UNORM8 or DPL_FORMAT_SRGB8"},
    {other_format, DPL_ERROR_ARGUMENT, "output: format is 1, the albedo's is 2"},
    {grey_albedo, DPL_ERROR_ARGUMENT, "albedo: 1 channels, not 3 or 4"},
    {empty_albedo, DPL_ERROR_SIZE, "albedo: size 0 x 3 is not within 1 .. 16384"},
    {small_light, DPL_ERROR_SIZE, "light: size is 128 x 3, the albedo's is 256 x 3"},
    {small_output, DPL_ERROR_SIZE, "output: size is 256 x 2, the albedo's is 256 x 3"},
    {short_stride, DPL_ERROR_ARGUMENT, "output: row_stride -1023 is shorter than a row of 1024 bytes"},
    {odd_light, DPL_ERROR_ARGUMENT, "light: data or row_stride is not a multiple of a channel's 4 bytes"},
    {odd_address, DPL_ERROR_ARGUMENT, "light: data or row_stride is not a multiple of a channel's 4 bytes"},
    {negative_exposure, DPL_ERROR_ARGUMENT, "the exposure must be finite and not negative"},
    {no_exposure, DPL_ERROR_ARGUMENT, "the exposure must be finite and not negative"},
    {no_curve, DPL_ERROR_ARGUMENT, "there is no curve 7"},
    {no_default, DPL_ERROR_DESC, "the lightmap desc was not made by dpl_lightmap_desc_default()"},
    {flipped_in_place, DPL_ERROR_ARGUMENT,
     "the output overlaps the albedo without being the same buffer in the same layout"},
    {other_channels_in_place, DPL_ERROR_ARGUMENT,
     "the output overlaps the albedo without being the same buffer in the same layout"},
    {over_the_light, DPL_ERROR_ARGUMENT, "the output overlaps the light"},
};

static void what_cannot_be_lit_is_refused_and_nothing_is_written(void **state) {
    (void)state;
    static uint8_t before[sizeof lit];
    memset(lit, 0x5a, sizeof lit);
    memcpy(before, lit, sizeof lit);
    const call good = {light_view(), albedo_view(DPL_FORMAT_SRGB8), dpl_lightmap_desc_default(),
                       output_view(DPL_FORMAT_SRGB8)};
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++) {
        call c = good;
        refusals[i].spoil(&c);
        assert_int_equal(dpl_lightmap_apply(context, &c.light, &c.albedo, &c.desc, &c.output),
                         refusals[i].status);
        assert_string_equal(dpl_context_message(context), refusals[i].message);
    }
    const call *c = &good;
    assert_int_equal(dpl_lightmap_apply(NULL, &c->light, &c->albedo, &c->desc, &c->output),
                     DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_lightmap_apply(context, NULL, &c->albedo, &c->desc, &c->output), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_lightmap_apply(context, &c->light, NULL, &c->desc, &c->output), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_lightmap_apply(context, &c->light, &c->albedo, &c->desc, NULL), DPL_ERROR_ARGUMENT);
    assert_memory_equal(lit, before, sizeof lit);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_of_one_changes_no_byte),
        cmocka_unit_test(without_light_all_is_black_and_alpha_stays),
        cmocka_unit_test(a_plain_multiply_doubles_bytes_and_clamps_them),
        cmocka_unit_test(every_byte_is_the_formula_rounded),
        cmocka_unit_test(strides_flips_and_channels_are_honoured),
        cmocka_unit_test(the_albedo_may_be_overwritten_and_parts_of_one_picture_lit),
        cmocka_unit_test(light_in_halves_is_light_in_floats),
        cmocka_unit_test(every_instruction_set_and_thread_count_gives_the_same_bytes),
        cmocka_unit_test(what_cannot_be_lit_is_refused_and_nothing_is_written),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
