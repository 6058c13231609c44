/* The table of claims. Figures are those of the ARC paper's sections 3 and 4; tolerances say how far another
 * draw of the same random scenes may lie (the paper's scenes are not seeded, so its own cannot be drawn
 * again). */
#include "claims.h"

#define ALPHA 0.05

/* Ray reductions are counted, so nothing but rounding may separate them from the paper's. */
#define REDUCTION(value)                                                                                     \
    { DPL_STUDY_RULE_NEAR, value, 0.005, 0.015 }
/* Of auto, which also depends on the scenes. */
#define REDUCTION_AUTO(value)                                                                                \
    { DPL_STUDY_RULE_NEAR, value, 0.01, 0.02 }
/* The mean of 50 scenes and their extremes [dB]. */
#define MEAN_DB(value)                                                                                       \
    { DPL_STUDY_RULE_NEAR, value, 1.5, 3.0 }
#define EXTREME_DB(value)                                                                                    \
    { DPL_STUDY_RULE_NEAR, value, 3.0, 6.0 }
/* r in the paper's own 95 % interval, partly a little outside. */
#define INTERVAL(low, high)                                                                                  \
    { DPL_STUDY_RULE_WITHIN, low, high, 0.1 }
#define NO_RULE                                                                                              \
    { DPL_STUDY_RULE_NONE, 0, 0, 0 }
#define FACTORS                                                                                              \
    { DPL_STUDY_RULE_FACTORS, 0, 0, 0 }
#define NO_SCENE                                                                                             \
    { DPL_STUDY_RULE_ZERO, 0, 0, 0.02 }
#define SOME_SCENE                                                                                           \
    { DPL_STUDY_RULE_SOME, 0, 0, 0 }

#define SKIP DPL_STUDY_SECTION_SKIP
#define FIXED DPL_STUDY_SECTION_FIXED
#define ADAPTIVE DPL_STUDY_SECTION_ADAPTIVE
#define CORRELATION DPL_STUDY_SECTION_CORRELATION
#define BEYOND DPL_STUDY_SECTION_BEYOND
#define TRUTH DPL_STUDY_SECTION_TRUTH

static const char note_l4[] = "L4 halves two of five equal levels: 20 %. 17 % is two of six levels, and the "
                              "paper's own page shows 20.0 %.";

