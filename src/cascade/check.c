/* Checks guesses, and gives up those that may be wrong: the loop by which --skip bounded keeps its bound.
 * Called by survey.c for each level; docs/algorithms/ray-skipping-exact-and-bounded.md explains it.
 *
 * A seeded sample of the guesses is traced. Where a guess was wrong, all guesses around are traced; where too
 * many may still be wrong, the sample grows; where no sample is enough, all of the level are traced. */
#include "cascade/guess.h"

#include "cascade/aim.h"
#include "cascade/trace.h"
#include "job/jobs.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* Wrong guesses that are taken to be in a sample beyond those that were found (Jeffreys' prior of a rate). */
#define ONE_MORE 0.5
/* Of the mean square error that a bound allows, what guesses may come to by their own account: 6 dB in hand.
 */
#define SAFETY 0.25
/* Share of wrong guesses in a sample that makes guessing hopeless. */
#define HOPELESS 0.005
/* The same in the pilot rows, of which every fourth guess is looked at before anything is given up. */
#define PILOT_HOPELESS 0.003
#define PILOT_HALVINGS 2
/* Least share of guesses of which a ray is traced: 2^-5. */
#define MOST_HALVINGS 5
/* Share of a level's live rays that must be guessed to be worth what making and checking takes. */
#define LEAST_GUESSED 0.2
/* Every round of checks looks at four times as many as the one before. */
#define HALVINGS_A_ROUND 2

/* ---- the sample ----------------------------------------------------------------------------------- */

/* 64 bits by chance from a number: SplitMix64 (Steele, Lea, Flood 2014). */
static uint64_t mix(uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Guesses of a word that are in the sample, each with a chance of 2^-halvings; of their three rays one is
 * traced, and rays[j] receives whose j-th it is. A larger sample holds all of a smaller one. */
static uint64_t sample_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word,
                            int32_t halvings, uint64_t rays[DPL_BRANCHING]) {
    const dpl_survey_level *level = g->survey.level;
    uint64_t sample = dpl_mask_row(&level->guessed, slot * level->aims + aim, row)[word];
    memset(rays, 0, DPL_BRANCHING * sizeof *rays);
    if (!sample)
        return 0;
    uint64_t state =
        mix(g->seed + ((uint64_t)level->number << 58) + (((uint64_t)slot * 4 + (uint64_t)aim) << 30) +
            ((uint64_t)row << 10) + (uint64_t)word);
    uint64_t low = state, high = state = mix(state);
    for (int32_t i = 0; i < halvings && sample; i++)
        sample &= state = mix(state);
    rays[1] = sample & ~low & ~high;
    rays[2] = sample & low;
    rays[3] = sample & ~low & high;
    return sample;
}

/* Those that were not in the sample of the round before. */
static uint64_t fresh_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word,
                           uint64_t rays[DPL_BRANCHING]) {
    uint64_t before[DPL_BRANCHING];
    if (g->round == 0)
        return sample_word(g, slot, aim, row, word, g->halvings, rays);
    uint64_t fresh = sample_word(g, slot, aim, row, word, g->halvings, rays) &
                     ~sample_word(g, slot, aim, row, word, g->halvings_before, before);
    for (int32_t j = 1; j < DPL_BRANCHING; j++)
        rays[j] &= fresh;
    return fresh;
}

/* ---- what the sample says ------------------------------------------------------------------------- */

static int32_t tile_of(const dpl_guess *g, int32_t cell) {
    int32_t row = dpl_guess_row(g, cell), column = cell - row * g->survey.grid.width;
    return row / DPL_GUESS_TILE * g->tiles_x + column / DPL_GUESS_TILE;
}

/* A guess was wrong: notes where, and how much light it was about. */
static void note_wrong(const dpl_guess *g, int32_t guessed, int32_t found) {
    const float(*emission)[4] = g->survey.grid.emission;
    double light = found >= 0 ? dpl_light_difference(emission[guessed], emission[found]) : g->mean_light;
    dpl_guess_tile *tile = &g->tiles[tile_of(g, guessed)];
    atomic_fetch_add(&tile->wrong, 1);
    atomic_fetch_add(&tile->light, dpl_light_steps(light));
    atomic_store(&tile->busy, 1);
    if (found >= 0)
        atomic_store(&g->tiles[tile_of(g, found)].busy, 1);
}

