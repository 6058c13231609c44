/* A batch of rays of many slots, rows and probes of a level, so that vectors are full although most rays are
 * left out. Filled by trace.c, and by guess.c and check.c, which trace some rays before others. */
#ifndef DPL_CASCADE_TRACE_H
#define DPL_CASCADE_TRACE_H

#include "cascade/survey.h"

#define DPL_TRACE_RAYS 4096
#define DPL_TRACE_WORDS 1024
#define DPL_TRACE_CHUNKS 512

/* The rays of a row and direction, as words of them begin, and those probes whose ray comes near anything:
 * first .. last-1. */
typedef struct dpl_ray_row {
    dpl_ray_word word;
    int32_t first, last;
} dpl_ray_row;

/* A chunk of a row in one slot: its words of the batch, and where the place of its cells goes. */
typedef struct dpl_traced_chunk {
    int32_t word, word_end;
    int64_t *cells_at;
} dpl_traced_chunk;

typedef struct dpl_trace_batch {
    int32_t ray_count, known_count, word_count, chunk_count;
    float ends[4][DPL_TRACE_RAYS + DPL_RAY_WORDS_PAD]; /* of the rays: x0, y0, x1, y1 */
    int32_t cell[DPL_TRACE_RAYS + DPL_RAY_WORDS_PAD];  /* that each ends at, or -1 */
    int32_t list[DPL_TRACE_RAYS + DPL_RAY_WORDS_PAD];
    dpl_ray_word words[DPL_TRACE_WORDS];
    dpl_traced_chunk chunks[DPL_TRACE_CHUNKS];
} dpl_trace_batch;

/* The worker's own, empty. */
dpl_trace_batch *dpl_trace_begin(const dpl_survey_task *t, int32_t worker);

dpl_ray_row dpl_trace_aim(const dpl_survey_task *t, int32_t ray, int32_t aim, int32_t row);

/* Is there no room for one more word? */
static inline bool dpl_trace_is_full(const dpl_trace_batch *b) {
    return b->ray_count > DPL_TRACE_RAYS - DPL_MASK_BITS || b->word_count == DPL_TRACE_WORDS;
}

/* Adds a word of a row that begins at probe `first`. There must be room. What becomes of its `hits` and
 * `ends` is up to who fills the batch. */
static inline void dpl_trace_add(dpl_trace_batch *b, const dpl_ray_row *row, int32_t first, uint64_t rays,
                                 uint64_t known, uint64_t *hits, int32_t *ends) {
    dpl_ray_word *word = &b->words[b->word_count++];
    *word = row->word;
    word->first = first;
    word->rays = rays;
    word->known = known;
    word->hits = hits;
    word->ends = ends;
    b->ray_count += dpl_bit_count(rays);
    b->known_count += dpl_bit_count(known);
}

/* Marches all rays of the batch into `cell`, word by word, and returns how many there are. */
int64_t dpl_trace_march(const dpl_survey_task *t, dpl_trace_batch *b);

void dpl_trace_clear(dpl_trace_batch *b);

#endif
