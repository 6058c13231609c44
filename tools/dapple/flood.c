/* Lights a scene as a tile world, a pixel to a cell, step by step: each step leaves what the next one needs
 * in the job. */
#include "flood.h"

#include "clock.h"
#include "json.h"
#include "render.h"
#include "report.h"

#include "image/file.h"
#include "scenes/scene.h"

#include <dapple/field.h>
#include <dapple/tonemap.h>
#include <math.h>
#include <stdlib.h>

/* Opacity of a medium in each channel, in this many steps up to opaque: 5^3 materials and one more. */
#define SHADES 5
#define MATERIAL_OPAQUE (SHADES * SHADES * SHADES)
#define MATERIALS (MATERIAL_OPAQUE + 1)

typedef struct flood_job {
    const dpl_flood_order *order;
    dpl_file_writer stats_file;
    bool stats_open;
    dpl_context *context;
    dpl_scene scene;
    dpl_field *field;
    dpl_flood *flood;
    dpl_picture picture;
    double brightest; /* radiance that becomes the full level */
    int32_t lights;
    double read_ms, field_ms, solve_ms, write_ms, start_ms;
} flood_job;

static int open_stats(flood_job *job) {
    dpl_error error;
    if (!job->order->stats)
        return DPL_EXIT_DONE;
    if (!dpl_file_writer_open(&job->stats_file, job->order->stats, &error))
        return dpl_report_failure("%s", error.text);
    job->stats_open = true;
    return DPL_EXIT_DONE;
}

static int read_scene(flood_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    dpl_status status = dpl_context_create(NULL, &job->context);
    if (status != DPL_OK)
        return dpl_report_status(NULL, status);
    if (!dpl_scene_read(job->order->scene, &job->scene, &error))
        return dpl_report_failure("%s", error.text);
    job->read_ms = dpl_tool_clock_ms() - start;
    start = dpl_tool_clock_ms();
    if (!dpl_scene_build_field(&job->scene, job->context, false, &job->field, &error))
        return dpl_report_failure("%s", error.text);
    job->field_ms = dpl_tool_clock_ms() - start;
    return DPL_EXIT_DONE;
}

/* ---- from radiance to levels ---------------------------------------------------------------------- */

static void light_radiance(const dpl_scene_light *light, float rgb[3]) {
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(light->color[c] * light->intensity);
}

static void find_brightest(flood_job *job, const float rgb[3]) {
    for (int c = 0; c < 3; c++)
        job->brightest = rgb[c] > job->brightest ? (double)rgb[c] : job->brightest;
}

static dpl_status measure_brightest(flood_job *job) {
    dpl_material material;
    for (int32_t y = 0; y < job->scene.height; y++)
        for (int32_t x = 0; x < job->scene.width; x++) {
            dpl_status status = dpl_field_read_pixel(job->field, x, y, &material);
            if (status != DPL_OK)
                return status;
            find_brightest(job, material.emission);
        }
    for (int32_t i = 0; i < job->scene.light_count; i++) {
        float rgb[3];
        light_radiance(&job->scene.lights[i], rgb);
        find_brightest(job, rgb);
    }
    for (int c = 0; c < 3 && job->order->sun; c++)
        job->brightest = job->scene.sky[c] > job->brightest ? job->scene.sky[c] : job->brightest;
    if (!(job->brightest > 0))
        job->brightest = 1;
    return DPL_OK;
}

static void levels_of(const flood_job *job, const float rgb[3], uint16_t levels[DPL_FLOOD_MAX_CHANNELS]) {
    for (int c = 0; c < 3; c++)
        levels[c] = (uint16_t)((double)rgb[c] / job->brightest * DPL_FLOOD_FULL + 0.5);
    levels[3] = 0;
}

/* ---- from extinction to materials ----------------------------------------------------------------- */

