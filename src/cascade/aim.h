/* Where probes stand, which parents they lie between, and where their rays begin and end. Used by whoever
 * traces rays of a level: all must agree to the bit. */
#ifndef DPL_CASCADE_AIM_H
#define DPL_CASCADE_AIM_H

#include <dapple/schedule.h>

static inline int32_t dpl_clamp_index(int32_t i, int32_t count) {
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

/* Which parents a probe lies between, in one axis: the lower one, and the share of the upper one. */
static inline int32_t dpl_lower_parent(int32_t probe) {
    return probe / 2 - (probe % 2 == 0);
}

static inline float dpl_upper_share(int32_t probe) {
    return probe % 2 == 0 ? 0.75f : 0.25f;
}

/* Exact: half pixels up to some ten thousands. */
static inline float dpl_probe_position(const dpl_schedule_level *plan, int32_t probe) {
    return ((float)probe + 0.5f) * (float)plan->spacing;
}

#endif
