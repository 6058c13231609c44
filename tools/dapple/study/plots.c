/* Prints the script and has it run. Colours are readable on white and on black: the report shows the plots on
 * both. */
#include "plots.h"

#include "folder_file.h"
#include "gnuplot.h"

#include <math.h>

#define SCRIPT "plots.gp"

/* One colour for each mode, and for each profile. */
#define COLOUR_L5 "#2f8fd8"
#define COLOUR_L4 "#2fa36b"
#define COLOUR_L3 "#d08a1d"
#define COLOUR_L2 "#d4504c"
#define COLOUR_AUTO "#8d6bd6"
#define COLOUR_PAPER "#d08a1d"
#define COLOUR_CORRECTED "#2f8fd8"
#define BAR "50 with lines lc rgb '#888888' dt 2 lw 1.5 title '50 dB'"

static void print_modes(FILE *script, const char *data) {
    fprintf(script,
            "set xlabel 'scene'\nset ylabel 'psnr\\_display vs off [dB]'\nset xrange [-1:50]\n"
            "plot %s using 1:2 with points pt 7 ps 0.6 lc rgb '" COLOUR_L5 "' title 'L5', \\\n"
            "  '' using 1:3 with points pt 5 ps 0.6 lc rgb '" COLOUR_L4 "' title 'L4', \\\n"
            "  '' using 1:4 with points pt 9 ps 0.7 lc rgb '" COLOUR_L3 "' title 'L3', \\\n"
            "  '' using 1:5 with points pt 11 ps 0.7 lc rgb '" COLOUR_L2 "' title 'L2', \\\n"
            "  '' using 1:6 with points pt 6 ps 1.1 lc rgb '" COLOUR_AUTO "' title 'auto', \\\n"
            "  " BAR "\n",
            data);
}

static void print_modes_paper(FILE *script) {
    print_modes(script, "$paper");
}

static void print_modes_corrected(FILE *script) {
    print_modes(script, "$corrected");
}

static void print_score(FILE *script) {
    fputs("set xlabel 'score: mean + stddev'\nset ylabel 'psnr\\_display of L2 vs off [dB]'\n"
          "set xrange [0:*]\n"
          "set arrow 1 from 0.45, graph 0 to 0.45, graph 1 nohead dt 2 lc rgb '#888888'\n"
          "set arrow 2 from 1.00, graph 0 to 1.00, graph 1 nohead dt 2 lc rgb '#888888'\n"
          "set label 1 'L5' at 0.43, graph 0.04 right\nset label 2 'L4' at 0.72, graph 0.04 center\n"
          "set label 3 'L3' at 1.02, graph 0.04 left\n"
          "plot $paper using 7:5 with points pt 7 ps 0.7 lc rgb '" COLOUR_PAPER "' title 'paper', \\\n"
          "  $corrected using 7:5 with points pt 6 ps 0.9 lc rgb '" COLOUR_CORRECTED "' title 'corrected'\n"
          "unset arrow\nunset label\n",
          script);
}

static void print_reduction(FILE *script) {
    fputs("set xlabel 'rays left out, counted [%]'\nset ylabel 'psnr\\_display vs off [dB]'\n"
          "set xrange [5:50]\n"
          "plot $paper_reduction using ($2-0.3):4:5:6 with yerrorbars pt 7 ps 0.9 lc rgb '" COLOUR_PAPER
          "' title 'paper', \\\n"
          "  '' using 2:5:1 with labels offset 0,-0.7 notitle, \\\n"
          "  '' using 3:4 with points pt 2 ps 0.9 lc rgb '" COLOUR_PAPER
          "' title 'paper, dead rays dropped', \\\n"
          "  $corrected_reduction using ($2+0.3):4:5:6 with yerrorbars pt 6 ps 0.9 lc rgb '" COLOUR_CORRECTED
          "' title 'corrected', \\\n"
          "  '' using 2:6:1 with labels offset 0,0.7 notitle, \\\n  " BAR "\n",
          script);
}

