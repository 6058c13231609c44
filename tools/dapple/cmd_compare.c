/* dapple compare: how far one picture is from another. */
#include "command.h"
#include "json.h"
#include "options.h"
#include "report.h"

#include "scenes/scene.h"

#include <dapple/metric.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: dapple compare A B [--mask SCENE] [--json]\n"
    "\n"
    "Judges the picture A against the reference B. Both are PFM or EXR (linear radiance),\n"
    "or both are PNG (compared as the display colours that they are).\n"
    "\n"
    "  psnr_linear   dB, peak 1, of unclamped linear values\n"
    "  psnr_display  dB, peak 255, after the tone map and rounding to 8 bits, RGB\n"
    "  rel_rmse      root mean square error / mean of the reference, linear\n"
    "  ssim          structural similarity of display luminance: 1 is best\n"
    "  flip          LDR-FLIP of the tone-mapped pictures: 0 is best\n"
    "  pixels        how many were compared\n"
    "\n"
    "Options:\n"
    "  --mask SCENE  leave out the pixels that are opaque in this scene (default: none)\n"
    "  --json        print JSON; an infinite number becomes null, and \"identical\" tells\n"
    "                equal pictures (default: a table)\n"
    "  -h, --help    print this text\n"
    "\n"
    "Example: how close cascades come to brute force\n"
    "  dapple render scene.json -o fast.pfm\n"
    "  dapple render scene.json -o truth.pfm --solver reference\n"
    "  dapple compare fast.pfm truth.pfm --mask scene.json\n";

typedef struct compare_options {
    const char *paths[2]; /* A, B */
    const char *mask;
    bool json;
} compare_options;

/* Everything that is in memory during a comparison. */
typedef struct comparison {
    dpl_context *context;
    dpl_picture pictures[2]; /* A, B: 3 channels */
    uint8_t *mask;           /* or NULL */
} comparison;

static int parse(int argc, char **argv, compare_options *given) {
    const dpl_option options[] = {
        {.name = "mask", .kind = DPL_OPTION_TEXT, .target = &given->mask},
        {.name = "json", .kind = DPL_OPTION_FLAG, .target = &given->json},
    };
    const dpl_operand operands[] = {
        {.name = "A", .required = true, .target = &given->paths[0]},
        {.name = "B", .required = true, .target = &given->paths[1]},
    };
    const dpl_syntax syntax = {
        .command = "compare",
        .help = help,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operands = operands,
        .operand_count = sizeof operands / sizeof operands[0],
    };
    return dpl_options_parse(&syntax, argc, argv);
}

/* Metrics want RGB: grey is repeated, alpha left out. */
static bool picture_to_rgb(dpl_picture *picture, dpl_error *error) {
    if (picture->channels == 3)
        return true;
    dpl_picture rgb = {0};
    if (!dpl_picture_create(&rgb, picture->width, picture->height, 3, error))
        return false;
    rgb.display = picture->display;
    size_t count = (size_t)picture->width * (size_t)picture->height;
    size_t channels = (size_t)picture->channels;
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            rgb.data[3 * i + c] = picture->data[channels * i + (channels < 3 ? 0 : c)];
    dpl_picture_free(picture);
    *picture = rgb;
    return true;
}

static int read_pictures(const compare_options *given, comparison *job) {
    dpl_error error;
    for (int i = 0; i < 2; i++)
        if (!dpl_picture_read(given->paths[i], DPL_PICTURE_RAW, &job->pictures[i], &error) ||
            !picture_to_rgb(&job->pictures[i], &error))
            return dpl_report_failure("%s", error.text);
    const dpl_picture *a = &job->pictures[0];
    const dpl_picture *b = &job->pictures[1];
    if (a->display != b->display) {
        int png = a->display ? 0 : 1;
        return dpl_report_failure("%s: is a PNG (display colours), but %s is linear: compare two PNGs, or "
                                  "PFM or EXR with each other",
                                  given->paths[png], given->paths[1 - png]);
    }
    if (a->width != b->width || a->height != b->height)
        return dpl_report_failure("%s: is %dx%d, but %s is %dx%d", given->paths[0], (int)a->width,
                                  (int)a->height, given->paths[1], (int)b->width, (int)b->height);
    return DPL_EXIT_DONE;
}

