/* Means, ranges and correlations over scenes. Sums run in the order of the scenes. */
#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Reductions that the paper's own program puts into its average, whatever was traced. */
static const double hard_coded[DPL_STUDY_MODES] = {
    [DPL_SKIP_L5] = 0.10, [DPL_SKIP_L4] = 0.17, [DPL_SKIP_L3] = 0.25, [DPL_SKIP_L2] = 0.40};

static const char *const signal_names[DPL_STUDY_SIGNALS] = {[DPL_STUDY_LIGHTS] = "lights",
                                                            [DPL_STUDY_SCORE] = "mean_stddev",
                                                            [DPL_STUDY_MEAN] = "mean",
                                                            [DPL_STUDY_STDDEV] = "stddev",
                                                            [DPL_STUDY_NON_ZERO] = "non_zero",
                                                            [DPL_STUDY_PEAK] = "peak_to_average",
                                                            [DPL_STUDY_BANDWIDTH] = "bandwidth90"};

static const char *const quality_names[DPL_STUDY_QUALITIES] = {"psnr_display", "psnr_linear"};

const char *dpl_study_signal_name(dpl_study_signal signal) {
    return signal_names[signal];
}

const char *dpl_study_quality_name(dpl_study_quality quality) {
    return quality_names[quality];
}

double dpl_study_signal_value(const dpl_study_scene_record *record, dpl_study_profile profile,
                              dpl_study_signal signal) {
    const dpl_signals *signals = &record->profiles[profile].signals;
    const double values[DPL_STUDY_SIGNALS] = {[DPL_STUDY_LIGHTS] = record->lights,
                                              [DPL_STUDY_SCORE] = signals->score,
                                              [DPL_STUDY_MEAN] = signals->mean,
                                              [DPL_STUDY_STDDEV] = signals->stddev,
                                              [DPL_STUDY_NON_ZERO] = signals->non_zero,
                                              [DPL_STUDY_PEAK] = signals->peak_to_average,
                                              [DPL_STUDY_BANDWIDTH] = signals->bandwidth90};
    return values[signal];
}

static double share_left_out(int64_t traced, int64_t full) {
    return 1.0 - (double)traced / (double)full;
}

double dpl_study_reduction(const dpl_study_mode_record *record) {
    return share_left_out(record->traced, record->full);
}

dpl_study_spread dpl_study_spread_of(const double *values, int32_t count) {
    dpl_study_spread spread = {.min = INFINITY, .max = -INFINITY};
    double sum = 0;
    for (int32_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            spread.infinite++;
            continue;
        }
        spread.finite++;
        sum += values[i];
        spread.min = fmin(spread.min, values[i]);
        spread.max = fmax(spread.max, values[i]);
    }
    if (spread.finite == 0)
        spread.min = spread.max = NAN;
    spread.mean = spread.finite > 0 ? sum / spread.finite : NAN;
    return spread;
}

/* A number of a run, by its place in the struct. */
static double *collect(const dpl_study_scene_record *records, int32_t count, dpl_study_profile profile,
                       int mode, size_t offset, double *values) {
    for (int32_t i = 0; i < count; i++)
        memcpy(&values[i], (const char *)&records[i].profiles[profile].modes[mode] + offset,
               sizeof values[i]);
    return values;
}

static void spread_errors(const dpl_study_scene_record *records, int32_t count, dpl_study_profile profile,
                          int mode, double *values, dpl_study_mode_statistics *statistics) {
    const struct {
        size_t offset;
        dpl_study_spread *spread;
    } rows[] = {
        {offsetof(dpl_study_mode_record, display_off), &statistics->display_off},
        {offsetof(dpl_study_mode_record, linear_off), &statistics->linear_off},
        {offsetof(dpl_study_mode_record, display_truth), &statistics->display_truth},
        {offsetof(dpl_study_mode_record, linear_truth), &statistics->linear_truth},
        {offsetof(dpl_study_mode_record, rel_rmse_truth), &statistics->rel_rmse_truth},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        *rows[i].spread =
            dpl_study_spread_of(collect(records, count, profile, mode, rows[i].offset, values), count);
}

static void count_rays(const dpl_study_scene_record *records, int32_t count, dpl_study_profile profile,
                       int mode, dpl_study_mode_statistics *statistics) {
    double traced = 0, with_signal = 0, dropped = 0;
    for (int32_t i = 0; i < count; i++) {
        const dpl_study_mode_record *record = &records[i].profiles[profile].modes[mode];
        traced += dpl_study_reduction(record);
        with_signal += share_left_out(record->traced + record->signal_rays, record->full);
        dropped += share_left_out(record->dropped, record->full);
        statistics->changed += record->same == 0;
        statistics->below += !(record->display_off > DPL_STUDY_BAR_DB);
    }
    statistics->reduction = traced / count;
    statistics->reduction_signal = with_signal / count;
    statistics->reduction_dropped = dpl_study_has_dropped(profile) ? dropped / count : (double)NAN;
}

static void count_choices(const dpl_study_scene_record *records, int32_t count, dpl_study_profile profile,
                          dpl_study_statistics *statistics) {
    for (int32_t i = 0; i < count; i++) {
        int32_t used = records[i].profiles[profile].modes[DPL_SKIP_AUTO].used;
        statistics->chosen[used]++;
        statistics->hard_coded += hard_coded[used] / count;
    }
}

/* Scenes whose PSNR is infinite take no part. */
static dpl_status correlate(const dpl_study_scene_record *records, int32_t count, dpl_study_profile profile,
                            double *scratch, dpl_study_statistics *statistics) {
    double *x = scratch, *y = scratch + count;
    for (int s = 0; s < DPL_STUDY_SIGNALS; s++)
        for (int q = 0; q < DPL_STUDY_QUALITIES; q++) {
            dpl_correlation *result = &statistics->correlations[s][q];
            int32_t pairs = 0;
            for (int32_t i = 0; i < count; i++) {
                const dpl_study_mode_record *record = &records[i].profiles[profile].modes[DPL_SKIP_L2];
                double quality = q == DPL_STUDY_DISPLAY ? record->display_off : record->linear_off;
                if (!isfinite(quality))
                    continue;
                x[pairs] = dpl_study_signal_value(&records[i], profile, (dpl_study_signal)s);
                y[pairs++] = quality;
            }
            *result = (dpl_correlation){.low = -1, .high = 1, .p = 1, .count = pairs};
            dpl_status status = pairs < 2 ? DPL_OK : dpl_correlate(x, y, pairs, result);
            if (status != DPL_OK)
                return status;
        }
    return DPL_OK;
}

dpl_status dpl_study_statistics_of(const dpl_study_scene_record *records, int32_t count,
                                   dpl_study_profile profile, dpl_study_statistics *statistics) {
    memset(statistics, 0, sizeof *statistics);
    statistics->scenes = count;
    statistics->levels = records[0].profiles[profile].levels;
    double *scratch = malloc(2 * (size_t)count * sizeof *scratch);
    if (!scratch)
        return DPL_ERROR_MEMORY;
    for (int m = 0; m < DPL_STUDY_MODES; m++) {
        spread_errors(records, count, profile, m, scratch, &statistics->modes[m]);
        count_rays(records, count, profile, m, &statistics->modes[m]);
    }
    count_choices(records, count, profile, statistics);
    dpl_status status = correlate(records, count, profile, scratch, statistics);
    free(scratch);
    return status;
}
