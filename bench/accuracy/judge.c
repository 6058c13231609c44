/* Solves scenes by every method and measures the distance to the truth. Called by main.c. */
#include "judge.h"

#include "../common/clock.h"
#include "../common/progress.h"
#include "../common/sample.h"

#include <math.h>
#include <stdlib.h>

static bool check(const dpl_bench_judge *judge, dpl_status status, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    const char *message = judge->context ? dpl_context_message(judge->context) : "";
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

static bool create_all(const dpl_bench_trial *trial, const dpl_bench_method *methods, int32_t method_count,
                       dpl_bench_judge *judge, dpl_error *error) {
    dpl_context_desc context = dpl_context_desc_default();
    context.thread_count = trial->threads;
    if (!check(judge, dpl_context_create(&context, &judge->context), error))
        return false;
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = trial->directions;
    desc.bounces = trial->bounces;
    if (!check(judge, dpl_solver_create(judge->context, &desc, &judge->reference), error))
        return false;
    for (int32_t i = 0; i < method_count; i++) {
        desc.kind = methods[i].kind;
        desc.cascades = methods[i].cascades;
        desc.holographic = methods[i].holographic;
        if (!check(judge, dpl_solver_create(judge->context, &desc, &judge->solvers[i]), error))
            return false;
        judge->method_count = i + 1;
    }
    return true;
}

bool dpl_bench_judge_create(const dpl_bench_trial *trial, const dpl_bench_method *methods,
                            int32_t method_count, dpl_bench_judge *judge, dpl_error *error) {
    if (create_all(trial, methods, method_count, judge, error))
        return true;
    dpl_bench_judge_free(judge);
    return false;
}

void dpl_bench_judge_free(dpl_bench_judge *judge) {
    for (int32_t i = 0; i < judge->method_count; i++)
        dpl_solver_destroy(judge->solvers[i]);
    dpl_solver_destroy(judge->reference);
    dpl_context_destroy(judge->context);
    dpl_picture_free(&judge->picture);
    *judge = (dpl_bench_judge){0};
}

static dpl_status compare(dpl_context *context, const float (*test)[3], const float (*truth)[3],
                          int32_t count, dpl_bench_score *score) {
    dpl_metrics metrics;
    dpl_status status = dpl_bench_sample_compare(context, test, truth, count, &metrics);
    if (status != DPL_OK)
        return status;
    score->rel_rmse = metrics.rel_rmse;
    score->psnr_linear = metrics.psnr_linear;
    score->psnr_display = metrics.psnr_display;
    double sum = 0, error = 0;
    for (int32_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            sum += (double)truth[i][c];
            error += (double)test[i][c] - (double)truth[i][c];
        }
    score->mean_truth = sum / (3.0 * count);
    score->bias = error == 0 ? 0 : error / sum;
    return DPL_OK;
}

/* Colours of the chosen pixels: room for the truth and for one method. */
typedef struct colours {
    float (*truth)[3];
    float (*test)[3];
} colours;

static bool judge_method(dpl_bench_judge *judge, dpl_field *field, const dpl_bench_sample *sample,
                         const colours *rgb, dpl_solver *solver, dpl_bench_score *score, dpl_error *error) {
    dpl_solver_stats stats;
    dpl_output output = dpl_picture_output(&judge->picture);
    dpl_bench_time start = dpl_bench_now();
    if (!check(judge, dpl_solver_solve(solver, field, &output), error))
        return false;
    score->cpu_ms = dpl_bench_since(start).cpu_ms;
    dpl_solver_read_stats(solver, &stats);
    score->rays = stats.rays_traced;
    score->solve_ms = stats.solve_ms;
    dpl_bench_sample_read(sample, &judge->picture, rgb->test);
    return check(judge,
                 compare(judge->context, (const float(*)[3])rgb->test, (const float(*)[3])rgb->truth,
                         sample->count, score),
                 error);
}

/* Distances first, for all alike: no method's time may hold them. Pictures keep their memory. */
static bool prepare(dpl_bench_judge *judge, dpl_field *field, dpl_error *error) {
    int32_t width = dpl_field_width(field), height = dpl_field_height(field);
    if (judge->picture.width != width || judge->picture.height != height) {
        dpl_picture_free(&judge->picture);
        if (!dpl_picture_create(&judge->picture, width, height, 3, error))
            return false;
    }
    float *distance = malloc((size_t)width * (size_t)height * sizeof *distance);
    dpl_status status = distance ? dpl_field_read_distance(field, distance, 0) : DPL_ERROR_MEMORY;
    free(distance);
    return check(judge, status, error);
}

static bool judge_field(dpl_bench_judge *judge, dpl_field *field, const dpl_bench_sample *sample,
                        dpl_bench_score *scores, dpl_error *error) {
    size_t bytes = (size_t)sample->count * sizeof(float[3]);
    colours rgb = {malloc(bytes), malloc(bytes)};
    bool good = rgb.truth && rgb.test;
    if (!good)
        dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    good = good && prepare(judge, field, error) &&
           check(judge,
                 dpl_reference_solve_pixels(judge->reference, field, (const int32_t(*)[2])sample->pixels,
                                            sample->count, rgb.truth),
                 error);
    for (int32_t i = 0; good && i < judge->method_count; i++)
        good = judge_method(judge, field, sample, &rgb, judge->solvers[i], &scores[i], error);
    free(rgb.truth);
    free(rgb.test);
    return good;
}

bool dpl_bench_judge_scene(dpl_bench_judge *judge, const dpl_bench_trial *trial, int32_t index,
                           dpl_bench_score *scores, dpl_error *error) {
    dpl_scene scene = {0};
    dpl_field *field = NULL;
    dpl_bench_sample sample = {0};
    dpl_bench_progress("scene %d of %d", (int)index + 1, (int)trial->count);
    bool good = trial->family->make(trial->seed, index, trial->size, &scene, error) &&
                dpl_scene_build_field(&scene, judge->context, false, &field, error) &&
                dpl_bench_sample_draw(field, trial->pixels, trial->seed, index, &sample, error) &&
                judge_field(judge, field, &sample, scores, error);
    dpl_bench_progress_end();
    dpl_bench_sample_free(&sample);
    dpl_field_destroy(field);
    dpl_scene_free(&scene);
    return good;
}
