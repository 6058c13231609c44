/* Lights one scene by every method that can, and measures error against the truth, time and memory. Used by
 * main.c and report.c. */
#ifndef DPL_BENCH_CHOOSING_JUDGE_H
#define DPL_BENCH_CHOOSING_JUDGE_H

#include "../common/memory.h"
#include "../common/summary.h"
#include "method.h"

#define DPL_BENCH_CHOOSING_ROUNDS_MAX 99

typedef struct dpl_bench_choosing_plan {
    uint64_t seed;      /* of scenes and pixels */
    int32_t size;       /* of a scene [px] */
    int32_t pixels;     /* judged per scene */
    int32_t directions; /* of tracers; the truth has its own */
    int32_t truth;      /* directions of the truth */
    int32_t rounds;     /* timed */
    int32_t threads;
} dpl_bench_choosing_plan;

/* A scene of a family. */
typedef struct dpl_bench_choosing_scene {
    const char *family;
    int32_t index;
    const char *what; /* for the report */
} dpl_bench_choosing_scene;

/* One method in one scene. */
typedef struct dpl_bench_choosing_score {
    bool there; /* false: the method cannot light this scene */
    double rel_rmse;
    double psnr_display;      /* [dB] */
    double scale;             /* that the picture was multiplied by; 1 for methods with a unit */
    double prepare_ms;        /* processor time of making it and handing the scene over, once */
    dpl_bench_summary cpu_ms; /* of a picture, summed over threads */
    int64_t bytes;            /* that the method held at most, besides the field */
} dpl_bench_choosing_score;

/* Fills a score for each method. */
bool dpl_bench_choosing_judge(const dpl_bench_choosing_plan *plan, const dpl_bench_choosing_scene *which,
                              dpl_bench_choosing_score scores[DPL_BENCH_CHOOSING_METHODS], dpl_error *error);

#endif
