/* Fills tile worlds from scenes. */
#include "scene_flood.h"

#include <math.h>

/* Opacity of a medium in each channel, in this many steps up to opaque: 5^3 materials and one more. */
#define SHADES 5
#define MATERIAL_OPAQUE (SHADES * SHADES * SHADES)
#define MATERIALS (MATERIAL_OPAQUE + 1)

typedef struct flood_job {
    const dpl_scene *scene;
    const dpl_field *field;
    dpl_context *context;
    const dpl_scene_flood_rules *rules;
    dpl_scene_flood *made;
} flood_job;

/* ---- from radiance to levels ---------------------------------------------------------------------- */

static void light_radiance(const dpl_scene_light *light, float rgb[3]) {
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(light->color[c] * light->intensity);
}

static void find_brightest(flood_job *job, const float rgb[3]) {
    for (int c = 0; c < 3; c++)
        job->made->brightest = rgb[c] > job->made->brightest ? (double)rgb[c] : job->made->brightest;
}

static dpl_status measure_brightest(flood_job *job) {
    dpl_material material;
    for (int32_t y = 0; y < job->scene->height; y++)
        for (int32_t x = 0; x < job->scene->width; x++) {
            dpl_status status = dpl_field_read_pixel(job->field, x, y, &material);
            if (status != DPL_OK)
                return status;
            find_brightest(job, material.emission);
        }
    for (int32_t i = 0; i < job->scene->light_count; i++) {
        float rgb[3];
        light_radiance(&job->scene->lights[i], rgb);
        find_brightest(job, rgb);
    }
    for (int c = 0; c < 3 && job->rules->sun; c++)
        job->made->brightest =
            job->scene->sky[c] > job->made->brightest ? job->scene->sky[c] : job->made->brightest;
    if (!(job->made->brightest > 0))
        job->made->brightest = 1;
    return DPL_OK;
}

static void levels_of(const flood_job *job, const float rgb[3], uint16_t levels[DPL_FLOOD_MAX_CHANNELS]) {
    for (int c = 0; c < 3; c++)
        levels[c] = (uint16_t)((double)rgb[c] / job->made->brightest * DPL_FLOOD_FULL + 0.5);
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
    const float sky[3] = {(float)job->scene->sky[0], (float)job->scene->sky[1], (float)job->scene->sky[2]};
    list_materials(materials);
    desc.width = job->scene->width;
    desc.height = job->scene->height;
    desc.falloff = job->rules->falloff;
    desc.step = (DPL_FLOOD_FULL + job->rules->range / 2) / job->rules->range;
    desc.keep = (int32_t)(32768 * pow(0.01, 1.0 / job->rules->range));
    desc.materials = materials;
    desc.material_count = MATERIALS;
    if (job->rules->sun) {
        desc.sun = DPL_FLOOD_SUN_Y_UP;
        levels_of(job, sky, desc.sun_level);
    }
    return dpl_flood_create(job->context, &desc, &job->made->flood);
}

static dpl_status add_light(flood_job *job, int32_t x, int32_t y, const float rgb[3]) {
    uint16_t levels[DPL_FLOOD_MAX_CHANNELS];
    dpl_flood_light light;
    levels_of(job, rgb, levels);
    if (levels[0] + levels[1] + levels[2] == 0)
        return DPL_OK;
    job->made->lights++;
    return dpl_flood_add_light(job->made->flood, x, y, 0, levels, &light);
}

static dpl_status fill_pixel(flood_job *job, int32_t x, int32_t y) {
    dpl_material material;
    dpl_status status = dpl_field_read_pixel(job->field, x, y, &material);
    if (status == DPL_OK)
        status = dpl_flood_set_cell(job->made->flood, x, y, 0, material_of(material.extinction));
    return status == DPL_OK ? add_light(job, x, y, material.emission) : status;
}

static dpl_status fill_world(flood_job *job) {
    dpl_status status = measure_brightest(job);
    if (status == DPL_OK)
        status = create_world(job);
    for (int32_t y = 0; y < job->scene->height; y++)
        for (int32_t x = 0; x < job->scene->width && status == DPL_OK; x++)
            status = fill_pixel(job, x, y);
    for (int32_t i = 0; i < job->scene->light_count && status == DPL_OK; i++) {
        const dpl_scene_light *light = &job->scene->lights[i];
        double x = floor(light->position[0]), y = floor(light->position[1]);
        float rgb[3];
        light_radiance(light, rgb);
        if (x >= 0 && y >= 0 && x < job->scene->width && y < job->scene->height)
            status = add_light(job, (int32_t)x, (int32_t)y, rgb);
    }
    return status;
}

dpl_status dpl_scene_build_flood(const dpl_scene *scene, const dpl_field *field, dpl_context *context,
                                 const dpl_scene_flood_rules *rules, dpl_scene_flood *made) {
    flood_job job = {scene, field, context, rules, made};
    *made = (dpl_scene_flood){0};
    return fill_world(&job);
}

dpl_status dpl_scene_read_flood(const dpl_scene_flood *made, const dpl_output *output) {
    float b = (float)made->brightest;
    const float weights[DPL_FLOOD_MAX_CHANNELS][3] = {{b, 0, 0}, {0, b, 0}, {0, 0, b}};
    return dpl_flood_read_light(made->flood, 0, weights, output);
}
