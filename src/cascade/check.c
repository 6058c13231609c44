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
/* Least share of guesses of which a ray is traced: 2^-5. */
#define MOST_HALVINGS 5
#define NO_SAMPLE 99
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
    if (!sample || halvings >= NO_SAMPLE)
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
    uint64_t fresh = sample_word(g, slot, aim, row, word, g->halvings, rays) &
                     ~sample_word(g, slot, aim, row, word, g->halvings_before, before);
    for (int32_t j = 1; j < DPL_BRANCHING; j++)
        rays[j] &= fresh;
    return fresh;
}

/* Of one slot, aim and row: guesses that are checked in this round; in the first, also the rays that are
 * neither first of their slot nor guessed. */
static int64_t trace_slot(const dpl_guess *g, dpl_trace_batch *b, int32_t slot, int32_t aim, int32_t row,
                          uint64_t *rays) {
    const dpl_survey_level *level = g->survey.level;
    const uint64_t *live = dpl_mask_row(&level->live, slot, row);
    const uint64_t *guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row);
    int32_t words = level->live.words;
    int64_t marched = 0;
    uint64_t any = 0;
    for (int32_t w = 0; w < words; w++) {
        uint64_t of_ray[DPL_BRANCHING], rest = g->round == 0 ? live[w] & ~guessed[w] : 0;
        any |= rest | fresh_word(g, slot, aim, row, w, of_ray);
        for (int32_t j = 1; j < DPL_BRANCHING; j++)
            rays[j * words + w] = rest | of_ray[j];
    }
    for (int32_t j = 1; j < DPL_BRANCHING && any; j++) {
        int32_t ray = slot * DPL_BRANCHING + j;
        marched += dpl_trace_add(&g->survey, b, ray, aim, row, rays + j * words,
                                 dpl_guess_results(g, ray, aim, row));
    }
    return marched;
}

static uint64_t *scratch_rays(const dpl_guess *g, int32_t worker) {
    return g->rays + (size_t)worker * dpl_guess_ray_words(g->survey.level->live.words);
}

static void trace_round(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_trace_batch *b = dpl_trace_begin(&g->survey, worker);
    int64_t marched = 0;
    for (int32_t item = begin; item < end; item++)
        for (int32_t aim = 0; aim < level->aims; aim++)
            marched += trace_slot(g, b, item / level->plan->probes_y, aim, item % level->plan->probes_y,
                                  scratch_rays(g, worker));
    g->survey.counters[worker].rays += marched + dpl_trace_end(&g->survey, b);
}

/* ---- what the sample says ------------------------------------------------------------------------- */

static int32_t tile_of(const dpl_guess *g, int32_t cell) {
    int32_t row = dpl_guess_row(g, cell), column = cell - row * g->survey.grid.width;
    return row / DPL_GUESS_TILE * g->tiles_x + column / DPL_GUESS_TILE;
}

/* A guess was wrong: notes where, and how much light it was about. */
static void note_wrong(const dpl_guess *g, int32_t guessed, int32_t found, int32_t own, int32_t next) {
    const float(*emission)[4] = g->survey.grid.emission;
    double light = found >= 0 ? dpl_light_difference(emission[guessed], emission[found]) : g->mean_light;
    dpl_guess_tile *tile = &g->tiles[tile_of(g, guessed)];
    atomic_fetch_add(&tile->wrong, 1);
    atomic_fetch_add(&tile->light, dpl_light_steps(light));
    atomic_store(&g->tiles[tile_of(g, own)].busy, 1);
    atomic_store(&g->tiles[tile_of(g, next)].busy, 1);
    if (found >= 0)
        atomic_store(&g->tiles[tile_of(g, found)].busy, 1);
}