static const dpl_study_plot plots[] = {
    {"psnr-paper", "PSNR of each mode vs off, scene by scene, in the paper's profile.", print_modes_paper},
    {"psnr-corrected", "The same in the corrected profile.", print_modes_corrected},
    {"score",
     "The score that picks auto's mode, and what the most aggressive mode then costs. Dashed: the paper's "
     "thresholds.",
     print_score},
    {"reduction",
     "What is saved and what it costs: mean, lowest and highest PSNR vs off of each mode, the profiles drawn "
     "side by side. Crosses: the paper's modes without dead rays, the same pictures for fewer rays.",
     print_reduction},
};

enum { PLOT_COUNT = sizeof plots / sizeof plots[0] };

const dpl_study_plot *dpl_study_plots(int *count) {
    *count = PLOT_COUNT;
    return plots;
}

static void put(FILE *script, double value) {
    if (isfinite(value))
        fprintf(script, " %.4f", value);
    else
        fputs(" NaN", script);
}

/* Scene, PSNR of L5, L4, L3, L2 and auto, score. */
static void print_scenes(FILE *script, const dpl_study_results *results, dpl_study_profile profile) {
    int32_t scenes = dpl_study_scene_count(results->plan);
    if (scenes > DPL_STUDY_PLOT_SCENES)
        scenes = DPL_STUDY_PLOT_SCENES;
    fprintf(script, "$%s << EOD\n", dpl_study_profile_name(profile));
    for (int32_t i = 0; i < scenes; i++) {
        const dpl_study_scene_record *scene = &results->records[i];
        fprintf(script, "%d", (int)scene->index);
        for (int m = DPL_SKIP_L5; m < DPL_STUDY_MODES; m++)
            put(script, scene->profiles[profile].modes[m].display_off);
        put(script, scene->profiles[profile].signals.score);
        fputc('\n', script);
    }
    fputs("EOD\n", script);
}

/* Mode, reduction, the same without dead rays, mean, lowest and highest PSNR. */
static void print_reductions(FILE *script, const dpl_study_results *results, dpl_study_profile profile) {
    fprintf(script, "$%s_reduction << EOD\n", dpl_study_profile_name(profile));
    for (int m = DPL_SKIP_L5; m < DPL_STUDY_MODES; m++) {
        const dpl_study_mode_statistics *mode = &results->pooled[profile].modes[m];
        fputs(dpl_skip_mode_name((dpl_skip_mode)m), script);
        put(script, 100 * mode->reduction);
        put(script, 100 * mode->reduction_dropped);
        put(script, mode->display_off.mean);
        put(script, mode->display_off.min);
        put(script, mode->display_off.max);
        fputc('\n', script);
    }
    fputs("EOD\n", script);
}

static void print_script(FILE *script, const void *user) {
    const dpl_study_results *results = user;
    fputs("# Draws the plots of this folder: gnuplot " SCRIPT "\n", script);
    for (int p = 0; p < DPL_STUDY_PROFILES; p++) {
        print_scenes(script, results, (dpl_study_profile)p);
        print_reductions(script, results, (dpl_study_profile)p);
    }
    fputs("set grid lc rgb '#888888' lw 0.5\nset border 3\nset tics nomirror\n"
          "set key outside top center horizontal\nset offsets 0, 0, graph 0.03, graph 0.03\n",
          script);
    for (int i = 0; i < PLOT_COUNT; i++) {
        fprintf(script,
                "\nset terminal svg size 640,440 font 'sans-serif,15'\n"
                "set output '%s.svg'\n",
                plots[i].name);
        plots[i].print(script);
        fprintf(script,
                "set terminal pngcairo size 1280,880 font 'sans-serif,22' linewidth 2 pointscale 2\n"
                "set output '%s.png'\n",
                plots[i].name);
        plots[i].print(script);
        fputs("unset output\n", script);
    }
}

bool dpl_study_write_plot_script(const dpl_study_results *results, dpl_error *error) {
    return dpl_study_write_file(results->plan->folder, SCRIPT, print_script, results, error);
}

bool dpl_study_draw_plots(const dpl_study_results *results, dpl_error *error) {
    const char *names[PLOT_COUNT];
    for (int i = 0; i < PLOT_COUNT; i++)
        names[i] = plots[i].name;
    return dpl_study_gnuplot_draw(results->plan->folder, SCRIPT, names, PLOT_COUNT, error);
}
