/* Prints the tables. Decimals are fixed, so that the same results are the same bytes. */
#include "csv.h"

#include "folder_file.h"
#include "headline.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const char *mode_name(int mode) {
    return dpl_skip_mode_name((dpl_skip_mode)mode);
}

/* A comma and a number: "inf" for INFINITY, nothing for NAN. */
static void put(FILE *stream, double value, int decimals) {
    if (isnan(value))
        fputc(',', stream);
    else
        fprintf(stream, isinf(value) ? ",inf" : ",%.*f", decimals, value);
}

static void put_spread(FILE *stream, const dpl_study_spread *spread, int decimals) {
    put(stream, spread->min, decimals);
    put(stream, spread->mean, decimals);
    put(stream, spread->max, decimals);
    fprintf(stream, ",%d", (int)spread->infinite);
}

static void print_result(FILE *stream, const dpl_study_scene_record *scene, dpl_study_profile profile,
                         int mode) {
    const dpl_study_mode_record *record = &scene->profiles[profile].modes[mode];
    const bool off = mode == DPL_SKIP_OFF;
    fprintf(stream, "%" PRIu64 ",%d,%d,%d,%s,%s,%s,%" PRId64 ",%" PRId64, scene->seed, (int)scene->index,
            (int)scene->lights, (int)scene->occluders, dpl_study_profile_name(profile), mode_name(mode),
            mode_name(record->used), record->full, record->traced);
    put(stream, dpl_study_reduction(record), 6);
    fprintf(stream, ",%" PRId64, record->signal_rays);
    if (record->dropped < 0)
        fputs(",,,", stream);
    else
        fprintf(stream, ",%" PRId64 ",%.6f,%d", record->dropped,
                1.0 - (double)record->dropped / (double)record->full, (int)record->same);
    put(stream, off ? (double)NAN : record->display_off, 4);
    put(stream, off ? (double)NAN : record->linear_off, 4);
    put(stream, record->display_truth, 4);
    put(stream, record->linear_truth, 4);
    put(stream, record->rel_rmse_truth, 6);
    fputc('\n', stream);
}

static void print_results(FILE *stream, const void *user) {
    const dpl_study_results *results = user;
    fputs("seed,scene,lights,occluders,profile,mode,used_mode,rays_full,rays_traced,reduction,signal_rays,"
          "rays_traced_dead_dropped,reduction_dead_dropped,same_picture_dead_dropped,"
          "psnr_display_vs_off,psnr_linear_vs_off,psnr_display_vs_truth,psnr_linear_vs_truth,"
          "rel_rmse_vs_truth\n",
          stream);
    for (int32_t i = 0; i < dpl_study_scene_count(results->plan); i++)
        for (int p = 0; p < DPL_STUDY_PROFILES; p++)
            for (int m = 0; m < DPL_STUDY_MODES; m++)
                print_result(stream, &results->records[i], (dpl_study_profile)p, m);
}

static void put_signals(FILE *stream, const dpl_signals *signals) {
    const double values[] = {signals->mean,     signals->stddev,          signals->score,
                             signals->non_zero, signals->peak_to_average, signals->bandwidth90};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        put(stream, values[i], 8);
}

static void print_signals(FILE *stream, const void *user) {
    const dpl_study_results *results = user;
    fputs("seed,scene,lights,occluders,profile,mean,stddev,mean_stddev,non_zero,peak_to_average,bandwidth90,"
          "auto_mode,auto_signal_rays,auto_mean,auto_stddev,auto_mean_stddev,auto_non_zero,"
          "auto_peak_to_average,auto_bandwidth90\n",
          stream);
    for (int32_t i = 0; i < dpl_study_scene_count(results->plan); i++)
        for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
            const dpl_study_scene_record *scene = &results->records[i];
            const dpl_study_profile_record *profile = &scene->profiles[p];
            const dpl_study_mode_record *mode = &profile->modes[DPL_SKIP_AUTO];
            fprintf(stream, "%" PRIu64 ",%d,%d,%d,%s", scene->seed, (int)scene->index, (int)scene->lights,
                    (int)scene->occluders, dpl_study_profile_name((dpl_study_profile)p));
            put_signals(stream, &profile->signals);
            fprintf(stream, ",%s,%" PRId64, mode_name(mode->used), mode->signal_rays);
            put_signals(stream, &profile->auto_signals);
            fputc('\n', stream);
        }
}