static void check_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word,
                       dpl_guess_counter *counter) {
    uint64_t rays[DPL_BRANCHING];
    if (!fresh_word(g, slot, aim, row, word, rays))
        return;
    const int32_t *own = dpl_guess_results(g, slot * DPL_BRANCHING, aim, row);
    const int32_t *next =
        dpl_guess_results(g, dpl_guess_next_slot(g->survey.level, slot) * DPL_BRANCHING, aim, row);
    for (int32_t j = 1; j < DPL_BRANCHING; j++) {
        const int32_t *found = dpl_guess_results(g, slot * DPL_BRANCHING + j, aim, row);
        for (; rays[j]; rays[j] &= rays[j] - 1) {
            int32_t x = word * DPL_MASK_BITS + dpl_bit_lowest(rays[j]);
            int32_t guessed = dpl_guess_between(own[x], next[x], j);
            counter->checked++;
            if (found[x] >= 0 && dpl_guess_is_one_colour(g, found[x], guessed))
                continue;
            counter->wrong++;
            note_wrong(g, guessed, found[x], own[x], next[x]);
        }
    }
}

static void check_sample(int32_t begin, int32_t end, int32_t worker, void *task) {
    dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_guess_counter counter = {0};
    for (int32_t item = begin; item < end; item++)
        for (int32_t aim = 0; aim < level->aims; aim++)
            for (int32_t w = 0; w < level->guessed.words; w++)
                check_word(g, item / level->plan->probes_y, aim, item % level->plan->probes_y, w, &counter);
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

/* Guesses of a word that are given up: all, or those near where one was wrong. */
static uint64_t give_up_word(const dpl_guess *g, int32_t slot, int32_t aim, int32_t row, int32_t word) {
    const dpl_survey_level *level = g->survey.level;
    uint64_t guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row)[word], given_up = 0;
    const int32_t *own = dpl_guess_results(g, slot * DPL_BRANCHING, aim, row) + word * DPL_MASK_BITS;
    const int32_t *next = dpl_guess_results(g, dpl_guess_next_slot(level, slot) * DPL_BRANCHING, aim, row) +
                          word * DPL_MASK_BITS;
    if (g->give_up_all)
        return guessed;
    for (uint64_t rays = guessed; rays; rays &= rays - 1) {
        int32_t i = dpl_bit_lowest(rays);
        if (is_near_busy(g, own[i]) || is_near_busy(g, next[i]))
            given_up |= rays & (0 - rays);
    }
    return given_up;
}

/* Of one slot, aim and row: traces the guesses that are given up, but for rays that the sample holds. */
static int64_t trace_doubtful(const dpl_guess *g, dpl_trace_batch *b, int32_t slot, int32_t aim, int32_t row,
                              uint64_t *rays) {
    const dpl_survey_level *level = g->survey.level;
    uint64_t *guessed = dpl_mask_row(&level->guessed, slot * level->aims + aim, row), any = 0;
    int32_t words = level->live.words;
    int64_t marched = 0;
    for (int32_t w = 0; w < words; w++) {
        uint64_t of_ray[DPL_BRANCHING] = {0}, given_up = give_up_word(g, slot, aim, row, w);
        if (given_up)
            sample_word(g, slot, aim, row, w, g->halvings, of_ray);
        for (int32_t j = 1; j < DPL_BRANCHING; j++)
            rays[j * words + w] = given_up & ~of_ray[j];
        guessed[w] &= ~given_up;
        any |= given_up;
    }
    for (int32_t j = 1; j < DPL_BRANCHING && any; j++) {
        int32_t ray = slot * DPL_BRANCHING + j;
        marched += dpl_trace_add(&g->survey, b, ray, aim, row, rays + j * words,
                                 dpl_guess_results(g, ray, aim, row));
    }
    return marched;
}

