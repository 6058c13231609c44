/* Signals of a ring of directions: how light is spread over them. Called by whoever picks a skip mode, and by
 * studies of what predicts the error of skipping. Needs no memory, so it needs no context. */
#include <dapple/signal.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static const double PI = 3.14159265358979323846;

#define NON_ZERO_ABOVE 0.01  /* the paper's code: darker samples count as black */
#define AVERAGE_ABOVE 0.001  /* the paper's code: a darker ring has no peak */
#define ENERGY_SHARE 0.9     /* of the spectrum, for bandwidth90 */
#define ENERGY_ROUNDING 1e-9 /* of the energy: what is exactly 90 % on paper must not hang on rounding */

/* Samples are read times a power of two that brings the largest near 1: no finite ring overflows when it is
 * squared, and nothing is rounded by it. */
typedef struct ring {
    const double *samples;
    int32_t count;
    double scale;
} ring;

static double ring_sample(const ring *r, int32_t j) {
    return r->samples[j] * r->scale;
}

static bool all_finite(const double *samples, int32_t count) {
    for (int32_t j = 0; j < count; j++)
        if (!isfinite(samples[j]))
            return false;
    return true;
}

static double scale_for(const double *samples, int32_t count) {
    double largest = 0.0;
    for (int32_t j = 0; j < count; j++)
        largest = fmax(largest, fabs(samples[j]));
    int exponent = 0;
    (void)frexp(largest, &exponent);
    /* Within what has a normal number as inverse: the results are divided by the scale again. */
    const int limit = 1000;
    return ldexp(1.0, exponent > limit ? -limit : exponent < -limit ? limit : -exponent);
}

/* ---- moments -------------------------------------------------------------------------------------- */

/* Counted from the first sample: a constant ring has exactly its constant as mean, and deviation 0. */
static double ring_mean(const ring *r) {
    const double first = ring_sample(r, 0);
    double sum = 0.0;
    for (int32_t j = 1; j < r->count; j++)
        sum += ring_sample(r, j) - first;
    return first + sum / r->count;
}

static double ring_stddev(const ring *r, double mean) {
    double sum = 0.0;
    for (int32_t j = 0; j < r->count; j++) {
        const double deviation = ring_sample(r, j) - mean;
        sum += deviation * deviation;
    }
    return sqrt(sum / r->count);
}

static double share_above(const double *samples, int32_t count, double threshold) {
    int32_t above = 0;
    for (int32_t j = 0; j < count; j++)
        above += samples[j] > threshold;
    return (double)above / count;
}

static double peak_to_average(const double *samples, int32_t count, double mean) {
    if (mean <= AVERAGE_ABOVE)
        return 1.0;
    double peak = samples[0];
    for (int32_t j = 1; j < count; j++)
        peak = fmax(peak, samples[j]);
    return peak / mean;
}

/* ---- spectrum ------------------------------------------------------------------------------------- */

/* M(k)^2. The angle turns by a product per sample: no table, and after some thousand samples it is still
 * within 1e-12 of where it should be. */
static double energy_at(const ring *r, int32_t k) {
    const double step = 2.0 * PI * ((double)k / r->count);
    const double step_cosine = cos(step), step_sine = sin(step);
    double cosine = 1.0, sine = 0.0, real = 0.0, imaginary = 0.0;
    for (int32_t j = 0; j < r->count; j++) {
        const double sample = ring_sample(r, j);
        real += sample * cosine;
        imaginary += sample * sine;
        const double turned = cosine * step_cosine - sine * step_sine;
        sine = sine * step_cosine + cosine * step_sine;
        cosine = turned;
    }
    return real * real + imaginary * imaginary;
}

/* Sum of M(k)^2 over k = 0 .. ceil(n/2)-1, without the spectrum: Parseval gives the sum over all n bins, bins
 * k and n - k are equal, bin 0 stands alone, and so does bin n/2 of an even ring, which is left out. Returns
 * 0 when nothing but rounding is left. */
static double energy_of_half(const ring *r) {
    double squares = 0.0, sum = 0.0, alternating = 0.0;
    for (int32_t j = 0; j < r->count; j++) {
        const double sample = ring_sample(r, j);
        squares += sample * sample;
        sum += sample;
        alternating += j % 2 == 0 ? sample : -sample;
    }
    if (r->count % 2 != 0)
        alternating = 0.0;
    const double all = squares * r->count;
    const double half = 0.5 * (all + sum * sum - alternating * alternating);
    return half > ENERGY_ROUNDING * all ? half : 0.0;
}

static double bandwidth90(const ring *r) {
    const int32_t bins = r->count / 2 + r->count % 2;
    const double total = energy_of_half(r);
    if (total <= 0.0)
        return 1.0;
    const double wanted = (ENERGY_SHARE - ENERGY_ROUNDING) * total;
    double energy = 0.0;
    int32_t k = 0;
    for (; k < bins - 1; k++) { /* the last bin is the answer where no earlier one is */
        energy += energy_at(r, k);
        if (energy >= wanted)
            break;
    }
    return (double)(k + 1) / bins;
}

dpl_status dpl_signals_of_ring(const double *samples, int32_t count, dpl_signals *signals) {
    if (!samples || count < 1 || !signals || !all_finite(samples, count))
        return DPL_ERROR_ARGUMENT;
    const ring scaled = {.samples = samples, .count = count, .scale = scale_for(samples, count)};
    const double scaled_mean = ring_mean(&scaled);
    const double mean = scaled_mean / scaled.scale;
    const double stddev = ring_stddev(&scaled, scaled_mean) / scaled.scale;
    *signals = (dpl_signals){
        .mean = mean,
        .stddev = stddev,
        .score = mean + stddev,
        .non_zero = share_above(samples, count, NON_ZERO_ABOVE),
        .peak_to_average = peak_to_average(samples, count, mean),
        .bandwidth90 = bandwidth90(&scaled),
    };
    return DPL_OK;
}
