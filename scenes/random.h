/* Seeded random numbers, the same on every machine. Used by the scene families. */
#ifndef DPL_SCENES_RANDOM_H
#define DPL_SCENES_RANDOM_H

#include <stdint.h>

/* xoshiro256** 1.0 (Blackman and Vigna 2018), seeded with SplitMix64. */
typedef struct dpl_random {
    uint64_t state[4];
} dpl_random;

/* Starts stream `stream` of `seed`: streams of one seed have nothing to do with each other. */
dpl_random dpl_random_start(uint64_t seed, uint64_t stream);

/* The next 64 bits. */
uint64_t dpl_random_bits(dpl_random *random);

/* Uniform in [0, 1), a multiple of 2^-53. */
double dpl_random_unit(dpl_random *random);

/* Uniform in [low, high). */
double dpl_random_between(dpl_random *random, double low, double high);

/* A whole number from 0 to count-1; `count` at least 1. */
int32_t dpl_random_below(dpl_random *random, int32_t count);

#endif
