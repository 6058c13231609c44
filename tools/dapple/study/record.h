/* What is known about a scene once it has been run, and the list of its numbers by name, which the journal
 * is written and read by. Used by everything in this folder. */
#ifndef DPL_STUDY_RECORD_H
#define DPL_STUDY_RECORD_H

#include "plan.h"

#include <dapple/signal.h>
#include <stddef.h>
#include <stdint.h>

/* One run: a scene in a profile and a mode. "off" is the same profile with nothing skipped, "truth" the
 * reference: the two are never compared with each other. */
typedef struct dpl_study_mode_record {
    int32_t used;          /* dpl_skip_mode: the chosen one for DPL_SKIP_AUTO */
    int64_t full;          /* rays if nothing were skipped */
    int64_t traced;        /* rays counted */
    int64_t signal_rays;   /* counted beside them, for the signals alone */
    int64_t dropped;       /* rays counted with dead ones dropped; -1 where there is no such run */
    int32_t same;          /* 1: dropping left every bit of the picture as it was; 0: not; -1: no such run */
    double display_off;    /* psnr_display vs off, all pixels [dB]; INFINITY when equal */
    double linear_off;     /* psnr_linear vs off, free pixels, peak: largest value of the off picture [dB] */
    double display_truth;  /* psnr_display vs truth, its pixels [dB] */
    double linear_truth;   /* psnr_linear vs truth, its pixels, peak 1 [dB] */
    double rel_rmse_truth; /* rel_rmse vs truth, its pixels */
    double ms;             /* wall time of the solve */
    double dropped_ms;     /* of the run without dead rays; 0 where there is none */
} dpl_study_mode_record;

typedef struct dpl_study_profile_record {
    int32_t levels;           /* of the cascades */
    dpl_signals signals;      /* with nothing skipped */
    dpl_signals auto_signals; /* as DPL_SKIP_AUTO saw them */
    dpl_study_mode_record modes[DPL_STUDY_MODES];
} dpl_study_profile_record;

typedef struct dpl_study_scene_record {
    uint64_t seed;
    int32_t index; /* 0 .. 49 */
    int32_t lights;
    int32_t occluders;
    int32_t truth_pixels; /* fewer than asked for when the scene has fewer free pixels */
    int32_t threads;
    double draw_ms;  /* both fields */
    double truth_ms; /* all of the truth */
    double total_ms; /* everything done for the scene */
    dpl_study_profile_record profiles[DPL_STUDY_PROFILES];
} dpl_study_scene_record;

typedef enum dpl_study_field_kind {
    DPL_STUDY_INT32,
    DPL_STUDY_INT64,
    DPL_STUDY_UINT64,
    DPL_STUDY_DOUBLE
} dpl_study_field_kind;

/* One number of a record. */
typedef struct dpl_study_record_field {
    const char *name;
    dpl_study_field_kind kind;
    size_t offset; /* in the struct that the list belongs to [byte] */
} dpl_study_record_field;

/* Numbers of a whole scene record. */
int dpl_study_record_size(void);

/* Calls `visit` with each number of a record, in a fixed order, until it returns false; false then. `where`
 * is the profile and mode as a prefix ("paper.L4."), "" for the scene's own numbers. */
bool dpl_study_record_each(dpl_study_scene_record *record,
                           bool (*visit)(const char *where, const dpl_study_record_field *field, void *value,
                                         void *user),
                           void *user);

#endif
