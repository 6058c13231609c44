/* Guesses of one level while they are made and checked. Filled by survey.c, worked off by guess.c. */
#ifndef DPL_CASCADE_GUESS_H
#define DPL_CASCADE_GUESS_H

#include "cascade/survey.h"

/* Side of the squares in which wrong guesses are counted [px]. */
#define DPL_GUESS_TILE 16

typedef struct dpl_guess_tile {
    atomic_int wrong;   /* guesses of this level that ended here and were found to be wrong */
    atomic_llong light; /* how wrong, in steps */
    atomic_int busy;    /* 1: something was overlooked near here, in this level or below */
    bool near_busy;     /* here, or in a tile around */
} dpl_guess_tile;

typedef struct dpl_guess_counter {
    int64_t guessed; /* rays */
    int64_t kept;    /* of them that were not given up */
    int64_t hits;    /* of first rays */
    int64_t light;   /* that they met, in steps */
    int64_t square;  /* of it, summed likewise */
    int64_t checked;
    int64_t wrong;
    char padding[8];
} dpl_guess_counter;

typedef struct dpl_guess {
    dpl_survey_task survey;
    uint64_t seed;
    int32_t tiles_x, tiles_y;
    dpl_guess_tile *tiles;
    uint64_t *rays;                 /* scratch: a row of words per ray of a slot and worker */
    int32_t round;                  /* of checks, from 0 */
    int32_t halvings;               /* of the sample: a guess is checked with a chance of 2^-halvings */
    int32_t halvings_before;        /* of the round before */
    double mean_light, mean_square; /* of the light that first rays met */
    float gap;                      /* between first rays of two slots [rad] */
    bool give_up_all;
    dpl_guess_counter counters[DPL_MAX_THREADS];
    dpl_guess_counter total;
} dpl_guess;

/* Traces what must be of a level and guesses the rest. `allowed` is the mean square error of radiance that
 * guesses of this level may come to, `error` receives what they are taken to come to. */
DPL_MUST_CHECK dpl_status dpl_survey_guess(dpl_context *context, dpl_guess *g, double allowed, double *error);

/* Forgets where guesses were wrong: before the first level of a frame. */
void dpl_guess_forget(dpl_survey *survey);

/* The root mean square of the tone map's slope over the picture, in short: of the light at a few points.
 * Counts its rays. */
double dpl_guess_slope(const dpl_survey_task *t);

/* The mean square error of radiance that a picture may have all over to stay above so many dB in
 * psnr_display. */
double dpl_guess_allowed(double decibels, double slope);

#endif