static void list_materials(dpl_flood_material materials[MATERIALS]) {
    for (int32_t i = 0; i < MATERIALS; i++) {
        const int32_t shade[3] = {i % SHADES, i / SHADES % SHADES, i / SHADES / SHADES};
        for (int c = 0; c < 3; c++)
            materials[i].attenuation[c] =
                (uint16_t)(i == MATERIAL_OPAQUE ? DPL_FLOOD_OPAQUE
                                                : shade[c] * DPL_FLOOD_OPAQUE / (SHADES - 1));
        materials[i].attenuation[3] = 0;
    }
}

static uint8_t material_of(const float extinction[3]) {
    int32_t number = 0;
    if (isinf(extinction[0]) && isinf(extinction[1]) && isinf(extinction[2]))
        return MATERIAL_OPAQUE;
    for (int c = 2; c >= 0; c--) /* the share that one pixel takes */
        number = number * SHADES + (int32_t)lround((1 - exp(-(double)extinction[c])) * (SHADES - 1));
    return (uint8_t)number;
}

/* ---- steps ---------------------------------------------------------------------------------------- */

static dpl_status create_world(flood_job *job) {
    dpl_flood_material materials[MATERIALS];
    dpl_flood_desc desc = dpl_flood_desc_default();
    const float sky[3] = {(float)job->scene.sky[0], (float)job->scene.sky[1], (float)job->scene.sky[2]};
    list_materials(materials);
    desc.width = job->scene.width;
    desc.height = job->scene.height;
    desc.falloff = job->order->falloff;
    desc.step = (DPL_FLOOD_FULL + job->order->range / 2) / job->order->range;
    desc.keep = (int32_t)(32768 * pow(0.01, 1.0 / job->order->range));
    desc.materials = materials;
    desc.material_count = MATERIALS;
    if (job->order->sun) {
        desc.sun = DPL_FLOOD_SUN_Y_UP;
        levels_of(job, sky, desc.sun_level);
    }
    return dpl_flood_create(job->context, &desc, &job->flood);
}

static dpl_status add_light(flood_job *job, int32_t x, int32_t y, const float rgb[3]) {
    uint16_t levels[DPL_FLOOD_MAX_CHANNELS];
    dpl_flood_light light;
    levels_of(job, rgb, levels);
    if (levels[0] + levels[1] + levels[2] == 0)
        return DPL_OK;
    job->lights++;
    return dpl_flood_add_light(job->flood, x, y, 0, levels, &light);
}

static dpl_status fill_pixel(flood_job *job, int32_t x, int32_t y) {
    dpl_material material;
    dpl_status status = dpl_field_read_pixel(job->field, x, y, &material);
    if (status == DPL_OK)
        status = dpl_flood_set_cell(job->flood, x, y, 0, material_of(material.extinction));
    return status == DPL_OK ? add_light(job, x, y, material.emission) : status;
}

static dpl_status fill_world(flood_job *job) {
    dpl_status status = measure_brightest(job);
    if (status == DPL_OK)
        status = create_world(job);
    for (int32_t y = 0; y < job->scene.height; y++)
        for (int32_t x = 0; x < job->scene.width && status == DPL_OK; x++)
            status = fill_pixel(job, x, y);
    for (int32_t i = 0; i < job->scene.light_count && status == DPL_OK; i++) {
        const dpl_scene_light *light = &job->scene.lights[i];
        double x = floor(light->position[0]), y = floor(light->position[1]);
        float rgb[3];
        light_radiance(light, rgb);
        if (x >= 0 && y >= 0 && x < job->scene.width && y < job->scene.height)
            status = add_light(job, (int32_t)x, (int32_t)y, rgb);
    }
    return status;
}

