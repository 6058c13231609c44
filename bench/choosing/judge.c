/* Judges methods one after another on one scene. Called by main.c. */
#include "judge.h"

#include "../../scenes/families.h"
#include "../common/clock.h"
#include "../common/progress.h"
#include "../common/sample.h"

#include <math.h>
#include <stdlib.h>

/* A first picture that takes longer than this is timed: warming up would change nothing. */
#define SLOW_MS 1000.0

/* Everything that one scene is judged with. */
typedef struct trial {
    const dpl_bench_choosing_plan *plan;
    dpl_bench_memory memory;
    dpl_bench_stand stand;
    dpl_bench_sample sample;
    dpl_picture picture;
    float (*truth)[3]; /* at the sample's pixels */
    float (*test)[3];
} trial;

static bool check(const trial *t, dpl_status status, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    const char *message = t->stand.context ? dpl_context_message(t->stand.context) : "";
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

/* ---- the scene ------------------------------------------------------------------------------------ */

/* The disc light becomes a shape: an opaque disc that emits what the light does. */
static bool place_disc(trial *t, dpl_error *error) {
    dpl_bench_stand *stand = &t->stand;
    if (stand->scene.light_count == 0)
        return true;
    const dpl_scene_light *light = &stand->scene.lights[0];
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    shape.disc = (dpl_disc){{light->position[0], light->position[1]}, light->radius};
    stand->light = (dpl_light){{light->position[0], light->position[1]}, light->radius, {0}, 1};
    for (int c = 0; c < 3; c++) {
        stand->light.color[c] = (float)(light->color[c] * light->intensity);
        shape.material.emission[c] = stand->light.color[c];
    }
    stand->scene.light_count = 0;
    return dpl_scene_build_field(&stand->scene, stand->context, false, &stand->unlit, error) &&
           dpl_scene_add_shape(&stand->scene, &shape, error);
}

/* Distances are made with the field, for all alike: no method's time may hold them. */
static bool warm_field(trial *t, dpl_field *field, dpl_error *error) {
    if (!field)
        return true;
    float *distance = malloc((size_t)t->plan->size * (size_t)t->plan->size * sizeof *distance);
    dpl_status status = distance ? dpl_field_read_distance(field, distance, 0) : DPL_ERROR_MEMORY;
    free(distance);
    return check(t, status, error);
}

static bool make_stand(trial *t, const dpl_bench_choosing_scene *which, dpl_error *error) {
    const dpl_scene_family *family = dpl_scene_family_find(which->family);
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = t->plan->threads;
    desc.allocator = dpl_bench_memory_allocator(&t->memory);
    t->stand.directions = t->plan->directions;
    if (!family)
        return dpl_error_set(error, "there is no family '%s'", which->family);
    return check(t, dpl_context_create(&desc, &t->stand.context), error) &&
           family->make(t->plan->seed, which->index, t->plan->size, &t->stand.scene, error) &&
           place_disc(t, error) &&
           dpl_scene_build_field(&t->stand.scene, t->stand.context, false, &t->stand.field, error) &&
           warm_field(t, t->stand.field, error) && warm_field(t, t->stand.unlit, error) &&
           dpl_picture_create(&t->picture, t->plan->size, t->plan->size, 3, error);
}

static bool find_truth(trial *t, const dpl_bench_choosing_scene *which, dpl_error *error) {
    dpl_solver *reference = NULL;
    dpl_solver_desc desc = dpl_solver_desc_default();
    if (!dpl_bench_sample_draw(t->stand.field, t->plan->pixels, t->plan->seed, which->index, &t->sample,
                               error))
        return false;
    t->truth = malloc((size_t)t->sample.count * sizeof *t->truth);
    t->test = malloc((size_t)t->sample.count * sizeof *t->test);
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = t->plan->truth;
    dpl_status status = t->truth && t->test ? DPL_OK : DPL_ERROR_MEMORY;
    if (status == DPL_OK)
        status = dpl_solver_create(t->stand.context, &desc, &reference);
    if (status == DPL_OK)
        status = dpl_reference_solve_pixels(reference, t->stand.field, (const int32_t(*)[2])t->sample.pixels,
                                            t->sample.count, t->truth);
    dpl_solver_destroy(reference);
    return check(t, status, error);
}

/* ---- a method ------------------------------------------------------------------------------------- */

/* Pictures until `rounds` are timed; three slow ones are enough. */
static dpl_status time_pictures(trial *t, const dpl_bench_method *method, dpl_bench_summary *cpu) {
    double ms[DPL_BENCH_CHOOSING_ROUNDS_MAX];
    const dpl_output output = dpl_picture_output(&t->picture);
    int32_t count = 0, wanted = t->plan->rounds;
    dpl_status status = DPL_OK;
    for (int32_t run = 0; count < wanted && status == DPL_OK; run++) {
        dpl_bench_time start = dpl_bench_now();
        status = method->light(&t->stand, &output);
        double taken = dpl_bench_since(start).cpu_ms;
        if (taken > SLOW_MS && wanted > 3)
            wanted = count < 3 ? 3 : count + 1;
        if (run > 0 || taken > SLOW_MS)
            ms[count++] = taken;
    }
    if (status == DPL_OK)
        *cpu = dpl_bench_summarise(ms, count);
    return status;
}

/* The factor that brings the picture nearest to the truth: least squares over pixels and channels. */
static double fit_scale(const trial *t) {
    double both = 0, square = 0;
    for (int32_t i = 0; i < t->sample.count; i++)
        for (int c = 0; c < 3; c++) {
            both += (double)t->test[i][c] * (double)t->truth[i][c];
            square += (double)t->test[i][c] * (double)t->test[i][c];
        }
    return square > 0 ? both / square : 1;
}

static dpl_status compare(trial *t, const dpl_bench_method *method, dpl_bench_choosing_score *score) {
    dpl_metrics metrics;
    dpl_bench_sample_read(&t->sample, &t->picture, t->test);
    score->scale = method->scaled ? fit_scale(t) : 1;
    for (int32_t i = 0; i < t->sample.count && method->scaled; i++)
        for (int c = 0; c < 3; c++)
            t->test[i][c] *= (float)score->scale;
    dpl_status status = dpl_bench_sample_compare(t->stand.context, (const float(*)[3])t->test,
                                                 (const float(*)[3])t->truth, t->sample.count, &metrics);
    if (status != DPL_OK)
        return status;
    score->rel_rmse = metrics.rel_rmse;
    score->psnr_display = metrics.psnr_display;
    return DPL_OK;
}

static dpl_status judge(trial *t, const dpl_bench_method *method, dpl_bench_choosing_score *score) {
    const int64_t before = t->memory.now;
    t->memory.peak = before;
    dpl_bench_time start = dpl_bench_now();
    dpl_status status = method->prepare(&t->stand, method);
    score->prepare_ms = dpl_bench_since(start).cpu_ms;
    if (status == DPL_OK)
        status = time_pictures(t, method, &score->cpu_ms);
    score->bytes = t->memory.peak - before;
    if (status == DPL_OK)
        status = compare(t, method, score);
    score->there = status == DPL_OK;
    dpl_bench_stand_clear(&t->stand);
    return status;
}

static bool judge_all(trial *t, const dpl_bench_choosing_scene *which, dpl_bench_choosing_score *scores,
                      dpl_error *error) {
    for (int i = 0; i < DPL_BENCH_CHOOSING_METHODS; i++) {
        const dpl_bench_method *method = &dpl_bench_choosing_methods[i];
        scores[i] = (dpl_bench_choosing_score){0};
        if (method->disc_only && !t->stand.unlit)
            continue;
        dpl_bench_progress("%s %d: %s", which->family, (int)which->index, method->name);
        if (!check(t, judge(t, method, &scores[i]), error))
            return false;
    }
    return true;
}

bool dpl_bench_choosing_judge(const dpl_bench_choosing_plan *plan, const dpl_bench_choosing_scene *which,
                              dpl_bench_choosing_score scores[DPL_BENCH_CHOOSING_METHODS], dpl_error *error) {
    trial t = {.plan = plan};
    dpl_bench_progress("%s %d: truth", which->family, (int)which->index);
    bool good =
        make_stand(&t, which, error) && find_truth(&t, which, error) && judge_all(&t, which, scores, error);
    dpl_bench_progress_end();
    free(t.truth);
    free(t.test);
    dpl_bench_sample_free(&t.sample);
    dpl_picture_free(&t.picture);
    dpl_field_destroy(t.stand.field);
    dpl_field_destroy(t.stand.unlit);
    dpl_scene_free(&t.stand.scene);
    dpl_context_destroy(t.stand.context);
    return good;
}
