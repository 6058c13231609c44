/* Rays of 64 neighbouring probes of a row at a time, as bits: which are marched, and which hit. What the
 * kernels `aim` and `list_hits` work on; filled by the survey of ray skipping. */
#ifndef DPL_KERNEL_RAY_WORDS_H
#define DPL_KERNEL_RAY_WORDS_H

#include <stdint.h>

/* Where probes stand in x, and what their rays are aimed at: the probes themselves, or their parents. */
typedef struct dpl_ray_axis {
    float spacing, target_spacing; /* number n of either stands at (n + 1/2) times that [px] */
    int32_t targets;               /* how many there are */
} dpl_ray_axis;

/* Rays in one direction. That of probe n, number n - first of the word, begins at (its x + start_x, y0), and
 * ends at (x of target (n + step) >> shift, or the nearest that there is, + end_x, y1). */
typedef struct dpl_ray_word {
    uint64_t rays;       /* that are marched */
    uint64_t known;      /* that are not, for it is known where they end */
    uint64_t *hits;      /* receives which of both end at an opaque pixel */
    int32_t *ends;       /* of the 64 probes: where known ones end, -1: nowhere */
    int32_t first;       /* probe */
    int32_t at;          /* receives the number of its first hit in the list */
    int32_t step, shift; /* to the target */
    float start_x, end_x, y0, y1;
} dpl_ray_word;

/* Kernels write whole vectors: there must be room for so many more numbers than they are said to write. */
enum { DPL_RAY_WORDS_PAD = 16 };

#endif
