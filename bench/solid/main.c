/* bench_solid: shadows in space on the reference scene: errors against rays, ours and Embree's, and costs.
 * Run by hand as docs/benchmarks.md says, and in small by ctest. */
#include "../common/clock.h"
#include "../common/machine.h"
#include "../common/options.h"
#include "embree_rays.h"

#include "../../scenes/solid_reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char program[] = "bench_solid";

static const char help[] =
    "Usage: bench_solid [OPTIONS]\n"
    "\n"
    "Measures the distances to the reference scene's mesh and the shadows of a spot light on a square of\n"
    "receivers, by every method, and prints a table: errors against 1024 rays each, time of the map and per\n"
    "receiver (least of all rounds, of this thread, for each block of 4096 receivers). Where Embree was "
    "built\n"
    "in, it takes part with 16 rays, and the truth itself is checked against Embree's answers to other "
    "rays:\n"
    "the run fails when the two are apart.\n"
    "\n"
    "  --side N          receivers along a side (default 320)\n"
    "  --map N           texels along a side (default 512)\n"
    "  --field N         samples of distance along the longest side (default 128)\n"
    "  --rounds N        measured (default 5)\n"
    "  --seed N          of the layout (default 7)\n"
    "  --isa N           instruction sets, added up: 1 scalar, 2 SSE2, 4 AVX2, 8 AVX-512 (default: all)\n"
    "  --help            print this text\n";

/* The truths of two samplings may differ by this much, root mean square. */
#define TRUTHS_APART 0.006

/* Receivers this near to a mesh count as contact [scene unit]. */
#define CONTACT 0.06f

/* Receivers are timed in blocks: what a machine does on the side then spoils few of them. */
enum { BLOCK = 4096, MOST_BLOCKS = 1024 };

typedef struct settings {
    int32_t side;
    int32_t map;
    int32_t field;
    int32_t rounds;
    int32_t seed;
    int32_t isa;
} settings;

typedef struct bench {
    settings s;
    int32_t count;
    dpl_context *context;
    dpl_mesh_data data;
    dpl_mesh *mesh;
    dpl_mesh_field *field;
    float (*positions)[3];
    float (*normals)[3];
    float *truth;
    float *visibility;
    double field_ms;
    double least[MOST_BLOCKS]; /* of the rounds, per block of receivers [ms] */
} bench;

/* A way to find shadows. */
typedef struct way {
    const char *name;
    dpl_solid_method method;
    int32_t sub_cones;
    int32_t samples;
    int32_t refine_rays;
    float refine_threshold;
} way;

static const way ways[] = {
    {"moments", DPL_SOLID_MOMENTS, 1, 1, 0, 0.0f},
    {"march, 1 cone", DPL_SOLID_MARCH, 1, 1, 0, 0.0f},
    {"march, 4 cones", DPL_SOLID_MARCH, 4, 1, 0, 0.0f},
    {"mrma, no rays", DPL_SOLID_MRMA, 1, 1, 0, 0.0f},
    {"mrma, 32 rays where its terms disagree", DPL_SOLID_MRMA, 1, 1, 32, 0.02f},
    {"mrma, 16 rays", DPL_SOLID_MRMA, 1, 1, 16, 0.0f},
    {"mrma, 32 rays (default)", DPL_SOLID_MRMA, 1, 1, 32, 0.0f},
    {"mrma, 64 rays", DPL_SOLID_MRMA, 1, 1, 64, 0.0f},
    {"16 rays everywhere, one by one", DPL_SOLID_REFERENCE, 1, 16, 0, 0.0f},
};

enum { WAY_COUNT = sizeof ways / sizeof ways[0] };

static bool good(const bench *b, dpl_status status, dpl_error *error) {
    return status == DPL_OK ||
           dpl_error_set(error, "%s", b->context ? dpl_context_message(b->context) : dpl_status_text(status));
}

/* ---- what is measured ----------------------------------------------------------------------------- */

