/* bench_frame: what a game's frame costs at the library's doors, beside solving: clearing the field, laying
 * raw buffers into it, the distances that follow, and applying the light to 8-bit colours, for each format.
 * One thread. */
#include "../common/clock.h"
#include "../common/machine.h"
#include "../common/options.h"

#include <dapple/dapple.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PROGRAM "bench_frame"

static const char help[] = "Usage: bench_frame [options]\n"
                           "\n"
                           "Times dpl_field_clear(), dpl_field_draw_layer(), dpl_field_read_distance() and "
                           "dpl_lightmap_apply() with\nraw buffers, and prints a table: "
                           "processor time of one thread, the least and the median of the repetitions.\n"
                           "\n"
                           "Options:\n"
                           "  --size PX         width and height (default 512)\n"
                           "  --repeat N        (default 60)\n"
                           "  --isa MASK        union of dpl_isa bits (default: all)\n";

enum { MOST_REPEATS = 1000 };

/* Buffers of a size that fits every format, and what is made from them. */
typedef struct rig {
    int32_t size, repeat;
    dpl_context *context;
    dpl_field *field;
    void *floats, *halves;     /* [size][size][4]: lamps */
    uint8_t *opacity, *colour; /* [size][size], [size][size][4] */
    float *distance;           /* [size][size] */
    double ms[MOST_REPEATS];
} rig;

/* ---- what is timed -------------------------------------------------------------------------------- */

typedef struct item {
    const char *name;
    dpl_format emission; /* or light */
    int32_t channels;
    dpl_format albedo; /* of a layer only where `with_albedo` */
    bool with_albedo;
    dpl_lightmap_curve curve;
} item;

static const item layers[] = {
    {"F32 RGB emission, UNORM8 opacity", DPL_FORMAT_F32, 3, DPL_FORMAT_SRGB8, false, 0},
    {"F16 RGBA emission, UNORM8 opacity", DPL_FORMAT_F16, 4, DPL_FORMAT_SRGB8, false, 0},
    {"SRGB8 RGBA emission, UNORM8 opacity", DPL_FORMAT_SRGB8, 4, DPL_FORMAT_SRGB8, false, 0},
    {"F16 RGBA emission, UNORM8 opacity, SRGB8 RGBA albedo", DPL_FORMAT_F16, 4, DPL_FORMAT_SRGB8, true, 0},
};

static const item lightmaps[] = {
    {"F32 RGB light, SRGB8 RGBA, clamp", DPL_FORMAT_F32, 3, DPL_FORMAT_SRGB8, true, DPL_LIGHTMAP_CLAMP},
    {"F32 RGB light, SRGB8 RGBA, display", DPL_FORMAT_F32, 3, DPL_FORMAT_SRGB8, true, DPL_LIGHTMAP_DISPLAY},
    {"F32 RGB light, UNORM8 RGBA, clamp", DPL_FORMAT_F32, 3, DPL_FORMAT_UNORM8, true, DPL_LIGHTMAP_CLAMP},
    {"F16 RGBA light, SRGB8 RGBA, clamp", DPL_FORMAT_F16, 4, DPL_FORMAT_SRGB8, true, DPL_LIGHTMAP_CLAMP},
};

static dpl_pixels view(const rig *r, dpl_format format, int32_t channels) {
    const void *data = format == DPL_FORMAT_F32   ? r->floats
                       : format == DPL_FORMAT_F16 ? r->halves
                                                  : r->colour;
    return (dpl_pixels){
        .data = data, .format = format, .width = r->size, .height = r->size, .channels = channels};
}

static dpl_status clear_field(rig *r, const item *what) {
    (void)what;
    dpl_field_clear(r->field);
    return DPL_OK;
}

static dpl_status draw_layer(rig *r, const item *what) {
    dpl_layer layer = dpl_layer_default();
    layer.emission = view(r, what->emission, what->channels);
    layer.extinction = view(r, DPL_FORMAT_UNORM8, 1);
    layer.extinction.data = r->opacity;
    if (what->with_albedo)
        layer.albedo = view(r, what->albedo, 4);
    return dpl_field_draw_layer(r->field, &layer);
}

/* The exact distance transform, for the layer has been drawn anew, and a copy of its result. */
static dpl_status read_distance(rig *r, const item *what) {
    (void)what;
    return dpl_field_read_distance(r->field, r->distance, 0);
}

/* In place: the colours darken from one repetition to the next, which costs the same. */
static dpl_status apply_light(rig *r, const item *what) {
    const dpl_pixels light = view(r, what->emission, what->channels), albedo = view(r, what->albedo, 4);
    const dpl_output output = {
        .data = r->colour, .format = what->albedo, .width = r->size, .height = r->size, .channels = 4};
    dpl_lightmap_desc desc = dpl_lightmap_desc_default();
    desc.curve = what->curve;
    return dpl_lightmap_apply(r->context, &light, &albedo, &desc, &output);
}

/* ---- timing --------------------------------------------------------------------------------------- */

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef dpl_status (*step)(rig *r, const item *what);

