/* Draws the plot by handing gnuplot a script. Called by main.c, after the CSV has been written. */
#define _POSIX_C_SOURCE 200809L
#include "report.h"

#include <signal.h>
#include <stdio.h>

/* Reads columns of scaling.csv by name. Bars reach from the least to the greatest time. Points of the two
 * thread counts stand a little apart, so that their bars do not hide each other. */
static const char script[] =
    "set datafile separator ','\n"
    "set terminal pngcairo size 1200,560 font 'DejaVu Sans,11'\n"
    "set output 'scaling.png'\n"
    "csv = 'scaling.csv'\n"
    "stats csv using 'size' skip 0 nooutput name 'size'\n"
    "set logscale x 2\n"
    "set xrange [size_min / 1.4 : size_max * 1.4]\n"
    "set xlabel 'size [px a side]'\n"
    "set xtics out nomirror\n"
    "set ytics out nomirror\n"
    "set border 3\n"
    "set grid ytics lt 1 lw 1 lc rgb '#d0d0d0'\n"
    "set yrange [0:*]\n"
    "set key bottom center outside horizontal maxrows 2 width -2 samplen 3 spacing 1.2\n"
    "merges = 'bilinear bilinear-fix'\n"
    "colours = '#0072b2 #d55e00'\n"
    "unit(ms) = ms * 1e6 / (column('size') ** 2 * column('levels'))\n"
    "keep(m, t) = strcol('merge') eq word(merges, m) && column('threads') == t\n"
    "spread(t) = column('size') * (t == 1 ? 0.97 : 1.03)\n"
    "middle(kind, m, t) = keep(m, t) ? unit(column('solve_'.kind.'_median')) : NaN\n"
    "low(kind) = unit(column('solve_'.kind.'_min'))\n"
    "high(kind) = unit(column('solve_'.kind.'_max'))\n"
    "set multiplot layout 1,2 \\\n"
    "  title 'Solve: time per pixel and level. A flat line grows as pixels x levels' font ',14'\n"
    "do for [kind in 'cpu wall'] {\n"
    "  set title (kind eq 'cpu' ? 'processor time, summed over threads' : 'wall time')\n"
    "  set ylabel 'ns per pixel and level (median, min to max)'\n"
    "  plot for [m = 1:2] for [t = 1:2] csv \\\n"
    "    using (spread(t)):(middle(kind, m, t)):(low(kind)):(high(kind)) \\\n"
    "    with yerrorlines lw 2 dt t pt (t == 1 ? 7 : 6) lc rgb word(colours, m) \\\n"
    "    title sprintf('%s, %d thread%s', word(merges, m), t, t > 1 ? 's' : '')\n"
    "}\n"
    "unset multiplot\n";

bool dpl_bench_plot(dpl_error *error) {
    /* Without gnuplot the shell ends before it has read the script: that is an error to report, no reason to
     * die. */
    signal(SIGPIPE, SIG_IGN);
    FILE *gnuplot = popen("gnuplot", "w");
    if (!gnuplot)
        return dpl_error_set(error, "gnuplot could not be started");
    bool written = fputs(script, gnuplot) >= 0;
    return (pclose(gnuplot) == 0 && written) || dpl_error_set(error, "scaling.png: gnuplot failed");
}
