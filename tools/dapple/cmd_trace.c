/* dapple trace: a scene of shapes goes in, a picture lit by rays against the shapes themselves comes out. */
#include "clock.h"
#include "command.h"
#include "json.h"
#include "options.h"
#include "output.h"
#include "paths.h"
#include "render.h"
#include "report.h"

#include "image/file.h"
#include "image/picture.h"
#include "scenes/scene.h"

#include <dapple/tracer.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: dapple trace SCENE -o OUT [options]\n"
    "\n"
    "Lights SCENE (a scene file of opaque shapes, without images) by rays against the\n"
    "shapes themselves, not against pixels, and writes the mean radiance that arrives at\n"
    "each pixel's centre: what `dapple render` comes to as pixels become finer.\n"
    "\n"
    "Options:\n"
    "  -o, --output OUT  .png is tone-mapped sRGB for looking at; .pfm and .exr hold the\n"
    "                    linear result; - writes PFM to standard output\n"
    "  --method METHOD   bvh, through a hierarchy of boxes, or naive, every shape for every\n"
    "                    ray; the pictures are the same bit for bit (default bvh)\n"
    "  --directions N    of each pixel: 1 to 1048576 (default 256)\n"
    "  --threads N       1 to 64 (default: one per processor)\n"
    "  --stats FILE      also write times and counted rays, shape tests and node visits as\n"
    "                    JSON\n"
    "  -h, --help        print this text\n"
    "\n"
    "Example:\n"
    "  dapple trace scene.json -o light.png --directions 1024\n";

#define DIRECTIONS_DEFAULT 256
#define DIRECTIONS_MAX 1048576

static const dpl_choice method_choices[] = {
    {"bvh", DPL_TRACER_BVH},
    {"naive", DPL_TRACER_NAIVE},
    {NULL, 0},
};

typedef struct trace_options {
    const char *scene;
    const char *output;
    const char *stats;
    int method;
    int32_t directions;
    int32_t threads;
} trace_options;

/* Everything that is open or in memory; each step leaves what the next one needs. */
typedef struct trace_job {
    const trace_options *given;
    dpl_scene scene;
    dpl_context *context;
    dpl_tracer *tracer;
    dpl_picture picture;
    double build_ms;
    double light_ms;
} trace_job;

static int parse(int argc, char **argv, trace_options *given) {
    const dpl_option options[] = {
        {.name = "output", .letter = 'o', .kind = DPL_OPTION_TEXT, .target = &given->output},
        {.name = "stats", .kind = DPL_OPTION_TEXT, .target = &given->stats},
        {.name = "method", .kind = DPL_OPTION_CHOICE, .target = &given->method, .choices = method_choices},
        {.name = "directions",
         .kind = DPL_OPTION_INTEGER,
         .target = &given->directions,
         .minimum = 1,
         .maximum = DIRECTIONS_MAX},
        {.name = "threads",
         .kind = DPL_OPTION_INTEGER,
         .target = &given->threads,
         .minimum = 1,
         .maximum = DPL_MAX_THREADS},
    };
    const dpl_operand operands[] = {{.name = "SCENE", .required = true, .target = &given->scene}};
    const dpl_syntax syntax = {
        .command = "trace",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

static int check_names(const trace_options *given) {
    dpl_error error;
    const dpl_tool_files files = {"trace", given->scene, given->output, given->stats};
    int status = dpl_tool_check_files(&files);
    if (status != DPL_OPTIONS_GO)
        return status;
    if (!dpl_path_check_writable(given->output, &error) ||
        (given->stats && !dpl_path_check_writable(given->stats, &error)))
        return dpl_report_failure("%s", error.text);
    return DPL_OPTIONS_GO;
}

static int read_scene(trace_job *job) {
    dpl_error error;
    if (!dpl_scene_read(job->given->scene, &job->scene, &error))
        return dpl_report_failure("%s", error.text);
    if (job->scene.image_count > 0)
        return dpl_report_failure("%s: trace wants shapes alone, and this scene has images",
                                  job->given->scene);
    return DPL_EXIT_DONE;
}

static int build(trace_job *job) {
    dpl_context_desc context = dpl_context_desc_default();
    dpl_tracer_desc tracer = dpl_tracer_desc_default();
    context.thread_count = job->given->threads;
    tracer.method = (dpl_tracer_method)job->given->method;
    dpl_status status = dpl_context_create(&context, &job->context);
    if (status != DPL_OK)
        return dpl_report_status(NULL, status);
    status = dpl_tracer_create(job->context, &tracer, &job->tracer);
    double start = dpl_tool_clock_ms();
    if (status == DPL_OK)
        status =
            dpl_tracer_set_shapes(job->tracer, DPL_TRACER_STATIC, job->scene.shapes, job->scene.shape_count);
    job->build_ms = dpl_tool_clock_ms() - start;
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->context, status);
}

static int light(trace_job *job) {
    dpl_error error;
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    desc.directions = job->given->directions;
    for (int c = 0; c < 3; c++)
        desc.sky[c] = (float)job->scene.sky[c];
    if (!dpl_picture_create(&job->picture, job->scene.width, job->scene.height, 3, &error))
        return dpl_report_failure("%s", error.text);
    dpl_output output = dpl_picture_output(&job->picture);
    double start = dpl_tool_clock_ms();
    dpl_status status = dpl_tracer_light(job->tracer, &desc, &output);
    job->light_ms = dpl_tool_clock_ms() - start;
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->context, status);
}

