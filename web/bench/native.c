/* bench_web_native FAMILY INDEX SIZE SOLVER ISA: solves a scene of seed 1 on one thread whenever a line comes
 * in, and answers with the processor time that it took [ms]. Run by solve.mjs, which lets it and the module
 * take turns. */
#include "bench/common/clock.h"

#include "scenes/families.h"

#include <dapple/solver.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct subject {
    dpl_context *context;
    dpl_field *field;
    dpl_solver *solver;
    float *light;
    int32_t size;
} subject;

static bool failed(const subject *s, dpl_status status, dpl_error *error) {
    const char *message = s->context ? dpl_context_message(s->context) : "";
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

static bool draw(subject *s, const char *family, int32_t index, dpl_error *error) {
    const dpl_scene_family *found = dpl_scene_family_find(family);
    dpl_scene scene = {0};
    bool good = (found || dpl_error_set(error, "%s: no such family", family)) &&
                found->make(1, index, s->size, &scene, error) &&
                dpl_scene_build_field(&scene, s->context, false, &s->field, error);
    dpl_scene_free(&scene);
    return good;
}

static bool make(subject *s, char **arguments, dpl_error *error) {
    static const dpl_isa isas[] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};
    dpl_context_desc context = dpl_context_desc_default();
    dpl_solver_desc solver = dpl_solver_desc_default();
    context.thread_count = 1;
    context.isa_mask = 0;
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++)
        if (strcmp(arguments[4], dpl_isa_name(isas[i])) == 0)
            context.isa_mask = (uint32_t)isas[i];
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_HOLOGRAPHIC; kind++)
        if (strcmp(arguments[3], dpl_solver_kind_name((dpl_solver_kind)kind)) == 0)
            solver.kind = (dpl_solver_kind)kind;
    s->size = atoi(arguments[2]);
    s->light = s->size > 0 ? malloc(3 * (size_t)s->size * (size_t)s->size * sizeof *s->light) : NULL;
    if (!s->light)
        return dpl_error_set(error, "%s: no such size, or no memory", arguments[2]);
    dpl_status status = dpl_context_create(&context, &s->context);
    if (status != DPL_OK)
        return failed(s, status, error);
    status = dpl_solver_create(s->context, &solver, &s->solver);
    return status == DPL_OK ? draw(s, arguments[0], atoi(arguments[1]), error) : failed(s, status, error);
}

static bool solve(const subject *s, double *ms, dpl_error *error) {
    const dpl_output output = {
        .data = s->light, .format = DPL_FORMAT_F32, .width = s->size, .height = s->size, .channels = 3};
    const dpl_bench_time start = dpl_bench_now();
    dpl_status status = dpl_solver_solve(s->solver, s->field, &output);
    *ms = dpl_bench_since(start).cpu_ms;
    return status == DPL_OK || failed(s, status, error);
}

int main(int argc, char **argv) {
    dpl_error error = {"usage: bench_web_native FAMILY INDEX SIZE SOLVER ISA"};
    subject s = {0};
    double ms;
    bool good = argc == 6 && make(&s, argv + 1, &error);
    for (int c = getchar(); good && c != EOF; c = getchar()) {
        good = c != '\n' || solve(&s, &ms, &error);
        if (good && c == '\n')
            printf("%.4f\n", ms);
        fflush(stdout);
    }
    dpl_solver_destroy(s.solver);
    dpl_field_destroy(s.field);
    dpl_context_destroy(s.context);
    free(s.light);
    if (!good)
        fprintf(stderr, "bench_web_native: %s\n", error.text);
    return good ? 0 : 1;
}