/* `before`, where there is one, is not counted. */
static dpl_status time_item(rig *r, step before, step run, const char *call, const item *what) {
    for (int32_t i = -1; i < r->repeat; i++) { /* the first is not counted: planes are allocated */
        dpl_status status = before ? before(r, what) : DPL_OK;
        dpl_bench_time start = dpl_bench_now();
        if (status == DPL_OK)
            status = run(r, what);
        if (status != DPL_OK)
            return status;
        if (i >= 0)
            r->ms[i] = dpl_bench_since(start).cpu_ms;
    }
    qsort(r->ms, (size_t)r->repeat, sizeof r->ms[0], by_value);
    printf("| %s | %s | %.2f | %.2f |\n", call, what ? what->name : "", r->ms[0], r->ms[r->repeat / 2]);
    return DPL_OK;
}

static dpl_status time_all(rig *r) {
    dpl_status status = time_item(r, NULL, clear_field, "`dpl_field_clear`", NULL);
    for (size_t i = 0; i < sizeof layers / sizeof layers[0] && status == DPL_OK; i++)
        status = time_item(r, NULL, draw_layer, "`dpl_field_draw_layer`", &layers[i]);
    if (status == DPL_OK)
        status = time_item(r, draw_layer, read_distance, "`dpl_field_read_distance`", &layers[0]);
    for (size_t i = 0; i < sizeof lightmaps / sizeof lightmaps[0] && status == DPL_OK; i++)
        status = time_item(r, NULL, apply_light, "`dpl_lightmap_apply`", &lightmaps[i]);
    return status;
}

/* ---- the rig -------------------------------------------------------------------------------------- */

/* A fifth walls and lamps, another fifth fog. */
static void fill(rig *r) {
    float *floats = r->floats;
    uint16_t *halves = r->halves;
    for (int32_t i = 0; i < r->size * r->size; i++) {
        int32_t x = i % r->size, y = i / r->size;
        int32_t fog = (x / 61 + y / 53) % 5 == 0 ? 1 + x % 200 : 0;
        r->opacity[i] = (uint8_t)((x / 37 + y / 29) % 5 == 0 ? 255 : fog);
        for (int c = 0; c < 4; c++) {
            floats[4 * i + c] = (float)((x * 7 + y * 3 + c) % 100) / 25.0f;
            halves[4 * i + c] = (uint16_t)(0x3000 + (x * 7 + y * 3 + c) % 3000);
            r->colour[4 * i + c] = (uint8_t)(x * 5 + y * 11 + 40 * c);
        }
    }
}

static dpl_status make(rig *r, uint32_t isa_mask) {
    size_t pixels = (size_t)r->size * (size_t)r->size;
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_field_desc size = dpl_field_desc_default();
    desc.thread_count = 1;
    desc.isa_mask = isa_mask;
    size.width = size.height = r->size;
    r->floats = malloc(pixels * 4 * sizeof(float));
    r->halves = malloc(pixels * 4 * sizeof(uint16_t));
    r->opacity = malloc(pixels);
    r->colour = malloc(pixels * 4);
    r->distance = malloc(pixels * sizeof(float));
    if (!r->floats || !r->halves || !r->opacity || !r->colour || !r->distance)
        return DPL_ERROR_MEMORY;
    fill(r);
    dpl_status status = dpl_context_create(&desc, &r->context);
    return status == DPL_OK ? dpl_field_create(r->context, &size, &r->field) : status;
}

static void unmake(rig *r) {
    dpl_field_destroy(r->field);
    dpl_context_destroy(r->context);
    free(r->floats);
    free(r->halves);
    free(r->opacity);
    free(r->colour);
    free(r->distance);
}

int main(int argc, char **argv) {
    static rig r = {.size = 512, .repeat = 60};
    int32_t isa_mask = DPL_ISA_ALL;
    const dpl_bench_option options[] = {
        {"size", DPL_BENCH_INTEGER, &r.size, 1, 4096},
        {"repeat", DPL_BENCH_INTEGER, &r.repeat, 1, MOST_REPEATS},
        {"isa", DPL_BENCH_INTEGER, &isa_mask, 1, DPL_ISA_ALL},
    };
    int exit_status =
        dpl_bench_options_read(PROGRAM, help, options, sizeof options / sizeof options[0], argc, argv);
    if (exit_status != DPL_BENCH_GO)
        return exit_status;
    dpl_status status = make(&r, (uint32_t)isa_mask);
    if (status == DPL_OK) {
        const dpl_bench_machine machine = dpl_bench_machine_read();
        dpl_bench_machine_write(&machine, r.context, stdout);
        printf(
            "\n%d x %d px, %d repetitions\n\n| call | with | least [ms] | median [ms] |\n|---|---|---|---|\n",
            r.size, r.size, r.repeat);
        status = time_all(&r);
    }
    if (status != DPL_OK)
        fprintf(stderr, PROGRAM ": %s\n",
                r.context ? dpl_context_message(r.context) : dpl_status_text(status));
    unmake(&r);
    return status == DPL_OK ? DPL_BENCH_DONE : DPL_BENCH_FAILED;
}