static bool prepare(bench *b, dpl_error *error) {
    dpl_context_desc context = dpl_context_desc_default();
    dpl_mesh_field_desc field = dpl_mesh_field_desc_default();
    context.thread_count = 1;
    context.isa_mask = (uint32_t)b->s.isa;
    field.resolution = b->s.field;
    b->count = b->s.side * b->s.side;
    size_t count = (size_t)b->count;
    b->positions = malloc(count * sizeof *b->positions);
    b->normals = malloc(count * sizeof *b->normals);
    b->truth = malloc(count * sizeof *b->truth);
    b->visibility = malloc(count * sizeof *b->visibility);
    if (!b->positions || !b->normals || !b->truth || !b->visibility)
        return dpl_error_set(error, "out of memory");
    dpl_solid_reference_receivers(b->s.side, b->positions, b->normals);
    if (!good(b, dpl_context_create(&context, &b->context), error) ||
        !dpl_solid_reference_mesh(b->s.seed, 18, &b->data, error))
        return false;
    dpl_mesh_desc desc = dpl_mesh_data_desc(&b->data);
    if (!good(b, dpl_mesh_create(b->context, &desc, &b->mesh), error) ||
        !good(b, dpl_mesh_field_create(b->context, &field, &b->field), error))
        return false;
    b->field_ms = INFINITY;
    for (int32_t i = 0; i < b->s.rounds; i++) {
        dpl_bench_time start = dpl_bench_now();
        if (!good(b, dpl_mesh_field_measure(b->field, b->mesh), error))
            return false;
        b->field_ms = fmin(b->field_ms, dpl_bench_since(start).cpu_ms);
    }
    return true;
}

typedef struct cost {
    double map_ms;
    double solve_ms;
    dpl_solid_shadow_stats stats;
} cost;

static int32_t size_of_block(const bench *b, int32_t first) {
    return b->count - first < BLOCK ? b->count - first : BLOCK;
}

static dpl_status solve_blocks(const bench *b, dpl_solid_shadow *shadow, float *visibility, double *least) {
    dpl_status status = DPL_OK;
    for (int32_t first = 0; first < b->count && status == DPL_OK; first += BLOCK) {
        dpl_bench_time start = dpl_bench_now();
        status = dpl_solid_shadow_visibility(shadow, (const float(*)[3])b->positions + first,
                                             (const float(*)[3])b->normals + first, size_of_block(b, first),
                                             visibility + first);
        least[first / BLOCK] = fmin(least[first / BLOCK], dpl_bench_since(start).cpu_ms);
    }
    return status;
}

static double sum_of(const double *least, int32_t count) {
    double sum = 0.0;
    for (int32_t i = 0; i * BLOCK < count; i++)
        sum += least[i];
    return sum;
}

static bool solve(bench *b, const dpl_solid_shadow_desc *desc, const dpl_solid_light *light, int32_t rounds,
                  float *visibility, cost *c, dpl_error *error) {
    dpl_solid_shadow *shadow;
    if (!good(b, dpl_solid_shadow_create(b->context, desc, &shadow), error))
        return false;
    c->map_ms = INFINITY;
    for (size_t i = 0; i < MOST_BLOCKS; i++)
        b->least[i] = INFINITY;
    dpl_status status = DPL_OK;
    for (int32_t i = 0; i < rounds && status == DPL_OK; i++) {
        dpl_bench_time start = dpl_bench_now();
        status = dpl_solid_shadow_set_light(shadow, b->mesh, b->field, light);
        c->map_ms = fmin(c->map_ms, dpl_bench_since(start).cpu_ms);
        if (status == DPL_OK)
            status = solve_blocks(b, shadow, visibility, b->least);
    }
    c->solve_ms = sum_of(b->least, b->count);
    dpl_solid_shadow_read_stats(shadow, &c->stats);
    dpl_solid_shadow_destroy(shadow);
    return good(b, status, error);
}

/* ---- Embree --------------------------------------------------------------------------------------- */

static dpl_bench_embree *build_embree(const bench *b, dpl_error *error) {
    dpl_bench_mesh mesh = {b->data.vertices, b->data.vertex_count, b->data.indices, b->data.triangle_count};
    return dpl_bench_embree_build(&mesh, error);
}

/* Root mean square of what the truth and Embree's differ by. */
static bool compare_truths(bench *b, dpl_bench_embree *embree, const dpl_solid_light *light,
                           dpl_error *error) {
    dpl_bench_sampling sampling = dpl_bench_sampling_grid();
    double sum = 0.0;
    dpl_bench_embree_see(embree, &sampling, light, (const float(*)[3])b->positions, b->count, b->visibility);
    for (int32_t i = 0; i < b->count; i++) {
        double difference = (double)b->truth[i] - (double)b->visibility[i];
        sum += difference * difference;
    }
    double apart = sqrt(sum / b->count);
    printf("\nR = %.1f: the truth is %.4f (rms) away from Embree %s with %d other rays.\n\n",
           (double)light->radius, apart, dpl_bench_embree_version(), (int)sampling.count);
    return apart < TRUTHS_APART || dpl_error_set(error, "the truth is %.4f away from Embree's", apart);
}

/* ---- distances to a ball -------------------------------------------------------------------------- */

