/* Moments of depth: how much of a filtered stretch of a shadow map lies before a receiver, from two or four
 * numbers. Pure mathematics, no memory: called by the maps of this room, in one dimension and in two.
 *
 * V is visibility: 1 is lit. Every bound here is an upper bound of V in exact arithmetic: it may leak light,
 * it never adds shadow. What may add some is named: bias does not, bleeding reduction does. */
#ifndef DPL_SHADOW_MOMENTS_H
#define DPL_SHADOW_MOMENTS_H

#include <stdbool.h>
#include <stdint.h>

/* ---- two moments ---------------------------------------------------------------------------------- */

/* Least variance of depths within 0 .. 1. */
#define DPL_MOMENTS_LEAST_VARIANCE 1e-5

/* Cantelli's one-sided bound (variance shadow maps: Donnelly and Lauritzen 2006): the share of depths that
 * are not below `depth` is at most var / (var + (depth - mean)^2) where depth > mean, and 1 elsewhere. */
double dpl_moments_cantelli(double mean, double mean_square, double depth, double least_variance);

/* Takes away the light that leaks where two blockers overlap: V below `amount` becomes 0, the rest is
 * stretched over 0 .. 1. Darkens penumbrae. 0 <= amount < 1. */
double dpl_moments_reduce_bleeding(double visibility, double amount);

/* Depth z in -1 .. 1 warped twice by exponentials (Lauritzen and McCool 2008), with squares: what an
 * exponential variance map filters. {e^cz, e^2cz, -e^-cz, e^-2cz}. c <= 42 keeps floats finite. */
void dpl_moments_warp(double z, double sharpness, double warped[4]);

/* The tighter of Cantelli's bounds on the two warps. `bias` is the depth whose variance is the least. */
double dpl_moments_warped_visibility(const double warped[4], double depth, double sharpness, double bias);

/* ---- four moments --------------------------------------------------------------------------------- */

/* How much of what a moment bias replaces: enough for the rounding of the numbers that moments are kept in.
 */
#define DPL_MOMENTS_BIAS_FLOAT 3e-7
#define DPL_MOMENTS_BIAS_SUMS 6e-7 /* of 32-bit integers, see moment_table.h */
#define DPL_MOMENTS_BIAS_16 6e-5

/* What the bias moves moments towards (Peters et al. 2017, JCGT 6(1)): 0.375 for floats, 0.628 for 16 bits.
 */
#define DPL_MOMENTS_TARGET_FLOAT 0.375
#define DPL_MOMENTS_TARGET_16 0.628

/* z, z^2, z^3, z^4. Depths lie within -1 .. 1. */
void dpl_moments_of(double z, double b[4]);

/* b = (1 - bias) b + bias (0, target, 0, target): keeps rounded moments possible. */
void dpl_moments_add_bias(double b[4], double bias, double target);

/* The depths and weights of the one distribution with these moments that has a point at z[0] = depth and at
 * most two more. A point at infinity has weight 0 and is given as z[0]. */
typedef struct dpl_moments_points {
    double z[3];
    double weight[3];
} dpl_moments_points;

/* Solves Hamburger's moment problem (Peters and Klein 2015). False when no distribution has these moments to
 * within rounding: add bias first. */
bool dpl_moments_solve(const double b[4], double depth, dpl_moments_points *points);

/* The sharpest upper bound on the share of depths that are not below `depth`: 1 minus the weights below it.
 */
double dpl_moments_visibility(const double b[4], double depth);

/* Mean depth of what lies before `depth`, from one solution, and through `share` how much that is, 0 .. 1
 * (Peters et al. 2017, soft shadows). Without any, `depth` itself. Never bias `depth` for this. */
double dpl_moments_blocker(const double b[4], double depth, double *share);

/* The four moments as numbers within 0 .. 1 whose rounding costs least: odd and even moments apart, two
 * values each. And back. Sources: the sparse transform of Peters et al. 2017. */
void dpl_moments_pack(const double b[4], double packed[4]);
void dpl_moments_unpack(const double packed[4], double b[4]);

/* The same, rounded to 16 bits each. */
void dpl_moments_pack_16(const double b[4], uint16_t packed[4]);
void dpl_moments_unpack_16(const uint16_t packed[4], double b[4]);

#endif
