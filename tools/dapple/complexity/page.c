/* Prints the page, section by section. */
#include "page.h"

#include "../study/folder_file.h"
#include "../study/html.h"
#include "figure.h"

#include <dapple/version.h>
#include <inttypes.h>
#include <math.h>

typedef struct page_content {
    const dpl_complexity_results *results;
    bool figure;
} page_content;

static void print_introduction(FILE *page, const dpl_complexity_results *results) {
    const dpl_complexity_plan *plan = results->worlds->plan;
    const dpl_bench_machine *m = &results->machine;
    dpl_html_element(
        page, "p",
        "How the work of three ways to light a plane grows, measured: rays against one object "
        "after another, rays through a hierarchy of boxes (BVH), and flood fill. The M.R.M.A. "
        "paper plots formulas for the same three. Counts are exact and repeat: the command fails "
        "otherwise. Times are processor time, medians with least and greatest, of rounds in "
        "which all cases take turns.");
    fprintf(page,
            "<p><code>dapple complexity --largest %d --largest-cells %d --seed %" PRIu64
            " --threads %d</code>, %d rounds; ",
            (int)plan->largest, (int)plan->side, plan->seed, (int)plan->threads, (int)plan->rounds);
    dpl_html_text(page, m->cpu);
    fprintf(page, ", %d processors, load %.2f when it began, %s; %s, %s, dapple %s, commit %s</p>\n",
            m->processors, m->load, m->date, m->compiler, DPL_BUILD_TYPE, dpl_version(), dpl_bench_commit());
}

static void print_size(FILE *page, double size) {
    fprintf(page, size < 1e7 ? "%.0f" : "%.3g", size);
}

static void print_finding(FILE *page, const dpl_complexity_finding *f) {
    fputs("<tr><th scope=\"row\">", page);
    dpl_html_text(page, f->what);
    fputs("</th><td>", page);
    print_size(page, f->from);
    if (f->to > f->from) {
        fputs(" to ", page);
        print_size(page, f->to);
    }
    fprintf(page, " %s</td><td>%.3f %s</td><td>%.3f .. %.3f</td><td>", f->of, f->value, f->unit, f->low,
            f->high);
    if (!isnan(f->r2))
        fprintf(page, "%.4f", f->r2);
    fprintf(page, "</td><td>%s", f->target);
    if (f->verdict != DPL_COMPLEXITY_NO_TARGET)
        fprintf(page, "<span class=\"v %s\">%s</span>",
                f->verdict == DPL_COMPLEXITY_MET ? "reproduced" : "not",
                dpl_complexity_verdict_name(f->verdict));
    fputs("</td></tr>\n", page);
}

static void print_findings(FILE *page, const dpl_complexity_findings *findings) {
    static const char *const columns[] = {"", "Over", "Value", "From .. to", "R2", "Target"};
    char caption[384];
    dpl_html_element(page, "h2", "What was found");
    snprintf(caption, sizeof caption,
             "Of exponents and growth per decade the 95 %% interval of the fit to logarithms, over objects "
             "at %d rays in a run; of times the least and greatest round; of the crossover, itself by least "
             "times, the least and "
             "greatest by rounds.",
             (int)findings->fit_rays);
    dpl_html_table_begin(page, caption, columns, 6);
    for (int32_t i = 0; i < findings->count; i++)
        print_finding(page, &findings->list[i]);
    dpl_html_table_end(page);
}

static void print_ns_per(FILE *page, const dpl_complexity_case *c, double units) {
    if (!c) {
        fputs("<td>–</td>", page);
        return;
    }
    const double ns = 1e6 / units;
    const int decimals = c->cpu.median * ns < 20 ? 2 : 0;
    fprintf(page, "<td>%.*f (%.*f .. %.*f)</td>", decimals, c->cpu.median * ns, decimals, c->cpu.min * ns,
            decimals, c->cpu.max * ns);
}

