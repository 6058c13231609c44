/* Wall time and processor time for stopwatches. Used by both benchmarks. */
#ifndef DPL_BENCH_CLOCK_H
#define DPL_BENCH_CLOCK_H

/* Both at once. Processor time is the sum over all threads of this program: what others do on the machine
 * does not count in it. */
typedef struct dpl_bench_time {
    double wall_ms;
    double cpu_ms;
} dpl_bench_time;

/* Time since some fixed moment. */
dpl_bench_time dpl_bench_now(void);

/* Time since an earlier dpl_bench_now(). */
dpl_bench_time dpl_bench_since(dpl_bench_time start);

#endif
