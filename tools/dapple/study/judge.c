/* Judges claims by their rules. The rules' numbers are in the table of claims.c. */
#include "claims.h"

#include <dapple/skip.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const verdict_names[DPL_STUDY_VERDICTS] = {"", "reproduced", "partly", "not"};

/* Decimal figures have no exact binary: what lies on a limit belongs to it. */
#define ROUNDING 1e-9

const char *dpl_study_verdict_name(dpl_study_verdict verdict) {
    return verdict_names[verdict];
}

/* `whole`: as claimed; `part`: near enough to be worth saying. */
static dpl_study_verdict grade(bool whole, bool part) {
    return whole ? DPL_STUDY_REPRODUCED : part ? DPL_STUDY_PARTLY : DPL_STUDY_NOT;
}

/* How far a value lies outside of low .. high. */
static double outside(double value, double low, double high) {
    return value < low ? low - value : value > high ? value - high : 0.0;
}

static bool is_largest(const dpl_study_statistics *statistics) {
    const double score = statistics->correlations[DPL_STUDY_SCORE][DPL_STUDY_DISPLAY].r;
    for (int s = DPL_STUDY_SCORE; s < DPL_STUDY_SIGNALS; s++)
        if (statistics->correlations[s][DPL_STUDY_DISPLAY].r > score)
            return false;
    return true;
}

/* Does a rule about significance hold for these scenes? */
static bool holds(const dpl_study_statistics *statistics, const dpl_study_claim *claim) {
    const dpl_correlation *found = dpl_study_headline_correlation(statistics, claim->headline);
    switch (claim->rule.kind) {
    case DPL_STUDY_RULE_POSITIVE:
        return found->r > 0 && found->p < claim->rule.a;
    case DPL_STUDY_RULE_NEGATIVE:
        return found->r < 0 && found->p < claim->rule.a;
    case DPL_STUDY_RULE_OPEN:
        return found->p >= claim->rule.a;
    default:
        return is_largest(statistics);
    }
}

static dpl_study_verdict judge_seeds(const dpl_study_results *results, dpl_study_profile profile,
                                     const dpl_study_claim *claim) {
    int32_t seeds = 0;
    for (int32_t s = 0; s < results->plan->seeds; s++)
        seeds += holds(&results->seeds[profile][s], claim);
    bool pooled = holds(&results->pooled[profile], claim);
    bool any = claim->rule.kind == DPL_STUDY_RULE_OPEN || claim->rule.kind == DPL_STUDY_RULE_LARGEST;
    return grade(seeds == results->plan->seeds, any ? seeds > 0 : pooled);
}

/* "1× 1× 2×" of the levels that there are. */
static void format_factors(const dpl_study_results *results, dpl_study_profile profile, int mode, char *text,
                           size_t size) {
    dpl_skip_rule rule = {0};
    size_t used = 0;
    text[0] = 0;
    if (dpl_skip_rule_of((dpl_skip_mode)mode, &rule) != DPL_OK)
        return;
    for (int32_t level = 0; level < results->pooled[profile].levels && used < size; level++)
        used += (size_t)snprintf(text + used, size - used, "%s%d×", level ? " " : "",
                                 (int)dpl_skip_factor(rule, level));
}

static dpl_study_verdict judge_factors(const dpl_study_results *results, dpl_study_profile profile,
                                       const dpl_study_claim *claim) {
    char ours[DPL_STUDY_TEXT_MAX];
    format_factors(results, profile, claim->headline.index, ours, sizeof ours);
    return grade(strncmp(ours, claim->paper, strlen(ours)) == 0, false);
}

