/* What a study does, as data: its arguments, the two profiles, the modes, and the solver of each run. Used by
 * everything in this folder. */
#ifndef DPL_STUDY_PLAN_H
#define DPL_STUDY_PLAN_H

#include <dapple/solver.h>
#include <stdbool.h>
#include <stdint.h>

/* Scenes of the family "arc" per seed. */
#define DPL_STUDY_SCENES_MAX 50
#define DPL_STUDY_SEEDS_MAX 1000
/* Below this the first interval of the paper's geometry is shorter than a schedule allows. */
#define DPL_STUDY_SIZE_MIN 64
#define DPL_STUDY_SIZE_MAX 4096
#define DPL_STUDY_TRUTH_MAX 16384
/* Directions of the reference at each pixel of the truth. */
#define DPL_STUDY_TRUTH_DIRECTIONS 4096

/* How a scene is solved. */
typedef enum dpl_study_profile {
    DPL_STUDY_PAPER,     /* as the paper's own code does it */
    DPL_STUDY_CORRECTED, /* the corrected method, with the paper's probes and intervals */
    DPL_STUDY_PROFILES
} dpl_study_profile;

/* Modes are indexed by dpl_skip_mode: off, L5, L4, L3, L2, auto. */
#define DPL_STUDY_MODES (DPL_SKIP_AUTO + 1)

/* The arguments. All but `threads`, `tasks` and `folder` decide what the results are. */
typedef struct dpl_study_plan {
    uint64_t first_seed;
    int32_t seeds;
    int32_t size;         /* of each scene [px] */
    int32_t scenes;       /* the first so many of each seed */
    int32_t truth;        /* pixels per scene that the truth is traced at */
    int32_t threads;      /* 0: as many as the machine has processors */
    dpl_task_hooks tasks; /* all NULL: own threads */
    const char *folder;
} dpl_study_plan;

/* All scenes of all seeds. */
int32_t dpl_study_scene_count(const dpl_study_plan *plan);

/* "paper" or "corrected". */
const char *dpl_study_profile_name(dpl_study_profile profile);

/* Does each of its runs also come with dead rays dropped? They exist in the paper's profile alone. Off has
 * none, and is the control. */
bool dpl_study_has_dropped(dpl_study_profile profile);

/* The solver of one run. `drop` picks the run without dead rays. Signals are measured where a mode needs them
 * and with nothing skipped (but not again without dead rays: that is off as it is timed). */
dpl_solver_desc dpl_study_solver(const dpl_study_plan *plan, dpl_study_profile profile, dpl_skip_mode mode,
                                 bool drop);

/* The field that a profile's solvers want. */
dpl_field_desc dpl_study_field(const dpl_study_plan *plan, dpl_study_profile profile);

#endif
