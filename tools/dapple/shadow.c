/* Shadows of a scene step by step: each step leaves what the next one needs in the job. */
#include "shadow.h"
#include "output.h"

#include "clock.h"
#include "interrupt.h"
#include "lights.h"
#include "render.h"
#include "report.h"

#include "image/file.h"

#include <stdlib.h>
#include <string.h>

static int open_context(dpl_shadow_job *job) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = job->order->threads;
    dpl_status status = dpl_context_create(&desc, &job->context);
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(NULL, status);
}

static int read_scene(dpl_shadow_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    if (!dpl_scene_read(job->order->scene, &job->scene, &error))
        return dpl_report_failure("%s", error.text);
    if (job->scene.light_count == 0)
        return dpl_report_failure("%s: the scene has no `lights`", job->order->scene);
    if (job->order->light >= job->scene.light_count)
        return dpl_report_failure("%s: there is no light %d: the scene has lights 0 to %d", job->order->scene,
                                  job->order->light, job->scene.light_count - 1);
    if (!dpl_scene_build_field(&job->scene, job->context, false, &job->field, &error))
        return dpl_report_failure("%s", error.text);
    job->read_ms = dpl_tool_clock_ms() - start;
    return DPL_EXIT_DONE;
}

static int take_lights(dpl_shadow_job *job) {
    job->lights = dpl_lights_of_scene(&job->scene);
    return job->lights ? DPL_EXIT_DONE : dpl_report_status(NULL, DPL_ERROR_MEMORY);
}

/* ---- solving -------------------------------------------------------------------------------------- */

static int on_progress(double done, void *user) {
    dpl_progress_update(user, done);
    return dpl_interrupt_status() == 0;
}

/* The exit status that goes with a status of the library. */
static int exit_status(const dpl_shadow_job *job, dpl_status status) {
    if (status == DPL_OK)
        return DPL_EXIT_DONE;
    if (status == DPL_ERROR_CANCELLED && dpl_interrupt_status())
        return dpl_interrupt_status();
    return dpl_report_status(job->context, status);
}

static dpl_status use_shadow(dpl_shadow_job *job, dpl_shadow *shadow, float *visibility) {
    int32_t light = job->order->light < 0 ? 0 : job->order->light;
    if (visibility)
        return dpl_shadow_visibility(shadow, job->field, &job->lights[light], visibility, 0);
    dpl_output output = dpl_picture_output(&job->picture);
    return dpl_shadow_light(shadow, job->field, job->lights, job->scene.light_count, &output);
}

/* `visibility` NULL: the light of all lights, into the job's picture. */
int dpl_shadow_solve(dpl_shadow_job *job, const dpl_shadow_desc *given, float *visibility,
                     dpl_shadow_stats *stats) {
    dpl_shadow *shadow;
    dpl_shadow_desc desc = *given;
    desc.progress = on_progress;
    desc.progress_user = &job->progress;
    dpl_status status = dpl_shadow_create(job->context, &desc, &shadow);
    if (status != DPL_OK)
        return dpl_report_status(job->context, status);
    dpl_progress_begin(&job->progress);
    status = use_shadow(job, shadow, visibility);
    dpl_progress_end(&job->progress);
    dpl_shadow_read_stats(shadow, stats);
    dpl_shadow_destroy(shadow);
    return exit_status(job, status);
}

static int solve(dpl_shadow_job *job) {
    dpl_error error;
    bool one = job->order->light != DPL_SHADOW_ALL_LIGHTS;
    if (job->order->compare)
        return dpl_shadow_compare(job);
    if (!dpl_picture_create(&job->picture, job->scene.width, job->scene.height, one ? 1 : 3, &error))
        return dpl_report_failure("%s", error.text);
    return dpl_shadow_solve(job, &job->order->shadow, one ? job->picture.data : NULL, &job->stats);
}

/* ---- writing -------------------------------------------------------------------------------------- */

static int write_picture(dpl_shadow_job *job) {
    double start = dpl_tool_clock_ms();
    if (job->order->compare)
        return DPL_EXIT_DONE; /* has written its sheet */
    int status = dpl_tool_write_picture(job->context, job->order->output, &job->picture,
                                        job->picture.channels == 1 ? DPL_LOOK_SHARE : DPL_LOOK_LIGHT);
    job->write_ms = dpl_tool_clock_ms() - start;
    return status;
}

static int write_stats(dpl_shadow_job *job, double start_ms) {
    dpl_error error;
    if (!job->order->stats || job->order->compare)
        return DPL_EXIT_DONE;
    job->total_ms = dpl_tool_clock_ms() - start_ms;
    char *text = dpl_shadow_stats_text(job, &error);
    bool good = text && dpl_file_write(job->order->stats, text, strlen(text), &error);
    free(text);
    return good ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}

int dpl_shadow_run(const dpl_shadow_order *order) {
    static int (*const steps[])(dpl_shadow_job *) = {open_context, read_scene, take_lights, solve,
                                                     write_picture};
    double start_ms = dpl_tool_clock_ms();
    dpl_shadow_job job = {.order = order};
    dpl_interrupt_catch();
    int status = DPL_EXIT_DONE;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++) {
        status = dpl_interrupt_status();
        if (status == DPL_EXIT_DONE)
            status = steps[i](&job);
    }
    if (status == DPL_EXIT_DONE)
        status = write_stats(&job, start_ms);
    dpl_picture_free(&job.picture);
    free(job.lights);
    dpl_field_destroy(job.field);
    dpl_scene_free(&job.scene);
    dpl_context_destroy(job.context);
    return status;
}
