/* Builds the ball twice, aims three kinds of rays at it, and asks both contestants. Called by main.c. */
#include "solid.h"

#include "../common/clock.h"
#include "../common/random.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

const char *const dpl_bench_solid_kinds[DPL_BENCH_SOLID_KINDS] = {"camera", "shadow", "random"};
const char *const dpl_bench_solid_queries[DPL_BENCH_SOLID_QUERIES] = {"closest", "occluded"};
static const int32_t mesh_rings[DPL_BENCH_SOLID_MESHES] = {45, 181};

/* One question to one contestant. */
typedef struct asking {
    dpl_bench_solid_world *world;
    int32_t kind;
    int32_t query;
    bool embree;
} asking;

struct dpl_bench_solid_world {
    dpl_bench_solid *solid;
    dpl_bench_mesh mesh;
    dpl_tracer *tracer;
    dpl_bench_embree *embree;
    dpl_ray *rays[DPL_BENCH_SOLID_KINDS];
    dpl_hit *hits[2]; /* ours and Embree's, of the last run */
    uint8_t *occluded[2];
    asking askings[2 * DPL_BENCH_SOLID_KINDS * DPL_BENCH_SOLID_QUERIES];
    int32_t asking_count;
};

static bool no_memory(dpl_error *error) {
    return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
}

/* ---- the mesh ------------------------------------------------------------------------------------- */

static void ball_vertex(int32_t ring, int32_t side, int32_t rings, float vertex[3]) {
    double down = PI * ring / rings, around = PI * side / rings;
    double radius =
        1.0 + 0.1 * sin(9 * down) * cos(7 * around) + 0.03 * sin(31 * down + 3) * cos(29 * around);
    vertex[0] = (float)(radius * sin(down) * cos(around));
    vertex[1] = (float)(radius * sin(down) * sin(around));
    vertex[2] = (float)(radius * cos(down));
}

static bool make_ball(int32_t rings, dpl_bench_mesh *mesh, dpl_error *error) {
    int32_t sides = 2 * rings;
    mesh->vertex_count = (rings + 1) * sides;
    mesh->vertices = malloc((size_t)mesh->vertex_count * sizeof *mesh->vertices);
    mesh->indices = malloc((size_t)(2 * rings * sides) * sizeof *mesh->indices);
    if (!mesh->vertices || !mesh->indices)
        return no_memory(error);
    for (int32_t i = 0; i < mesh->vertex_count; i++)
        ball_vertex(i / sides, i % sides, rings, mesh->vertices[i]);
    for (int32_t i = 0; i < rings * sides; i++) {
        int32_t next = i % sides == sides - 1 ? i + 1 - sides : i + 1;
        const int32_t pair[2][3] = {{i, next, i + sides}, {next, next + sides, i + sides}};
        memcpy(mesh->indices[mesh->count], pair, sizeof pair);
        mesh->count += 2;
    }
    return true;
}

/* ---- rays ----------------------------------------------------------------------------------------- */

/* A picture of the ball from a point, row by row. */
static dpl_ray camera_ray(int32_t i, int32_t count, uint64_t *state) {
    (void)state;
    int32_t side = (int32_t)ceil(sqrt(count));
    dpl_ray ray = {.origin = {0, -4, 0.3f}, .far = INFINITY};
    ray.direction[0] = 0.9f * ((float)(i % side) / (float)side - 0.5f);
    ray.direction[1] = 1.0f;
    ray.direction[2] = 0.9f * ((float)(i / side) / (float)side - 0.5f);
    return ray;
}

/* From a floor below the ball to 16 places on a square lamp above it. */
static dpl_ray shadow_ray(int32_t i, int32_t count, uint64_t *state) {
    int32_t point = i / 16, side = (int32_t)ceil(sqrt(count / 16.0));
    const float from[3] = {6.0f * ((float)(point % side) / (float)side - 0.5f),
                           6.0f * ((float)(point / side) / (float)side - 0.5f), -1.25f};
    const float to[3] = {(float)dpl_bench_random(state, 0.3, 0.7), (float)dpl_bench_random(state, 0.1, 0.5),
                         3.0f};
    return dpl_ray_between(from, to);
}