/* Compares where the rays of a batch end with what was guessed, and empties it. */
static int64_t finish_sample(const dpl_guess *g, dpl_trace_batch *b, dpl_guess_counter *counter) {
    int64_t marched = dpl_trace_march(&g->survey, b);
    const int32_t *found = b->cell;
    for (const dpl_ray_word *word = b->words; word < b->words + b->word_count; word++)
        for (uint64_t rays = word->rays; rays; rays &= rays - 1, found++) {
            int32_t guessed = word->ends[dpl_bit_lowest(rays)];
            counter->checked++;
            if (*found >= 0 && dpl_guess_is_one_colour(g, *found, guessed))
                continue;
            counter->wrong++;
            note_wrong(g, guessed, *found);
        }
    dpl_trace_clear(b);
    return marched;
}

/* Of one slot, aim and row: traces what is checked in this round. */
static int64_t trace_sample(const dpl_guess *g, dpl_trace_batch *b, int32_t slot, int32_t aim, int32_t row,
                            dpl_guess_counter *counter) {
    const dpl_survey_level *level = g->survey.level;
    dpl_ray_row r[DPL_BRANCHING] = {{.last = 0}};
    int64_t marched = 0;
    for (int32_t w = 0; w < level->guessed.words; w++) {
        uint64_t rays[DPL_BRANCHING];
        if (!fresh_word(g, slot, aim, row, w, rays))
            continue;
        for (int32_t j = 1; j < DPL_BRANCHING; j++) {
            int32_t base = w * DPL_MASK_BITS;
            if (!rays[j])
                continue;
            if (r[j].last == 0)
                r[j] = dpl_trace_aim(&g->survey, slot * DPL_BRANCHING + j, aim, row);
            if (dpl_trace_is_full(b))
                marched += finish_sample(g, b, counter);
            int32_t *ends = dpl_survey_guess_ends(level, slot, j, aim, row) + base;
            dpl_trace_add(b, &r[j], base, rays[j], 0, NULL, ends);
        }
    }
    return marched;
}

static void check_sample(int32_t begin, int32_t end, int32_t worker, void *task) {
    dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_trace_batch *b = dpl_trace_begin(&g->survey, worker);
    dpl_guess_counter counter = {0};
    int64_t marched = 0;
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
        for (int32_t aim = 0; aim < level->aims && dpl_survey_is_known_row(level, row); aim++)
            marched += trace_sample(g, b, slot, aim, row, &counter);
    }
    g->survey.counters[worker].rays += marched + finish_sample(g, b, &counter);
    dpl_guess_add(&g->counters[worker], &counter);
}

/* Spreads `busy` to all tiles around. False when there is none. */
static bool widen_busy(dpl_guess *g) {
    bool any = false;
    for (int32_t i = 0; i < g->tiles_x * g->tiles_y; i++) {
        int32_t x = i % g->tiles_x, y = i / g->tiles_x;
        g->tiles[i].near_busy = false;
        for (int32_t v = y > 0 ? y - 1 : 0; v <= y + 1 && v < g->tiles_y; v++)
            for (int32_t u = x > 0 ? x - 1 : 0; u <= x + 1 && u < g->tiles_x; u++)
                g->tiles[i].near_busy |= atomic_load(&g->tiles[v * g->tiles_x + u].busy) != 0;
        any |= g->tiles[i].near_busy;
    }
    return any;
}

static bool is_near_busy(const dpl_guess *g, int32_t cell) {
    return g->tiles[tile_of(g, cell)].near_busy;
}

/* Guesses of a word but those that end near where one was wrong. */
static uint64_t keep_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word) {
    const dpl_survey_level *level = g->survey.level;
    uint64_t guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row)[word], kept = guessed;
    const int32_t *own = dpl_survey_ends(level, slot, aim, row) + word * DPL_MASK_BITS;
    const int32_t *next =
        dpl_survey_ends(level, dpl_guess_next_slot(level, slot), aim, row) + word * DPL_MASK_BITS;
    for (uint64_t rays = guessed; rays; rays &= rays - 1) {
        int32_t i = dpl_bit_lowest(rays);
        if (is_near_busy(g, own[i]) || is_near_busy(g, next[i]))
            kept &= ~(rays & (0 - rays));
    }
    return kept;
}

