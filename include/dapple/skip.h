/** @file
 * Ray skipping in radiance cascades: which rays of which levels are left out.
 *
 * A slot of a level stands for DPL_BRANCHING rays. With factor f only 4/f of them are traced. The factor is 1
 * below a start level and doubles with each level from there, up to 2^max_bits: f(l) = 2^min(l - start + 1,
 * max_bits). Source: ARC paper, section 3.1, and its own code.
 */
#ifndef DAPPLE_SKIP_H
#define DAPPLE_SKIP_H

#include <dapple/export.h>
#include <dapple/signal.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Which rays are left out. */
typedef enum dpl_skip_mode {
    DPL_SKIP_OFF = 0,    /**< none */
    DPL_SKIP_L5 = 1,     /**< start level 4, up to 4x: 10 % fewer of five levels */
    DPL_SKIP_L4 = 2,     /**< start level 3, up to 2x: 20 % (the paper says 17) */
    DPL_SKIP_L3 = 3,     /**< start level 3, up to 4x: 25 % */
    DPL_SKIP_L2 = 4,     /**< start level 2, up to 4x: 40 % */
    DPL_SKIP_AUTO = 5,   /**< L5, L4 or L3 by the score of the picture */
    DPL_SKIP_CUSTOM = 6, /**< dpl_skip_desc::custom */
    DPL_SKIP_EXACT = 7,  /**< rays that are proved not to matter: the picture of DPL_SKIP_OFF, bit for bit */
    DPL_SKIP_BOUNDED = 8 /**< as few as a bound on the error allows, see dpl_skip_desc::bound_db */
} dpl_skip_mode;

/** A mode as data. */
typedef struct dpl_skip_rule {
    int32_t start_level; /**< first level that skips, >= 0 */
    int32_t max_bits;    /**< most skipping is 2^max_bits: 0 none, 1 twofold, 2 fourfold */
} dpl_skip_rule;

/** Where the ray that stands for a group of skipped ones points. */
typedef enum dpl_skip_placement {
    /** As the profile has it. */
    DPL_PLACEMENT_PROFILE = 0,
    /** At the middle of its group, and it sees the mean of the group's slots above. */
    DPL_PLACEMENT_CENTRED = 1,
    /** The paper's: the first of the group, which turns the light by up to 1.5 rays. */
    DPL_PLACEMENT_FIRST = 2
} dpl_skip_placement;

/** What becomes of rays whose slot no ray of the level below reads. They exist with DPL_PLACEMENT_FIRST only.
 */
typedef enum dpl_dead_rays {
    DPL_DEAD_RAYS_PROFILE = 0, /**< as the profile has it */
    DPL_DEAD_RAYS_DROP = 1,    /**< not traced: the same picture for less */
    DPL_DEAD_RAYS_TRACE = 2    /**< traced all the same, as the paper's code does */
} dpl_dead_rays;

/** Settings of skipping. All zero means off. */
typedef struct dpl_skip_desc {
    dpl_skip_mode mode;    /**< default DPL_SKIP_OFF */
    dpl_skip_rule custom;  /**< read by DPL_SKIP_CUSTOM */
    double thresholds[2];  /**< read by DPL_SKIP_AUTO: scores below the first give L5, below the second L4,
                              from  there on L3. 0 < first < second; both 0: the paper's 0.45 and 1.00 */
    int32_t signal_probes; /**< probes that the signals are measured at, 1 .. 65536; 0: 64, in the paper
                              profile 16 */
    int32_t measure;       /**< 1: measure the signals in every mode; 0 (default): only for DPL_SKIP_AUTO */
    dpl_skip_placement placement; /**< default by profile: default centred, paper first */
    dpl_dead_rays dead_rays;      /**< default by profile: default drop, paper trace */
    double bound_db; /**< read by DPL_SKIP_BOUNDED: what psnr_display against DPL_SKIP_OFF is to stay
                        above [dB], 20 .. 120; 0: 50 */
    uint64_t seed;   /**< read by DPL_SKIP_BOUNDED: of the sample of guesses that is checked */
} dpl_skip_desc;

/** What skipping did in a solve. */
typedef struct dpl_skip_report {
    dpl_skip_mode mode;  /**< that was used: for DPL_SKIP_AUTO the one that was chosen */
    dpl_skip_rule rule;  /**< of that mode; {0, 0} when off */
    int32_t measured;    /**< 1 when `signals` hold values */
    dpl_signals signals; /**< means over the probes that were looked at */
    int64_t signal_rays; /**< traced for the signals alone, not part of any level's count */
    int64_t guessed;     /**< DPL_SKIP_BOUNDED: rays whose end was guessed from their neighbours' */
    int64_t checked;     /**< guesses that were traced all the same, to see whether they were right */
    int64_t wrong;       /**< of them that were not */
} dpl_skip_report;

/**
 * The rule of a fixed mode.
 * @param mode DPL_SKIP_OFF, _L5, _L4, _L3 or _L2
 * @param rule receives it
 * @return DPL_OK; DPL_ERROR_ARGUMENT for any other mode. Thread-safe.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_skip_rule_of(dpl_skip_mode mode, dpl_skip_rule *rule);

/** The factor of a rule at a level: 1, 2 or 4. A level below 0 gives 1. Thread-safe. */
DPL_API int32_t dpl_skip_factor(dpl_skip_rule rule, int32_t level);

/**
 * The mode that DPL_SKIP_AUTO takes for a score: L5 below thresholds[0], L4 below thresholds[1], else L3.
 * @param score      not a number counts as 0: the least skipping
 * @param thresholds rising, above 0; NULL or both 0: the paper's 0.45 and 1.00
 * Thread-safe.
 */
DPL_API dpl_skip_mode dpl_skip_choose(double score, const double thresholds[2]);

/** Name of a mode as the command line spells it: "off", "L5", "L4", "L3", "L2", "auto", "custom",
 * "exact", "bounded", or "?". */
DPL_API const char *dpl_skip_mode_name(dpl_skip_mode mode);

#ifdef __cplusplus
}
#endif
#endif
