/* Seeded numbers for objects and rays: the same on every machine. Used by scatter.c and the tracers'
 * benchmark. */
#ifndef DPL_BENCH_RANDOM_H
#define DPL_BENCH_RANDOM_H

#include <stdint.h>

/* The next of a sequence; the state must not be 0. Source: Marsaglia 2003, "Xorshift RNGs". */
static inline double dpl_bench_random(uint64_t *state, double low, double high) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return low + (high - low) * (double)(*state >> 11) / 9007199254740992.0;
}

#endif
