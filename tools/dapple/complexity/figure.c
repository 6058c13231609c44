/* Prints the script and has it run. Colours are readable on white and on black: the page shows the figure on
 * both. */
#include "figure.h"

#include "../study/folder_file.h"
#include "../study/gnuplot.h"
#include "paper.h"

#define SCRIPT DPL_COMPLEXITY_FIGURE ".gp"

/* The paper draws its naive panel in red, the optimized one in blue, flood fill in green. */
static const char *const naive_shades[DPL_COMPLEXITY_RAY_COUNTS] = {"#f0a8a0", "#e88a82", "#d86a62",
                                                                    "#c84a42", "#b02a22"};
static const char *const bvh_shades[DPL_COMPLEXITY_RAY_COUNTS] = {"#a8cdf0", "#86b6e8", "#5f9cdc", "#3f84d0",
                                                                  "#1f68b8"};
#define GREEN "#2fa36b"
#define PAPER "#888888"
/* The paper's r, and its most objects: there the curves without a unit are laid upon the measurements. */
#define PAPER_RAYS 100

static double scale_at(const dpl_complexity_case *c, double paper) {
    return c && paper > 0 ? c->cpu.median / paper : 1;
}

/* The measured case that the paper's curve of a method is laid upon. */
static const dpl_complexity_case *anchor(const dpl_complexity_worlds *worlds, dpl_complexity_method method) {
    const dpl_complexity_case *found = NULL;
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        bool flood = method == DPL_COMPLEXITY_FLOOD;
        if (c->part == DPL_COMPLEXITY_GROWTH && c->method == method && (flood || c->rays == PAPER_RAYS) &&
            c->size <= (flood ? 128 : DPL_COMPLEXITY_PAPER_LARGEST))
            found = c;
    }
    return found;
}

static void print_series(FILE *script, const dpl_complexity_worlds *worlds, dpl_complexity_method method,
                         int32_t rays) {
    fprintf(script, "$%s_%d << EOD\n", dpl_complexity_method_name(method), (int)rays);
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        if (c->part != DPL_COMPLEXITY_GROWTH || c->method != method || c->rays != rays)
            continue;
        fprintf(script, "%.0f %.6g %.6g %.6g", dpl_complexity_items(c), c->cpu.median, c->cpu.min,
                c->cpu.max);
        if (rays > 0)
            fprintf(script, " %.4f", (double)c->counts[DPL_COMPLEXITY_STEPS] / rays);
        fputc('\n', script);
    }
    fputs("EOD\n", script);
}

static void print_data(FILE *script, const dpl_complexity_worlds *worlds) {
    for (int method = DPL_COMPLEXITY_NAIVE; method <= DPL_COMPLEXITY_BVH; method++)
        for (int i = 0; i < DPL_COMPLEXITY_RAY_COUNTS; i++)
            print_series(script, worlds, (dpl_complexity_method)method, dpl_complexity_ray_counts[i]);
    print_series(script, worlds, DPL_COMPLEXITY_FLOOD, 0);
    const dpl_complexity_case *naive = anchor(worlds, DPL_COMPLEXITY_NAIVE);
    const dpl_complexity_case *bvh = anchor(worlds, DPL_COMPLEXITY_BVH);
    const dpl_complexity_case *flood = anchor(worlds, DPL_COMPLEXITY_FLOOD);
    fprintf(script, "paper_naive = %.6g\npaper_optimized = %.6g\npaper_flood = %.6g\n",
            scale_at(naive, dpl_complexity_paper_naive(naive->size)),
            scale_at(bvh, dpl_complexity_paper_optimized(bvh->size)),
            dpl_complexity_paper_flood() * flood->cpu.median / dpl_complexity_items(flood));
}

/* One line for each number of rays in a run, most rays first, as they lie in the panel. */
static void print_rays(FILE *script, dpl_complexity_method method, const char *const *shades) {
    for (int i = DPL_COMPLEXITY_RAY_COUNTS - 1; i >= 0; i--)
        fprintf(
            script,
            "  $%s_%d using 1:2:3:4 with yerrorlines pt 7 ps 0.35 lw 1.3 lc rgb '%s' title 'r = %d', \\\n",
            dpl_complexity_method_name(method), (int)dpl_complexity_ray_counts[i], shades[i],
            (int)dpl_complexity_ray_counts[i]);
}