static void give_up_doubtful(int32_t begin, int32_t end, int32_t worker, void *task) {
    dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    int64_t kept = 0;
    for (int32_t item = begin; item < end; item++)
        for (int32_t aim = 0; aim < level->aims; aim++) {
            int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
            uint64_t *guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row);
            for (int32_t w = 0; w < level->guessed.words; w++) {
                guessed[w] = keep_word(g, slot, aim, row, w);
                kept += (DPL_BRANCHING - 1) * dpl_bit_count(guessed[w]);
            }
        }
    g->counters[worker].kept += kept;
}

/* ---- the loop ------------------------------------------------------------------------------------- */

/* Adds up what the workers counted; they count anew. */
static dpl_guess_counter take_counters(dpl_guess *g) {
    dpl_guess_counter sum = {0};
    for (int32_t i = 0; i < DPL_MAX_THREADS; i++)
        dpl_guess_add(&sum, &g->counters[i]);
    memset(g->counters, 0, sizeof g->counters);
    return sum;
}

/* What wrong guesses are about: light, and its square, summed. */
typedef struct wrong_light {
    double sum, squares;
} wrong_light;

/* Tiles where just one guess was found to be wrong: an as large sample of other guesses would find about as
 * much in tiles that nobody knows of yet (Good and Turing, in Good 1953). */
static wrong_light light_of_single_tiles(const dpl_guess *g) {
    wrong_light found = {0.0, 0.0};
    for (int32_t i = 0; i < g->tiles_x * g->tiles_y; i++)
        if (atomic_load(&g->tiles[i].wrong) == 1) {
            double light = (double)atomic_load(&g->tiles[i].light) * DPL_LIGHT_STEP;
            found.sum += light;
            found.squares += light * light;
        }
    return found;
}

/* The mean square error of radiance that `guesses` rays of the level may come to, if of a sample of `checked`
 * those that are not in known tiles were `wrong`, and ONE_MORE that looks like any other ray. A pixel sees
 * the mean of a probe's directions: errors that have nothing to do with each other add up to e^2 /
 * directions, errors that are the same all over to e^2. Both are counted. */
static double error_of(const dpl_guess *g, int64_t guesses, double checked, wrong_light wrong) {
    double share = (double)guesses / (double)g->survey.level->plan->rays;
    if (guesses == 0)
        return 0.0;
    double chance = share * (wrong.squares + ONE_MORE * g->mean_square) / fmax(checked, 1.0);
    double bias = share * (wrong.sum + ONE_MORE * g->mean_light) / fmax(checked, 1.0);
    return chance / g->survey.level->plan->directions + bias * bias;
}

/* Are there enough guesses to go on? */
static bool is_worth_guessing(const dpl_guess_counter *found) {
    return (double)found->guessed >= LEAST_GUESSED * (DPL_BRANCHING - 1) * (double)found->first;
}

/* The smallest sample that is enough if nothing is wrong in it. False when there is none. */
static bool choose_sample(dpl_guess *g, const dpl_guess_counter *found, double allowed) {
    double hits = found->hits > 0 ? (double)found->hits : 1.0;
    g->mean_light = (double)found->light * DPL_LIGHT_STEP / hits;
    g->mean_square = (double)found->square * DPL_LIGHT_STEP / hits;
    for (g->halvings = MOST_HALVINGS; g->halvings > 0; g->halvings--) {
        double checked = ldexp((double)found->guessed / (DPL_BRANCHING - 1), -g->halvings);
        if (error_of(g, found->guessed, checked, (wrong_light){0.0, 0.0}) <= 0.7 * allowed)
            return true;
    }
    return false;
}

static dpl_status run(dpl_context *context, dpl_task_function function, dpl_guess *g) {
    const dpl_schedule_level *plan = g->survey.level->plan;
    return dpl_jobs_run(context, function, plan->slots * plan->probes_y, 1, g);
}

static void forget_counts(dpl_guess *g) {
    for (int32_t i = 0; i < g->tiles_x * g->tiles_y; i++) {
        atomic_init(&g->tiles[i].wrong, 0);
        atomic_init(&g->tiles[i].light, 0);
    }
}

void dpl_guess_forget(dpl_survey *survey) {
    dpl_guess_tile *tiles = survey->tiles.data;
    for (size_t i = 0; i < survey->tiles.bytes / sizeof *tiles; i++)
        atomic_init(&tiles[i].busy, 0);
}

