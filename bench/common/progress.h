/* One line on standard error that says how far the work is, on a terminal only. Used by both benchmarks. */
#ifndef DPL_BENCH_PROGRESS_H
#define DPL_BENCH_PROGRESS_H

/* Replaces the line (printf-like). */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void dpl_bench_progress(const char *format, ...);

/* Wipes the line. */
void dpl_bench_progress_end(void);

#endif
