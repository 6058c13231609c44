/* Runs the survey over all levels, from level 0 up. Called by cascades.c before levels are merged. */
#include "cascade/survey.h"

#include "cascade/cascades.h"
#include "cascade/guess.h"
#include "cascade/lamps.h"
#include "job/jobs.h"

#include <math.h>

/* A pixel that a ray touches has its centre within half a diagonal of the ray [px]. */
#define HALF_DIAGONAL 0.70710678
/* The paper's march reads distances at corners of pixels, up to a diagonal from the ray's point and from the
 * disc's centre, and takes less than one pixel for a hit [px]. */
#define SURFACE_SPARE (1.0 + 2.0 * 1.41421357)

/* Room for hits of all levels, in times the rays of the largest one. Light that a ray stops needs no rays
 * above, so this is seldom short; where it is, the rays of a level are traced again when they are merged. */
#define CELLS_PER_RAY 2

/* What --skip bounded keeps where no bound is given [dB]. */
#define DEFAULT_BOUND 50.0
/* Levels below have few rays left to guess. */
#define FIRST_GUESSED 4

/* ---- memory --------------------------------------------------------------------------------------- */

static size_t mask_bytes(const dpl_schedule_level *plan, int64_t indices) {
    return (size_t)indices * (size_t)plan->probes_y * (size_t)dpl_mask_words(plan->probes_x) *
           sizeof(uint64_t);
}

static dpl_mask take_mask(const dpl_schedule_level *plan, int64_t indices, char **memory) {
    dpl_mask mask = {(uint64_t *)(void *)*memory, plan->probes_y, dpl_mask_words(plan->probes_x),
                     plan->probes_x};
    *memory += mask_bytes(plan, indices);
    return mask;
}

static dpl_status plan_level(dpl_survey *survey, dpl_context *context, const dpl_schedule *schedule,
                             int32_t n, bool guesses) {
    const dpl_schedule_level *plan = &schedule->levels[n];
    dpl_survey_level *level = &survey->levels[n];
    int64_t rays = (int64_t)plan->directions * plan->aims;
    *level = (dpl_survey_level){
        .plan = plan,
        .above = n + 1 < schedule->level_count ? plan + 1 : NULL,
        .number = n,
        .merge = schedule->merge,
        .aims = plan->aims,
    };
    if (level->above)
        level->reach = dpl_ray_reach(plan, schedule->merge);
    size_t chunks =
        (size_t)plan->slots * (size_t)plan->probes_y * (size_t)dpl_survey_chunks(level) * sizeof(int64_t);
    size_t bytes = mask_bytes(plan, 1) + 2 * mask_bytes(plan, plan->slots) + mask_bytes(plan, rays) + chunks +
                   mask_bytes(plan, guesses ? (int64_t)plan->slots * (plan->aims + 1) : 0);
    DPL_TRY(dpl_buffer_reserve(context, &survey->masks[n], bytes, 1));
    char *memory = survey->masks[n].data;
    level->empty = take_mask(plan, 1, &memory);
    level->needed = take_mask(plan, plan->slots, &memory);
    level->live = take_mask(plan, plan->slots, &memory);
    level->hits = take_mask(plan, rays, &memory);
    level->lit = take_mask(plan, guesses ? plan->slots : 0, &memory);
    level->guessed = take_mask(plan, guesses ? (int64_t)plan->slots * plan->aims : 0, &memory);
    level->cells_at = (int64_t *)(void *)memory;
    return DPL_OK;
}

static dpl_status plan_guesses(dpl_survey *survey, dpl_context *context, const dpl_schedule *schedule) {
    size_t rays = 0;
    const dpl_schedule_level *bottom = &schedule->levels[0]; /* its probes cover the picture */
    size_t tiles_x = (size_t)(bottom->probes_x * bottom->spacing) / DPL_GUESS_TILE + 1;
    size_t tiles_y = (size_t)(bottom->probes_y * bottom->spacing) / DPL_GUESS_TILE + 1;
    for (int32_t n = 0; n < schedule->level_count; n++) {
        const dpl_schedule_level *plan = &schedule->levels[n];
        rays = (size_t)plan->rays > rays ? (size_t)plan->rays : rays;
    }
    DPL_TRY(dpl_buffer_reserve(context, &survey->ends, rays / DPL_BRANCHING, sizeof(int32_t)));
    for (int32_t n = 0; n < schedule->level_count; n++)
        survey->levels[n].ends = survey->ends.data;
    DPL_TRY(dpl_buffer_reserve(context, &survey->tiles, tiles_x * tiles_y, sizeof(dpl_guess_tile)));
    return dpl_lamps_plan(survey, context, schedule);
}

