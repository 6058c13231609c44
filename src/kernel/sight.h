/* What the scalar reference and the vector kernels of shadows share, which must agree to the bit: constants
 * of ray maps and of covered discs, and how a map is drawn. Polynomials by interpolation at Chebyshev's
 * nodes, highest last. */
#ifndef DPL_KERNEL_SIGHT_H
#define DPL_KERNEL_SIGHT_H

#include <stdint.h>

/* atan(x) / x in x^2, |x| <= 1: within 5.2e-6. */
#define ATAN_0 0.99999483f
#define ATAN_1 (-0.33295711f)
#define ATAN_2 0.19534659f
#define ATAN_3 (-0.12044859f)
#define ATAN_4 0.05658999f
#define ATAN_5 (-0.01313038f)

/* acos(x) / sqrt(1 - x) in x, 0 <= x <= 1: within 6.8e-5 of the angle (Abramowitz and Stegun 4.4.45). */
#define ACOS_0 1.5707288f
#define ACOS_1 (-0.2121144f)
#define ACOS_2 0.0742610f
#define ACOS_3 (-0.0187293f)

/* asin(x) / x in x^2, |x| <= 0.667: within 3.2e-5. */
#define ASIN_0 0.99997955f
#define ASIN_1 0.16812003f
#define ASIN_2 0.05962785f
#define ASIN_3 0.09208807f

/* 1 / sqrt(1 - x^2) in x^2, |x| <= 0.667: within 3.8e-4. */
#define SLANT_0 0.99977699f
#define SLANT_1 0.51581418f
#define SLANT_2 0.20970590f
#define SLANT_3 0.80690828f

/* Half a pixel's side, and a little more, so that no ray slips through where two pixels meet [px]. */
#define HALF_SIDE 0.501f
/* A pixel at the disc's rim is met along the whole ray: it counts as if it were this far along, squared
 * [px^2].
 */
#define LEAST_ALONG 0.25f

/* A disc is too wide when one of its sides runs less than this along, per length. */
#define LEAST_SIDE 0.2f
/* Stands for no bound of a slope. */
#define STEEPEST 1e30f

#define SIGHT_PI 3.14159265f
#define SIGHT_HALF_PI 1.57079633f

/* The nearer of what is there and `square`, over a stretch of directions. */
static inline void draw_stretch(float *reach, int32_t mask, int32_t begin, int32_t end, float square) {
    for (int32_t bin = begin; bin < end; bin++)
        reach[bin & mask] = reach[bin & mask] < square ? reach[bin & mask] : square;
}

#endif