static int fill_mask(const char *path, comparison *job, const dpl_scene *scene) {
    const dpl_picture *a = &job->pictures[0];
    if (scene->width != a->width || scene->height != a->height)
        return dpl_report_failure("%s: is %dx%d, but the pictures are %dx%d", path, (int)scene->width,
                                  (int)scene->height, (int)a->width, (int)a->height);
    job->mask = malloc((size_t)a->width * (size_t)a->height);
    if (!job->mask)
        return dpl_report_status(NULL, DPL_ERROR_MEMORY);
    dpl_field *field;
    dpl_error error;
    if (!dpl_scene_build_field(scene, job->context, false, &field, &error))
        return dpl_report_failure("%s", error.text);
    dpl_status status = dpl_field_read_opaque(field, job->mask, 0);
    dpl_field_destroy(field);
    return status == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(job->context, status);
}

static int read_mask(const char *path, comparison *job) {
    dpl_scene scene = {0};
    dpl_error error;
    int status = dpl_scene_read(path, &scene, &error) ? fill_mask(path, job, &scene)
                                                      : dpl_report_failure("%s", error.text);
    dpl_scene_free(&scene);
    return status;
}

/* Different values have an error above zero; only equal ones have none. */
static bool is_identical(const dpl_metrics *metrics) {
    return metrics->rel_rmse == 0;
}

static int print_json(const dpl_metrics *metrics) {
    return dpl_json_print(json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:I, s:b}", "psnr_linear", dpl_json_real(metrics->psnr_linear),
        "psnr_display", dpl_json_real(metrics->psnr_display), "rel_rmse", dpl_json_real(metrics->rel_rmse),
        "ssim", dpl_json_real(metrics->ssim), "flip", dpl_json_real(metrics->flip), "pixels",
        (json_int_t)metrics->pixels, "identical", is_identical(metrics)));
}

static int print_table(const dpl_metrics *metrics) {
    const struct {
        const char *name;
        double value;
        const char *unit;
    } rows[] = {
        {"psnr_linear", metrics->psnr_linear, "dB, peak 1"},
        {"psnr_display", metrics->psnr_display, "dB, peak 255"},
        {"rel_rmse", metrics->rel_rmse, "of the reference's mean"},
        {"ssim", metrics->ssim, "1 is best"},
        {"flip", metrics->flip, "0 is best"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        printf("%-12s  %12.6g  %s\n", rows[i].name, rows[i].value, rows[i].unit);
    printf("%-12s  %12lld  px\n", "pixels", (long long)metrics->pixels);
    printf("%-12s  %12s\n", "identical", is_identical(metrics) ? "yes" : "no");
    return DPL_EXIT_DONE;
}

static int compare(const compare_options *given, comparison *job) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    desc.test = dpl_picture_pixels(&job->pictures[0]);
    desc.reference = dpl_picture_pixels(&job->pictures[1]);
    desc.mask = job->mask;
    desc.display_referred = job->pictures[0].display;
    dpl_metrics metrics;
    dpl_status status = dpl_metrics_compare(job->context, &desc, &metrics);
    if (status != DPL_OK)
        return dpl_report_status(job->context, status);
    return given->json ? print_json(&metrics) : print_table(&metrics);
}

static int run(int argc, char **argv) {
    compare_options given = {0};
    int status = parse(argc, argv, &given);
    if (status != DPL_OPTIONS_GO)
        return status;
    comparison job = {0};
    dpl_status created = dpl_context_create(NULL, &job.context);
    status = created == DPL_OK ? DPL_EXIT_DONE : dpl_report_status(NULL, created);
    if (status == DPL_EXIT_DONE)
        status = read_pictures(&given, &job);
    if (status == DPL_EXIT_DONE && given.mask)
        status = read_mask(given.mask, &job);
    if (status == DPL_EXIT_DONE)
        status = compare(&given, &job);
    free(job.mask);
    dpl_picture_free(&job.pictures[0]);
    dpl_picture_free(&job.pictures[1]);
    dpl_context_destroy(job.context);
    return status;
}

const dpl_command dpl_command_compare = {
    "compare",
    "judge a picture against a reference",
    help,
    run,
};
