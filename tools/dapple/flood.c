/* Lights a scene as a tile world, a pixel to a cell, step by step: each step leaves what the next one needs
 * in the job. */
#include "flood.h"
#include "output.h"

#include "clock.h"
#include "json.h"
#include "render.h"
#include "report.h"

#include "image/file.h"
#include "scenes/scene_flood.h"

#include <dapple/field.h>
#include <stdlib.h>

typedef struct flood_job {
    const dpl_flood_order *order;
    dpl_file_writer stats_file;
    bool stats_open;
    dpl_context *context;
    dpl_scene scene;
    dpl_field *field;
    dpl_scene_flood world;
    dpl_picture picture;
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

/* ---- steps ---------------------------------------------------------------------------------------- */

static int solve(flood_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    dpl_status status =
        dpl_scene_build_flood(&job->scene, job->field, job->context, &job->order->rules, &job->world);
    job->field_ms += dpl_tool_clock_ms() - start;
    start = dpl_tool_clock_ms();
    if (status == DPL_OK)
        status = dpl_flood_solve(job->world.flood);
    job->solve_ms = dpl_tool_clock_ms() - start;
    if (status != DPL_OK)
        return dpl_report_status(job->context, status);
    if (!dpl_picture_create(&job->picture, job->scene.width, job->scene.height, 3, &error))
        return dpl_report_failure("%s", error.text);
    dpl_output output = dpl_picture_output(&job->picture);
    status = dpl_scene_read_flood(&job->world, &output);
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->context, status);
}

static int write_picture(flood_job *job) {
    double start = dpl_tool_clock_ms();
    int status = dpl_tool_write_picture(job->context, job->order->output, &job->picture, DPL_LOOK_LIGHT);
    job->write_ms = dpl_tool_clock_ms() - start;
    return status;
}

static int write_stats(flood_job *job) {
    dpl_error error;
    dpl_flood_stats counts;
    if (!job->stats_open)
        return DPL_EXIT_DONE;
    dpl_flood_read_stats(job->world.flood, &counts);
    json_t *ms =
        json_pack("{s:o, s:o, s:o, s:o, s:o}", "read", dpl_json_ms(job->read_ms), "field",
                  dpl_json_ms(job->field_ms), "solve", dpl_json_ms(job->solve_ms), "write",
                  dpl_json_ms(job->write_ms), "total", dpl_json_ms(dpl_tool_clock_ms() - job->start_ms));
    char *text = dpl_json_text(
        json_pack("{s:s, s:s, s:i, s:[i,i], s:i, s:I, s:I, s:I, s:o}", "solver", "flood", "falloff",
                  dpl_flood_falloff_name(job->order->rules.falloff), "range", (int)job->order->rules.range,
                  "size", (int)job->scene.width, (int)job->scene.height, "lights", (int)job->world.lights,
                  "visits", (json_int_t)counts.visits, "pushes", (json_int_t)counts.pushes, "memory_bytes",
                  (json_int_t)counts.memory_bytes, "ms", ms),
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
    dpl_flood_destroy(job.world.flood);
    dpl_field_destroy(job.field);
    dpl_scene_free(&job.scene);
    dpl_context_destroy(job.context);
    return status;
}