static void print_tracing(FILE *page, const dpl_complexity_results *results) {
    static const char *const columns[] = {"Objects",      "Naive [ns/ray]", "Tests/ray",
                                          "BVH [ns/ray]", "Tests/ray",      "Visits/ray"};
    const dpl_complexity_worlds *worlds = results->worlds;
    const int32_t rays = results->findings.fit_rays;
    char caption[128];
    dpl_html_element(page, "h2", "Rays");
    snprintf(caption, sizeof caption, "Discs that cover a tenth of a square; %d rays in a run.", (int)rays);
    dpl_html_table_begin(page, caption, columns, 6);
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *bvh = &worlds->cases[i];
        if (bvh->method != DPL_COMPLEXITY_BVH || bvh->part != DPL_COMPLEXITY_GROWTH || bvh->rays != rays)
            continue;
        fprintf(page, "<tr><td>%d</td>", (int)bvh->size);
        print_ns_per(page, dpl_complexity_find(worlds, DPL_COMPLEXITY_NAIVE, bvh->size, rays), rays);
        fprintf(page, "<td>%d</td>", (int)bvh->size);
        print_ns_per(page, bvh, rays);
        fprintf(page, "<td>%.2f</td><td>%.2f</td></tr>\n", (double)bvh->counts[DPL_COMPLEXITY_WORK] / rays,
                (double)bvh->counts[DPL_COMPLEXITY_STEPS] / rays);
    }
    dpl_html_table_end(page);
}

static void print_flood(FILE *page, const dpl_complexity_results *results) {
    static const char *const columns[] = {"World", "Cells", "Visits", "Time [ns/cell]"};
    const dpl_complexity_worlds *worlds = results->worlds;
    dpl_html_element(page, "h2", "Flood fill");
    dpl_html_table_begin(page, "One lamp lights an open world to its corners, three channels, breadth-first.",
                         columns, 4);
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        if (c->method != DPL_COMPLEXITY_FLOOD)
            continue;
        fprintf(page, "<tr><td>%d x %d</td><td>%.0f</td><td>%" PRId64 "</td>", (int)c->size, (int)c->size,
                dpl_complexity_items(c), c->counts[DPL_COMPLEXITY_WORK]);
        print_ns_per(page, c, dpl_complexity_items(c));
        fputs("</tr>\n", page);
    }
    dpl_html_table_end(page);
}

static void print_paper(FILE *page) {
    dpl_html_element(page, "h2", "What the paper plots");
    fputs(
        "<ul>\n"
        "<li><strong>Naive</strong>: \"O(r n k)\" is drawn as 12 N N 10, quadratic in the objects; r does "
        "not occur. The text calls it exponential. Measured it is linear in the objects and in the "
        "rays.</li>\n"
        "<li><strong>Optimized</strong>: 100 log2 N, nothing at all for one object. Measured, node visits do "
        "grow by a constant per decade, from where there is something to sort; time grows a little more "
        "once the objects leave the caches.</li>\n"
        "<li><strong>Flood fill</strong>: the number 100 * 100 as a level line over objects. Measured, it "
        "is linear in the cells; objects do not matter to it. \"Typically not optimized further\": editing "
        "a block relights only what it touches.</li>\n"
        "</ul>\n",
        page);
}

static void print_page(FILE *page, const void *user) {
    const page_content *content = user;
    const dpl_complexity_results *results = content->results;
    dpl_html_begin(page, "Complexity, measured");
    print_introduction(page, results);
    if (content->figure) {
        dpl_html_element(page, "h2", "The paper's figure, measured");
        dpl_html_figure(
            page, results->worlds->plan->folder, DPL_COMPLEXITY_FIGURE,
            "Points and bars: median, least and greatest. Dashed: the paper's curves, which have no "
            "unit, laid upon the measurement at r = 100 and n = 1000 (or the most there are), and "
            "at 128 x 128 cells.");
    }
    print_findings(page, &results->findings);
    print_tracing(page, results);
    print_flood(page, results);
    print_paper(page);
    dpl_html_element(
        page, "p",
        "Beside this file: tracing.csv and flood.csv with every case, findings.csv, paper.csv with "
        "the paper's curves, complexity.gp that draws the figure again.");
    dpl_html_end(page);
}

bool dpl_complexity_write_page(const dpl_complexity_results *results, bool figure, dpl_error *error) {
    const page_content content = {results, figure};
    return dpl_study_write_file(results->worlds->plan->folder, "complexity.html", print_page, &content,
                                error);
}
