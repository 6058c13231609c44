/* Renders a scene step by step: each step leaves what the next one needs in the job. */
#include "render.h"
#include "output.h"

#include "clock.h"
#include "holographic.h"
#include "interrupt.h"
#include "lights.h"
#include "progress.h"
#include "report.h"
#include "stats.h"

#include "image/file.h"
#include "scenes/scene.h"

#include <stdlib.h>

/* Everything that is open or in memory during a render. */
typedef struct render_job {
    const dpl_render_order *order;
    dpl_render_stats stats;
    dpl_file_writer stats_file;
    bool stats_open;
    dpl_context *context;
    dpl_scene scene;
    dpl_field *field;
    dpl_solver *solver;
    dpl_picture picture;
    dpl_light *lights; /* of the scene, where they are wanted; malloc'ed */
    int32_t light_count;
    dpl_shadow *shadow;
    dpl_picture lit; /* what they give */
    dpl_progress progress;
} render_job;

/* Opened first, so that a name that cannot be written is found before the work, not after. */
static int open_stats(render_job *job) {
    dpl_error error;
    if (!job->order->stats)
        return DPL_EXIT_DONE;
    if (!dpl_file_writer_open(&job->stats_file, job->order->stats, &error))
        return dpl_report_failure("%s", error.text);
    job->stats_open = true;
    return DPL_EXIT_DONE;
}

static int open_context(render_job *job) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = job->order->threads;
    desc.isa_mask = job->order->isa_mask;
    dpl_status status = dpl_context_create(&desc, &job->context);
    if (status != DPL_OK)
        return dpl_report_status(NULL, status);
    job->stats.threads = dpl_context_thread_count(job->context);
    job->stats.isa = dpl_isa_name(dpl_context_isa(job->context));
    return DPL_EXIT_DONE;
}

static int read_scene(render_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    if (!dpl_scene_read(job->order->scene, &job->scene, &error))
        return dpl_report_failure("%s", error.text);
    job->stats.read_ms = dpl_tool_clock_ms() - start;
    if (job->order->margin >= 0)
        job->scene.margin = job->order->margin;
    job->stats.width = job->scene.width;
    job->stats.height = job->scene.height;
    return DPL_EXIT_DONE;
}

static int make_field(render_job *job) {
    dpl_error error;
    double start = dpl_tool_clock_ms();
    bool shapes = job->order->solver.kind == DPL_SOLVER_CASCADES &&
                  job->order->solver.cascades.profile == DPL_PROFILE_PAPER;
    if (!dpl_scene_build_field(&job->scene, job->context, shapes, &job->field, &error))
        return dpl_report_failure("%s", error.text);
    job->stats.field_ms = dpl_tool_clock_ms() - start;
    return DPL_EXIT_DONE;
}

static int on_progress(double done, void *user) {
    dpl_progress_update(user, done);
    return dpl_interrupt_status() == 0;
}

/* The exit status that goes with a status of the library. */
static int exit_status(const render_job *job, dpl_status status) {
    if (status == DPL_OK)
        return DPL_EXIT_DONE;
    if (status == DPL_ERROR_CANCELLED && dpl_interrupt_status())
        return dpl_interrupt_status();
    return dpl_report_status(job->context, status);
}

/* Also without bounces, where they change nothing. */
static dpl_status make_solver(render_job *job) {
    dpl_solver_desc desc = job->order->solver;
    desc.progress = on_progress;
    desc.progress_user = &job->progress;
    dpl_status status = dpl_solver_create(job->context, &desc, &job->solver);
    return status == DPL_OK ? dpl_solver_set_lights(job->solver, job->lights, job->light_count) : status;
}

static int solve(render_job *job) {
    dpl_error error;
    dpl_status status = make_solver(job);
    if (status != DPL_OK)
        return dpl_report_status(job->context, status);
    if (!dpl_picture_create(&job->picture, job->scene.width, job->scene.height, 3, &error))
        return dpl_report_failure("%s", error.text);
    dpl_output output = dpl_picture_output(&job->picture);
    dpl_progress_begin(&job->progress);
    status = dpl_solver_solve(job->solver, job->field, &output);
    dpl_progress_end(&job->progress);
    if (status != DPL_OK)
        return exit_status(job, status);
    dpl_solver_read_stats(job->solver, &job->stats.counts);
    job->stats.field_ms += job->stats.counts.field_ms;
    job->stats.solve_ms = job->stats.counts.solve_ms;
    return DPL_EXIT_DONE;
}

