/* The generator. Integer arithmetic and one exact conversion: no rounding that could differ. */
#include "random.h"

/* Steele, Lea and Flood 2014. */
static uint64_t split_mix(uint64_t *state) {
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static uint64_t rotate_left(uint64_t bits, int count) {
    return bits << count | bits >> (64 - count);
}

dpl_random dpl_random_start(uint64_t seed, uint64_t stream) {
    dpl_random random;
    uint64_t state = split_mix(&seed) ^ split_mix(&stream) * 3;
    for (int i = 0; i < 4; i++)
        random.state[i] = split_mix(&state);
    return random;
}

uint64_t dpl_random_bits(dpl_random *random) {
    uint64_t *s = random->state;
    uint64_t result = rotate_left(s[1] * 5, 7) * 9, t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotate_left(s[3], 45);
    return result;
}

double dpl_random_unit(dpl_random *random) {
    return (double)(dpl_random_bits(random) >> 11) * 0x1p-53;
}

double dpl_random_between(dpl_random *random, double low, double high) {
    return low + (high - low) * dpl_random_unit(random);
}

int32_t dpl_random_below(dpl_random *random, int32_t count) {
    return (int32_t)(dpl_random_unit(random) * count);
}
