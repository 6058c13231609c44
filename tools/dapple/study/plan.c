/* The runs of a study as data. */
#include "plan.h"

#include <math.h>

/* Geometry of the paper's code, which DPL_PROFILE_PAPER has by itself and the corrected profile is given, so
 * that both trace the same number of rays over the same intervals. */
#define PAPER_SPACING 2
#define PAPER_DIRECTIONS 16
#define PAPER_LEVELS 5
#define PAPER_INTERVAL (4.0 / 1023.0) /* of the diagonal */

typedef struct profile_row {
    const char *name;
    dpl_profile profile;
    int32_t keep_shape_distance;
    bool dead_rays; /* it traces rays that nobody reads */
    bool geometry;  /* must be given the paper's */
} profile_row;

static const profile_row profiles[DPL_STUDY_PROFILES] = {
    [DPL_STUDY_PAPER] = {"paper", DPL_PROFILE_PAPER, 1, true, false},
    [DPL_STUDY_CORRECTED] = {"corrected", DPL_PROFILE_DEFAULT, 0, false, true},
};

int32_t dpl_study_scene_count(const dpl_study_plan *plan) {
    return plan->seeds * plan->scenes;
}

const char *dpl_study_profile_name(dpl_study_profile profile) {
    return profiles[profile].name;
}

bool dpl_study_has_dropped(dpl_study_profile profile) {
    return profiles[profile].dead_rays;
}

dpl_solver_desc dpl_study_solver(const dpl_study_plan *plan, dpl_study_profile profile, dpl_skip_mode mode,
                                 bool drop) {
    const profile_row *row = &profiles[profile];
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.profile = row->profile;
    desc.cascades.merge = DPL_MERGE_BILINEAR;
    if (row->geometry) {
        desc.cascades.spacing = PAPER_SPACING;
        desc.cascades.directions = PAPER_DIRECTIONS;
        desc.cascades.levels = PAPER_LEVELS;
        desc.cascades.interval = sqrt(2.0) * plan->size * PAPER_INTERVAL;
    }
    desc.cascades.skip.mode = mode;
    desc.cascades.skip.measure = mode == DPL_SKIP_OFF && !drop;
    if (drop)
        desc.cascades.skip.dead_rays = DPL_DEAD_RAYS_DROP;
    return desc;
}

dpl_field_desc dpl_study_field(const dpl_study_plan *plan, dpl_study_profile profile) {
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = plan->size;
    desc.keep_shape_distance = profiles[profile].keep_shape_distance;
    return desc;
}
