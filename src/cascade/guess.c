/* Guessing what rays hit from their neighbours: what --skip bounded does beyond exact. Part of the survey,
 * see survey.h; check.c finds out how good the guesses are.
 *
 * Of each slot that is live the first ray is traced. Where it and the first ray of the next slot end on one
 * surface of one colour, the three rays in between are guessed to end there too. */
#include "cascade/guess.h"

#include "cascade/aim.h"
#include "cascade/trace.h"

#include <math.h>

/* How far apart pixels of one surface may be: [px], and in times the gap between the rays that met them. */
#define SURFACE_MORE 2.0f
#define SURFACE_GAPS 2.5f
/* Of so many rows one shows what guessing will yield, and which. */
#define PILOT_ROWS 8
#define PILOT_ROW 3

/* Where a pixel lies, seen from a probe [px]. */
typedef struct sight {
    float x, y, distance;
} sight;

static sight sight_of(const dpl_guess *g, float x, float y, int32_t cell) {
    int32_t width = g->survey.grid.width, row = dpl_guess_row(g, cell);
    float dx = (float)(cell - row * width) + 0.5f - x, dy = (float)row + 0.5f - y;
    return (sight){dx, dy, sqrtf(dx * dx + dy * dy)};
}

/* Do two pixels belong to one surface, as far as one can see: are they not much further apart than the rays
 * between them, no further from the probe than where the strip of the slot was found to end, or a little
 * beyond, and not where the interval begins or ends, so that a ray between them may begin behind them or end
 * before? */
static bool is_one_surface(const dpl_guess *g, sight a, sight b) {
    float dx = a.x - b.x, dy = a.y - b.y, far = dpl_larger(a.distance, b.distance),
          near = a.distance + b.distance - far;
    float apart = SURFACE_MORE + SURFACE_GAPS * g->gap * far, slack = SURFACE_MORE + (far - near);
    const dpl_schedule_level *plan = g->survey.level->plan;
    return dx * dx + dy * dy <= apart * apart && far + slack <= (float)plan->t1 &&
           near - slack >= (float)plan->t0;
}

static uint64_t guess_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word,
                           dpl_guess_counter *counter) {
    const dpl_survey_level *level = g->survey.level;
    int32_t after = dpl_guess_next_slot(level, slot), base = word * DPL_MASK_BITS;
    const int32_t *own = dpl_guess_results(g, slot * DPL_BRANCHING, aim, row) + base;
    const int32_t *next = dpl_guess_results(g, after * DPL_BRANCHING, aim, row) + base;
    uint64_t live = dpl_mask_row(&level->live, slot, row)[word];
    uint64_t may = dpl_mask_row(&level->live, after, row)[word] & ~dpl_mask_row(&level->lit, slot, row)[word];
    uint64_t guessed = 0;
    float y = dpl_probe_position(level->plan, row);
    counter->first += dpl_bit_count(live);
    for (uint64_t rays = live; rays; rays &= rays - 1) {
        int32_t i = dpl_bit_lowest(rays);
        if (own[i] < 0)
            continue;
        counter->hits++;
        double light = dpl_light_brightest(g->survey.grid.emission[own[i]]);
        counter->light += dpl_light_steps(light);
        counter->square += dpl_light_steps(light * light);
        if (!(may >> i & 1) || next[i] < 0 || !dpl_guess_is_one_colour(g, own[i], next[i]))
            continue;
        float x = dpl_probe_position(level->plan, base + i);
        if (is_one_surface(g, sight_of(g, x, y, own[i]), sight_of(g, x, y, next[i])))
            guessed |= (uint64_t)1 << i;
    }
    return guessed;
}

void dpl_guess_trace_first(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_trace_batch *b = dpl_trace_begin(&g->survey, worker);
    int64_t marched = 0;
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
        for (int32_t aim = 0; aim < level->aims; aim++)
            marched += dpl_trace_add(&g->survey, b, slot * DPL_BRANCHING, aim, row,
                                     dpl_mask_row(&level->live, slot, row),
                                     dpl_guess_results(g, slot * DPL_BRANCHING, aim, row));
    }
    g->survey.counters[worker].rays += marched + dpl_trace_end(&g->survey, b);
}

void dpl_guess_make(int32_t begin, int32_t end, int32_t worker, void *task) {
    dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_guess_counter counter = {0}; /* of its own: workers' counters share cache lines */
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
        if ((row % PILOT_ROWS == PILOT_ROW) != g->is_pilot)
            continue;
        for (int32_t aim = 0; aim < level->aims; aim++) {
            uint64_t *guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row);
            for (int32_t w = 0; w < level->guessed.words; w++) {
                guessed[w] = guess_word(g, slot, aim, row, w, &counter);
                counter.guessed += (DPL_BRANCHING - 1) * dpl_bit_count(guessed[w]);
            }
        }
    }
    dpl_guess_add(&g->counters[worker], &counter);
}
