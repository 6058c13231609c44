/** @file
 * Signals: numbers that describe how light is spread over directions at a probe, from which adaptive ray
 * skipping picks its mode. Source: ARC paper, sections 3.2 to 3.4, and its own code where the text is silent.
 */
#ifndef DAPPLE_SIGNAL_H
#define DAPPLE_SIGNAL_H

#include <dapple/export.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Signals of one ring of directions, or their means over several probes. A black ring gives 0, 0, 0, 0,
 * 1, 1. */
typedef struct dpl_signals {
    double mean;            /**< mean of the samples */
    double stddev;          /**< population standard deviation: sqrt(mean((s - mean)^2)) */
    double score;           /**< mean + stddev: what picks the mode */
    double non_zero;        /**< share of samples above 0.01, 0 .. 1 */
    double peak_to_average; /**< largest sample / mean; 1 when the mean is at most 0.001 */
    double bandwidth90; /**< share of the spectrum that holds 90 % of the energy: with magnitudes M(k) of the
                           discrete Fourier transform, k = 0 .. ceil(n/2)-1, it is (k+1) / ceil(n/2) for the
                           smallest k with sum_{0..k} M^2 >= 0.9 of the sum over all k */
} dpl_signals;

/**
 * Computes the signals of one ring.
 * @param samples radiance per direction, uniformly spaced over the circle (the paper: r + g + b of a stored
 * slot)
 * @param count   1 or more, any number
 * @param signals receives them
 * @return DPL_OK; DPL_ERROR_ARGUMENT (also for a sample that is not finite). Thread-safe.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_signals_of_ring(const double *samples, int32_t count,
                                                      dpl_signals *signals);

#ifdef __cplusplus
}
#endif
#endif
