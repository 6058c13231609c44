/* Errors and thread CPU times of the fast shadow methods, one light, one thread:
 *
 *     dapple scenes shadows --seed 1 --out FOLDER
 *     bench_shadows FOLDER [FRAMES]
 *
 * Each method runs FRAMES times (default 5) on each of the eight cases; the least time counts, after a first
 * frame that allocates. Errors are against the exact method. Prints a Markdown table. */
#define _POSIX_C_SOURCE 200809L

#include "../../scenes/scene.h"

#include <dapple/dapple.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { CASES = 8, METHODS = 4 };

static const dpl_shadow_method methods[METHODS] = {DPL_SHADOW_EXACT, DPL_SHADOW_RAYS, DPL_SHADOW_MRMA,
                                                   DPL_SHADOW_DISTANCE_CONES};

typedef struct result {
    double rmse, leak, ms, worst; /* sums over the cases, and the slowest of them */
} result;

static double cpu_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void fail(const char *what) {
    fprintf(stderr, "bench_shadows: %s\n", what);
    exit(1);
}

/* Least time of a frame; V is left in `v`. */
static double time_method(dpl_context *context, dpl_field *field, const dpl_light *light,
                          dpl_shadow_method method, int frames, float *v) {
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_shadow *shadow;
    double best = INFINITY;
    desc.method = method;
    if (dpl_shadow_create(context, &desc, &shadow) != DPL_OK)
        fail(dpl_context_message(context));
    for (int i = 0; i <= frames; i++) {
        double start = cpu_ms();
        if (dpl_shadow_visibility(shadow, field, light, v, 0) != DPL_OK)
            fail(dpl_context_message(context));
        best = i > 0 ? fmin(best, cpu_ms() - start) : best;
    }
    dpl_shadow_destroy(shadow);
    return best;
}

static void add_errors(const float *v, const float *truth, size_t count, result *r) {
    double squares = 0.0, leak = 0.0, dark = 1e-9;
    for (size_t i = 0; i < count; i++) {
        double error = (double)v[i] - (double)truth[i];
        squares += error * error;
        leak += truth[i] == 0.0f ? (double)v[i] : 0.0;
        dark += truth[i] == 0.0f;
    }
    r->rmse += sqrt(squares / (double)count);
    r->leak += leak / dark;
}

static void run_case(dpl_context *context, const char *path, int frames, result results[METHODS]) {
    dpl_scene scene = {0};
    dpl_error error;
    dpl_field *field;
    if (!dpl_scene_read(path, &scene, &error) ||
        !dpl_scene_build_field(&scene, context, false, &field, &error))
        fail(error.text);
    const dpl_scene_light *from = &scene.lights[0];
    dpl_light light = {{from->position[0], from->position[1]}, from->radius, {1, 1, 1}, 1};
    size_t count = (size_t)scene.width * (size_t)scene.height;
    float *planes = malloc(2 * count * sizeof *planes);
    if (!planes)
        fail("out of memory");
    for (int m = 0; m < METHODS; m++) { /* the first is the truth of the others */
        float *v = m == 0 ? planes : planes + count;
        double ms = time_method(context, field, &light, methods[m], frames, v);
        results[m].ms += ms;
        results[m].worst = fmax(results[m].worst, ms);
        add_errors(v, planes, count, &results[m]);
    }
    free(planes);
    dpl_field_destroy(field);
    dpl_scene_free(&scene);
}

int main(int argc, char **argv) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *context;
    result results[METHODS] = {{0}};
    int frames = argc > 2 ? atoi(argv[2]) : 5;
    if (argc < 2 || frames < 1)
        fail("usage: bench_shadows FOLDER [FRAMES]");
    desc.thread_count = 1;
    if (dpl_context_create(&desc, &context) != DPL_OK)
        fail("no context");
    for (int i = 0; i < CASES; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/shadows-%02d.json", argv[1], i);
        run_case(context, path, frames, results);
    }
    printf("%s, %d frames\n\n| method | RMSE | leak | mean ms | worst ms |\n|---|---|---|---|---|\n",
           dpl_isa_name(dpl_context_isa(context)), frames);
    for (int m = 0; m < METHODS; m++)
        printf("| %s | %.4f | %.4f | %.1f | %.1f |\n", dpl_shadow_method_name(methods[m]),
               results[m].rmse / CASES, results[m].leak / CASES, results[m].ms / CASES, results[m].worst);
    dpl_context_destroy(context);
    return 0;
}
