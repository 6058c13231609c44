/* The numbers of a record, by name. */
#include "record.h"

#include <stdio.h>

#define FIELD(type, member, kind)                                                                            \
    { #member, kind, offsetof(type, member) }
#define SCENE(member, kind) FIELD(dpl_study_scene_record, member, kind)
#define PROFILE(member, kind) FIELD(dpl_study_profile_record, member, kind)
#define MODE(member, kind) FIELD(dpl_study_mode_record, member, kind)

static const dpl_study_record_field scene_fields[] = {
    SCENE(seed, DPL_STUDY_UINT64),        SCENE(index, DPL_STUDY_INT32),
    SCENE(lights, DPL_STUDY_INT32),       SCENE(occluders, DPL_STUDY_INT32),
    SCENE(truth_pixels, DPL_STUDY_INT32), SCENE(threads, DPL_STUDY_INT32),
    SCENE(draw_ms, DPL_STUDY_DOUBLE),     SCENE(truth_ms, DPL_STUDY_DOUBLE),
    SCENE(total_ms, DPL_STUDY_DOUBLE),
};

static const dpl_study_record_field profile_fields[] = {
    PROFILE(levels, DPL_STUDY_INT32),
    PROFILE(signals.mean, DPL_STUDY_DOUBLE),
    PROFILE(signals.stddev, DPL_STUDY_DOUBLE),
    PROFILE(signals.score, DPL_STUDY_DOUBLE),
    PROFILE(signals.non_zero, DPL_STUDY_DOUBLE),
    PROFILE(signals.peak_to_average, DPL_STUDY_DOUBLE),
    PROFILE(signals.bandwidth90, DPL_STUDY_DOUBLE),
    PROFILE(auto_signals.mean, DPL_STUDY_DOUBLE),
    PROFILE(auto_signals.stddev, DPL_STUDY_DOUBLE),
    PROFILE(auto_signals.score, DPL_STUDY_DOUBLE),
    PROFILE(auto_signals.non_zero, DPL_STUDY_DOUBLE),
    PROFILE(auto_signals.peak_to_average, DPL_STUDY_DOUBLE),
    PROFILE(auto_signals.bandwidth90, DPL_STUDY_DOUBLE),
};

static const dpl_study_record_field mode_fields[] = {
    MODE(used, DPL_STUDY_INT32),
    MODE(full, DPL_STUDY_INT64),
    MODE(traced, DPL_STUDY_INT64),
    MODE(signal_rays, DPL_STUDY_INT64),
    MODE(dropped, DPL_STUDY_INT64),
    MODE(same, DPL_STUDY_INT32),
    MODE(display_off, DPL_STUDY_DOUBLE),
    MODE(linear_off, DPL_STUDY_DOUBLE),
    MODE(display_truth, DPL_STUDY_DOUBLE),
    MODE(linear_truth, DPL_STUDY_DOUBLE),
    MODE(rel_rmse_truth, DPL_STUDY_DOUBLE),
    MODE(ms, DPL_STUDY_DOUBLE),
    MODE(dropped_ms, DPL_STUDY_DOUBLE),
};

enum {
    SCENE_FIELDS = sizeof scene_fields / sizeof scene_fields[0],
    PROFILE_FIELDS = sizeof profile_fields / sizeof profile_fields[0],
    MODE_FIELDS = sizeof mode_fields / sizeof mode_fields[0]
};

int dpl_study_record_size(void) {
    return SCENE_FIELDS + DPL_STUDY_PROFILES * (PROFILE_FIELDS + DPL_STUDY_MODES * MODE_FIELDS);
}

/* A list of fields, and what to do with each. */
typedef struct field_walk {
    bool (*visit)(const char *where, const dpl_study_record_field *field, void *value, void *user);
    void *user;
} field_walk;

static bool walk_fields(const field_walk *walk, const char *where, const dpl_study_record_field *fields,
                        int count, void *record) {
    for (int i = 0; i < count; i++)
        if (!walk->visit(where, &fields[i], (char *)record + fields[i].offset, walk->user))
            return false;
    return true;
}

static bool walk_profile(const field_walk *walk, dpl_study_profile profile,
                         dpl_study_profile_record *record) {
    char where[32];
    const char *name = dpl_study_profile_name(profile);
    snprintf(where, sizeof where, "%s.", name);
    if (!walk_fields(walk, where, profile_fields, PROFILE_FIELDS, record))
        return false;
    for (int m = 0; m < DPL_STUDY_MODES; m++) {
        snprintf(where, sizeof where, "%s.%s.", name, dpl_skip_mode_name((dpl_skip_mode)m));
        if (!walk_fields(walk, where, mode_fields, MODE_FIELDS, &record->modes[m]))
            return false;
    }
    return true;
}

bool dpl_study_record_each(dpl_study_scene_record *record,
                           bool (*visit)(const char *where, const dpl_study_record_field *field, void *value,
                                         void *user),
                           void *user) {
    const field_walk walk = {visit, user};
    if (!walk_fields(&walk, "", scene_fields, SCENE_FIELDS, record))
        return false;
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        if (!walk_profile(&walk, (dpl_study_profile)p, &record->profiles[p]))
            return false;
    return true;
}