/* The first column of tables by seed: a seed, or "all" behind the last one. */
static void put_seed(FILE *stream, const dpl_study_plan *plan, int32_t seed) {
    if (seed == plan->seeds)
        fputs("all", stream);
    else
        fprintf(stream, "%" PRIu64, plan->first_seed + (uint64_t)seed);
}

static const dpl_study_statistics *statistics_of(const dpl_study_results *results, int profile,
                                                 int32_t seed) {
    return seed == results->plan->seeds ? &results->pooled[profile] : &results->seeds[profile][seed];
}

static void print_summary_row(FILE *stream, const dpl_study_statistics *statistics, int mode) {
    const dpl_study_mode_statistics *row = &statistics->modes[mode];
    const bool is_auto = mode == DPL_SKIP_AUTO, off = mode == DPL_SKIP_OFF;
    fprintf(stream, ",%s,%d", mode_name(mode), (int)statistics->scenes);
    put(stream, row->reduction, 6);
    put(stream, is_auto ? row->reduction_signal : (double)NAN, 6);
    put(stream, is_auto ? statistics->hard_coded : (double)NAN, 6);
    put(stream, row->reduction_dropped, 6);
    put(stream, isnan(row->reduction_dropped) ? (double)NAN : row->changed, 0);
    for (int m = DPL_SKIP_L5; m <= DPL_SKIP_L3; m++)
        put(stream, is_auto ? statistics->chosen[m] : (double)NAN, 0);
    put(stream, off ? (double)NAN : row->below, 0);
    if (off)
        fputs(",,,,,,,,", stream);
    else {
        put_spread(stream, &row->display_off, 4);
        put_spread(stream, &row->linear_off, 4);
    }
    put_spread(stream, &row->display_truth, 4);
    put_spread(stream, &row->linear_truth, 4);
    put_spread(stream, &row->rel_rmse_truth, 6);
    fputc('\n', stream);
}

static void print_summary(FILE *stream, const void *user) {
    static const char *const spreads[] = {"psnr_display_vs_off", "psnr_linear_vs_off",
                                          "psnr_display_vs_truth", "psnr_linear_vs_truth",
                                          "rel_rmse_vs_truth"};
    const dpl_study_results *results = user;
    fputs("seed,profile,mode,scenes,reduction,reduction_with_signal_rays,reduction_hard_coded,"
          "reduction_dead_dropped,pictures_changed_dead_dropped,auto_chose_L5,auto_chose_L4,auto_chose_L3,"
          "not_above_50_db_vs_off",
          stream);
    for (size_t i = 0; i < sizeof spreads / sizeof spreads[0]; i++)
        fprintf(stream, ",%s_min,%s_mean,%s_max,%s_infinite", spreads[i], spreads[i], spreads[i], spreads[i]);
    fputc('\n', stream);
    for (int32_t s = 0; s <= results->plan->seeds; s++)
        for (int p = 0; p < DPL_STUDY_PROFILES; p++)
            for (int m = 0; m < DPL_STUDY_MODES; m++) {
                put_seed(stream, results->plan, s);
                fprintf(stream, ",%s", dpl_study_profile_name((dpl_study_profile)p));
                print_summary_row(stream, statistics_of(results, p, s), m);
            }
}

static void print_correlation(FILE *stream, const dpl_study_statistics *statistics, int signal, int quality) {
    const dpl_correlation *found = &statistics->correlations[signal][quality];
    fprintf(stream, ",%s,%s_vs_off,%d,%d", dpl_study_signal_name((dpl_study_signal)signal),
            dpl_study_quality_name((dpl_study_quality)quality), (int)found->count,
            (int)(statistics->scenes - found->count));
    put(stream, found->count < 2 ? (double)NAN : found->r, 6);
    put(stream, found->low, 6);
    put(stream, found->high, 6);
    fprintf(stream, ",%.6g\n", found->p);
}