static const dpl_study_claim claims[] = {
    {SKIP,
     "Levels",
     "6 (L0 to L5)",
     {DPL_STUDY_LEVELS, 0},
     {DPL_STUDY_RULE_NEAR, 6, 0, 0},
     "The table of section 3.1 lists six levels; section 4.1 and the paper's code have five, L0 to L4, "
     "and so have both profiles."},
    {SKIP, "L5, factors from L0", "1× 1× 1× 1× 2× 4×", {DPL_STUDY_REDUCTION, DPL_SKIP_L5}, FACTORS, NULL},
    {SKIP, "L4, factors from L0", "1× 1× 1× 2× 2× 2×", {DPL_STUDY_REDUCTION, DPL_SKIP_L4}, FACTORS, NULL},
    {SKIP, "L3, factors from L0", "1× 1× 1× 2× 4× 4×", {DPL_STUDY_REDUCTION, DPL_SKIP_L3}, FACTORS, NULL},
    {SKIP, "L5, total reduction", "~10\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L5}, REDUCTION(0.10), NULL},
    {SKIP, "L4, total reduction", "~17\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L4}, REDUCTION(0.17), note_l4},
    {SKIP, "L3, total reduction", "~25\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L3}, REDUCTION(0.25), NULL},

    {FIXED, "L5, ray reduction", "~10\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L5}, REDUCTION(0.10), NULL},
    {FIXED, "L5, lowest PSNR", "56.7\u00a0dB", {DPL_STUDY_PSNR_MIN, DPL_SKIP_L5}, EXTREME_DB(56.7), NULL},
    {FIXED, "L5, highest PSNR", "67.6\u00a0dB", {DPL_STUDY_PSNR_MAX, DPL_SKIP_L5}, EXTREME_DB(67.6), NULL},
    {FIXED, "L5, mean PSNR", "61.8\u00a0dB", {DPL_STUDY_PSNR_MEAN, DPL_SKIP_L5}, MEAN_DB(61.8), NULL},
    {FIXED, "L5, scenes not above 50 dB", "none", {DPL_STUDY_BELOW, DPL_SKIP_L5}, NO_SCENE, NULL},
    {FIXED, "L4, ray reduction", "~17\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L4}, REDUCTION(0.17), note_l4},
    {FIXED, "L4, lowest PSNR", "49.9\u00a0dB", {DPL_STUDY_PSNR_MIN, DPL_SKIP_L4}, EXTREME_DB(49.9), NULL},
    {FIXED, "L4, highest PSNR", "60.6\u00a0dB", {DPL_STUDY_PSNR_MAX, DPL_SKIP_L4}, EXTREME_DB(60.6), NULL},
    {FIXED, "L4, mean PSNR", "55.2\u00a0dB", {DPL_STUDY_PSNR_MEAN, DPL_SKIP_L4}, MEAN_DB(55.2), NULL},
    {FIXED, "L4, scenes not above 50 dB", "some", {DPL_STUDY_BELOW, DPL_SKIP_L4}, SOME_SCENE, NULL},
    {FIXED, "L3, ray reduction", "~25\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L3}, REDUCTION(0.25), NULL},
    {FIXED, "L3, lowest PSNR", "47.3\u00a0dB", {DPL_STUDY_PSNR_MIN, DPL_SKIP_L3}, EXTREME_DB(47.3), NULL},
    {FIXED, "L3, highest PSNR", "59.5\u00a0dB", {DPL_STUDY_PSNR_MAX, DPL_SKIP_L3}, EXTREME_DB(59.5), NULL},
    {FIXED, "L3, mean PSNR", "53.7\u00a0dB", {DPL_STUDY_PSNR_MEAN, DPL_SKIP_L3}, MEAN_DB(53.7), NULL},
    {FIXED, "L3, scenes not above 50 dB", "some", {DPL_STUDY_BELOW, DPL_SKIP_L3}, SOME_SCENE, NULL},
    {FIXED, "L2, ray reduction", "~40\u00a0%", {DPL_STUDY_REDUCTION, DPL_SKIP_L2}, REDUCTION(0.40), NULL},
    {FIXED, "L2, lowest PSNR", "35.9\u00a0dB", {DPL_STUDY_PSNR_MIN, DPL_SKIP_L2}, EXTREME_DB(35.9), NULL},
    {FIXED, "L2, highest PSNR", "52.0\u00a0dB", {DPL_STUDY_PSNR_MAX, DPL_SKIP_L2}, EXTREME_DB(52.0), NULL},
    {FIXED, "L2, mean PSNR", "43.6\u00a0dB", {DPL_STUDY_PSNR_MEAN, DPL_SKIP_L2}, MEAN_DB(43.6), NULL},
    {FIXED, "L2, scenes not above 50 dB", "some", {DPL_STUDY_BELOW, DPL_SKIP_L2}, SOME_SCENE, NULL},

    {ADAPTIVE,
     "Average reduction, rays counted",
     "~19 %",
     {DPL_STUDY_REDUCTION, DPL_SKIP_AUTO},
     REDUCTION_AUTO(0.19),
     NULL},
    {ADAPTIVE,
     "Average reduction, 10, 17 or 25 % a scene",
     "~19 %",
     {DPL_STUDY_HARD_CODED, 0},
     REDUCTION_AUTO(0.19),
     "How the paper's program computes its average: from these three constants, not from rays."},
    {ADAPTIVE,
     "Lowest PSNR",
     "> 50 dB",
     {DPL_STUDY_PSNR_MIN, DPL_SKIP_AUTO},
     {DPL_STUDY_RULE_ABOVE, DPL_STUDY_BAR_DB, 0, 1},
     NULL},
    {ADAPTIVE,
     "Scenes not above 50 dB",
     "none",
     {DPL_STUDY_BELOW, DPL_SKIP_AUTO},
     NO_SCENE,
     "The paper's thresholds were fitted to the scenes that they were judged on."},

    {CORRELATION,
     "Light count",
     "0.81 [0.69,\u00a00.89]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_LIGHTS},
     INTERVAL(0.69, 0.89),
     NULL},
    {CORRELATION,
     "Mean",
     "0.77 [0.62,\u00a00.86]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_MEAN},
     INTERVAL(0.62, 0.86),
     NULL},
    {CORRELATION,
     "Mean + StdDev",
     "0.73 [0.56,\u00a00.84]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_SCORE},
     INTERVAL(0.56, 0.84),
     NULL},
    {CORRELATION,
     "StdDev",
     "0.69 [0.50,\u00a00.81]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_STDDEV},
     INTERVAL(0.50, 0.81),
     NULL},
    {CORRELATION,
     "Non-zero ratio",
     "0.20 [-0.08,\u00a00.45]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_NON_ZERO},
     INTERVAL(-0.08, 0.45),
     NULL},
    {CORRELATION,
     "Peak / average",
     "-0.60 [-0.75,\u00a0-0.39]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_PEAK},
     INTERVAL(-0.75, -0.39),
     NULL},
    {CORRELATION,
     "90 % bandwidth",
     "-0.68 [-0.81,\u00a0-0.50]",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_BANDWIDTH},
     INTERVAL(-0.81, -0.50),
     NULL},
    {CORRELATION,
     "Mean + StdDev predicts",
     "r > 0, p < 0.05",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_SCORE},
     {DPL_STUDY_RULE_POSITIVE, ALPHA, 0, 0},
     NULL},
    {CORRELATION,
     "Bandwidth is negative",
     "r < 0, p < 0.05",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_BANDWIDTH},
     {DPL_STUDY_RULE_NEGATIVE, ALPHA, 0, 0},
     NULL},
    {CORRELATION,
     "Non-zero ratio says nothing",
     "p ≥ 0.05",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_NON_ZERO},
     {DPL_STUDY_RULE_OPEN, ALPHA, 0, 0},
     NULL},
    {CORRELATION,
     "Mean + StdDev is the best that can be measured",
     "best",
     {DPL_STUDY_R_DISPLAY, DPL_STUDY_SCORE},
     {DPL_STUDY_RULE_LARGEST, 0, 0, 0},
     "In the paper's own table, Mean (0.77) is ahead of Mean + StdDev (0.73)."},

    {BEYOND,
     "L5 reduction, dead rays dropped",
     "",
     {DPL_STUDY_REDUCTION_DROPPED, DPL_SKIP_L5},
     NO_RULE,
     NULL},
    {BEYOND,
     "L4 reduction, dead rays dropped",
     "",
     {DPL_STUDY_REDUCTION_DROPPED, DPL_SKIP_L4},
     NO_RULE,
     NULL},
    {BEYOND,
     "L3 reduction, dead rays dropped",
     "",
     {DPL_STUDY_REDUCTION_DROPPED, DPL_SKIP_L3},
     NO_RULE,
     NULL},
    {BEYOND,
     "L2 reduction, dead rays dropped",
     "",
     {DPL_STUDY_REDUCTION_DROPPED, DPL_SKIP_L2},
     NO_RULE,
     NULL},
    {BEYOND,
     "Auto reduction, dead rays dropped",
     "",
     {DPL_STUDY_REDUCTION_DROPPED, DPL_SKIP_AUTO},
     NO_RULE,
     "Rays that no ray of the level below reads. They exist where the first ray of a group stands for it, as "
     "in the paper's code."},
    {BEYOND,
     "Auto pictures changed by dropping them",
     "",
     {DPL_STUDY_CHANGED, DPL_SKIP_AUTO},
     NO_RULE,
     "Compared bit by bit, as in each of the fixed modes."},
    {BEYOND,
     "Auto reduction, signal's own rays counted",
     "",
     {DPL_STUDY_REDUCTION_SIGNAL, DPL_SKIP_AUTO},
     NO_RULE,
     "What choosing the mode costs when it is done for every frame. In the paper's profile that lights four "
     "of "
     "the five levels without skipping; the paper's page does so every 60 frames."},
    {BEYOND, "Scenes that auto gives L5", "", {DPL_STUDY_CHOSEN, DPL_SKIP_L5}, NO_RULE, NULL},
    {BEYOND, "Scenes that auto gives L4", "", {DPL_STUDY_CHOSEN, DPL_SKIP_L4}, NO_RULE, NULL},
    {BEYOND, "Scenes that auto gives L3", "", {DPL_STUDY_CHOSEN, DPL_SKIP_L3}, NO_RULE, NULL},
    {BEYOND,
     "Mean + StdDev, r with linear PSNR",
     "",
     {DPL_STUDY_R_LINEAR, DPL_STUDY_SCORE},
     NO_RULE,
     "Against linear PSNR (peak: the largest value of the off picture, free pixels) the sign turns: what "
     "bright scenes tolerate is relative error, not error."},
    {BEYOND, "Light count, r with linear PSNR", "", {DPL_STUDY_R_LINEAR, DPL_STUDY_LIGHTS}, NO_RULE, NULL},
    {BEYOND,
     "90 % bandwidth, r with linear PSNR",
     "",
     {DPL_STUDY_R_LINEAR, DPL_STUDY_BANDWIDTH},
     NO_RULE,
     NULL},

    {TRUTH,
     "off, mean PSNR vs truth",
     "",
     {DPL_STUDY_TRUTH_DISPLAY, DPL_SKIP_OFF},
     NO_RULE,
     "The paper's edge blend paints surfaces into the free pixels beside them, which counts against it "
     "here."},
    {TRUTH, "L5, mean PSNR vs truth", "", {DPL_STUDY_TRUTH_DISPLAY, DPL_SKIP_L5}, NO_RULE, NULL},
    {TRUTH, "L4, mean PSNR vs truth", "", {DPL_STUDY_TRUTH_DISPLAY, DPL_SKIP_L4}, NO_RULE, NULL},
    {TRUTH, "L3, mean PSNR vs truth", "", {DPL_STUDY_TRUTH_DISPLAY, DPL_SKIP_L3}, NO_RULE, NULL},
    {TRUTH, "L2, mean PSNR vs truth", "", {DPL_STUDY_TRUTH_DISPLAY, DPL_SKIP_L2}, NO_RULE, NULL},
    {TRUTH, "auto, mean PSNR vs truth", "", {DPL_STUDY_TRUTH_DISPLAY, DPL_SKIP_AUTO}, NO_RULE, NULL},
    {TRUTH, "off, mean relative RMSE vs truth", "", {DPL_STUDY_TRUTH_RMSE, DPL_SKIP_OFF}, NO_RULE, NULL},
    {TRUTH, "L2, mean relative RMSE vs truth", "", {DPL_STUDY_TRUTH_RMSE, DPL_SKIP_L2}, NO_RULE, NULL},
    {TRUTH, "auto, mean relative RMSE vs truth", "", {DPL_STUDY_TRUTH_RMSE, DPL_SKIP_AUTO}, NO_RULE, NULL},
};

const dpl_study_claim *dpl_study_claims(int *count) {
    *count = (int)(sizeof claims / sizeof claims[0]);
    return claims;
}
