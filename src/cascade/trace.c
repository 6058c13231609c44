/* Traces the rays of a level that are needed and not proved to miss, and writes down what they hit: a bit for
 * each ray, and for each hit the pixel. Part of the survey, see survey.h.
 *
 * Rays of many slots, rows and probes go into one batch, so that vectors are full although most rays are left
 * out. They begin and end to the bit where chunk.c would have them. */
#include "cascade/trace.h"
#include "cascade/aim.h"
#include "cascade/survey.h"

/* The most that one chunk can add. */
#define CHUNK_WORDS (DPL_BRANCHING * 4 * DPL_CHUNK_WORDS)
#define CHUNK_RAYS (CHUNK_WORDS * DPL_MASK_BITS)

size_t dpl_survey_trace_bytes(void) {
    return sizeof(dpl_trace_batch);
}

/* ---- rays ----------------------------------------------------------------------------------------- */

/* Do rays end t1 along the way from a parent, instead of from their probe? */
static bool aims_at_parents(const dpl_survey_level *level) {
    return level->above && level->merge != DPL_MERGE_BILINEAR;
}

dpl_ray_row dpl_trace_aim(const dpl_survey_task *t, int32_t ray, int32_t aim, int32_t row) {
    const dpl_survey_level *level = t->level;
    const float *direction = level->directions[2 * ray + 1];
    float t0 = (float)level->plan->t0, t1 = (float)level->plan->t1;
    float y = dpl_probe_position(level->plan, row), target_y = y;
    dpl_ray_row r = {.word = {.start_x = direction[0] * t0, .end_x = direction[0] * t1}};
    if (aims_at_parents(level)) {
        bool nearest = level->merge == DPL_MERGE_NEAREST_FIX;
        int32_t parent = nearest ? row / 2 : dpl_lower_parent(row) + (aim >> 1);
        r.word.shift = 1; /* as dpl_lower_parent() */
        r.word.step = nearest ? 0 : aim & 1 ? 1 : -1;
        target_y = dpl_probe_position(level->above, dpl_clamp_index(parent, level->above->probes_y));
    }
    r.word.y0 = y + direction[1] * t0;
    r.word.y1 = target_y + direction[1] * t1;
    dpl_rays_near(level->plan, direction, row, &t->survey->box,
                  (double)level->reach + (double)t->survey->margin, &r.first, &r.last);
    return r;
}

/* ---- batches -------------------------------------------------------------------------------------- */

void dpl_trace_clear(dpl_trace_batch *b) {
    b->ray_count = b->known_count = b->word_count = b->chunk_count = 0;
}

dpl_trace_batch *dpl_trace_begin(const dpl_survey_task *t, int32_t worker) {
    dpl_trace_batch *b = dpl_survey_scratch(t->survey, worker);
    dpl_trace_clear(b);
    return b;
}

int64_t dpl_trace_march(const dpl_survey_task *t, dpl_trace_batch *b) {
    const dpl_schedule_level *own = t->level->plan, *to = aims_at_parents(t->level) ? t->level->above : own;
    dpl_ray_axis axis = {(float)own->spacing, (float)to->spacing, to->probes_x};
    float *ends[4] = {b->ends[0], b->ends[1], b->ends[2], b->ends[3]};
    t->kernels->aim(&axis, b->word_count, b->words, ends);
    dpl_segments segments = {b->ray_count, ends[0], ends[1], ends[2], ends[3]};
    t->kernels->march_to_cell(&t->grid, &segments, b->cell);
    return b->ray_count;
}

/* ---- hits as bits and a list of cells ------------------------------------------------------------- */

static int64_t finish(const dpl_survey_task *t, dpl_trace_batch *b) {
    int64_t marched = dpl_trace_march(t, b), at;
    int32_t count = t->kernels->list_hits(b->word_count, b->words, b->cell, b->list);
    int32_t *out = dpl_survey_take_cells(t->survey, count, &at);
    if (out)
        memcpy(out, b->list, (size_t)count * sizeof *out);
    for (int32_t i = 0; i < b->chunk_count; i++) {
        const dpl_traced_chunk *chunk = &b->chunks[i];
        *chunk->cells_at = chunk->word < chunk->word_end ? at + b->words[chunk->word].at : 0;
    }
    dpl_trace_clear(b);
    return marched;
}

/* Of one ray of a slot and row: which words are known, and from where. */
typedef struct known_row {
    const uint64_t *words; /* NULL: none */
    int32_t *ends;
    bool is_whole; /* all that is not known to hit is known to hit nothing */
} known_row;

