/* A batch of rays of many slots, rows and probes of a level, so that vectors are full although most rays are
 * left out. Filled by trace.c, and by guess.c, which traces some rays before others. */
#ifndef DPL_CASCADE_TRACE_H
#define DPL_CASCADE_TRACE_H

#include "cascade/survey.h"

#define DPL_TRACE_RAYS 4096
#define DPL_TRACE_WORDS 1024
#define DPL_TRACE_CHUNKS 512

/* 64 probes of a row, one ray: which are traced, and where their hits go, or else the cells of all. */
typedef struct dpl_traced_word {
    uint64_t rays;
    uint64_t *hits;
    int32_t *results; /* of the first of the 64 probes */
} dpl_traced_word;

/* A chunk of a row in one slot: its words of the batch, and where the place of its cells goes. */
typedef struct dpl_traced_chunk {
    int32_t word_end;
    int64_t *cells_at;
} dpl_traced_chunk;

typedef struct dpl_trace_batch {
    int32_t ray_count, word_count, chunk_count;
    float x0[DPL_TRACE_RAYS], y0[DPL_TRACE_RAYS], x1[DPL_TRACE_RAYS], y1[DPL_TRACE_RAYS];
    int32_t cell[DPL_TRACE_RAYS];
    dpl_traced_word words[DPL_TRACE_WORDS];
    dpl_traced_chunk chunks[DPL_TRACE_CHUNKS];
} dpl_trace_batch;

/* The worker's own, empty. */
dpl_trace_batch *dpl_trace_begin(const dpl_survey_task *t, int32_t worker);

/* Of one ray of a row of probes, those that `rays` names; `results` receives the pixel that each ends at, or
 * -1: one number per probe of the row. Returns the rays that were marched meanwhile. */
int64_t dpl_trace_add(const dpl_survey_task *t, dpl_trace_batch *b, int32_t ray, int32_t aim, int32_t row,
                      const uint64_t *rays, int32_t *results);

/* Marches what is left of the batch; returns how many rays that were. */
int64_t dpl_trace_end(const dpl_survey_task *t, dpl_trace_batch *b);

#endif
