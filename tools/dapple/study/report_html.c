/* Prints the report, section by section. What is claimed and how it is judged is in claims.c. */
#include "report_html.h"

#include "claims.h"
#include "folder_file.h"
#include "html.h"
#include "plots.h"

#include <dapple/version.h>
#include <inttypes.h>
#include <math.h>

static const struct {
    const char *title;
    const char *text;
    const char *caption;
    bool truth; /* compares with the truth: no figures of the paper beside */
} sections[DPL_STUDY_SECTIONS] = {
    [DPL_STUDY_SECTION_SKIP] = {"Skip patterns", "The paper's section 3.1: what each mode leaves out.",
                                "Reductions are counted rays, means over scenes.", false},
    [DPL_STUDY_SECTION_FIXED] = {"Fixed modes", "The paper's section 4.2. PSNR is psnr_display vs off.",
                                 "psnr_display vs off over all pixels.", false},
    [DPL_STUDY_SECTION_ADAPTIVE] = {"Adaptive mode", "The paper's section 4.3. PSNR is psnr_display vs off.",
                                    "psnr_display vs off over all pixels.", false},
    [DPL_STUDY_SECTION_CORRELATION] =
        {"Correlation of signals with quality",
         "The paper's sections 3.3, 3.4 and 4.4: Pearson's r of each signal with psnr_display of the L2 mode "
         "vs off, and its 95 % interval. Signals are measured with nothing skipped.",
         "r with psnr_display of L2 vs off.", false},
    [DPL_STUDY_SECTION_BEYOND] = {"What the paper does not report",
                                  "Found on the same scenes; PSNR is vs off here too. There is nothing to "
                                  "reproduce, so there are no verdicts.",
                                  "vs off.", false},
    [DPL_STUDY_SECTION_TRUTH] =
        {"Against the truth",
         "How far all of this is from the light that a brute-force reference finds in the same pixel world. "
         "The paper compares with off alone. What skipping adds must be seen beside what off is wrong by.",
         "psnr_display and relative RMSE vs truth, at the pixels of the truth.", true},
};

/* As the report spells verdicts. */
static const char *const verdict_texts[DPL_STUDY_VERDICTS] = {"", "reproduced", "partly", "not reproduced"};

static void print_value(FILE *page, const dpl_study_results *results, dpl_study_profile profile,
                        const dpl_study_claim *claim) {
    char value[DPL_STUDY_TEXT_MAX];
    dpl_study_verdict verdict = dpl_study_judge(results, profile, claim);
    dpl_study_claim_value(results, profile, claim, value);
    fputs("<td>", page);
    dpl_html_text(page, value);
    if (verdict != DPL_STUDY_NO_VERDICT)
        fprintf(page, "<span class=\"v %s\">%s</span>", dpl_study_verdict_name(verdict),
                verdict_texts[verdict]);
    fputs("</td>", page);
}

static void print_claim(FILE *page, const dpl_study_results *results, const dpl_study_claim *claim,
                        bool truth) {
    char rule[DPL_STUDY_TEXT_MAX];
    dpl_study_rule_text(claim, rule, sizeof rule);
    fputs("<tr><th scope=\"row\">", page);
    dpl_html_text(page, claim->text);
    if (claim->note) {
        fputs("<span class=\"note\">", page);
        dpl_html_text(page, claim->note);
        fputs("</span>", page);
    }
    if (rule[0]) {
        fputs("<span class=\"rule\">Rule: ", page);
        dpl_html_text(page, rule);
        fputs("</span>", page);
    }
    fputs("</th>", page);
    if (!truth) {
        fputs("<td>", page);
        dpl_html_text(page, claim->paper[0] ? claim->paper : "–");
        fputs("</td>", page);
    }
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        print_value(page, results, (dpl_study_profile)p, claim);
    fputs("</tr>\n", page);
}

static void print_section(FILE *page, const dpl_study_results *results, dpl_study_section section) {
    static const char *const columns[] = {"", "The paper", "Ours, paper's profile",
                                          "Ours, corrected profile"};
    static const char *const columns_truth[] = {"", "Paper's profile", "Corrected profile"};
    const bool truth = sections[section].truth;
    int count;
    const dpl_study_claim *claims = dpl_study_claims(&count);
    dpl_html_element(page, "h2", sections[section].title);
    dpl_html_element(page, "p", sections[section].text);
    dpl_html_table_begin(page, sections[section].caption, truth ? columns_truth : columns, truth ? 3 : 4);
    for (int i = 0; i < count; i++)
        if (claims[i].section == section)
            print_claim(page, results, &claims[i], truth);
    dpl_html_table_end(page);
}

