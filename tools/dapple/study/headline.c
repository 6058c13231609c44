/* The table of headline numbers, and how each is read from statistics. */
#include "headline.h"

#include <math.h>
#include <stdio.h>

#define MODES DPL_STUDY_BY_MODE, false, DPL_SKIP_L5, DPL_SKIP_AUTO
#define MODES_TRUTH DPL_STUDY_BY_MODE, true, DPL_SKIP_OFF, DPL_SKIP_AUTO
#define SIGNALS DPL_STUDY_BY_SIGNAL, false, 0, DPL_STUDY_SIGNALS - 1
#define ALONE DPL_STUDY_BY_NOTHING, false, 0, 0

static const dpl_study_headline_row rows[DPL_STUDY_HEADLINE_KINDS] = {
    [DPL_STUDY_LEVELS] = {"levels", DPL_STUDY_COUNT, ALONE},
    [DPL_STUDY_REDUCTION] = {"reduction", DPL_STUDY_PERCENT, MODES},
    [DPL_STUDY_REDUCTION_SIGNAL] = {"reduction_with_signal_rays", DPL_STUDY_PERCENT, DPL_STUDY_BY_MODE, false,
                                    DPL_SKIP_AUTO, DPL_SKIP_AUTO},
    [DPL_STUDY_REDUCTION_DROPPED] = {"reduction_dead_rays_dropped", DPL_STUDY_PERCENT, MODES},
    [DPL_STUDY_CHANGED] = {"pictures_changed_by_dropping", DPL_STUDY_SCENES, MODES},
    [DPL_STUDY_HARD_CODED] = {"reduction_hard_coded", DPL_STUDY_PERCENT, ALONE},
    [DPL_STUDY_PSNR_MIN] = {"psnr_display_vs_off_min", DPL_STUDY_DB, MODES},
    [DPL_STUDY_PSNR_MEAN] = {"psnr_display_vs_off_mean", DPL_STUDY_DB, MODES},
    [DPL_STUDY_PSNR_MAX] = {"psnr_display_vs_off_max", DPL_STUDY_DB, MODES},
    [DPL_STUDY_BELOW] = {"scenes_not_above_50_db", DPL_STUDY_SCENES, MODES},
    [DPL_STUDY_CHOSEN] = {"scenes_given_mode", DPL_STUDY_SCENES, DPL_STUDY_BY_MODE, false, DPL_SKIP_L5,
                          DPL_SKIP_L3},
    [DPL_STUDY_R_DISPLAY] = {"r_with_psnr_display_vs_off", DPL_STUDY_R, SIGNALS},
    [DPL_STUDY_R_LINEAR] = {"r_with_psnr_linear_vs_off", DPL_STUDY_R, SIGNALS},
    [DPL_STUDY_TRUTH_DISPLAY] = {"psnr_display_vs_truth_mean", DPL_STUDY_DB, MODES_TRUTH},
    [DPL_STUDY_TRUTH_RMSE] = {"rel_rmse_vs_truth_mean", DPL_STUDY_RATIO, MODES_TRUTH},
};

const dpl_study_headline_row *dpl_study_headline_row_of(dpl_study_headline_kind kind) {
    return &rows[kind];
}

const dpl_correlation *dpl_study_headline_correlation(const dpl_study_statistics *statistics,
                                                      dpl_study_headline headline) {
    if (headline.kind == DPL_STUDY_R_DISPLAY)
        return &statistics->correlations[headline.index][DPL_STUDY_DISPLAY];
    if (headline.kind == DPL_STUDY_R_LINEAR)
        return &statistics->correlations[headline.index][DPL_STUDY_LINEAR];
    return NULL;
}

static double mode_value(const dpl_study_statistics *statistics, dpl_study_headline headline) {
    const dpl_study_mode_statistics *mode = &statistics->modes[headline.index];
    const double scenes = statistics->scenes;
    switch (headline.kind) {
    case DPL_STUDY_REDUCTION:
        return mode->reduction;
    case DPL_STUDY_REDUCTION_SIGNAL:
        return mode->reduction_signal;
    case DPL_STUDY_REDUCTION_DROPPED:
        return mode->reduction_dropped;
    case DPL_STUDY_CHANGED:
        return isnan(mode->reduction_dropped) ? (double)NAN : mode->changed / scenes;
    case DPL_STUDY_PSNR_MIN:
        return mode->display_off.min;
    case DPL_STUDY_PSNR_MEAN:
        return mode->display_off.mean;
    case DPL_STUDY_PSNR_MAX:
        return mode->display_off.max;
    case DPL_STUDY_BELOW:
        return mode->below / scenes;
    case DPL_STUDY_CHOSEN:
        return statistics->chosen[headline.index] / scenes;
    case DPL_STUDY_TRUTH_DISPLAY:
        return mode->display_truth.mean;
    case DPL_STUDY_TRUTH_RMSE:
        return mode->rel_rmse_truth.mean;
    default:
        return (double)NAN;
    }
}