#define SHARED_BUFFERS 5

static void list_shared(dpl_survey *survey, dpl_buffer *out[SHARED_BUFFERS]) {
    dpl_buffer *all[SHARED_BUFFERS] = {&survey->cells, &survey->ends, &survey->tiles, &survey->lamp_tiles,
                                       &survey->scratch};
    memcpy(out, all, sizeof all);
}

dpl_status dpl_survey_plan(dpl_survey *survey, dpl_context *context, const dpl_schedule *schedule,
                           bool guesses) {
    size_t proof = dpl_survey_proof_bytes(), trace = dpl_survey_trace_bytes();
    size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    survey->scratch_bytes = ((proof > trace ? proof : trace) + 63) / 64 * 64;
    DPL_TRY(dpl_buffer_reserve(context, &survey->scratch, workers, survey->scratch_bytes));
    survey->capacity = 0;
    for (int32_t n = 0; n < schedule->level_count; n++) {
        DPL_TRY(plan_level(survey, context, schedule, n, guesses));
        int64_t capacity = CELLS_PER_RAY * schedule->levels[n].rays;
        survey->capacity = capacity > survey->capacity ? capacity : survey->capacity;
    }
    DPL_TRY(dpl_buffer_reserve(context, &survey->cells, (size_t)survey->capacity, sizeof(int32_t)));
    for (int32_t n = 0; n < schedule->level_count; n++)
        survey->levels[n].cells = survey->cells.data;
    return guesses ? plan_guesses(survey, context, schedule) : DPL_OK;
}

void dpl_survey_free(dpl_survey *survey, dpl_context *context) {
    for (int32_t n = 0; n < DPL_MAX_LEVELS; n++)
        dpl_buffer_free(context, &survey->masks[n]);
    dpl_buffer *shared[SHARED_BUFFERS];
    list_shared(survey, shared);
    for (int32_t i = 0; i < SHARED_BUFFERS; i++)
        dpl_buffer_free(context, shared[i]);
}

size_t dpl_survey_bytes(dpl_survey *survey) {
    dpl_buffer *shared[SHARED_BUFFERS];
    size_t bytes = 0;
    list_shared(survey, shared);
    for (int32_t i = 0; i < SHARED_BUFFERS; i++)
        bytes += shared[i]->bytes;
    for (int32_t n = 0; n < DPL_MAX_LEVELS; n++)
        bytes += survey->masks[n].bytes;
    return bytes;
}

/* ---- one frame ------------------------------------------------------------------------------------ */

/* The smallest box around all that is not empty. */
static dpl_ray_box box_of(const dpl_field *field) {
    dpl_ray_box box = {field->width, field->height, -1.0, -1.0};
    int32_t left = field->width, right = -1;
    const uint8_t *kind = field->kind.data;
    for (int32_t y = 0; y < field->height; y++, kind += field->width) {
        int32_t first = 0, last = field->width - 1;
        while (first < field->width && kind[first] == DPL_PIXEL_EMPTY)
            first++;
        if (first == field->width)
            continue;
        while (kind[last] == DPL_PIXEL_EMPTY)
            last--;
        left = first < left ? first : left;
        right = last > right ? last : right;
        box.y0 = fmin(box.y0, y);
        box.y1 = y + 1.0;
    }
    box.x0 = left;
    box.x1 = right + 1.0;
    return box;
}

static void look_at_field(dpl_survey *survey, const dpl_field *field, bool surface) {
    dpl_grid grid = dpl_field_grid(field);
    survey->distances = (dpl_clearances){grid.width, grid.height, grid.clearance, 1, 0.0f};
    if (surface) {
        survey->distances.plane = &grid.surface[0][0];
        survey->distances.stride = 4;
        /* That march meets shapes near the picture's edges up to a pixel outside. */
        survey->box = (dpl_ray_box){-1.0, -1.0, field->width + 1.0, field->height + 1.0};
    } else {
        survey->box = box_of(field);
    }
    atomic_store(&survey->used, 0);
}