static void print_panels(FILE *script) {
    const int most = (int)dpl_complexity_ray_counts[DPL_COMPLEXITY_RAY_COUNTS - 1];
    fputs("set multiplot layout 1,3\nset logscale xy\nset format xy '10^{%T}'\n"
          "set title 'Ray tracing (naive)'\nset xlabel 'objects n'\nset ylabel 'time of r rays [ms]'\n"
          "set xrange [0.7:*]\nset yrange [1e-3:1e4]\nset key top left\nplot \\\n",
          script);
    print_rays(script, DPL_COMPLEXITY_NAIVE, naive_shades);
    fputs("  paper_naive * 12 * x * x * 10 with lines dt 2 lw 1.5 lc rgb '" PAPER
          "' title \"paper: 12 N N 10\"\n"
          "set title 'Ray tracing (BVH)'\nset ylabel 'time of r rays [ms]'\n"
          "set ytics nomirror\nset y2tics 0, 4, 16 nomirror tc rgb '#8d6bd6'\nset format y2 '%.0f'\nunset "
          "logscale y2\n"
          "set y2range [0:24]\nset y2label 'node visits per ray' tc rgb '#8d6bd6'\nplot \\\n",
          script);
    print_rays(script, DPL_COMPLEXITY_BVH, bvh_shades);
    fprintf(script,
            "  $bvh_%d using 1:5 axes x1y2 with points pt 6 ps 0.7 lw 1.2 lc rgb '#8d6bd6' "
            "title 'node visits', \\\n"
            "  (x > 1 ? paper_optimized * 100 * log(x) / log(2) : NaN) with lines dt 2 lw 1.5 lc rgb '" PAPER
            "' title \"paper: 100 log_2 N\"\n",
            most);
    fputs("unset y2tics\nunset y2label\nset ytics mirror\nset title 'Flood fill'\nset xlabel 'cells w h'\n"
          "set ylabel 'time of a solve [ms]'\nset xrange [2e3:3e7]\nset yrange [1e-3:1e4]\nplot \\\n"
          "  $flood_0 using 1:2:3:4 with yerrorlines pt 7 ps 0.5 lw 1.3 lc rgb '" GREEN
          "' title 'measured', \\\n"
          "  paper_flood with lines dt 2 lw 1.5 lc rgb '" PAPER "' title \"paper: 100 * 100\"\n"
          "unset multiplot\nunset output\nreset\n",
          script);
}

static void print_script(FILE *script, const void *user) {
    const dpl_complexity_results *results = user;
    static const char *const terminals[] = {
        "set terminal svg size 1000,400 font 'sans-serif,13'\nset output '" DPL_COMPLEXITY_FIGURE ".svg'\n",
        "set terminal pngcairo size 2400,840 font 'sans-serif,20' linewidth 2 pointscale 2\n"
        "set output '" DPL_COMPLEXITY_FIGURE ".png'\n",
    };
    fputs("# Draws the figure of this folder: gnuplot " SCRIPT "\n", script);
    print_data(script, results->worlds);
    for (int i = 0; i < 2; i++) {
        fprintf(script, "\n%sset grid lc rgb '#888888' lw 0.4\nset samples 200\n", terminals[i]);
        print_panels(script);
    }
}

bool dpl_complexity_write_figure_script(const dpl_complexity_results *results, dpl_error *error) {
    return dpl_study_write_file(results->worlds->plan->folder, SCRIPT, print_script, results, error);
}

bool dpl_complexity_draw_figure(const dpl_complexity_results *results, dpl_error *error) {
    static const char *const names[] = {DPL_COMPLEXITY_FIGURE};
    return dpl_study_gnuplot_draw(results->worlds->plan->folder, SCRIPT, names, 1, error);
}