double dpl_study_headline_value(const dpl_study_statistics *statistics, dpl_study_headline headline) {
    const dpl_correlation *correlation = dpl_study_headline_correlation(statistics, headline);
    if (correlation)
        return correlation->count < 2 ? (double)NAN : correlation->r;
    if (headline.kind == DPL_STUDY_LEVELS)
        return statistics->levels;
    if (headline.kind == DPL_STUDY_HARD_CODED)
        return statistics->hard_coded;
    return mode_value(statistics, headline);
}

dpl_study_spread dpl_study_headline_spread(const dpl_study_results *results, dpl_study_profile profile,
                                           dpl_study_headline headline) {
    double values[DPL_STUDY_SEEDS_MAX];
    for (int32_t s = 0; s < results->plan->seeds; s++)
        values[s] = dpl_study_headline_value(&results->seeds[profile][s], headline);
    return dpl_study_spread_of(values, results->plan->seeds);
}

double dpl_study_headline_overall(const dpl_study_results *results, dpl_study_profile profile,
                                  dpl_study_headline headline) {
    if (dpl_study_headline_correlation(&results->pooled[profile], headline))
        return dpl_study_headline_value(&results->pooled[profile], headline);
    return dpl_study_headline_spread(results, profile, headline).mean;
}

void dpl_study_format_value(double value, dpl_study_unit unit, char *text, size_t size) {
    if (isnan(value)) {
        snprintf(text, size, "–");
        return;
    }
    switch (unit) {
    case DPL_STUDY_COUNT:
        snprintf(text, size, "%.0f", value);
        return;
    case DPL_STUDY_PERCENT:
    case DPL_STUDY_SCENES:
        snprintf(text, size, "%.1f\u00a0%%", 100 * value);
        return;
    case DPL_STUDY_DB:
        snprintf(text, size, "%.1f\u00a0dB", value);
        return;
    case DPL_STUDY_R:
        snprintf(text, size, "%.2f", value);
        return;
    case DPL_STUDY_RATIO:
        snprintf(text, size, "%.4f", value);
        return;
    }
}

/* One value of a number, of all scenes or of one seed's. */
static void format_of(double value, dpl_study_unit unit, int32_t scenes, char *text, size_t size) {
    if (unit == DPL_STUDY_SCENES && !isnan(value))
        snprintf(text, size, "%.0f of %d", value * scenes, (int)scenes);
    else
        dpl_study_format_value(value, unit, text, size);
}

void dpl_study_headline_format(const dpl_study_results *results, dpl_study_profile profile,
                               dpl_study_headline headline, char text[DPL_STUDY_TEXT_MAX]) {
    const dpl_study_unit unit = rows[headline.kind].unit;
    const dpl_study_plan *plan = results->plan;
    const double value = dpl_study_headline_overall(results, profile, headline);
    const dpl_correlation *all = dpl_study_headline_correlation(&results->pooled[profile], headline);
    const dpl_study_spread spread = dpl_study_headline_spread(results, profile, headline);
    char overall[32], interval[48] = "", low[32], high[32];
    format_of(value, unit, dpl_study_scene_count(plan), overall, sizeof overall);
    if (all && !isnan(value))
        snprintf(interval, sizeof interval, " [%.2f,\u00a0%.2f]", all->low, all->high);
    if (plan->seeds == 1 || !(spread.min < spread.max)) {
        snprintf(text, DPL_STUDY_TEXT_MAX, "%s%s", overall, interval);
        return;
    }
    format_of(spread.min, unit, plan->scenes, low, sizeof low);
    format_of(spread.max, unit, plan->scenes, high, sizeof high);
    snprintf(text, DPL_STUDY_TEXT_MAX, "%s%s (seeds %s to %s)", overall, interval, low, high);
}