static int solve(flood_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    dpl_status status = fill_world(job);
    job->field_ms += dpl_tool_clock_ms() - start;
    start = dpl_tool_clock_ms();
    if (status == DPL_OK)
        status = dpl_flood_solve(job->flood);
    job->solve_ms = dpl_tool_clock_ms() - start;
    if (status != DPL_OK)
        return dpl_report_status(job->context, status);
    if (!dpl_picture_create(&job->picture, job->scene.width, job->scene.height, 3, &error))
        return dpl_report_failure("%s", error.text);
    float b = (float)job->brightest;
    const float weights[DPL_FLOOD_MAX_CHANNELS][3] = {{b, 0, 0}, {0, b, 0}, {0, 0, b}};
    dpl_output output = dpl_picture_output(&job->picture);
    status = dpl_flood_read_light(job->flood, 0, weights, &output);
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->context, status);
}

static int write_png(flood_job *job) {
    dpl_error error;
    const dpl_picture *picture = &job->picture;
    uint8_t *rgb = malloc((size_t)picture->width * (size_t)picture->height * 3);
    if (!rgb)
        return dpl_report_status(NULL, DPL_ERROR_MEMORY);
    dpl_pixels pixels = dpl_picture_pixels(picture);
    dpl_status status = dpl_tonemap(job->context, &pixels, rgb, 0);
    int result = DPL_EXIT_DONE;
    if (status != DPL_OK)
        result = dpl_report_status(job->context, status);
    else if (!dpl_picture_write_png(job->order->output, picture->width, picture->height, 3, rgb, &error))
        result = dpl_report_failure("%s", error.text);
    free(rgb);
    return result;
}

static int write_picture(flood_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    int status = DPL_EXIT_DONE;
    if (dpl_render_has_extension(job->order->output, ".png"))
        status = write_png(job);
    else if (!dpl_picture_write(job->order->output, &job->picture, &error))
        status = dpl_report_failure("%s", error.text);
    job->write_ms = dpl_tool_clock_ms() - start;
    return status;
}

static int write_stats(flood_job *job) {
    dpl_error error;
    dpl_flood_stats counts;
    if (!job->stats_open)
        return DPL_EXIT_DONE;
    dpl_flood_read_stats(job->flood, &counts);
    json_t *ms =
        json_pack("{s:o, s:o, s:o, s:o, s:o}", "read", dpl_json_ms(job->read_ms), "field",
                  dpl_json_ms(job->field_ms), "solve", dpl_json_ms(job->solve_ms), "write",
                  dpl_json_ms(job->write_ms), "total", dpl_json_ms(dpl_tool_clock_ms() - job->start_ms));
    char *text = dpl_json_text(json_pack("{s:s, s:s, s:i, s:[i,i], s:i, s:I, s:I, s:I, s:o}", "solver",
                                         "flood", "falloff", dpl_flood_falloff_name(job->order->falloff),
                                         "range", (int)job->order->range, "size", (int)job->scene.width,
                                         (int)job->scene.height, "lights", (int)job->lights, "visits",
                                         (json_int_t)counts.visits, "pushes", (json_int_t)counts.pushes,
                                         "memory_bytes", (json_int_t)counts.memory_bytes, "ms", ms),
                               &error);
    if (text)
        fputs(text, job->stats_file.stream); /* closing tells whether that went well */
    job->stats_open = false;
    bool good = dpl_file_writer_close(&job->stats_file, text != NULL, &error);
    free(text);
    return good ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}

int dpl_flood_run(const dpl_flood_order *order) {
    static int (*const steps[])(flood_job *) = {open_stats, read_scene, solve, write_picture, write_stats};
    flood_job job = {.order = order, .start_ms = dpl_tool_clock_ms()};
    int status = DPL_EXIT_DONE;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++)
        status = steps[i](&job);
    if (job.stats_open)
        (void)dpl_file_writer_close(&job.stats_file, false, NULL);
    dpl_picture_free(&job.picture);
    dpl_flood_destroy(job.flood);
    dpl_field_destroy(job.field);
    dpl_scene_free(&job.scene);
    dpl_context_destroy(job.context);
    return status;
}