/* From anywhere around, roughly towards the middle. */
static dpl_ray random_ray(int32_t i, int32_t count, uint64_t *state) {
    (void)i, (void)count;
    dpl_ray ray = {.far = INFINITY};
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = (float)dpl_bench_random(state, -2, 2);
        ray.direction[axis] = (float)dpl_bench_random(state, -1, 1) - 0.5f * ray.origin[axis];
    }
    return ray;
}

static bool make_rays(dpl_bench_solid_world *w, dpl_error *error) {
    static dpl_ray (*const makers[DPL_BENCH_SOLID_KINDS])(int32_t, int32_t,
                                                          uint64_t *) = {camera_ray, shadow_ray, random_ray};
    int32_t count = w->solid->ray_count;
    uint64_t state = 31;
    for (int32_t kind = 0; kind < DPL_BENCH_SOLID_KINDS; kind++) {
        w->rays[kind] = malloc((size_t)count * sizeof *w->rays[kind]);
        if (!w->rays[kind])
            return no_memory(error);
        for (int32_t i = 0; i < count; i++)
            w->rays[kind][i] = makers[kind](i, count, &state);
    }
    for (int who = 0; who < 2; who++) {
        w->hits[who] = malloc((size_t)count * sizeof *w->hits[who]);
        w->occluded[who] = malloc((size_t)count);
        if (!w->hits[who] || !w->occluded[who])
            return no_memory(error);
    }
    return true;
}

/* ---- asking --------------------------------------------------------------------------------------- */

static bool ask_us(dpl_bench_trial *trial, const asking *a, dpl_error *error) {
    dpl_bench_solid_world *w = a->world;
    const dpl_ray *rays = w->rays[a->kind];
    dpl_status status = a->query == 0 ? dpl_tracer_trace(w->tracer, rays, trial->rays, w->hits[0])
                                      : dpl_tracer_occluded(w->tracer, rays, trial->rays, w->occluded[0]);
    return dpl_bench_good(status, w->solid->context, error) && dpl_bench_trial_count(trial, w->tracer, error);
}

static void ask_embree(const dpl_bench_trial *trial, const asking *a) {
    dpl_bench_solid_world *w = a->world;
    if (a->query == 0)
        dpl_bench_embree_closest(w->embree, w->rays[a->kind], trial->rays, w->hits[1]);
    else
        dpl_bench_embree_occluded(w->embree, w->rays[a->kind], trial->rays, w->occluded[1]);
}

static void compare_hits(dpl_bench_agreement *agreement, const dpl_hit *ours, const dpl_hit *theirs) {
    bool hit = ours->object >= 0, same = hit == (theirs->object >= 0);
    float off = hit && same ? fabsf(ours->t - theirs->t) / ours->t : 0.0f;
    if (!same || off > DPL_BENCH_DIFFERENT_T)
        agreement->different++;
    else
        agreement->largest_t = fmax(agreement->largest_t, (double)off);
}

/* Embree has just answered what we had answered before. */
static void compare(const dpl_bench_trial *trial, const asking *a) {
    dpl_bench_solid_world *w = a->world;
    dpl_bench_agreement *agreement = &w->solid->agreement;
    agreement->rays += trial->rays;
    for (int64_t i = 0; i < trial->rays; i++)
        if (a->query == 0)
            compare_hits(agreement, &w->hits[0][i], &w->hits[1][i]);
        else
            agreement->different += w->occluded[0][i] != w->occluded[1][i];
}

static bool run(dpl_bench_trial *trial, dpl_error *error) {
    const asking *a = trial->subject;
    if (!a->embree && !ask_us(trial, a, error))
        return false;
    if (a->embree)
        ask_embree(trial, a);
    if (trial->runs > 0)
        return true;
    int who = a->embree;
    for (int64_t i = 0; i < trial->rays; i++)
        trial->hits += a->query == 0 ? a->world->hits[who][i].object >= 0 : a->world->occluded[who][i];
    if (a->embree)
        compare(trial, a);
    return true;
}

/* ---- making trials -------------------------------------------------------------------------------- */