static known_row known_of(const dpl_survey_level *level, int32_t slot, int32_t j, int32_t aim, int32_t row) {
    known_row k = {NULL, NULL, false};
    bool is_there = dpl_survey_is_known_row(level, row);
    if (is_there && j == 0) {
        k.words = dpl_mask_row(&level->hits, slot * DPL_BRANCHING * level->aims + aim, row);
        k.ends = dpl_survey_ends(level, slot, aim, row);
        k.is_whole = true;
    } else if (is_there && level->has_guesses) {
        k.words = dpl_mask_row(&level->guessed, slot * level->aims + aim, row);
        k.ends = dpl_survey_guess_ends(level, slot, j, aim, row);
    }
    return k;
}

/* One ray of a slot and row, in one word. */
static void trace_word(const dpl_ray_row *r, const known_row *k, int32_t w, uint64_t live, uint64_t *hits,
                       dpl_trace_batch *b) {
    int32_t first = w * DPL_MASK_BITS;
    uint64_t known = k->words ? k->words[w] : 0, rays = 0;
    if (!k->is_whole)
        rays = live & ~known & dpl_mask_range(first, r->first, r->last);
    hits[w] = 0;
    if (rays | known)
        dpl_trace_add(b, r, first, rays, known, &hits[w], known ? k->ends + first : NULL);
}

static bool has_any(const uint64_t *row, int32_t words) {
    uint64_t any = 0;
    for (int32_t w = 0; w < words; w++)
        any |= row[w];
    return any != 0;
}

/* Nothing is live: nothing is hit. */
static void leave_row_empty(const dpl_survey_level *level, int32_t slot, int32_t row) {
    int32_t rays = DPL_BRANCHING * level->aims;
    for (int32_t i = 0; i < rays; i++)
        memset(dpl_mask_row(&level->hits, slot * rays + i, row), 0,
               (size_t)level->hits.words * sizeof(uint64_t));
    memset(dpl_survey_cells_at(level, slot, row, 0), 0, (size_t)dpl_survey_chunks(level) * sizeof(int64_t));
}

static int64_t trace_row(const dpl_survey_task *t, int32_t slot, int32_t row, dpl_trace_batch *b) {
    const dpl_survey_level *level = t->level;
    const uint64_t *live = dpl_mask_row(&level->live, slot, row);
    int32_t chunks = dpl_survey_chunks(level), words = level->live.words, aims = level->aims;
    dpl_ray_row rays[DPL_BRANCHING * 4];
    known_row known[DPL_BRANCHING * 4];
    int64_t marched = 0;
    if (!has_any(live, words)) {
        leave_row_empty(level, slot, row);
        return 0;
    }
    for (int32_t i = 0; i < DPL_BRANCHING * aims; i++) {
        rays[i] = dpl_trace_aim(t, slot * DPL_BRANCHING + i / aims, i % aims, row);
        known[i] = known_of(level, slot, i / aims, i % aims, row);
    }
    for (int32_t chunk = 0; chunk < chunks; chunk++) {
        if (b->ray_count + b->known_count > DPL_TRACE_RAYS - CHUNK_RAYS ||
            b->word_count > DPL_TRACE_WORDS - CHUNK_WORDS || b->chunk_count == DPL_TRACE_CHUNKS)
            marched += finish(t, b);
        int32_t word = b->word_count;
        for (int32_t i = 0; i < DPL_BRANCHING * aims; i++) {
            uint64_t *hits = dpl_mask_row(&level->hits, slot * DPL_BRANCHING * aims + i, row);
            for (int32_t w = chunk * DPL_CHUNK_WORDS; w < (chunk + 1) * DPL_CHUNK_WORDS && w < words; w++)
                trace_word(&rays[i], &known[i], w, live[w], hits, b);
        }
        b->chunks[b->chunk_count++] =
            (dpl_traced_chunk){word, b->word_count, dpl_survey_cells_at(level, slot, row, chunk)};
    }
    return marched;
}

void dpl_survey_trace(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_survey_task *t = task;
    dpl_trace_batch *b = dpl_trace_begin(t, worker);
    int64_t marched = 0;
    for (int32_t item = begin; item < end; item++)
        marched += trace_row(t, item / t->level->plan->probes_y, item % t->level->plan->probes_y, b);
    t->counters[worker].rays += marched + finish(t, b);
}