static void trace_given_up(int32_t begin, int32_t end, int32_t worker, void *task) {
    dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    dpl_trace_batch *b = dpl_trace_begin(&g->survey, worker);
    int64_t marched = 0, kept = 0;
    for (int32_t item = begin; item < end; item++)
        for (int32_t aim = 0; aim < level->aims; aim++) {
            int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
            marched += trace_doubtful(g, b, slot, aim, row, scratch_rays(g, worker));
            for (int32_t w = 0; w < level->guessed.words; w++)
                kept += (DPL_BRANCHING - 1) *
                        dpl_bit_count(dpl_mask_row(&level->guessed, slot * level->aims + aim, row)[w]);
        }
    g->counters[worker].kept += kept;
    g->survey.counters[worker].rays += marched + dpl_trace_end(&g->survey, b);
}

/* ---- hits of the level, traced and guessed -------------------------------------------------------- */

/* Bits and cells of one ray in one word. Returns how many cells there are. */
static int32_t collect_word(const dpl_guess *g, int32_t ray, int32_t aim, int32_t row, int32_t word,
                            uint64_t guessed, int32_t *cells) {
    const dpl_survey_level *level = g->survey.level;
    int32_t slot = ray / DPL_BRANCHING, base = word * DPL_MASK_BITS, count = 0;
    uint64_t live = dpl_mask_row(&level->live, slot, row)[word], hits = 0;
    const int32_t *found = dpl_guess_results(g, ray, aim, row) + base;
    const int32_t *stand_in =
        dpl_guess_results(
            g, dpl_guess_between(slot, dpl_guess_next_slot(level, slot), ray % DPL_BRANCHING) * DPL_BRANCHING,
            aim, row) +
        base;
    for (; live; live &= live - 1) {
        int32_t i = dpl_bit_lowest(live);
        int32_t cell = (guessed >> i & 1 ? stand_in : found)[i];
        cells[count] = cell;
        count += cell >= 0;
        hits |= (uint64_t)(cell >= 0) << i;
    }
    dpl_mask_row(&level->hits, ray * level->aims + aim, row)[word] = hits;
    return count;
}

/* The same for all rays of a slot in one chunk, in the order in which chunk.c reads them. */
static int32_t collect_chunk(const dpl_guess *g, int32_t slot, int32_t row, int32_t chunk, int32_t *cells) {
    const dpl_survey_level *level = g->survey.level;
    uint64_t guessed[4][DPL_CHUNK_WORDS][DPL_BRANCHING];
    int32_t first = chunk * DPL_CHUNK_WORDS, left = level->hits.words - first, count = 0;
    int32_t words = left < DPL_CHUNK_WORDS ? left : DPL_CHUNK_WORDS;
    for (int32_t aim = 0; aim < level->aims; aim++)
        for (int32_t w = 0; w < words; w++) {
            uint64_t sample[DPL_BRANCHING];
            uint64_t all = dpl_mask_row(&level->guessed, slot * level->aims + aim, row)[first + w];
            sample_word(g, slot, aim, row, first + w, g->halvings, sample);
            for (int32_t j = 0; j < DPL_BRANCHING; j++)
                guessed[aim][w][j] = j == 0 ? 0 : all & ~sample[j];
        }
    for (int32_t j = 0; j < DPL_BRANCHING; j++)
        for (int32_t aim = 0; aim < level->aims; aim++)
            for (int32_t w = 0; w < words; w++)
                count += collect_word(g, slot * DPL_BRANCHING + j, aim, row, first + w, guessed[aim][w][j],
                                      cells + count);
    return count;
}

static void collect(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const dpl_guess *g = task;
    const dpl_survey_level *level = g->survey.level;
    int32_t cells[DPL_CHUNK * DPL_BRANCHING * 4 + 1], chunks = dpl_survey_chunks(level);
    for (int32_t item = begin; item < end; item++)
        for (int32_t chunk = 0; chunk < chunks; chunk++) {
            int32_t slot = item / level->plan->probes_y, row = item % level->plan->probes_y;
            int32_t count = collect_chunk(g, slot, row, chunk, cells);
            int32_t *out =
                dpl_survey_take_cells(g->survey.survey, count, dpl_survey_cells_at(level, slot, row, chunk));
            if (out)
                memcpy(out, cells, (size_t)count * sizeof *cells);
        }
}

