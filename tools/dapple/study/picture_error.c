/* Sums of squared differences. The order of the sums is fixed, so that results are too. */
#include "picture_error.h"

#include <math.h>

#define PEAK_DISPLAY 255.0

static double psnr(double mean_squared, double peak) {
    return mean_squared > 0.0 ? 10.0 * log10(peak * peak / mean_squared) : (double)INFINITY;
}

double dpl_study_psnr_display(const uint8_t *test, const uint8_t *reference, size_t bytes) {
    uint64_t sum = 0;
    for (size_t i = 0; i < bytes; i++) {
        const int32_t difference = test[i] - reference[i];
        sum += (uint64_t)(difference * difference);
    }
    return psnr((double)sum / (double)bytes, PEAK_DISPLAY);
}

dpl_study_linear_error dpl_study_compare_linear(const float *test, const float *reference,
                                                const uint8_t *masked, size_t pixels) {
    dpl_study_linear_error error = {0};
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        if (masked && masked[i])
            continue;
        count++;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            const double difference = (double)test[c] - (double)reference[c];
            error.mean_squared += difference * difference;
            error.reference_mean += (double)reference[c];
        }
    }
    error.mean_squared /= 3.0 * (double)count;
    error.reference_mean /= 3.0 * (double)count;
    return error;
}

double dpl_study_psnr_linear(const dpl_study_linear_error *error, double peak) {
    return psnr(error->mean_squared, peak);
}

double dpl_study_rel_rmse(const dpl_study_linear_error *error) {
    if (error->mean_squared == 0.0)
        return 0.0;
    return error->reference_mean > 0.0 ? sqrt(error->mean_squared) / error->reference_mean : (double)INFINITY;
}

double dpl_study_peak(const float *picture, size_t values) {
    float peak = 0.0f;
    for (size_t i = 0; i < values; i++)
        if (picture[i] > peak)
            peak = picture[i];
    return (double)peak;
}
