/* Lights a scene in space for its camera: reads, looks, asks the shadow of each light, shades, writes. Called
 * by cmd_shadow3d.c. */
#include "solid_shadow.h"
#include "output.h"

#include "clock.h"
#include "json.h"
#include "render.h"
#include "report.h"

#include "image/file.h"
#include "image/picture.h"
#include "scenes/solid_scene.h"

#include <stdlib.h>
#include <string.h>

static const float PI = 3.14159265f;

/* Everything that is open or in memory; each step leaves what the next one needs. */
typedef struct solid_job {
    const dpl_solid_shadow_order *order;
    dpl_solid_scene scene;
    dpl_mesh_data seen; /* triangles that the camera looks at */
    dpl_context *context;
    dpl_mesh *looked_at;
    dpl_mesh *casting;
    dpl_mesh_field *field;
    dpl_solid_shadow *shadow;
    float (*positions)[3];
    float (*normals)[3];
    int32_t *triangles;
    float *visibility;
    dpl_picture picture;
    json_t *lights; /* what each light cost */
    double mesh_ms;
    double field_ms;
    double look_ms;
    double map_ms;
    double solve_ms;
} solid_job;

static int64_t pixel_count(const solid_job *job) {
    return (int64_t)job->scene.camera.width * job->scene.camera.height;
}

static int check(const solid_job *job, dpl_status status) {
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->context, status);
}

/* ---- steps ---------------------------------------------------------------------------------------- */

static int read_scene(solid_job *job) {
    dpl_error error;
    const char *path = job->order->scene;
    if (!dpl_solid_scene_read(path, &job->scene, &error) ||
        !dpl_solid_scene_join(&job->scene, &job->seen, &error))
        return dpl_report_failure("%s", error.text);
    if (job->order->light >= job->scene.light_count)
        return dpl_report_failure("%s: has %d lights, and no light %d", path, (int)job->scene.light_count,
                                  (int)job->order->light);
    return DPL_EXIT_DONE;
}

static int reserve(solid_job *job) {
    size_t pixels = (size_t)pixel_count(job);
    dpl_error error;
    if (!dpl_picture_create(&job->picture, job->scene.camera.width, job->scene.camera.height, 3, &error))
        return dpl_report_failure("%s", error.text);
    job->positions = malloc(pixels * sizeof *job->positions);
    job->normals = malloc(pixels * sizeof *job->normals);
    job->triangles = malloc(pixels * sizeof *job->triangles);
    job->visibility = malloc(pixels * sizeof *job->visibility);
    job->lights = json_array();
    bool good = job->positions && job->normals && job->triangles && job->visibility && job->lights;
    return good ? DPL_EXIT_DONE : dpl_report_status(NULL, DPL_ERROR_MEMORY);
}

static int build_meshes(solid_job *job) {
    dpl_context_desc context = dpl_context_desc_default();
    dpl_mesh_desc seen = dpl_mesh_data_desc(&job->seen), casting = dpl_mesh_data_desc(&job->scene.casting);
    double start = dpl_tool_clock_ms();
    context.thread_count = job->order->threads;
    dpl_status status = dpl_context_create(&context, &job->context);
    if (status == DPL_OK)
        status = dpl_mesh_create(job->context, &seen, &job->looked_at);
    if (status == DPL_OK)
        status = dpl_mesh_create(job->context, &casting, &job->casting);
    job->mesh_ms = dpl_tool_clock_ms() - start;
    return check(job, status);
}

static int measure(solid_job *job) {
    dpl_mesh_field_desc field = dpl_mesh_field_desc_default();
    dpl_solid_shadow_desc shadow = job->order->shadow;
    bool marches = shadow.method == DPL_SOLID_MRMA || shadow.method == DPL_SOLID_MARCH;
    double start = dpl_tool_clock_ms();
    field.resolution = job->order->field_resolution;
    memcpy(shadow.eye, job->scene.camera.eye, sizeof shadow.eye);
    dpl_status status = dpl_mesh_field_create(job->context, &field, &job->field);
    if (status == DPL_OK && marches)
        status = dpl_mesh_field_measure(job->field, job->casting);
    job->field_ms = dpl_tool_clock_ms() - start;
    if (status == DPL_OK)
        status = dpl_solid_shadow_create(job->context, &shadow, &job->shadow);
    return check(job, status);
}

static int look(solid_job *job) {
    double start = dpl_tool_clock_ms();
    dpl_status status = dpl_solid_camera_look(job->looked_at, &job->scene.camera, job->positions,
                                              job->normals, job->triangles);
    job->look_ms = dpl_tool_clock_ms() - start;
    return check(job, status);
}

/* ---- light ---------------------------------------------------------------------------------------- */

static bool keep_stats(solid_job *job, double map_ms, double solve_ms) {
    dpl_solid_shadow_stats s;
    dpl_solid_shadow_read_stats(job->shadow, &s);
    job->map_ms += map_ms;
    job->solve_ms += solve_ms;
    json_t *entry = json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:I}", "receivers", (json_int_t)s.receivers,
                              "lit", (json_int_t)s.lit, "dark", (json_int_t)s.dark, "refined",
                              (json_int_t)s.refined, "steps", (json_int_t)s.steps, "rays", (json_int_t)s.rays,
                              "memory_bytes", (json_int_t)s.memory_bytes);
    job->lights = dpl_json_append(job->lights, entry);
    return job->lights != NULL;
}