/* ---- the loop ------------------------------------------------------------------------------------- */

/* Adds up what the workers counted. */
static dpl_guess_counter sum_of_counters(const dpl_guess *g) {
    dpl_guess_counter sum = {0};
    for (int32_t i = 0; i < DPL_MAX_THREADS; i++)
        dpl_guess_add(&sum, &g->counters[i]);
    return sum;
}

/* The same, and they count anew. */
static dpl_guess_counter take_counters(dpl_guess *g) {
    dpl_guess_counter sum = sum_of_counters(g);
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
    DPL_TRY(run(context, trace_round, g));
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
        DPL_TRY(run(context, trace_given_up, g));
        g->total.kept = take_counters(g).kept;
    }
    *error = error_of(g, g->total.kept, (double)found.checked, single);
    return DPL_OK;
}

static dpl_status give_up_all(dpl_context *context, dpl_guess *g) {
    g->give_up_all = true;
    DPL_TRY(run(context, trace_given_up, g));
    g->total.kept = take_counters(g).kept;
    return DPL_OK;
}

/* Nothing is guessed, so all that is not traced yet is. */
static dpl_status trace_rest(dpl_context *context, dpl_guess *g) {
    const dpl_survey_level *level = g->survey.level;
    const dpl_mask *guessed = &level->guessed;
    size_t words =
        (size_t)(level->plan->slots * level->aims) * (size_t)guessed->rows * (size_t)guessed->words;
    memset(guessed->bits, 0, words * sizeof *guessed->bits);
    g->total.kept = 0;
    return run(context, trace_round, g);
}

static dpl_status check_guesses(dpl_context *context, dpl_guess *g, double allowed, double *error) {
    DPL_TRY(check_round(context, g, error));
    while (!g->is_hopeless && *error > allowed && g->halvings > HALVINGS_A_ROUND) {
        g->round++;
        g->halvings_before = g->halvings;
        g->halvings -= HALVINGS_A_ROUND;
        DPL_TRY(check_round(context, g, error));
    }
    if (!g->is_hopeless && *error <= allowed)
        return DPL_OK;
    *error = 0.0;
    return give_up_all(context, g);
}

/* A few, and where those are worth it, all. */
static dpl_status make_guesses(dpl_context *context, dpl_guess *g) {
    g->is_pilot = true;
    DPL_TRY(run(context, dpl_guess_make, g));
    dpl_guess_counter pilot = sum_of_counters(g);
    g->is_pilot = false;
    if (is_worth_guessing(&pilot))
        DPL_TRY(run(context, dpl_guess_make, g));
    g->total = take_counters(g);
    g->total.kept = g->total.guessed;
    return DPL_OK;
}

dpl_status dpl_survey_guess(dpl_context *context, dpl_guess *g, double allowed, double *error) {
    g->tiles_x = (g->survey.grid.width + DPL_GUESS_TILE - 1) / DPL_GUESS_TILE;
    g->tiles_y = (g->survey.grid.height + DPL_GUESS_TILE - 1) / DPL_GUESS_TILE;
    g->inverse_width = 1.0 / g->survey.grid.width;
    g->gap = (float)(2.0 * PI * DPL_BRANCHING / g->survey.level->plan->directions);
    g->halvings = g->halvings_before = NO_SAMPLE;
    *error = 0.0;
    DPL_TRY(run(context, dpl_guess_trace_first, g));
    DPL_TRY(make_guesses(context, g));
    g->is_hopeless = !is_worth_guessing(&g->total) || !choose_sample(g, &g->total, allowed);
    DPL_TRY(g->is_hopeless ? trace_rest(context, g) : check_guesses(context, g, allowed, error));
    return run(context, collect, g);
}

double dpl_guess_allowed(double decibels, double slope) {
    return SAFETY * pow(10.0, -decibels / 10.0) / fmax(slope * slope, 1e-9);
}
