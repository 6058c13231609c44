/* Lights pictures of lamps and walls, everything traced or only what moves. Called by main.c. */
#include "frame.h"

#include "../common/random.h"

#include <stdlib.h>

enum { MOST_MOVING = 100, CASES = 3 };
static const int32_t moving_counts[CASES] = {1, 10, MOST_MOVING};

typedef float picture[DPL_BENCH_FRAME_SIZE][DPL_BENCH_FRAME_SIZE][3];

struct dpl_bench_frame_world {
    dpl_bench_frame *frame;
    dpl_tracer *tracer;
    const dpl_bench_frame_world *other; /* traced just before, and must look the same; or NULL */
    int32_t moving;
    bool keep;
    dpl_shape shapes[MOST_MOVING];
    picture pixels;
};

static void random_shapes(dpl_shape *shapes, int32_t count, uint64_t seed) {
    for (int32_t i = 0; i < count; i++) {
        double x = dpl_bench_random(&seed, 0, DPL_BENCH_FRAME_SIZE);
        double y = dpl_bench_random(&seed, 0, DPL_BENCH_FRAME_SIZE);
        shapes[i] = dpl_shape_default(DPL_SHAPE_DISC);
        shapes[i].disc = (dpl_disc){{x, y}, dpl_bench_random(&seed, 0.1, 0.5)};
        for (int c = 0; c < 3; c++)
            shapes[i].material.emission[c] = i % 3 ? 0.0f : (float)dpl_bench_random(&seed, 0, 2);
    }
}

static bool run(dpl_bench_trial *trial, dpl_error *error) {
    dpl_bench_frame_world *w = trial->subject;
    dpl_context *context = w->frame->context;
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    dpl_output output = {.data = &w->pixels[0][0][0],
                         .width = DPL_BENCH_FRAME_SIZE,
                         .height = DPL_BENCH_FRAME_SIZE,
                         .channels = 3};
    desc.directions = DPL_BENCH_FRAME_DIRECTIONS;
    desc.keep_static = w->keep;
    desc.sky[2] = 0.1f;
    dpl_status status = dpl_tracer_set_shapes(w->tracer, DPL_TRACER_DYNAMIC, w->shapes, w->moving);
    if (status == DPL_OK)
        status = dpl_tracer_light(w->tracer, &desc, &output);
    if (!dpl_bench_good(status, context, error))
        return false;
    if (w->other && memcmp(w->pixels, w->other->pixels, sizeof w->pixels) != 0)
        return dpl_error_set(error, "kept static hits changed the picture");
    dpl_tracer_stats stats;
    dpl_tracer_read_stats(w->tracer, &stats);
    w->frame->kept_bytes = stats.kept_bytes > w->frame->kept_bytes ? stats.kept_bytes : w->frame->kept_bytes;
    if (trial->runs == 0 && w->keep) { /* this one traced the static layer; later ones do not */
        dpl_tracer_reset_stats(w->tracer);
        status = dpl_tracer_light(w->tracer, &desc, &output);
        if (!dpl_bench_good(status, context, error))
            return false;
    }
    return dpl_bench_trial_count(trial, w->tracer, error);
}

static bool add(dpl_bench_frame *frame, int32_t moving, bool keep, const dpl_shape *statics,
                dpl_bench_trials *trials, dpl_error *error) {
    dpl_bench_frame_world *w = &frame->worlds[frame->count++];
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    w->frame = frame;
    w->moving = moving;
    w->keep = keep;
    w->other = keep ? w - 1 : NULL;
    random_shapes(w->shapes, moving, 3);
    dpl_status status = dpl_tracer_create(frame->context, &desc, &w->tracer);
    if (status == DPL_OK)
        status = dpl_tracer_set_shapes(w->tracer, DPL_TRACER_STATIC, statics, DPL_BENCH_FRAME_STATICS);
    if (!dpl_bench_good(status, frame->context, error))
        return false;
    dpl_tracer_reset_stats(w->tracer);
    dpl_bench_trial *trial = dpl_bench_trials_add(trials, error);
    if (!trial)
        return false;
    trial->part = "frame";
    trial->set = "discs";
    trial->query = "light";
    trial->method = keep ? "kept" : "anew";
    trial->objects = moving;
    trial->rays = (int64_t)DPL_BENCH_FRAME_SIZE * DPL_BENCH_FRAME_SIZE * DPL_BENCH_FRAME_DIRECTIONS;
    trial->run = run;
    trial->subject = w;
    return true;
}

bool dpl_bench_frame_prepare(dpl_bench_frame *frame, dpl_bench_trials *trials, dpl_error *error) {
    dpl_shape *statics = malloc(DPL_BENCH_FRAME_STATICS * sizeof *statics);
    frame->worlds = calloc((size_t)(2 * CASES), sizeof *frame->worlds);
    bool good = (statics && frame->worlds) || dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    if (good)
        random_shapes(statics, DPL_BENCH_FRAME_STATICS, 2);
    for (int i = 0; good && i < CASES; i++)
        good = add(frame, moving_counts[i], false, statics, trials, error) &&
               add(frame, moving_counts[i], true, statics, trials, error);
    free(statics);
    return good;
}

void dpl_bench_frame_free(dpl_bench_frame *frame) {
    for (int32_t i = 0; i < frame->count; i++)
        dpl_tracer_destroy(frame->worlds[i].tracer);
    free(frame->worlds);
    *frame = (dpl_bench_frame){0};
}
