/* The methods to choose from, as data, and how each lights a scene. Used by judge.c and report.c. */
#ifndef DPL_BENCH_CHOOSING_METHOD_H
#define DPL_BENCH_CHOOSING_METHOD_H

#include "../../image/error.h"
#include "../../scenes/scene_flood.h"

#include <dapple/dapple.h>

/* A scene in each of the forms that methods want. */
typedef struct dpl_bench_stand {
    dpl_context *context;
    dpl_scene scene;    /* its disc light, if it has one, is an opaque disc that emits */
    dpl_field *field;   /* of that scene */
    dpl_field *unlit;   /* the same without the disc, for shadows; NULL where the scene has no disc light */
    dpl_light light;    /* that disc */
    int32_t directions; /* of tracers */
    dpl_scene_flood flood;
    dpl_solver *solver;
    dpl_tracer *tracer;
    dpl_shadow *shadow;
} dpl_bench_stand;

typedef struct dpl_bench_method dpl_bench_method;

struct dpl_bench_method {
    const char *name; /* as tables spell it, without commas */
    int variant;      /* of the kind: which tracer, merge, storage or shadow */
    bool disc_only;   /* lights scenes with one disc light only */
    bool scaled;      /* has no unit of its own: its scale is fitted to the truth */
    /* Makes what lights and hands the scene over. */
    dpl_status (*prepare)(dpl_bench_stand *stand, const dpl_bench_method *method);
    /* Lights the picture. */
    dpl_status (*light)(dpl_bench_stand *stand, const dpl_output *output);
};

#define DPL_BENCH_CHOOSING_METHODS 9

extern const dpl_bench_method dpl_bench_choosing_methods[DPL_BENCH_CHOOSING_METHODS];

/* Frees what the last prepare() has made. */
void dpl_bench_stand_clear(dpl_bench_stand *stand);

#endif