dpl_study_verdict dpl_study_judge(const dpl_study_results *results, dpl_study_profile profile,
                                  const dpl_study_claim *claim) {
    const dpl_study_rule *rule = &claim->rule;
    const double value = dpl_study_headline_overall(results, profile, claim->headline);
    const double lowest = dpl_study_headline_spread(results, profile, claim->headline).min;
    double distance;
    switch (rule->kind) {
    case DPL_STUDY_RULE_NONE:
        return DPL_STUDY_NO_VERDICT;
    case DPL_STUDY_RULE_NEAR:
        distance = fabs(value - rule->a);
        return grade(distance <= rule->b + ROUNDING, distance <= rule->c + ROUNDING);
    case DPL_STUDY_RULE_WITHIN:
        distance = outside(value, rule->a, rule->b);
        return grade(distance <= 0.0, distance <= rule->c + ROUNDING);
    case DPL_STUDY_RULE_ABOVE: /* without any finite value nothing is below */
        return grade(!(lowest <= rule->a), lowest > rule->a - rule->c);
    case DPL_STUDY_RULE_ZERO:
        return grade(value == 0.0, value <= rule->c + ROUNDING);
    case DPL_STUDY_RULE_SOME:
        return grade(value > 0.0, false);
    case DPL_STUDY_RULE_FACTORS:
        return judge_factors(results, profile, claim);
    case DPL_STUDY_RULE_POSITIVE:
    case DPL_STUDY_RULE_NEGATIVE:
    case DPL_STUDY_RULE_OPEN:
    case DPL_STUDY_RULE_LARGEST:
        break;
    }
    return judge_seeds(results, profile, claim);
}

void dpl_study_claim_value(const dpl_study_results *results, dpl_study_profile profile,
                           const dpl_study_claim *claim, char text[DPL_STUDY_TEXT_MAX]) {
    if (claim->rule.kind == DPL_STUDY_RULE_FACTORS)
        format_factors(results, profile, claim->headline.index, text, DPL_STUDY_TEXT_MAX);
    else
        dpl_study_headline_format(results, profile, claim->headline, text);
}

void dpl_study_count_verdicts(const dpl_study_results *results, dpl_study_profile profile,
                              int counts[DPL_STUDY_VERDICTS]) {
    int count;
    const dpl_study_claim *claims = dpl_study_claims(&count);
    memset(counts, 0, DPL_STUDY_VERDICTS * sizeof *counts);
    for (int i = 0; i < count; i++)
        counts[dpl_study_judge(results, profile, &claims[i])]++;
}

void dpl_study_rule_text(const dpl_study_claim *claim, char *text, size_t size) {
    const dpl_study_rule *rule = &claim->rule;
    const dpl_study_unit unit = dpl_study_headline_row_of(claim->headline.kind)->unit;
    char a[32], b[32], c[32];
    dpl_study_format_value(rule->a, unit, a, sizeof a);
    dpl_study_format_value(rule->b, unit, b, sizeof b);
    dpl_study_format_value(rule->c, unit, c, sizeof c);
    text[0] = 0;
    switch (rule->kind) {
    case DPL_STUDY_RULE_NONE:
        return;
    case DPL_STUDY_RULE_NEAR:
        if (rule->b == 0.0)
            snprintf(text, size, "exactly %s", a);
        else
            snprintf(text, size, "%s ± %s; partly ± %s", a, b, c);
        return;
    case DPL_STUDY_RULE_WITHIN:
        snprintf(text, size, "%s to %s; partly up to %s outside", a, b, c);
        return;
    case DPL_STUDY_RULE_ABOVE:
        snprintf(text, size, "every seed above %s; partly up to %s below", a, c);
        return;
    case DPL_STUDY_RULE_ZERO:
        snprintf(text, size, "none; partly up to %s of the scenes", c);
        return;
    case DPL_STUDY_RULE_SOME:
        snprintf(text, size, "at least one scene");
        return;
    case DPL_STUDY_RULE_POSITIVE:
        snprintf(text, size, "r > 0 and p < %s in every seed; partly in all scenes together", a);
        return;
    case DPL_STUDY_RULE_NEGATIVE:
        snprintf(text, size, "r < 0 and p < %s in every seed; partly in all scenes together", a);
        return;
    case DPL_STUDY_RULE_OPEN:
        snprintf(text, size, "p ≥ %s in every seed; partly in some", a);
        return;
    case DPL_STUDY_RULE_LARGEST:
        snprintf(text, size, "largest r of the measured signals in every seed; partly in some");
        return;
    case DPL_STUDY_RULE_FACTORS:
        snprintf(text, size, "the same factors on the levels that there are");
        return;
    }
}