static void print_correlations(FILE *stream, const void *user) {
    const dpl_study_results *results = user;
    fputs("seed,profile,signal,with_L2_mode,scenes,infinite_left_out,r,low95,high95,p\n", stream);
    for (int32_t s = 0; s <= results->plan->seeds; s++)
        for (int p = 0; p < DPL_STUDY_PROFILES; p++)
            for (int q = 0; q < DPL_STUDY_QUALITIES; q++)
                for (int signal = 0; signal < DPL_STUDY_SIGNALS; signal++) {
                    put_seed(stream, results->plan, s);
                    fprintf(stream, ",%s", dpl_study_profile_name((dpl_study_profile)p));
                    print_correlation(stream, statistics_of(results, p, s), signal, q);
                }
}

static void print_headline(FILE *stream, const dpl_study_results *results, dpl_study_profile profile,
                           dpl_study_headline headline) {
    const dpl_study_headline_row *row = dpl_study_headline_row_of(headline.kind);
    const dpl_study_spread spread = dpl_study_headline_spread(results, profile, headline);
    const char *of = row->index == DPL_STUDY_BY_MODE ? mode_name(headline.index)
                     : row->index == DPL_STUDY_BY_SIGNAL
                         ? dpl_study_signal_name((dpl_study_signal)headline.index)
                         : "";
    fprintf(stream, "%s,%s,%s,%d", dpl_study_profile_name(profile), row->name, of, (int)results->plan->seeds);
    put(stream, spread.min, 6);
    put(stream, spread.mean, 6);
    put(stream, spread.max, 6);
    put(stream, dpl_study_headline_value(&results->pooled[profile], headline), 6);
    fputc('\n', stream);
}

/* One table for each reference: numbers vs off and vs truth never stand in one column. */
static void print_headlines_of(FILE *stream, const dpl_study_results *results, bool vs_truth) {
    fputs("profile,number,of,seeds,min_over_seeds,mean_over_seeds,max_over_seeds,all_scenes\n", stream);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        for (int k = 0; k < DPL_STUDY_HEADLINE_KINDS; k++) {
            const dpl_study_headline_row *row = dpl_study_headline_row_of((dpl_study_headline_kind)k);
            for (int i = row->first; row->vs_truth == vs_truth && i <= row->last; i++)
                print_headline(stream, results, (dpl_study_profile)p,
                               (dpl_study_headline){(dpl_study_headline_kind)k, i});
        }
}

static void print_headlines(FILE *stream, const void *user) {
    print_headlines_of(stream, user, false);
}

static void print_headlines_truth(FILE *stream, const void *user) {
    print_headlines_of(stream, user, true);
}

static void print_below(FILE *stream, const void *user) {
    const dpl_study_results *results = user;
    fputs("seed,scene,lights,occluders,profile,auto_mode,psnr_display_vs_off\n", stream);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        for (int32_t i = 0; i < dpl_study_scene_count(results->plan); i++) {
            const dpl_study_scene_record *scene = &results->records[i];
            const dpl_study_mode_record *mode = &scene->profiles[p].modes[DPL_SKIP_AUTO];
            if (mode->display_off > DPL_STUDY_BAR_DB)
                continue;
            fprintf(stream, "%" PRIu64 ",%d,%d,%d,%s,%s", scene->seed, (int)scene->index, (int)scene->lights,
                    (int)scene->occluders, dpl_study_profile_name((dpl_study_profile)p),
                    mode_name(mode->used));
            put(stream, mode->display_off, 4);
            fputc('\n', stream);
        }
}

bool dpl_study_write_tables(const dpl_study_results *results, dpl_error *error) {
    static const struct {
        const char *name;
        dpl_study_print print;
    } tables[] = {
        {"results.csv", print_results},     {"signals.csv", print_signals},
        {"summary.csv", print_summary},     {"correlations.csv", print_correlations},
        {"headlines.csv", print_headlines}, {"headlines-vs-truth.csv", print_headlines_truth},
        {"below-50-db.csv", print_below},
    };
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++)
        if (!dpl_study_write_file(results->plan->folder, tables[i].name, tables[i].print, results, error))
            return false;
    return true;
}
