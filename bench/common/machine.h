/* Where, with what and when figures were taken: stands at the head of every report. Used by both benchmarks.
 */
#ifndef DPL_BENCH_MACHINE_H
#define DPL_BENCH_MACHINE_H

#include <dapple/context.h>
#include <stdio.h>

typedef struct dpl_bench_machine {
    char cpu[128];      /* model name as the system gives it */
    char slug[128];     /* the same as a folder's name: lower case, dashes */
    int processors;     /* online */
    char compiler[128]; /* name and version */
    char build[128];    /* build type, and sanitizers if there are any */
    char date[32];      /* UTC */
    double load;        /* runnable threads of the whole machine, mean of the last minute; -1: not known */
} dpl_bench_machine;

dpl_bench_machine dpl_bench_machine_read(void);

/* "- machine: …" and "- build: …", two items of a Markdown list. */
void dpl_bench_machine_write(const dpl_bench_machine *machine, const dpl_context *context, FILE *stream);

/* The commit that was built, "+changes" behind it when files differed from it; "unknown" outside git. Made
 * with every build by commit.cmake. */
const char *dpl_bench_commit(void);

#endif
