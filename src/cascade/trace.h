/* A batch of rays of many slots, rows and probes of a level, so that vectors are full although most rays are
 * left out. Filled by trace.c, and by guess.c and check.c, which trace some rays before others. */
#ifndef DPL_CASCADE_TRACE_H
#define DPL_CASCADE_TRACE_H

#include "cascade/survey.h"

#define DPL_TRACE_RAYS 4096
#define DPL_TRACE_WORDS 1024
#define DPL_TRACE_CHUNKS 512

/* What the rays of a row and direction share: where they begin and end, seen from the probe, or from the
 * parent that they are aimed at. */
typedef enum dpl_ray_target { DPL_AT_SELF, DPL_AT_LOWER, DPL_AT_UPPER, DPL_AT_NEAREST } dpl_ray_target;

typedef struct dpl_ray_row {
    float start_x, end_x;
    float y0, y1;
    dpl_ray_target target;
    int32_t first, last; /* probes whose ray comes near anything: first .. last-1 */
} dpl_ray_row;

/* 64 probes of a row, one ray. Who fills a batch says what becomes of `hits` and `ends`. */
typedef struct dpl_traced_word {
    uint64_t rays;  /* that are marched */
    uint64_t known; /* that are not, for they are known to end at the pixels in `ends` */
    uint64_t *hits;
    int32_t *ends; /* of the first of the 64 probes */
} dpl_traced_word;

/* A chunk of a row in one slot: its words of the batch, and where the place of its cells goes. */
typedef struct dpl_traced_chunk {
    int32_t word_end;
    int64_t *cells_at;
} dpl_traced_chunk;

typedef struct dpl_trace_batch {
    int32_t ray_count, known_count, word_count, chunk_count;
    float x0[DPL_TRACE_RAYS], y0[DPL_TRACE_RAYS], x1[DPL_TRACE_RAYS], y1[DPL_TRACE_RAYS];
    int32_t cell[DPL_TRACE_RAYS]; /* that each ray ends at, or -1 */
    int32_t found[DPL_TRACE_RAYS];
    dpl_traced_word words[DPL_TRACE_WORDS];
    dpl_traced_chunk chunks[DPL_TRACE_CHUNKS];
} dpl_trace_batch;

/* The worker's own, empty. */
dpl_trace_batch *dpl_trace_begin(const dpl_survey_task *t, int32_t worker);

dpl_ray_row dpl_trace_aim(const dpl_survey_task *t, int32_t ray, int32_t aim, int32_t row);

/* Is there no room for one more word? */
static inline bool dpl_trace_is_full(const dpl_trace_batch *b) {
    return b->ray_count > DPL_TRACE_RAYS - DPL_MASK_BITS || b->word_count == DPL_TRACE_WORDS;
}

/* Adds rays of the 64 probes from `base` on. There must be room. */
void dpl_trace_add(const dpl_survey_level *level, const dpl_ray_row *row, int32_t base, dpl_traced_word word,
                   dpl_trace_batch *b);

/* Marches all rays of the batch into `cell`, word by word, and returns how many there are. */
int64_t dpl_trace_march(const dpl_survey_task *t, dpl_trace_batch *b);

void dpl_trace_clear(dpl_trace_batch *b);

#endif