/* One round: traces the sample, and gives up what it shows to be doubtful. `error` receives what the guesses
 * that are left may come to. */
static dpl_status check_round(dpl_context *context, dpl_guess *g, double *error) {
    forget_counts(g);
    DPL_TRY(run(context, check_sample, g));
    dpl_guess_counter found = take_counters(g);
    g->total.checked += found.checked;
    g->total.wrong += found.wrong;
    wrong_light single = light_of_single_tiles(g);
    g->is_hopeless = (double)found.wrong > HOPELESS * (double)found.checked;
    if (g->is_hopeless)
        return DPL_OK;
    /* in the first round, also what is known from levels below */
    if ((found.wrong > 0 || g->round == 0) && widen_busy(g)) {
        DPL_TRY(run(context, give_up_doubtful, g));
        g->total.kept = take_counters(g).kept;
    }
    *error = error_of(g, g->total.kept, (double)found.checked, single);
    return DPL_OK;
}

static dpl_status check_guesses(dpl_context *context, dpl_guess *g, double allowed, double *error) {
    DPL_TRY(check_round(context, g, error));
    while (!g->is_hopeless && *error > allowed && g->halvings > HALVINGS_A_ROUND) {
        g->round++;
        g->halvings_before = g->halvings;
        g->halvings -= HALVINGS_A_ROUND;
        DPL_TRY(check_round(context, g, error));
    }
    g->survey.level->has_guesses = !g->is_hopeless && *error <= allowed;
    return DPL_OK;
}

/* Traces first rays, and guesses from them, in rows that are not known yet. */
static dpl_status make_guesses(dpl_context *context, dpl_guess *g, dpl_known_rows rows) {
    g->survey.level->known = rows;
    DPL_TRY(run(context, dpl_guess_trace_first, g));
    DPL_TRY(run(context, dpl_guess_make, g));
    dpl_guess_counter found = take_counters(g);
    dpl_guess_add(&g->total, &found);
    return DPL_OK;
}

/* Is it hopeless by what a few rows show: are there enough guesses, would a sample do, and are they right? */
static dpl_status try_pilot(dpl_context *context, dpl_guess *g, double allowed) {
    DPL_TRY(make_guesses(context, g, DPL_KNOWN_PILOT));
    dpl_guess_counter all = g->total;
    all.guessed *= DPL_PILOT_ROWS;
    g->is_hopeless = !is_worth_guessing(&g->total) || !choose_sample(g, &all, allowed);
    if (g->is_hopeless)
        return DPL_OK;
    g->halvings = PILOT_HALVINGS;
    DPL_TRY(run(context, check_sample, g));
    dpl_guess_counter found = take_counters(g);
    g->is_hopeless = (double)found.wrong > PILOT_HOPELESS * (double)found.checked;
    dpl_guess_add(&g->total, &found);
    return DPL_OK;
}

dpl_status dpl_survey_guess(dpl_context *context, dpl_guess *g, double allowed, double *error) {
    g->tiles_x = (g->survey.grid.width + DPL_GUESS_TILE - 1) / DPL_GUESS_TILE;
    g->tiles_y = (g->survey.grid.height + DPL_GUESS_TILE - 1) / DPL_GUESS_TILE;
    g->inverse_width = 1.0 / g->survey.grid.width;
    g->gap = (float)(2.0 * PI * DPL_BRANCHING / g->survey.level->plan->directions);
    forget_counts(g);
    DPL_TRY(try_pilot(context, g, allowed));
    if (g->is_hopeless)
        return DPL_OK;
    DPL_TRY(make_guesses(context, g, DPL_KNOWN_ALL));
    g->total.kept = g->total.guessed;
    g->is_hopeless = !is_worth_guessing(&g->total) || !choose_sample(g, &g->total, allowed);
    if (!g->is_hopeless)
        DPL_TRY(check_guesses(context, g, allowed, error));
    if (!g->survey.level->has_guesses) {
        g->total.kept = 0;
        *error = 0.0;
    }
    return DPL_OK;
}

double dpl_guess_allowed(double decibels, double slope) {
    return SAFETY * pow(10.0, -decibels / 10.0) / fmax(slope * slope, 1e-9);
}