static int write_picture(trace_job *job) {
    return dpl_tool_write_picture(job->context, job->given->output, &job->picture, DPL_LOOK_LIGHT);
}

static int write_stats(trace_job *job) {
    dpl_error error;
    dpl_tracer_stats stats;
    if (!job->given->stats)
        return DPL_EXIT_DONE;
    dpl_tracer_read_stats(job->tracer, &stats);
    char *text = dpl_json_text(
        json_pack("{s:s, s:[i,i], s:i, s:i, s:i, s:{s:o, s:o}, s:I, s:I, s:I, s:i, s:I}", "method",
                  dpl_tracer_method_name((dpl_tracer_method)job->given->method), "size",
                  (int)job->scene.width, (int)job->scene.height, "threads",
                  (int)dpl_context_thread_count(job->context), "directions", (int)job->given->directions,
                  "shapes", (int)job->scene.shape_count, "ms", "build", dpl_json_ms(job->build_ms), "light",
                  dpl_json_ms(job->light_ms), "rays", (json_int_t)stats.rays, "object_tests",
                  (json_int_t)stats.object_tests, "node_visits", (json_int_t)stats.node_visits, "depth",
                  (int)stats.depth[DPL_TRACER_STATIC], "hierarchy_bytes", (json_int_t)stats.hierarchy_bytes),
        &error);
    bool good = text && dpl_file_write(job->given->stats, text, strlen(text), &error);
    free(text);
    return good ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}

static int run(int argc, char **argv) {
    static int (*const steps[])(trace_job *) = {read_scene, build, light, write_picture, write_stats};
    trace_options given = {.method = DPL_TRACER_BVH, .directions = DIRECTIONS_DEFAULT};
    trace_job job = {.given = &given};
    int status = parse(argc, argv, &given);
    if (status == DPL_OPTIONS_GO)
        status = check_names(&given);
    if (status != DPL_OPTIONS_GO)
        return status;
    status = DPL_EXIT_DONE;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0] && status == DPL_EXIT_DONE; i++)
        status = steps[i](&job);
    dpl_picture_free(&job.picture);
    dpl_tracer_destroy(job.tracer);
    dpl_context_destroy(job.context);
    dpl_scene_free(&job.scene);
    return status;
}

const dpl_command dpl_command_trace = {
    "trace",
    "light a scene of shapes by rays against the shapes themselves",
    help,
    run,
};
