/* The schedule of radiance cascades, computed in this one place. Read by the solver and printed by
 * `dapple info --schedule`. */
#include "base/context.h"

#include <dapple/field.h>
#include <dapple/schedule.h>
#include <math.h>

/* Defaults, and length of the first interval in units of the spacing: see
 * docs/algorithms/radiance-cascades.md. */
#define DEFAULT_SPACING 1
#define DEFAULT_DIRECTIONS 4
#define DEFAULT_INTERVAL 2.0

/* The paper's own code: probes 2 px apart, 16 directions, five levels, and a first interval such that the
 * last one ends just beyond the diagonal. */
#define PAPER_SPACING 2
#define PAPER_DIRECTIONS 16
#define PAPER_LEVELS 5

static void fill_paper(dpl_cascades_desc *desc, double diagonal) {
    int32_t levels = desc->levels ? desc->levels : PAPER_LEVELS;
    if (desc->spacing == 0)
        desc->spacing = PAPER_SPACING;
    if (desc->directions == 0)
        desc->directions = PAPER_DIRECTIONS;
    if (desc->interval == 0.0 && levels > 0 && levels <= DPL_MAX_LEVELS)
        desc->interval = fmax(0.25, diagonal * DPL_BRANCHING / (ldexp(1.0, 2 * levels) - 1.0));
    desc->levels = levels;
}

/* What may be asked of DPL_SKIP_BOUNDED [dB]. */
#define BOUND_MIN 20.0
#define BOUND_MAX 120.0

static bool skip_is_good(const dpl_skip_desc *skip) {
    bool paper_thresholds = skip->thresholds[0] == 0.0 && skip->thresholds[1] == 0.0;
    bool own_thresholds = skip->thresholds[0] > 0.0 && skip->thresholds[1] > skip->thresholds[0];
    return (int)skip->mode >= DPL_SKIP_OFF && skip->mode <= DPL_SKIP_BOUNDED &&
           skip->custom.start_level >= 0 && skip->custom.max_bits >= 0 && skip->custom.max_bits <= 2 &&
           (skip->bound_db == 0.0 || (skip->bound_db >= BOUND_MIN && skip->bound_db <= BOUND_MAX)) &&
           (paper_thresholds || own_thresholds) && skip->signal_probes >= 0 && skip->signal_probes <= 65536 &&
           (skip->measure == 0 || skip->measure == 1) && (int)skip->placement >= DPL_PLACEMENT_PROFILE &&
           skip->placement <= DPL_PLACEMENT_FIRST && (int)skip->dead_rays >= DPL_DEAD_RAYS_PROFILE &&
           skip->dead_rays <= DPL_DEAD_RAYS_TRACE;
}

static dpl_status fill_defaults(dpl_cascades_desc *desc, double diagonal) {
    if (desc->profile == DPL_PROFILE_PAPER)
        fill_paper(desc, diagonal);
    if (desc->spacing == 0)
        desc->spacing = DEFAULT_SPACING;
    if (desc->directions == 0)
        desc->directions = DEFAULT_DIRECTIONS;
    if (desc->interval == 0.0)
        desc->interval = DEFAULT_INTERVAL * desc->spacing;
    bool good = desc->spacing >= 1 && desc->spacing <= 64 && desc->directions >= 4 &&
                desc->directions <= 1024 && desc->directions % DPL_BRANCHING == 0 && desc->interval >= 0.25 &&
                desc->interval <= 1024.0 && desc->levels >= 0 && desc->levels <= DPL_MAX_LEVELS &&
                (int)desc->merge >= DPL_MERGE_BILINEAR && desc->merge <= DPL_MERGE_NEAREST_FIX &&
                (int)desc->profile >= DPL_PROFILE_DEFAULT && desc->profile <= DPL_PROFILE_PAPER &&
                skip_is_good(&desc->skip);
    return good ? DPL_OK : DPL_ERROR_ARGUMENT;
}

/* Levels until the last interval ends beyond the diagonal. */
static int32_t levels_to_cover(double interval, double diagonal) {
    int32_t count = 1;
    while (count < DPL_MAX_LEVELS && interval < diagonal) {
        interval *= DPL_BRANCHING;
        count++;
    }
    return count;
}

static int32_t probes_along(int32_t pixels, int64_t spacing) {
    return (int32_t)((pixels + spacing - 1) / spacing);
}

dpl_status dpl_schedule_compute(const dpl_cascades_desc *given, int32_t width, int32_t height,
                                dpl_schedule *schedule) {
    dpl_cascades_desc desc = {0};
    if (!schedule)
        return DPL_ERROR_ARGUMENT;
    if (given)
        desc = *given;
    if (width < 1 || height < 1 || width > DPL_MAX_SIZE || height > DPL_MAX_SIZE)
        return DPL_ERROR_SIZE;
    double diagonal = hypot(width, height);
    DPL_TRY(fill_defaults(&desc, diagonal));
    int32_t count = desc.levels ? desc.levels : levels_to_cover(desc.interval, diagonal);
    memset(schedule, 0, sizeof *schedule);
    schedule->width = width;
    schedule->height = height;
    schedule->level_count = count;
    schedule->merge = desc.merge;
    for (int32_t n = 0; n < count; n++) {
        dpl_schedule_level *level = &schedule->levels[n];
        int64_t spacing = (int64_t)desc.spacing << n, directions = (int64_t)desc.directions << (2 * n);
        if (directions > INT32_MAX)
            return DPL_ERROR_ARGUMENT;
        level->probes_x = probes_along(width, spacing);
        level->probes_y = probes_along(height, spacing);
        level->spacing = (double)spacing;
        level->directions = (int32_t)directions;
        level->slots = level->directions / DPL_BRANCHING;
        level->t0 = n == 0 ? 0.0 : schedule->levels[n - 1].t1;
        level->t1 = ldexp(desc.interval, 2 * n);
        level->aims = desc.merge == DPL_MERGE_BILINEAR_FIX && n + 1 < count ? 4 : 1;
        int64_t probes = (int64_t)level->probes_x * level->probes_y;
        level->rays = probes * level->directions * level->aims;
        level->bytes = probes * level->slots * 3 * (int64_t)sizeof(float);
        schedule->rays += level->rays;
    }
    return DPL_OK;
}

const char *dpl_merge_name(dpl_merge merge) {
    static const char *const names[] = {"bilinear", "bilinear-fix", "nearest-fix"};
    return (int)merge >= 0 && (int)merge < 3 ? names[merge] : "?";
}