static void print_verdicts(FILE *page, const dpl_study_results *results) {
    static const char *const columns[] = {"Claims", "reproduced", "partly", "not reproduced"};
    dpl_html_table_begin(page, "How many of the paper's figures and claims were found again.", columns, 4);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        int counts[DPL_STUDY_VERDICTS];
        dpl_study_count_verdicts(results, (dpl_study_profile)p, counts);
        fprintf(page,
                "<tr><th scope=\"row\">%s</th><td class=\"reproduced\">%d</td><td class=\"partly\">%d</td>"
                "<td class=\"not\">%d</td></tr>\n",
                p == DPL_STUDY_PAPER ? "in the paper's profile" : "in the corrected profile",
                counts[DPL_STUDY_REPRODUCED], counts[DPL_STUDY_PARTLY], counts[DPL_STUDY_NOT]);
    }
    dpl_html_table_end(page);
}

/* What a reader wants to see first: where the paper's own method does not give the paper's figures. */
static void print_differences(FILE *page, const dpl_study_results *results) {
    int count;
    const dpl_study_claim *claims = dpl_study_claims(&count);
    fputs("<p>In the paper's profile, other than the paper says:</p>\n<ul>\n", page);
    for (int i = 0; i < count; i++) {
        char value[DPL_STUDY_TEXT_MAX];
        dpl_study_verdict verdict = dpl_study_judge(results, DPL_STUDY_PAPER, &claims[i]);
        if (verdict != DPL_STUDY_PARTLY && verdict != DPL_STUDY_NOT)
            continue;
        dpl_study_claim_value(results, DPL_STUDY_PAPER, &claims[i], value);
        fprintf(page, "<li>%s: ", sections[claims[i].section].title);
        dpl_html_text(page, claims[i].text);
        fputs(": ", page);
        dpl_html_text(page, claims[i].paper);
        fputs(" in the paper, ", page);
        dpl_html_text(page, value);
        fprintf(page, " here <span class=\"%s\">(%s)</span></li>\n", dpl_study_verdict_name(verdict),
                verdict_texts[verdict]);
    }
    fputs("</ul>\n", page);
}

static void print_introduction(FILE *page, const dpl_study_results *results) {
    const dpl_study_plan *plan = results->plan;
    fprintf(page,
            "<p>“Adaptive Ray Skipping for Radiance Cascades” (Botros Youssef 2026), measured again on %d "
            "seeded scenes of %d × %d pixels: scenes 0 to %d of the family <code>arc</code>, seed%s %" PRIu64,
            (int)dpl_study_scene_count(plan), (int)plan->size, (int)plan->size, (int)plan->scenes - 1,
            plan->seeds == 1 ? "" : "s", plan->first_seed);
    if (plan->seeds > 1)
        fprintf(page, " to %" PRIu64, plan->first_seed + (uint64_t)plan->seeds - 1);
    fputs(".</p>\n", page);
    if (plan->scenes < DPL_STUDY_SCENES_MAX)
        fprintf(page,
                "<p><strong>Only the first %d of the 50 scenes were run: figures and verdicts are not "
                "those of the study.</strong></p>\n",
                (int)plan->scenes);
    fputs(
        "<p><strong>Paper's profile</strong>: the geometry, the march, the edge blend and the signal probes "
        "of the paper's own code. <strong>Corrected profile</strong>: the same probes, directions and "
        "intervals; exact traversal of the pixel world, coarse rays in the middle of those they stand for, "
        "signals over the whole picture.</p>\n",
        page);
    print_verdicts(page, results);
    print_differences(page, results);
    fprintf(page,
            "<p>The command that made this: <code>dapple study --seeds %d --first-seed %" PRIu64
            " --scenes %d --size %d --truth %d --out DIR</code> (dapple %s).</p>\n",
            (int)plan->seeds, plan->first_seed, (int)plan->scenes, (int)plan->size, (int)plan->truth,
            dpl_version());
}

static int32_t count_infinite(const dpl_study_results *results, int profile, bool truth) {
    int32_t infinite = 0;
    for (int m = DPL_SKIP_L5; m < DPL_STUDY_MODES; m++) {
        const dpl_study_mode_statistics *mode = &results->pooled[profile].modes[m];
        infinite += truth ? mode->display_truth.infinite : mode->display_off.infinite;
    }
    return infinite;
}

