/* What is out of date of a level whose radiance is that of the last frame: probes whose rays come near pixels
 * that have changed, and probes that interpolate others which have. Found by dirty.c, obeyed by level.c,
 * which notes what really changed for the level below. docs/algorithms/reuse.md has the argument. */
#ifndef DPL_CASCADE_DIRTY_H
#define DPL_CASCADE_DIRTY_H

#include "cascade/mask.h"
#include "cascade/near.h"
#include "solver/reuse.h"

/* Words of the longest row of probes, and of one chunk more. */
#define DPL_DIRTY_WORDS (DPL_MAX_SIZE / DPL_MASK_BITS + 2)

typedef struct dpl_dirt {
    int32_t box_count;
    dpl_ray_box boxes[DPL_REUSE_BOXES]; /* of pixels that have changed */
    double slack;                       /* how near to them a ray must come to read one [px] */
    dpl_mask changed;                   /* [slot]: probes of this level whose radiance has */
    dpl_mask changed_above;             /* of the level above, where there is one */
} dpl_dirt;

struct dpl_level;

/* Probes of a slot and row that are out of date, as bits; false when there are none. */
bool dpl_level_find_dirty(const struct dpl_level *level, int32_t slot, int32_t row,
                          uint64_t dirty[DPL_DIRTY_WORDS]);

#endif
