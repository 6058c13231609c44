/* Statistics over scenes: of one seed, or of all. Used by headline.c, csv.c and the report. */
#ifndef DPL_STUDY_STATISTICS_H
#define DPL_STUDY_STATISTICS_H

#include "record.h"

#include <dapple/correlation.h>

/* What the paper calls visually identical: more than this, vs off [dB]. */
#define DPL_STUDY_BAR_DB 50.0

/* Signals that are correlated with quality: the six of dpl_signals and the number of lights. */
typedef enum dpl_study_signal {
    DPL_STUDY_LIGHTS,
    DPL_STUDY_SCORE,
    DPL_STUDY_MEAN,
    DPL_STUDY_STDDEV,
    DPL_STUDY_NON_ZERO,
    DPL_STUDY_PEAK,
    DPL_STUDY_BANDWIDTH,
    DPL_STUDY_SIGNALS
} dpl_study_signal;

/* What of the L2 mode they are correlated with, both vs off. */
typedef enum dpl_study_quality {
    DPL_STUDY_DISPLAY, /* psnr_display, all pixels: the paper's */
    DPL_STUDY_LINEAR,  /* psnr_linear, free pixels, peak of the off picture */
    DPL_STUDY_QUALITIES
} dpl_study_quality;

/* Smallest, mean and largest of the finite values; all NAN when there is none. */
typedef struct dpl_study_spread {
    int32_t finite;
    int32_t infinite; /* left out */
    double min;
    double mean;
    double max;
} dpl_study_spread;

typedef struct dpl_study_mode_statistics {
    double reduction;         /* mean over scenes of the counted 1 - traced / full */
    double reduction_signal;  /* the same with the rays of the signal counted too */
    double reduction_dropped; /* the same without dead rays; NAN where there are none */
    int32_t changed;          /* pictures that dropping dead rays changed */
    int32_t below;            /* scenes that are not above DPL_STUDY_BAR_DB vs off */
    dpl_study_spread display_off;
    dpl_study_spread linear_off;
    dpl_study_spread display_truth;
    dpl_study_spread linear_truth;
    dpl_study_spread rel_rmse_truth;
} dpl_study_mode_statistics;

/* Of some scenes in one profile. */
typedef struct dpl_study_statistics {
    int32_t scenes;
    int32_t levels; /* of the cascades */
    dpl_study_mode_statistics modes[DPL_STUDY_MODES];
    int32_t chosen[DPL_STUDY_MODES]; /* scenes that auto gave each mode */
    double hard_coded;               /* auto's reduction as the paper computes it: 10, 17 or 25 % a scene */
    dpl_correlation correlations[DPL_STUDY_SIGNALS][DPL_STUDY_QUALITIES];
} dpl_study_statistics;

/* Fills the statistics of `count` scenes (at least 1) in a profile. DPL_ERROR_MEMORY. */
dpl_status dpl_study_statistics_of(const dpl_study_scene_record *records, int32_t count,
                                   dpl_study_profile profile, dpl_study_statistics *statistics);

/* Smallest, mean and largest of some values. */
dpl_study_spread dpl_study_spread_of(const double *values, int32_t count);

/* A signal of a scene in a profile, with nothing skipped. */
double dpl_study_signal_value(const dpl_study_scene_record *record, dpl_study_profile profile,
                              dpl_study_signal signal);

/* "lights", "mean_stddev", "mean", … */
const char *dpl_study_signal_name(dpl_study_signal signal);

/* "psnr_display" or "psnr_linear". */
const char *dpl_study_quality_name(dpl_study_quality quality);

/* Counted 1 - traced / full of one run. */
double dpl_study_reduction(const dpl_study_mode_record *record);

#endif
