/* The judge: truth at chance pixels of a scene, and how far each method is from it. Used by main.c and the
 * reports. */
#ifndef DPL_BENCH_JUDGE_H
#define DPL_BENCH_JUDGE_H

#include "../../image/picture.h"
#include "../../scenes/families.h"
#include "method.h"

#include <dapple/dapple.h>

/* What to judge on. */
typedef struct dpl_bench_trial {
    const dpl_scene_family *family;
    uint64_t seed;      /* of the scenes and of the pixels */
    int32_t count;      /* scenes, from the family's first */
    int32_t size;       /* of a scene [px] */
    int32_t pixels;     /* per scene */
    int32_t directions; /* of the truth, per pixel */
    int32_t bounces;    /* of the truth and of the methods */
    int32_t threads;    /* 0: as many as there are processors */
} dpl_bench_trial;

/* One method in one scene, over the chosen pixels and RGB. */
typedef struct dpl_bench_score {
    double rel_rmse;     /* rms error / mean of the truth */
    double psnr_linear;  /* [dB] */
    double psnr_display; /* [dB] */
    double bias;         /* mean error / mean of the truth */
    double mean_truth;   /* linear radiance */
    int64_t rays;        /* counted by the solver */
    double solve_ms;     /* wall time without the distance field */
    double cpu_ms;       /* processor time of the same, over all threads */
} dpl_bench_score;

/* Zero-initialise; free with dpl_bench_judge_free(). */
typedef struct dpl_bench_judge {
    dpl_context *context;
    dpl_solver *reference;
    dpl_solver *solvers[DPL_BENCH_MAX_METHODS];
    int32_t method_count;
    dpl_picture picture; /* of a method, of the scene's size */
} dpl_bench_judge;

bool dpl_bench_judge_create(const dpl_bench_trial *trial, const dpl_bench_method *methods,
                            int32_t method_count, dpl_bench_judge *judge, dpl_error *error);

void dpl_bench_judge_free(dpl_bench_judge *judge);

/* Judges every method in scene `index`; `scores` has one entry per method. */
bool dpl_bench_judge_scene(dpl_bench_judge *judge, const dpl_bench_trial *trial, int32_t index,
                           dpl_bench_score *scores, dpl_error *error);

#endif
