/* Four levels in one word: arithmetic on all of them at once in plain integers. Used by all of src/flood.
 *
 * A lane is 16 bits: 15 of level, and a guard bit on top that catches the borrow of a subtraction. In a
 * world's plane of levels the guards hold marks (flood.h); functions say where they allow that. */
#ifndef DPL_FLOOD_LANES_H
#define DPL_FLOOD_LANES_H

#include <stdint.h>

#define DPL_LANES_GUARDS UINT64_C(0x8000800080008000)
#define DPL_LANES_LEVELS UINT64_C(0x7fff7fff7fff7fff)

/* The guards of lanes where a >= b. `a` may carry marks. */
static inline uint64_t dpl_lanes_at_least(uint64_t a, uint64_t b) {
    return ((a | DPL_LANES_GUARDS) - b) & DPL_LANES_GUARDS;
}

/* From guards to all level bits of these lanes. */
static inline uint64_t dpl_lanes_mask(uint64_t guards) {
    return guards - (guards >> 15);
}

static inline uint64_t dpl_lanes_max(uint64_t a, uint64_t b) {
    return b ^ ((a ^ b) & dpl_lanes_mask(dpl_lanes_at_least(a, b)));
}

static inline uint64_t dpl_lanes_min(uint64_t a, uint64_t b) {
    return a ^ ((a ^ b) & dpl_lanes_mask(dpl_lanes_at_least(a, b)));
}

/* a - b, or 0 where that is below 0. */
static inline uint64_t dpl_lanes_minus(uint64_t a, uint64_t b) {
    uint64_t difference = (a | DPL_LANES_GUARDS) - b;
    return difference & dpl_lanes_mask(difference & DPL_LANES_GUARDS);
}

/* One lane, 0 .. 3. `a` may carry marks. */
static inline uint32_t dpl_lanes_read(uint64_t a, int lane) {
    return (uint32_t)(a >> (16 * lane)) & 0x7fff;
}

/* floor(a * b / 32768). */
static inline uint64_t dpl_lanes_times(uint64_t a, uint64_t b) {
    uint64_t product = 0;
    for (int lane = 0; lane < 4; lane++)
        product |= (uint64_t)(dpl_lanes_read(a, lane) * dpl_lanes_read(b, lane) >> 15) << (16 * lane);
    return product;
}

/* The greatest lane. */
static inline uint32_t dpl_lanes_greatest(uint64_t a) {
    uint64_t two = dpl_lanes_max(a, a >> 32);
    uint32_t even = dpl_lanes_read(two, 0), odd = dpl_lanes_read(two, 1);
    return even > odd ? even : odd;
}

/* The same level in every lane. */
static inline uint64_t dpl_lanes_all(uint32_t level) {
    return level * UINT64_C(0x0001000100010001);
}

#endif