static bool build_ours(dpl_bench_solid_world *w, int32_t builds, dpl_bench_summary *ms, dpl_error *error) {
    double times[DPL_BENCH_MAX_ROUNDS];
    dpl_context *context = w->solid->context;
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    desc.geometry = DPL_TRACER_TRIANGLES;
    for (int32_t i = 0; i < builds; i++) {
        dpl_tracer_destroy(w->tracer);
        w->tracer = NULL;
        if (!dpl_bench_good(dpl_tracer_create(context, &desc, &w->tracer), context, error))
            return false;
        dpl_bench_time start = dpl_bench_now();
        dpl_status status = dpl_tracer_set_triangles(
            w->tracer, DPL_TRACER_STATIC, (const float(*)[3])w->mesh.vertices, w->mesh.vertex_count,
            (const int32_t(*)[3])w->mesh.indices, w->mesh.count);
        times[i] = dpl_bench_since(start).cpu_ms;
        if (!dpl_bench_good(status, context, error))
            return false;
    }
    *ms = dpl_bench_summarise(times, builds);
    dpl_tracer_reset_stats(w->tracer);
    return true;
}

static bool build_embree(dpl_bench_solid_world *w, int32_t builds, dpl_bench_summary *ms, dpl_error *error) {
    double times[DPL_BENCH_MAX_ROUNDS];
    for (int32_t i = 0; i < builds; i++) {
        dpl_bench_embree_free(w->embree);
        dpl_bench_time start = dpl_bench_now();
        w->embree = dpl_bench_embree_build(&w->mesh, error);
        times[i] = dpl_bench_since(start).cpu_ms;
        if (!w->embree)
            return false;
    }
    *ms = dpl_bench_summarise(times, builds);
    return true;
}

static bool add(dpl_bench_solid_world *w, asking which, dpl_bench_summary build, dpl_bench_trials *trials,
                dpl_error *error) {
    dpl_bench_trial *trial = dpl_bench_trials_add(trials, error);
    if (!trial)
        return false;
    asking *kept = &w->askings[w->asking_count++];
    *kept = which;
    trial->part = "solid";
    trial->set = dpl_bench_solid_kinds[which.kind];
    trial->query = dpl_bench_solid_queries[which.query];
    trial->method = which.embree ? "embree" : "bvh";
    trial->objects = w->mesh.count;
    trial->rays = w->solid->ray_count;
    trial->build_ms = build;
    trial->run = run;
    trial->subject = kept;
    return true;
}

/* Our trial comes right before Embree's, so that answers can be compared. */
static bool add_all(dpl_bench_solid_world *w, int32_t builds, dpl_bench_trials *trials, dpl_error *error) {
    dpl_bench_summary ours, theirs = {0};
    if (!build_ours(w, builds, &ours, error) ||
        (w->solid->embree && !build_embree(w, builds, &theirs, error)))
        return false;
    for (int32_t kind = 0; kind < DPL_BENCH_SOLID_KINDS; kind++)
        for (int32_t query = 0; query < DPL_BENCH_SOLID_QUERIES; query++)
            if (!add(w, (asking){w, kind, query, false}, ours, trials, error) ||
                (w->solid->embree && !add(w, (asking){w, kind, query, true}, theirs, trials, error)))
                return false;
    return true;
}

bool dpl_bench_solid_prepare(dpl_bench_solid *solid, bool small, int32_t builds, dpl_bench_trials *trials,
                             dpl_error *error) {
    solid->worlds = calloc(DPL_BENCH_SOLID_MESHES, sizeof *solid->worlds);
    if (!solid->worlds)
        return no_memory(error);
    for (int32_t i = 0; i < (small ? 1 : DPL_BENCH_SOLID_MESHES); i++) {
        dpl_bench_solid_world *w = &solid->worlds[i];
        w->solid = solid;
        if (!make_ball(mesh_rings[i], &w->mesh, error) || !make_rays(w, error) ||
            !add_all(w, builds, trials, error))
            return false;
    }
    return true;
}

void dpl_bench_solid_free(dpl_bench_solid *solid) {
    for (int32_t i = 0; solid->worlds && i < DPL_BENCH_SOLID_MESHES; i++) {
        dpl_bench_solid_world *w = &solid->worlds[i];
        dpl_tracer_destroy(w->tracer);
        dpl_bench_embree_free(w->embree);
        free(w->mesh.vertices);
        free(w->mesh.indices);
        for (int32_t kind = 0; kind < DPL_BENCH_SOLID_KINDS; kind++)
            free(w->rays[kind]);
        for (int who = 0; who < 2; who++) {
            free(w->hits[who]);
            free(w->occluded[who]);
        }
    }
    free(solid->worlds);
    *solid = (dpl_bench_solid){0};
}
