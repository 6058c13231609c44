/* What every solver shares: its head, its table of functions, and how results reach the caller's buffer. A
 * method is a struct that begins with dpl_solver and a dpl_solver_ops that src/api/solver.c knows. A back end
 * on another processor is one more such table. */
#ifndef DPL_SOLVER_SOLVER_H
#define DPL_SOLVER_SOLVER_H

#include "solver/reuse.h"

#include <dapple/solver.h>

/* Where a solve puts its results: outputs of the picture's size with explicit strides. Cosine and sine have
 * no data where they are not wanted. */
typedef struct dpl_targets {
    dpl_output mean;
    dpl_output cosine;
    dpl_output sine;
} dpl_targets;

typedef struct dpl_solver_ops {
    const char *name;
    size_t bytes;         /* of the method's struct; it is zeroed before `prepare` */
    bool reads_clearance; /* wants the field's distances up to date */
    /* Checks the method's own part of the desc and fills in defaults. */
    dpl_status (*prepare)(dpl_solver *solver);
    /* Lights a measured field and fills stats; refuses targets that it does not know how to fill. */
    dpl_status (*solve)(dpl_solver *solver, const dpl_field *field, const dpl_targets *targets);
    /* Frees buffers, not the struct. */
    void (*release)(dpl_solver *solver);
} dpl_solver_ops;

/* A face of a wall, by the free pixel before it and the way it looks. */
typedef struct dpl_face {
    int32_t x, y;      /* of the world */
    int32_t normal[2]; /* one of (1, 0), (0, 1), (-1, 0), (0, -1) */
} dpl_face;

/* Faces that are to be lit by the solver's lights. */
typedef struct dpl_face_order {
    const dpl_field *field; /* the world that faces are in; not always the caller's */
    double margin;          /* of the caller's world: the picture's origin in it */
    double scale;           /* pixels of that world along a pixel of the caller's */
    const dpl_face *faces;
    int32_t count;
    float (*rgb)[3]; /* receives half of the irradiance, which times albedo is what a face sends out */
} dpl_face_order;

struct dpl_solver {
    const dpl_solver_ops *ops;
    dpl_context *context;
    dpl_solver_desc desc;
    dpl_solver_stats stats;
    dpl_reuse reuse;   /* where the desc asks for it */
    dpl_buffer lights; /* dpl_light each, checked; places are the picture's */
    int32_t light_count;
    /* How a solver that has no way of its own lights faces: src/shadow/, which solvers do not know. Memory
     * that it works in is kept in `face_state`. */
    dpl_status (*light_faces)(dpl_solver *solver, const dpl_face_order *order);
    void *face_state;
};

extern const dpl_solver_ops dpl_cascades_ops;    /* src/cascade/ */
extern const dpl_solver_ops dpl_reference_ops;   /* src/reference/ */
extern const dpl_solver_ops dpl_holographic_ops; /* src/holographic/ */

/* src/reference/: the public function of the same purpose, arguments checked, field measured or not. Pixels
 * are the picture's. */
DPL_MUST_CHECK dpl_status dpl_reference_trace_pixels(dpl_solver *solver, const dpl_field *field,
                                                     const int32_t (*pixels)[2], int32_t count,
                                                     float (*rgb)[3]);

/* Rays counted by workers, each on its own cache line. */
typedef struct dpl_ray_counter {
    int64_t rays;
    char padding[64 - sizeof(int64_t)];
} dpl_ray_counter;

/* Sum over all workers. */
int64_t dpl_ray_counter_sum(const dpl_ray_counter counters[DPL_MAX_THREADS]);

/* Tells the progress hook; DPL_ERROR_CANCELLED when it says stop. */
DPL_MUST_CHECK dpl_status dpl_solver_progress(dpl_solver *solver, double done);

/* Runs work over [0, item_count) and tells the progress hook on the way: `done_before` and `done_after` are
 * the shares of the whole solve before and after this work. */
DPL_MUST_CHECK dpl_status dpl_solver_run(dpl_solver *solver, dpl_task_function function, int32_t item_count,
                                         int32_t min_range, void *task, double done_before,
                                         double done_after);

/* Writes a kept picture, float [y][x][3], to the caller. */
DPL_MUST_CHECK dpl_status dpl_solver_write_picture(const dpl_field *field, const dpl_output *output,
                                                   const float (*picture)[3]);

/* Writes `count` pixels of row y of the picture, from column x on, in the output's format. */
void dpl_solver_write_pixels(const dpl_field *field, const dpl_output *output, int32_t x, int32_t y,
                             int32_t count, const float (*rgb)[3]);

/* Writes row y of the world, which lies in the picture, from three planes of the world's width; what is in
 * the margin is cut off. With `show_emission` opaque pixels get their emission instead. */
void dpl_solver_write_row(const dpl_field *field, const dpl_output *output, int32_t y,
                          const float *const planes[3], bool show_emission);

#endif