static int take_lights(render_job *job) {
    if (!job->order->with_lights || job->scene.light_count == 0)
        return DPL_EXIT_DONE;
    job->lights = dpl_lights_of_scene(&job->scene);
    if (!job->lights)
        return dpl_report_status(NULL, DPL_ERROR_MEMORY);
    job->light_count = job->scene.light_count;
    return DPL_EXIT_DONE;
}

/* The light of the scene's `lights`, into the picture `lit`. */
static int shine(render_job *job) {
    dpl_error error;
    dpl_shadow_desc desc = job->order->shadow;
    desc.progress = on_progress;
    desc.progress_user = &job->progress;
    dpl_status status = dpl_shadow_create(job->context, &desc, &job->shadow);
    if (status != DPL_OK)
        return dpl_report_status(job->context, status);
    if (!dpl_picture_create(&job->lit, job->scene.width, job->scene.height, 3, &error))
        return dpl_report_failure("%s", error.text);
    dpl_output output = dpl_picture_output(&job->lit);
    dpl_progress_begin(&job->progress);
    status = dpl_shadow_light(job->shadow, job->field, job->lights, job->light_count, &output);
    dpl_progress_end(&job->progress);
    return exit_status(job, status);
}

/* Light is linear: what the lights give directly comes on top of what the solver found, which has their light
 * by way of walls alone. */
static int add_lights(render_job *job) {
    if (job->light_count == 0)
        return DPL_EXIT_DONE;
    double start = dpl_tool_clock_ms();
    int status = shine(job);
    if (status != DPL_EXIT_DONE)
        return status;
    size_t count = (size_t)job->scene.width * (size_t)job->scene.height * 3;
    for (size_t i = 0; i < count; i++)
        job->picture.data[i] += job->lit.data[i];
    job->stats.lights = job->light_count;
    job->stats.shadow = dpl_shadow_method_name(job->order->shadow.method);
    job->stats.lights_ms = dpl_tool_clock_ms() - start;
    return DPL_EXIT_DONE;
}

static int write_picture(render_job *job) {
    double start = dpl_tool_clock_ms();
    int status = dpl_tool_write_picture(job->context, job->order->output, &job->picture, DPL_LOOK_LIGHT);
    job->stats.write_ms = dpl_tool_clock_ms() - start;
    return status;
}

static void describe_order(render_job *job, double start_ms) {
    const dpl_solver_desc *solver = &job->order->solver;
    job->stats.total_ms = dpl_tool_clock_ms() - start_ms;
    job->stats.solver = dpl_solver_kind_name(solver->kind);
    if (solver->kind == DPL_SOLVER_CASCADES)
        job->stats.merge = dpl_merge_name(solver->cascades.merge);
    if (solver->kind == DPL_SOLVER_HOLOGRAPHIC) {
        job->stats.storage = dpl_holographic_storage_name(solver->holographic.storage);
        job->stats.resolution = dpl_holographic_resolution_name(solver->holographic.resolution);
    }
    job->stats.skip = dpl_skip_mode_name(solver->cascades.skip.mode);
}

static int write_stats(render_job *job) {
    dpl_error error;
    if (!job->stats_open)
        return DPL_EXIT_DONE;
    char *text = dpl_render_stats_text(&job->stats, &error);
    if (text)
        fputs(text, job->stats_file.stream); /* closing tells whether that went well */
    job->stats_open = false;
    bool good = dpl_file_writer_close(&job->stats_file, text != NULL, &error);
    free(text);
    return good ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}

static void clean_up(render_job *job) {
    if (job->stats_open)
        (void)dpl_file_writer_close(&job->stats_file, false, NULL);
    dpl_picture_free(&job->picture);
    dpl_picture_free(&job->lit);
    free(job->lights);
    dpl_shadow_destroy(job->shadow);
    dpl_solver_destroy(job->solver);
    dpl_field_destroy(job->field);
    dpl_scene_free(&job->scene);
    dpl_context_destroy(job->context);
}

int dpl_render_run(const dpl_render_order *order) {
    static int (*const steps[])(render_job *) = {
        open_context, open_stats, read_scene, make_field, take_lights, solve, add_lights, write_picture,
    };
    double start_ms = dpl_tool_clock_ms();
    render_job job = {.order = order};
    dpl_interrupt_catch();
    int status = DPL_EXIT_DONE;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++) {
        status = dpl_interrupt_status(); /* a picture that is written already stays, with its statistics */
        if (status == DPL_EXIT_DONE)
            status = steps[i](&job);
    }
    if (status == DPL_EXIT_DONE) {
        describe_order(&job, start_ms);
        status = write_stats(&job);
    }
    clean_up(&job);
    return status;
}
