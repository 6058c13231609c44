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
    return (dx * dx + dy * dy <= apart * apart) & (far + slack <= (float)plan->t1) &
           (near - slack >= (float)plan->t0);
}

/* Notes how bright it is where first rays end. */
static void note_light(const dpl_guess *g, const int32_t *ends, uint64_t hits, dpl_guess_counter *counter) {
    counter->hits += dpl_bit_count(hits);
    for (; hits; hits &= hits - 1) {
        double light = dpl_light_brightest(g->survey.grid.emission[ends[dpl_bit_lowest(hits)]]);
        counter->light += dpl_light_steps(light);
        counter->square += dpl_light_steps(light * light);
    }
}

/* Of 64 probes, whose rays between the first of a slot and that of the next are guessed. */
static uint64_t guess_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word,
                           dpl_guess_counter *counter) {
    const dpl_survey_level *level = g->survey.level;
    int32_t after = dpl_guess_next_slot(level, slot), base = word * DPL_MASK_BITS;
    const int32_t *own = dpl_survey_ends(level, slot, aim, row) + base;
    const int32_t *next = dpl_survey_ends(level, after, aim, row) + base;
    uint64_t hits = dpl_guess_first_hits(level, slot, aim, row)[word], guessed = 0;
    uint64_t both = hits & dpl_guess_first_hits(level, after, aim, row)[word] &
                    ~dpl_mask_row(&level->lit, slot, row)[word];
    float y = dpl_probe_position(level->plan, row);
    counter->first += dpl_bit_count(dpl_mask_row(&level->live, slot, row)[word]);
    if (level->known == DPL_KNOWN_PILOT)
        note_light(g, own, hits, counter);
    for (; both; both &= both - 1) { /* without branches, which nobody could predict */
        int32_t i = dpl_bit_lowest(both);
        float x = dpl_probe_position(level->plan, base + i);
        uint64_t is_one = is_one_surface(g, sight_of(g, x, y, own[i]), sight_of(g, x, y, next[i]));
        is_one &= dpl_guess_is_one_colour(g, own[i], next[i]);
        guessed |= is_one << i;
    }
    return guessed;
}

/* Are the first rays of a row traced, and guesses made from them, in this pass: the one over pilot rows, or
 * that over the others? */
static bool is_of_pass(const dpl_survey_level *level, int32_t row) {
    return dpl_survey_is_pilot_row(row) == (level->known == DPL_KNOWN_PILOT);
}

/* Writes down where the rays of a batch end, and empties it. */
static int64_t finish_first(const dpl_guess *g, dpl_trace_batch *b) {
    int64_t marched = dpl_trace_march(&g->survey, b);
    const int32_t *cell = b->cell;
    for (const dpl_ray_word *word = b->words; word < b->words + b->word_count; word++) {
        uint64_t hits = 0;
        for (uint64_t rays = word->rays; rays; rays &= rays - 1) {
            word->ends[dpl_bit_lowest(rays)] = *cell;
            hits |= rays & (0 - rays) & (0 - (uint64_t)(*cell++ >= 0));
        }
        *word->hits = hits;
    }
    dpl_trace_clear(b);
    return marched;
}

static int64_t trace_first(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, dpl_trace_batch *b) {
    const dpl_survey_level *level = g->survey.level;
    const uint64_t *live = dpl_mask_row(&level->live, slot, row);
    uint64_t *hits = dpl_guess_first_hits(level, slot, aim, row);
    dpl_ray_row r = {.last = -1}; /* not aimed yet */
    int64_t marched = 0;
    for (int32_t w = 0; w < level->live.words; w++) {
        int32_t base = w * DPL_MASK_BITS;
        hits[w] = 0;
        if (!live[w])
            continue;
        if (r.last < 0)
            r = dpl_trace_aim(&g->survey, slot * DPL_BRANCHING, aim, row);
        uint64_t near = live[w] & dpl_mask_range(base, r.first, r.last);
        if (!near)
            continue;
        if (dpl_trace_is_full(b))
            marched += finish_first(g, b);
        dpl_trace_add(b, &r, base, near, 0, &hits[w], dpl_survey_ends(level, slot, aim, row) + base);
    }
    return marched;
}

void dpl_guess_trace_first(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_trace_batch *b = dpl_trace_begin(&g->survey, worker);
    int64_t marched = 0;
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
        for (int32_t aim = 0; aim < level->aims && is_of_pass(level, row); aim++)
            marched += trace_first(g, slot, aim, row, b);
    }
    g->survey.counters[worker].rays += marched + finish_first(g, b);
}

void dpl_guess_make(int32_t begin, int32_t end, int32_t worker, void *task) {
    dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_guess_counter counter = {0}; /* of its own: workers' counters share cache lines */
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
        for (int32_t aim = 0; aim < level->aims && is_of_pass(level, row); aim++) {
            uint64_t *guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row);
            for (int32_t w = 0; w < level->guessed.words; w++) {
                guessed[w] = guess_word(g, slot, aim, row, w, &counter);
                counter.guessed += (DPL_BRANCHING - 1) * dpl_bit_count(guessed[w]);
            }
        }
    }
    dpl_guess_add(&g->counters[worker], &counter);
}
