/* Constants of the two marches, shared by the scalar reference and the vector kernels: they must agree to the
 * bit. */
#ifndef DPL_KERNEL_MARCH_H
#define DPL_KERNEL_MARCH_H

/* A clearance from here on is worth a jump: less, and a step to the next pixel edge gets as far. */
#define JUMP_FROM 2.0f
/* From anywhere in a pixel to its centre, and from a pixel's centre to anywhere in it [px]. */
#define TWO_HALF_DIAGONALS 1.41421368f
/* Stands for 1/0 where a ray is parallel to an axis: finite, so that 0 times it is 0. */
#define NEVER 1e30f
/* A ray that comes from outside enters the picture where it crosses the last of two edges, and that point may
 * round to just outside: by no more than this in either axis, or the ray passes by a corner [px]. Less than
 * what dpl_march_margin() of src/cascade allows for, so that proofs hold for rays that enter so. */
#define ENTRY_SLACK 0.03125f

/* Sweeping a strip: most discs, the least worthwhile advance [px], and a factor below 1 for all that rounds
 * in proportion. */
#define SWEEP_DISCS 64
#define SWEEP_LEAST 0.25f
#define SWEEP_SHRINK 0.9999f

/* The march through `surface`, by the rule of the ARC paper's code: steps, least travel before a hit, how
 * near counts as one, and the distance outside the picture [px]. */
#define SURFACE_STEPS 256
#define SURFACE_LEAST_TRAVEL 0.2f
#define SURFACE_HIT 1.0f
#define SURFACE_OUTSIDE 1000.0f

#endif
