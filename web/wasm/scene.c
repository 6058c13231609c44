/* Draws a family's scene and reads it back pixel by pixel. */
#include "scene.h"

#include "host.h"

#include "scenes/families.h"

#include <string.h>

const char *dpl_web_family_name(int32_t family) {
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    return family >= 0 && family < count ? families[family].name : NULL;
}

int32_t dpl_web_family_count(int32_t family) {
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    return family >= 0 && family < count ? families[family].count : 0;
}

static bool read_planes(dpl_web_session *session, dpl_error *error) {
    for (int32_t y = 0; y < session->height; y++)
        for (int32_t x = 0; x < session->width; x++) {
            dpl_material material;
            dpl_status status = dpl_field_read_pixel(session->field, x, y, &material);
            if (status != DPL_OK)
                return dpl_error_set(error, "%s", dpl_status_text(status));
            size_t at = 3 * ((size_t)y * (size_t)session->width + (size_t)x);
            memcpy(session->planes[DPL_WEB_EMISSION] + at, material.emission, sizeof material.emission);
            memcpy(session->planes[DPL_WEB_EXTINCTION] + at, material.extinction, sizeof material.extinction);
            memcpy(session->planes[DPL_WEB_ALBEDO] + at, material.albedo, sizeof material.albedo);
        }
    return true;
}

static void read_lights(const dpl_scene *scene, double *lights, int32_t *light_count) {
    *light_count = scene->light_count < DPL_WEB_LIGHTS_MAX ? scene->light_count : DPL_WEB_LIGHTS_MAX;
    for (int32_t i = 0; i < *light_count; i++) {
        const dpl_scene_light *light = &scene->lights[i];
        const double row[DPL_WEB_LIGHT_NUMBERS] = {light->position[0], light->position[1], light->radius,
                                                   light->color[0],    light->color[1],    light->color[2],
                                                   light->intensity};
        memcpy(lights + DPL_WEB_LIGHT_NUMBERS * i, row, sizeof row);
    }
}

/* The scene is made already. */
static bool draw(dpl_web_session *session, dpl_scene *scene, int32_t width, int32_t height,
                 dpl_error *error) {
    if (scene->margin > 0 || scene->sky_ring)
        return dpl_error_set(error, "this scene has a world outside its picture, which planes cannot hold");
    scene->width = width;
    scene->height = height;
    dpl_status status = (dpl_status)dpl_web_resize(session, width, height);
    if (status != DPL_OK)
        return dpl_error_set(error, "%s", dpl_web_message(session, (int32_t)status));
    return dpl_scene_draw(scene, session->context, session->field, error) && read_planes(session, error);
}

int32_t dpl_web_scene(dpl_web_session *session, int32_t family, uint64_t seed, int32_t index, int32_t width,
                      int32_t height, double sky[3], double *lights, int32_t *light_count) {
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    dpl_error error;
    dpl_scene scene = {0};
    bool good = (family >= 0 && family < count && index >= 0 && index < families[family].count) ||
                dpl_error_set(&error, "there is no such scene");
    good = good && families[family].make(seed, index, width > height ? width : height, &scene, &error) &&
           draw(session, &scene, width, height, &error);
    if (good) {
        memcpy(sky, scene.sky, sizeof scene.sky);
        read_lights(&scene, lights, light_count);
    } else {
        dpl_web_report(error.text);
    }
    dpl_scene_free(&scene);
    return good;
}
