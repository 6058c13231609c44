/* Guesses of one level while they are made and checked. Filled by survey.c, worked off by check.c and
 * guess.c. */
#ifndef DPL_CASCADE_GUESS_H
#define DPL_CASCADE_GUESS_H

#include "cascade/survey.h"

#include <math.h>

/* Side of the squares in which wrong guesses are counted [px]. */
#define DPL_GUESS_TILE 16

/* Emission is summed in steps of this, so that the order of adding does not matter. */
#define DPL_LIGHT_STEP (1.0 / 4096.0)
/* What one ray may count for in such sums: keeps them within 64 bits. */
#define DPL_LIGHT_MOST 1e6

typedef struct dpl_guess_tile {
    atomic_int wrong;   /* guesses of this level that ended here and were found to be wrong */
    atomic_llong light; /* how wrong, in steps */
    atomic_int busy;    /* 1: something was overlooked near here, in this level or below */
    bool near_busy;     /* here, or in a tile around */
} dpl_guess_tile;

typedef struct dpl_guess_counter {
    int64_t first;   /* rays that were traced before all others */
    int64_t guessed; /* rays */
    int64_t kept;    /* of them that were not given up */
    int64_t hits;    /* of first rays in pilot rows */
    int64_t light;   /* that they met, in steps */
    int64_t square;  /* of it, summed likewise */
    int64_t checked;
    int64_t wrong;
} dpl_guess_counter;

typedef struct dpl_guess {
    dpl_survey_task survey;
    uint64_t seed;
    int32_t tiles_x, tiles_y;
    double inverse_width; /* of the picture [1/px] */
    dpl_guess_tile *tiles;
    int32_t round;                  /* of checks, from 0 */
    int32_t halvings;               /* of the sample: a guess is checked with a chance of 2^-halvings */
    int32_t halvings_before;        /* of the round before */
    double mean_light, mean_square; /* of the light that first rays met */
    float gap;                      /* between first rays of two slots [rad] */
    bool is_hopeless;               /* no sample would do, there are too few guesses, or too many are wrong */
    dpl_guess_counter counters[DPL_MAX_THREADS];
    dpl_guess_counter total;
} dpl_guess;

static inline void dpl_guess_add(dpl_guess_counter *sum, const dpl_guess_counter *more) {
    sum->first += more->first;
    sum->guessed += more->guessed;
    sum->kept += more->kept;
    sum->hits += more->hits;
    sum->light += more->light;
    sum->square += more->square;
    sum->checked += more->checked;
    sum->wrong += more->wrong;
}

/* guess.c: dpl_task_functions over slots x rows: the first ray of each live slot, and what is guessed from
 * them. */
void dpl_guess_trace_first(int32_t begin, int32_t end, int32_t worker, void *task);
void dpl_guess_make(int32_t begin, int32_t end, int32_t worker, void *task);

/* check.c: traces the first rays of a level and guesses of the others as many as it may; the rest is left to
 * trace.c. `allowed` is the mean square error of radiance that guesses of this level may come to, `error`
 * receives what they are taken to come to. */
DPL_MUST_CHECK dpl_status dpl_survey_guess(dpl_context *context, dpl_guess *g, double allowed, double *error);

/* Forgets where guesses were wrong: before the first level of a frame. */
void dpl_guess_forget(dpl_survey *survey);

/* The root mean square of the tone map's slope over the picture, in short: of the light at a few points.
 * Counts its rays. */
DPL_MUST_CHECK dpl_status dpl_guess_slope(dpl_context *context, const dpl_survey_task *t, double *slope);

/* The mean square error of radiance that a picture may have all over to stay above so many dB in
 * psnr_display. */
double dpl_guess_allowed(double decibels, double slope);

/* ---- rays and their colours ----------------------------------------------------------------------- */

/* The row of a pixel's number, without a division: half a pixel is far more than rounding. */
static inline int32_t dpl_guess_row(const dpl_guess *g, int32_t cell) {
    return (int32_t)(((double)cell + 0.5) * g->inverse_width);
}

static inline int32_t dpl_guess_next_slot(const dpl_survey_level *level, int32_t slot) {
    return slot + 1 < level->plan->slots ? slot + 1 : 0;
}

/* Which first rays of a slot and row hit anything. */
static inline uint64_t *dpl_guess_first_hits(const dpl_survey_level *level, int32_t slot, int32_t aim,
                                             int32_t row) {
    return dpl_mask_row(&level->hits, slot * DPL_BRANCHING * level->aims + aim, row);
}

static inline float dpl_larger(float a, float b) {
    return a > b ? a : b;
}

static inline double dpl_light_brightest(const float rgb[4]) {
    return (double)dpl_larger(rgb[0], dpl_larger(rgb[1], rgb[2]));
}

/* Largest difference in any channel. */
static inline double dpl_light_difference(const float a[4], const float b[4]) {
    float most = 0.0f;
    for (int c = 0; c < 3; c++)
        most = dpl_larger(most, fabsf(a[c] - b[c]));
    return (double)most;
}

static inline int64_t dpl_light_steps(double light) {
    return (int64_t)((light < DPL_LIGHT_MOST ? light : DPL_LIGHT_MOST) / DPL_LIGHT_STEP);
}

static inline bool dpl_guess_is_one_colour(const dpl_guess *g, int32_t a, int32_t b) {
    const float *first = g->survey.grid.emission[a], *second = g->survey.grid.emission[b];
    return (first[0] == second[0]) & (first[1] == second[1]) & (first[2] == second[2]);
}

#endif