static void print_reading(FILE *page, const dpl_study_results *results) {
    dpl_html_element(page, "h2", "How to read this");
    fputs(
        "<ul>\n"
        "<li><strong>vs off</strong>: compared with the same profile and nothing skipped, as the paper does. "
        "<strong>vs truth</strong>: compared with the reference. The two never share a column.</li>\n"
        "<li><strong>psnr_display</strong>: after the tone map, 8 bits, RGB, peak 255; vs off over all "
        "pixels, solid ones included, as in the paper. <strong>psnr_linear</strong>: unclamped linear "
        "radiance; vs off over free pixels with the largest value of the off picture as its peak, vs truth "
        "with peak 1.</li>\n",
        page);
    fprintf(
        page,
        "<li><strong>Truth</strong>: %d directions from the centre of up to %d free pixels a scene, drawn by "
        "seed; the same pixels for both profiles.</li>\n",
        DPL_STUDY_TRUTH_DIRECTIONS, (int)results->plan->truth);
    fputs(
        "<li><strong>Rays</strong> are counted where they are traced, never computed from a formula.</li>\n"
        "<li><strong>Seeds</strong>: a figure is the mean over seeds, with its range when there are several; "
        "a correlation is that of all scenes together.</li>\n"
        "<li><strong>Verdicts</strong> follow the rule in small print. The same rule is put to the corrected "
        "profile, where it says whether the paper's figure still stands: it may fail by being better.</li>\n",
        page);
    fprintf(page,
            "<li><strong>Infinite PSNR</strong> (no error at all) is left out of means, ranges and "
            "correlations. There were, over all modes that skip: vs off %d in the paper's profile and %d in "
            "the corrected one; vs truth %d and %d.</li>\n</ul>\n",
            (int)count_infinite(results, DPL_STUDY_PAPER, false),
            (int)count_infinite(results, DPL_STUDY_CORRECTED, false),
            (int)count_infinite(results, DPL_STUDY_PAPER, true),
            (int)count_infinite(results, DPL_STUDY_CORRECTED, true));
}

static void print_below(FILE *page, const dpl_study_results *results) {
    static const char *const columns[] = {"Seed", "Scene", "Lights / occluders", "Profile", "Mode", "vs off"};
    dpl_html_element(page, "h2", "Scenes that auto leaves at or below 50 dB");
    dpl_html_table_begin(page, "psnr_display vs off.", columns, 6);
    int32_t rows = 0;
    for (int p = 0; p < DPL_STUDY_PROFILES; p++)
        for (int32_t i = 0; i < dpl_study_scene_count(results->plan); i++) {
            const dpl_study_scene_record *scene = &results->records[i];
            const dpl_study_mode_record *mode = &scene->profiles[p].modes[DPL_SKIP_AUTO];
            if (mode->display_off > DPL_STUDY_BAR_DB)
                continue;
            rows++;
            fprintf(page,
                    "<tr><td>%" PRIu64 "</td><td>%d</td><td>%d / %d</td><td>%s</td><td>%s</td>"
                    "<td>%.2f dB</td></tr>\n",
                    scene->seed, (int)scene->index, (int)scene->lights, (int)scene->occluders,
                    dpl_study_profile_name((dpl_study_profile)p),
                    dpl_skip_mode_name((dpl_skip_mode)mode->used), mode->display_off);
        }
    if (rows == 0)
        fputs("<tr><td colspan=\"6\">none</td></tr>\n", page);
    dpl_html_table_end(page);
}

static void print_plots(FILE *page, const dpl_study_results *results) {
    int count;
    const dpl_study_plot *plots = dpl_study_plots(&count);
    dpl_html_element(page, "h2", "Plots");
    if (dpl_study_scene_count(results->plan) > DPL_STUDY_PLOT_SCENES)
        fprintf(page, "<p>Points are those of the first %d scenes.</p>\n", DPL_STUDY_PLOT_SCENES);
    for (int i = 0; i < count; i++)
        dpl_html_figure(page, results->plan->folder, plots[i].name, plots[i].caption);
}

/* What print_report() gets to see. */
typedef struct report_content {
    const dpl_study_results *results;
    bool plots;
} report_content;

static void print_report(FILE *page, const void *user) {
    const report_content *content = user;
    const dpl_study_results *results = content->results;
    dpl_html_begin(page, "Adaptive ray skipping, measured again");
    print_introduction(page, results);
    for (int s = 0; s <= DPL_STUDY_SECTION_ADAPTIVE; s++)
        print_section(page, results, (dpl_study_section)s);
    print_below(page, results);
    for (int s = DPL_STUDY_SECTION_ADAPTIVE + 1; s < DPL_STUDY_SECTIONS; s++)
        print_section(page, results, (dpl_study_section)s);
    if (content->plots)
        print_plots(page, results);
    print_reading(page, results);
    dpl_html_element(page, "p",
                     "Beside this file: results.csv, signals.csv, summary.csv, correlations.csv, "
                     "headlines.csv, headlines-vs-truth.csv and below-50-db.csv with every number behind it; "
                     "times.csv and times.md with wall times.");
    dpl_html_end(page);
}

bool dpl_study_write_report(const dpl_study_results *results, bool plots, dpl_error *error) {
    const report_content content = {results, plots};
    return dpl_study_write_file(results->plan->folder, "report.html", print_report, &content, error);
}
