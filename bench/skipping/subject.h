/* The scenes that ray skipping is judged on. Used by main.c. */
#ifndef DPL_BENCH_SUBJECT_H
#define DPL_BENCH_SUBJECT_H

#include "../../scenes/families.h"

/* A family, or "textured": boxes and discs whose light changes from pixel to pixel, which no scene file can
 * describe. */
typedef struct dpl_bench_subject {
    const char *name;
    int32_t count; /* scenes per seed */
} dpl_bench_subject;

/* By name; false when there is none. */
bool dpl_bench_subject_find(const char *name, dpl_bench_subject *subject);

/* Makes the field of scene `index` of `seed`, size x size pixels. */
bool dpl_bench_subject_field(const dpl_bench_subject *subject, uint64_t seed, int32_t index, int32_t size,
                             dpl_context *context, dpl_field **field, dpl_error *error);

#endif