/* A ball of 10200 triangles; every `without`th is left out, none where that is 0. */
static bool make_ball(bench *b, int32_t without, dpl_mesh **mesh, dpl_error *error) {
    dpl_mesh_data data = {0};
    dpl_mesh_transform none = dpl_mesh_transform_none();
    bool made = dpl_mesh_data_add_sphere(&data, &none, 51, error);
    if (made && without > 0) {
        int32_t kept = 0;
        for (int32_t i = 0; i < data.triangle_count; i++)
            if (i % without != 0)
                memmove(data.indices[kept++], data.indices[i], sizeof data.indices[i]);
        data.triangle_count = kept;
    }
    dpl_mesh_desc desc = dpl_mesh_data_desc(&data);
    made = made && good(b, dpl_mesh_create(b->context, &desc, mesh), error);
    dpl_mesh_data_free(&data);
    return made;
}

/* Samples on the other side of the true ball's surface than their sign says, but for the triangles' own
 * distance from it. */
static double wrong_signs(const dpl_mesh_field *field) {
    dpl_mesh_grid grid = dpl_mesh_field_grid(field);
    const float *sample = dpl_mesh_field_samples(field);
    int64_t wrong = 0, count = (int64_t)grid.size[0] * grid.size[1] * grid.size[2];
    for (int64_t i = 0; i < count; i++) {
        int64_t at[3] = {i % grid.size[0], i / grid.size[0] % grid.size[1], i / grid.size[0] / grid.size[1]};
        double square = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            double place = (double)grid.origin[axis] + (double)grid.spacing * (double)at[axis];
            square += place * place;
        }
        double truth = sqrt(square) - 1.0;
        wrong += (truth < 0.0) != (sample[i] < 0.0f) && fabs(truth) > 0.002;
    }
    return (double)wrong / (double)count;
}

static bool run_ball(bench *b, const char *name, int32_t without, dpl_error *error) {
    dpl_mesh *mesh = NULL;
    if (!make_ball(b, without, &mesh, error))
        return false;
    double ms = INFINITY;
    dpl_status status = DPL_OK;
    for (int32_t i = 0; i < b->s.rounds && status == DPL_OK; i++) {
        dpl_bench_time start = dpl_bench_now();
        status = dpl_mesh_field_measure(b->field, mesh);
        ms = fmin(ms, dpl_bench_since(start).cpu_ms);
    }
    if (status == DPL_OK)
        printf("%s: distances in %.0f ms, wrong signs %.4f %%\n", name, ms, 100.0 * wrong_signs(b->field));
    dpl_mesh_destroy(mesh);
    return good(b, status, error);
}

/* ---- the table ------------------------------------------------------------------------------------ */

typedef struct judgement {
    double all;
    double penumbra;
    double contact;
    double leak;
} judgement;

static double mean_of(double sum, int64_t count) {
    return count > 0 ? sum / (double)count : 0.0;
}

static judgement judge(const bench *b) {
    double sums[4] = {0};
    int64_t counts[4] = {0};
    for (int32_t i = 0; i < b->count; i++) {
        double truth = (double)b->truth[i], error = (double)b->visibility[i] - truth;
        bool in[4] = {true, truth > 0.02 && truth < 0.98,
                      dpl_mesh_field_distance(b->field, b->positions[i]) < CONTACT, truth <= 0.0};
        for (int k = 0; k < 4; k++) {
            sums[k] += !in[k] ? 0.0 : k < 3 ? error * error : (double)b->visibility[i];
            counts[k] += in[k];
        }
    }
    return (judgement){sqrt(mean_of(sums[0], counts[0])), sqrt(mean_of(sums[1], counts[1])),
                       sqrt(mean_of(sums[2], counts[2])), mean_of(sums[3], counts[3])};
}

/* The first columns of a row. */
static void print_errors(const bench *b, const dpl_solid_light *light, const char *name) {
    judgement j = judge(b);
    printf("| %.1f | %s | %.4f | %.4f | %.4f | %.4f ", (double)light->radius, name, j.all, j.penumbra,
           j.contact, j.leak);
}

static bool run_way(bench *b, const way *w, const dpl_solid_light *light, dpl_error *error) {
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    cost c;
    desc.method = w->method;
    desc.sub_cones = w->sub_cones;
    desc.samples = w->samples;
    desc.refine_rays = w->refine_rays;
    desc.refine_threshold = w->refine_threshold;
    desc.map_resolution = b->s.map;
    if (!solve(b, &desc, light, b->s.rounds, b->visibility, &c, error))
        return false;
    double receivers = (double)c.stats.receivers;
    print_errors(b, light, w->name);
    printf("| %.1f | %.0f | %.0f | %.1f |\n", c.map_ms, c.solve_ms * 1e6 / b->count,
           100.0 * (double)(c.stats.lit + c.stats.dark) / receivers,
           100.0 * (double)c.stats.refined / receivers);
    return true;
}

