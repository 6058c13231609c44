/* Command lines of the benchmarks as a table: `--name value`, names and ranges as data. Used by both main.c.
 */
#ifndef DPL_BENCH_OPTIONS_H
#define DPL_BENCH_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

/* Exit statuses, as those of the command line tool. */
enum { DPL_BENCH_DONE = 0, DPL_BENCH_FAILED = 1, DPL_BENCH_USAGE = 2 };

/* The work may start: no exit status has this value. */
#define DPL_BENCH_GO (-1)

typedef enum dpl_bench_option_kind {
    DPL_BENCH_FLAG,    /* no value; bool, set to true */
    DPL_BENCH_TEXT,    /* const char * */
    DPL_BENCH_INTEGER, /* int32_t within minimum .. maximum */
    DPL_BENCH_SEED     /* uint64_t */
} dpl_bench_option_kind;

typedef struct dpl_bench_option {
    const char *name; /* without the dashes */
    dpl_bench_option_kind kind;
    void *target; /* keeps what it holds when the option is not given */
    int32_t minimum;
    int32_t maximum;
} dpl_bench_option;

/* Reads a command line. Returns DPL_BENCH_GO, or the exit status after --help (prints `help`) or after a
 * wrong argument (one line on standard error that begins with `program`). */
int dpl_bench_options_read(const char *program, const char *help, const dpl_bench_option *options, int count,
                           int argc, char **argv);

/* Says on standard error what is wrong with the command line (printf-like); returns DPL_BENCH_USAGE. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
int dpl_bench_usage(const char *program, const char *format, ...);

#endif
