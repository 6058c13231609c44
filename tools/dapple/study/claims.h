/* The paper's claims as a table: what it says, which of our numbers answers it, and by which rule the answer
 * counts as reproduced. Used by the report and the tool's closing lines. */
#ifndef DPL_STUDY_CLAIMS_H
#define DPL_STUDY_CLAIMS_H

#include "headline.h"

/* Tables of the report, in its order. */
typedef enum dpl_study_section {
    DPL_STUDY_SECTION_SKIP,
    DPL_STUDY_SECTION_FIXED,
    DPL_STUDY_SECTION_ADAPTIVE,
    DPL_STUDY_SECTION_CORRELATION,
    DPL_STUDY_SECTION_BEYOND, /* what the paper does not say: no verdicts */
    DPL_STUDY_SECTION_TRUTH,  /* likewise, vs truth */
    DPL_STUDY_SECTIONS
} dpl_study_section;

typedef enum dpl_study_verdict {
    DPL_STUDY_NO_VERDICT,
    DPL_STUDY_REPRODUCED,
    DPL_STUDY_PARTLY,
    DPL_STUDY_NOT,
    DPL_STUDY_VERDICTS
} dpl_study_verdict;

typedef enum dpl_study_rule_kind {
    DPL_STUDY_RULE_NONE,
    DPL_STUDY_RULE_NEAR,     /* within a +- b; partly within a +- c */
    DPL_STUDY_RULE_WITHIN,   /* from a to b; partly up to c outside */
    DPL_STUDY_RULE_ABOVE,    /* every seed above a; partly above a - c */
    DPL_STUDY_RULE_ZERO,     /* zero; partly up to c */
    DPL_STUDY_RULE_SOME,     /* more than zero */
    DPL_STUDY_RULE_POSITIVE, /* r > 0 with p < a in every seed; partly in all scenes together */
    DPL_STUDY_RULE_NEGATIVE, /* r < 0 likewise */
    DPL_STUDY_RULE_OPEN,     /* p >= a in every seed; partly in some */
    DPL_STUDY_RULE_LARGEST,  /* r largest of the measured signals in every seed; partly in some */
    DPL_STUDY_RULE_FACTORS   /* factors of the mode, level by level, as `paper` lists them */
} dpl_study_rule_kind;

typedef struct dpl_study_rule {
    dpl_study_rule_kind kind;
    double a;
    double b;
    double c;
} dpl_study_rule;

typedef struct dpl_study_claim {
    dpl_study_section section;
    const char *text;  /* what is claimed */
    const char *paper; /* the paper's figure, "" where it gives none */
    dpl_study_headline headline;
    dpl_study_rule rule;
    const char *note; /* or NULL */
} dpl_study_claim;

/* All claims, by section; `count` receives how many. */
const dpl_study_claim *dpl_study_claims(int *count);

/* Does a claim hold in a profile? */
dpl_study_verdict dpl_study_judge(const dpl_study_results *results, dpl_study_profile profile,
                                  const dpl_study_claim *claim);

/* "reproduced", "partly", "not", ""; also the class in the report. */
const char *dpl_study_verdict_name(dpl_study_verdict verdict);

/* A rule in words, for the report: "9.5 % to 10.5 %, partly up to …". */
void dpl_study_rule_text(const dpl_study_claim *claim, char *text, size_t size);

/* Our figure for a claim. */
void dpl_study_claim_value(const dpl_study_results *results, dpl_study_profile profile,
                           const dpl_study_claim *claim, char text[DPL_STUDY_TEXT_MAX]);

/* Verdicts of a profile, counted. */
void dpl_study_count_verdicts(const dpl_study_results *results, dpl_study_profile profile,
                              int counts[DPL_STUDY_VERDICTS]);

#endif