static void add_light(solid_job *job, const dpl_solid_light *light) {
    for (int64_t i = 0; i < pixel_count(job); i++) {
        float rgb[3];
        if (job->triangles[i] < 0)
            continue;
        dpl_solid_light_shine(light, job->positions[i], job->normals[i], rgb);
        for (int c = 0; c < 3; c++)
            job->picture.data[3 * i + c] += job->visibility[i] * rgb[c];
    }
}

static void show_visibility(solid_job *job) {
    for (int64_t i = 0; i < pixel_count(job); i++)
        for (int c = 0; c < 3; c++)
            job->picture.data[3 * i + c] = job->visibility[i];
}

static int cast(solid_job *job) {
    int32_t only = job->order->light;
    for (int32_t k = only < 0 ? 0 : only; k < (only < 0 ? job->scene.light_count : only + 1); k++) {
        const dpl_solid_light *light = &job->scene.lights[k];
        double start = dpl_tool_clock_ms();
        dpl_status status = dpl_solid_shadow_set_light(job->shadow, job->casting, job->field, light);
        double set = dpl_tool_clock_ms();
        if (status == DPL_OK)
            status = dpl_solid_shadow_visibility(job->shadow, (const float(*)[3])job->positions,
                                                 (const float(*)[3])job->normals, pixel_count(job),
                                                 job->visibility);
        if (status != DPL_OK)
            return dpl_report_status(job->context, status);
        if (!keep_stats(job, set - start, dpl_tool_clock_ms() - set))
            return dpl_report_status(NULL, DPL_ERROR_MEMORY);
        if (only < 0)
            add_light(job, light);
        else
            show_visibility(job);
    }
    return DPL_EXIT_DONE;
}

/* From irradiance to what the camera sees of surfaces that scatter evenly. */
static int shade(solid_job *job) {
    for (int64_t i = 0; i < pixel_count(job) && job->order->light < 0; i++) {
        float *rgb = job->picture.data + 3 * i;
        const dpl_solid_part *part = dpl_solid_scene_part(&job->scene, job->triangles[i]);
        for (int c = 0; c < 3; c++)
            rgb[c] = job->triangles[i] >= 0 && part ? (rgb[c] + job->scene.ambient[c]) * part->albedo[c] / PI
                                                    : job->scene.background[c];
    }
    return DPL_EXIT_DONE;
}

/* ---- writing -------------------------------------------------------------------------------------- */

/* A visibility is shown as it is, light through the tone map. */
static int write_picture(solid_job *job) {
    return dpl_tool_write_picture(job->context, job->order->output, &job->picture,
                                  job->order->light >= 0 ? DPL_LOOK_SHARE : DPL_LOOK_LIGHT);
}

static int write_stats(solid_job *job) {
    dpl_error error;
    dpl_mesh_facts facts;
    if (!job->order->stats)
        return DPL_EXIT_DONE;
    dpl_mesh_read_facts(job->casting, &facts);
    char *text = dpl_json_text(
        json_pack("{s:s, s:[i,i], s:i, s:{s:i, s:i, s:i, s:i, s:i}, s:{s:o, s:o, s:o, s:o, s:o}, s:O}",
                  "method", dpl_solid_method_name(job->order->shadow.method), "size", (int)job->picture.width,
                  (int)job->picture.height, "threads", (int)dpl_context_thread_count(job->context), "mesh",
                  "triangles", (int)facts.triangles, "degenerate", (int)facts.degenerate, "parts",
                  (int)facts.parts, "closed", (int)facts.closed_parts, "open", (int)facts.open_parts, "ms",
                  "mesh", dpl_json_ms(job->mesh_ms), "field", dpl_json_ms(job->field_ms), "look",
                  dpl_json_ms(job->look_ms), "map", dpl_json_ms(job->map_ms), "solve",
                  dpl_json_ms(job->solve_ms), "lights", job->lights),
        &error);
    bool good = text && dpl_file_write(job->order->stats, text, strlen(text), &error);
    free(text);
    return good ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}

int dpl_solid_shadow_run(const dpl_solid_shadow_order *order) {
    static int (*const steps[])(solid_job *) = {read_scene, reserve, build_meshes,  measure,    look,
                                                cast,       shade,   write_picture, write_stats};
    solid_job job = {.order = order};
    int status = DPL_EXIT_DONE;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++)
        status = steps[i](&job);
    json_decref(job.lights);
    free(job.positions);
    free(job.normals);
    free(job.triangles);
    free(job.visibility);
    dpl_picture_free(&job.picture);
    dpl_solid_shadow_destroy(job.shadow);
    dpl_mesh_field_destroy(job.field);
    dpl_mesh_destroy(job.casting);
    dpl_mesh_destroy(job.looked_at);
    dpl_context_destroy(job.context);
    dpl_mesh_data_free(&job.seen);
    dpl_solid_scene_free(&job.scene);
    return status;
}
