/* The modes of ray skipping as data, and what they mean at a level. Called by the cascade solver, which obeys
 * them, and by tools, which name them. */
#include <dapple/schedule.h>
#include <dapple/skip.h>

#include <assert.h>
#include <stddef.h>

/* A slot has four rays, so four is the most that one of them can stand for. */
#define MAX_BITS 2
static_assert(1 << MAX_BITS == DPL_BRANCHING, "the largest factor leaves one ray of a slot");

typedef struct named_mode {
    const char *name;
    int fixed; /* 1: `rule` says all about it */
    dpl_skip_rule rule;
} named_mode;

static const named_mode modes[] = {
    [DPL_SKIP_OFF] = {"off", 1, {0, 0}},         [DPL_SKIP_L5] = {"L5", 1, {4, 2}},
    [DPL_SKIP_L4] = {"L4", 1, {3, 1}},           [DPL_SKIP_L3] = {"L3", 1, {3, 2}},
    [DPL_SKIP_L2] = {"L2", 1, {2, 2}},           [DPL_SKIP_AUTO] = {"auto", 0, {0, 0}},
    [DPL_SKIP_CUSTOM] = {"custom", 0, {0, 0}},   [DPL_SKIP_EXACT] = {"exact", 0, {0, 0}},
    [DPL_SKIP_BOUNDED] = {"bounded", 0, {0, 0}},
};

static const double paper_thresholds[2] = {0.45, 1.00};

/* NULL for a number that is no mode. */
static const named_mode *find_mode(dpl_skip_mode mode) {
    const size_t index = (size_t)mode;
    return index < sizeof modes / sizeof modes[0] ? &modes[index] : NULL;
}

dpl_status dpl_skip_rule_of(dpl_skip_mode mode, dpl_skip_rule *rule) {
    const named_mode *found = find_mode(mode);
    if (!found || !found->fixed || !rule)
        return DPL_ERROR_ARGUMENT;
    *rule = found->rule;
    return DPL_OK;
}

/* Bits outside 0 .. MAX_BITS count as the nearer end. Any level and start will do: the difference is taken
 * in 64 bits. */
int32_t dpl_skip_factor(dpl_skip_rule rule, int32_t level) {
    if (level < 0 || level < rule.start_level || rule.max_bits <= 0)
        return 1;
    const int64_t max_bits = rule.max_bits < MAX_BITS ? rule.max_bits : MAX_BITS;
    const int64_t bits = (int64_t)level - rule.start_level + 1;
    return 1 << (bits < max_bits ? bits : max_bits);
}

/* Thresholds as in dpl_skip_desc: both 0, or none at all, are the paper's. A score that is not a number skips
 * least. */
dpl_skip_mode dpl_skip_choose(double score, const double thresholds[2]) {
    if (!thresholds || (thresholds[0] == 0.0 && thresholds[1] == 0.0))
        thresholds = paper_thresholds;
    if (!(score >= thresholds[0]))
        return DPL_SKIP_L5;
    return score < thresholds[1] ? DPL_SKIP_L4 : DPL_SKIP_L3;
}

const char *dpl_skip_mode_name(dpl_skip_mode mode) {
    const named_mode *found = find_mode(mode);
    return found ? found->name : "?";
}