/* An equal part of the error that is still allowed, for every level that is still to come. */
static dpl_status guess_level(dpl_cascades *c, const dpl_survey_task *t) {
    dpl_survey *survey = t->survey;
    dpl_guess guess = {
        .survey = *t,
        .seed = (uint64_t)c->head.desc.cascades.skip.seed,
        .tiles = survey->tiles.data,
    };
    double error = 0.0, allowed = survey->error_left / (c->schedule.level_count - t->level->number);
    DPL_TRY(dpl_survey_guess(c->head.context, &guess, allowed, &error));
    survey->error_left -= error;
    survey->guesses = !guess.is_hopeless; /* nor will it be better above */
    c->head.stats.skip.guessed += guess.total.kept;
    c->head.stats.skip.checked += guess.total.checked;
    c->head.stats.skip.wrong += guess.total.wrong;
    return DPL_OK;
}

static dpl_status survey_level(dpl_cascades *c, dpl_survey_task *t) {
    dpl_context *context = c->head.context;
    const dpl_schedule_level *plan = t->level->plan;
    int32_t items = plan->slots * plan->probes_y;
    bool surface = c->head.desc.cascades.profile == DPL_PROFILE_PAPER;
    t->survey->margin = dpl_march_margin(plan, t->survey->distances.width, t->survey->distances.height);
    t->survey->distances.spare = (float)(surface ? SURFACE_SPARE : HALF_DIAGONAL) + t->survey->margin;
    DPL_TRY(dpl_jobs_run(context, dpl_survey_need, items, 1, t));
    DPL_TRY(dpl_jobs_run(context, dpl_survey_find_empty, plan->probes_y, 8, t));
    DPL_TRY(dpl_jobs_run(context, dpl_survey_prove, dpl_survey_proof_items(t->level), 1, t));
    t->level->traced = t->level->stored = !surface && !t->grid.extinction;
    if (!t->level->traced)
        return DPL_OK;
    long long used = atomic_load(&t->survey->used);
    t->level->known = DPL_KNOWN_NONE;
    t->level->has_guesses = false;
    if (t->guesses)
        DPL_TRY(guess_level(c, t));
    DPL_TRY(dpl_jobs_run(context, dpl_survey_trace, items, 1, t));
    if (atomic_load(&t->survey->used) > t->survey->capacity) {
        t->level->stored = false;
        atomic_store(&t->survey->used, used);
    }
    return DPL_OK;
}

/* What all guesses of the frame may come to. */
static dpl_status allow_error(dpl_cascades *c, const dpl_survey_task *t) {
    double decibels = c->head.desc.cascades.skip.bound_db, slope;
    DPL_TRY(dpl_guess_slope(c->head.context, t, &slope));
    t->survey->error_left = dpl_guess_allowed(decibels > 0.0 ? decibels : DEFAULT_BOUND, slope);
    return DPL_OK;
}

/* Of the top level most rays begin outside the picture, and what a guess saves there takes longer to find
 * out; unless it is the only one. */
static bool is_guessed(const dpl_survey_level *level) {
    return level->number == FIRST_GUESSED || (level->number > FIRST_GUESSED && level->above);
}

dpl_status dpl_cascades_survey(dpl_cascades *c, const dpl_field *field) {
    dpl_survey *survey = &c->survey;
    bool surface = c->head.desc.cascades.profile == DPL_PROFILE_PAPER;
    const float(*directions)[2] = c->directions.data;
    bool guesses =
        c->head.desc.cascades.skip.mode == DPL_SKIP_BOUNDED && !surface && !dpl_field_grid(field).extinction;
    look_at_field(survey, field, surface);
    survey->guesses = guesses;
    if (guesses) {
        dpl_guess_forget(survey);
        DPL_TRY(dpl_lamps_measure(survey, c->head.context, field));
    }
    for (int32_t n = 0; n < c->schedule.level_count; n++) {
        dpl_ray_counter counters[DPL_MAX_THREADS] = {{0}};
        dpl_survey_task task = {
            .survey = survey,
            .level = &survey->levels[n],
            .below = n > 0 ? &survey->levels[n - 1] : NULL,
            .field = field,
            .kernels = c->head.context->kernels,
            .grid = dpl_field_grid(field),
            .walls_unseen = !surface,
            .guesses = survey->guesses && is_guessed(&survey->levels[n]),
            .counters = counters,
        };
        if (guesses && n == 0)
            DPL_TRY(allow_error(c, &task));
        survey->levels[n].directions = directions;
        directions += 2 * c->schedule.levels[n].directions;
        DPL_TRY(survey_level(c, &task));
        c->head.stats.levels[n].traced = dpl_ray_counter_sum(counters);
        DPL_TRY(dpl_solver_progress(&c->head, 0.0));
    }
    return DPL_OK;
}
