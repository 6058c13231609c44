/* Probes of a cascade in a row, and the light of the level above that stands behind their rays. What the
 * kernels `merge`, `merge_hits` and `spread` work on. Included by kernel.h. */
#ifndef DPL_KERNEL_PROBES_H
#define DPL_KERNEL_PROBES_H

#include <stddef.h>
#include <stdint.h>

/* Floats behind a row of parents that kernels may read, and make nothing of. */
#define DPL_PARENTS_SPARE 16

/* How probes i of a row look at a row of parents, of which there is one for two probes. `row` begins with the
 * left parent of probe 0, which is even. */
typedef enum dpl_parents_seen {
    DPL_PARENTS_FOUR, /* interpolated: 3/4 of the way from row[i/2] to row[i/2 + 1] where i is even; from the
                         next one on and 1/4 where it is odd; and `between` of it from `row` to `next_row` */
    DPL_PARENT_LEFT,  /* row[i/2 + i%2]; so the right ones are left ones one further on */
    DPL_PARENT_NEAREST, /* row[i/2 + 1] */
    DPL_PARENT_SAME,    /* row[0] */
} dpl_parents_seen;

typedef struct dpl_parents {
    dpl_parents_seen seen;
    float between;
    const float *row;      /* of the first channel */
    const float *next_row; /* for DPL_PARENTS_FOUR */
    ptrdiff_t plane;       /* from a channel to the next */
} dpl_parents;

/* Where light of one ray of each probe is added: sum[c][i] += weight[i % 2] * light. */
typedef struct dpl_probe_sums {
    int32_t count; /* of probes */
    float *sum[3];
    float weight[2];
} dpl_probe_sums;

#endif