/* 16 rays everywhere by Embree, to the points that ours go to. */
static void run_embree(bench *b, dpl_bench_embree *embree, const dpl_solid_light *light, bool packets) {
    dpl_bench_sampling sampling = dpl_bench_sampling_spiral(16);
    sampling.packets = packets;
    for (size_t i = 0; i < MOST_BLOCKS; i++)
        b->least[i] = INFINITY;
    for (int32_t i = 0; i < b->s.rounds; i++)
        for (int32_t first = 0; first < b->count; first += BLOCK) {
            dpl_bench_time start = dpl_bench_now();
            dpl_bench_embree_see(embree, &sampling, light, (const float(*)[3])b->positions + first,
                                 size_of_block(b, first), b->visibility + first);
            double *least = &b->least[first / BLOCK];
            *least = fmin(*least, dpl_bench_since(start).cpu_ms);
        }
    print_errors(b, light, packets ? "Embree, 16 rays everywhere, a packet" : "Embree, 16 rays everywhere");
    printf("| - | %.0f | - | - |\n", sum_of(b->least, b->count) * 1e6 / b->count);
}

static bool run_light(bench *b, dpl_bench_embree *embree, float radius, dpl_error *error) {
    dpl_solid_light light = dpl_solid_reference_light(radius);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    cost c;
    desc.method = DPL_SOLID_REFERENCE;
    desc.samples = 1024;
    if (!solve(b, &desc, &light, 1, b->truth, &c, error))
        return false;
    for (size_t i = 0; i < WAY_COUNT; i++)
        if (!run_way(b, &ways[i], &light, error))
            return false;
    for (int packets = 0; packets < 2 && embree; packets++)
        run_embree(b, embree, &light, packets);
    return !embree || compare_truths(b, embree, &light, error);
}

/* Both lights, with Embree where it is built in. */
static bool run_lights(bench *b, dpl_error *error) {
    dpl_bench_embree *embree = NULL;
    if (dpl_bench_embree_version() && !(embree = build_embree(b, error)))
        return false;
    bool done = run_light(b, embree, 0.1f, error) && run_light(b, embree, 0.3f, error);
    dpl_bench_embree_free(embree);
    return done;
}

static bool run(bench *b, dpl_error *error) {
    if (!prepare(b, error))
        return false;
    dpl_mesh_facts facts;
    dpl_mesh_read_facts(b->mesh, &facts);
    dpl_bench_machine machine = dpl_bench_machine_read();
    dpl_bench_machine_write(&machine, b->context, stdout);
    printf("\nCommit %s; %s --side %d --map %d --field %d --rounds %d --seed %d\n", dpl_bench_commit(),
           program, (int)b->s.side, (int)b->s.map, (int)b->s.field, (int)b->s.rounds, (int)b->s.seed);
    printf("\n%d triangles in %d parts; distances: %.0f ms\n\n", (int)facts.triangles, (int)facts.parts,
           b->field_ms);
    printf("| R | method | RMSE | penumbra | contact | leak | map [ms] | [ns/receiver] | classified [%%] "
           "| refined [%%] |\n|---|---|---|---|---|---|---|---|---|---|\n");
    return run_lights(b, error) && run_ball(b, "Ball", 0, error) &&
           run_ball(b, "Ball without every 200th triangle", 200, error);
}

int main(int argc, char **argv) {
    bench b = {.s = {.side = 320,
                     .map = 512,
                     .field = 128,
                     .rounds = 5,
                     .seed = DPL_SOLID_REFERENCE_SEED,
                     .isa = DPL_ISA_ALL}};
    const dpl_bench_option options[] = {
        {"side", DPL_BENCH_INTEGER, &b.s.side, 8, 2048},
        {"map", DPL_BENCH_INTEGER, &b.s.map, 16, 4096},
        {"field", DPL_BENCH_INTEGER, &b.s.field, 8, DPL_MAX_MESH_RESOLUTION},
        {"rounds", DPL_BENCH_INTEGER, &b.s.rounds, 1, 100},
        {"seed", DPL_BENCH_INTEGER, &b.s.seed, 0, 1000000},
        {"isa", DPL_BENCH_INTEGER, &b.s.isa, 1, DPL_ISA_ALL},
    };
    dpl_error error = {""};
    int status =
        dpl_bench_options_read(program, help, options, (int)(sizeof options / sizeof options[0]), argc, argv);
    if (status != DPL_BENCH_GO)
        return status;
    bool done = run(&b, &error);
    if (!done)
        fprintf(stderr, "%s: %s\n", program, error.text);
    dpl_mesh_destroy(b.mesh);
    dpl_mesh_field_destroy(b.field);
    dpl_context_destroy(b.context);
    dpl_mesh_data_free(&b.data);
    free(b.positions);
    free(b.normals);
    free(b.truth);
    free(b.visibility);
    return done ? DPL_BENCH_DONE : DPL_BENCH_FAILED;
}
