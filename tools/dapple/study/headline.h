/* Headline numbers: single values of a study that can be put beside the paper's, each with its spread over
 * seeds. Used by claims.c, csv.c and the report. */
#ifndef DPL_STUDY_HEADLINE_H
#define DPL_STUDY_HEADLINE_H

#include "results.h"

/* What kind of number; those of a mode or signal come with its index. */
typedef enum dpl_study_headline_kind {
    DPL_STUDY_LEVELS,
    DPL_STUDY_REDUCTION,         /* of a mode, counted */
    DPL_STUDY_REDUCTION_SIGNAL,  /* the same, the signal's own rays counted too */
    DPL_STUDY_REDUCTION_DROPPED, /* the same, dead rays dropped */
    DPL_STUDY_CHANGED,           /* share of pictures that dropping them changed */
    DPL_STUDY_HARD_CODED,        /* auto's reduction as the paper computes it */
    DPL_STUDY_PSNR_MIN,          /* psnr_display vs off of a mode */
    DPL_STUDY_PSNR_MEAN,
    DPL_STUDY_PSNR_MAX,
    DPL_STUDY_BELOW,         /* share of scenes at or below 50 dB vs off in a mode */
    DPL_STUDY_CHOSEN,        /* share of scenes that auto gives a mode */
    DPL_STUDY_R_DISPLAY,     /* correlation of a signal with psnr_display of L2 vs off */
    DPL_STUDY_R_LINEAR,      /* the same with psnr_linear */
    DPL_STUDY_TRUTH_DISPLAY, /* mean psnr_display vs truth of a mode */
    DPL_STUDY_TRUTH_RMSE,    /* mean rel_rmse vs truth of a mode */
    DPL_STUDY_HEADLINE_KINDS
} dpl_study_headline_kind;

/* How a number is printed. */
typedef enum dpl_study_unit {
    DPL_STUDY_COUNT,
    DPL_STUDY_PERCENT, /* the value is a share: 0.2 is 20 % */
    DPL_STUDY_SCENES,  /* a share of the scenes, printed as how many of how many */
    DPL_STUDY_DB,
    DPL_STUDY_R,
    DPL_STUDY_RATIO
} dpl_study_unit;

/* What an index of a kind means. */
typedef enum dpl_study_index { DPL_STUDY_BY_NOTHING, DPL_STUDY_BY_MODE, DPL_STUDY_BY_SIGNAL } dpl_study_index;

typedef struct dpl_study_headline_row {
    const char *name; /* as files spell it */
    dpl_study_unit unit;
    dpl_study_index index;
    bool vs_truth;
    int first; /* indices that the number is worth having for */
    int last;
} dpl_study_headline_row;

typedef struct dpl_study_headline {
    dpl_study_headline_kind kind;
    int index; /* dpl_skip_mode, dpl_study_signal, or 0 */
} dpl_study_headline;

const dpl_study_headline_row *dpl_study_headline_row_of(dpl_study_headline_kind kind);

/* Of some statistics. NAN when there is no such number. */
double dpl_study_headline_value(const dpl_study_statistics *statistics, dpl_study_headline headline);

/* What stands in reports: the value of all scenes together for a correlation, else the mean over seeds. */
double dpl_study_headline_overall(const dpl_study_results *results, dpl_study_profile profile,
                                  dpl_study_headline headline);

/* Over the seeds. */
dpl_study_spread dpl_study_headline_spread(const dpl_study_results *results, dpl_study_profile profile,
                                           dpl_study_headline headline);

/* The correlation behind a number, or NULL. */
const dpl_correlation *dpl_study_headline_correlation(const dpl_study_statistics *statistics,
                                                      dpl_study_headline headline);

/* Prints a value with its unit: "20.0 %", "55.2 dB". */
void dpl_study_format_value(double value, dpl_study_unit unit, char *text, size_t size);

/* Longest text of dpl_study_headline_format(). */
#define DPL_STUDY_TEXT_MAX 160

/* Prints the overall value, with an interval for a correlation and the range over seeds when there are
 * several. */
void dpl_study_headline_format(const dpl_study_results *results, dpl_study_profile profile,
                               dpl_study_headline headline, char text[DPL_STUDY_TEXT_MAX]);

#endif
