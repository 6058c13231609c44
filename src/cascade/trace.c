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

/* Where rays end, seen from their probe: t1 from the probe itself, or from a parent. */
typedef enum ray_target { TARGET_SELF, TARGET_LOWER, TARGET_UPPER, TARGET_NEAREST } ray_target;

/* What the rays of a row and direction share. */
typedef struct row_of_rays {
    float start_x, end_x; /* from where the probe or the target is */
    float y0, y1;
    ray_target target;
    int32_t first, last; /* probes whose ray comes near anything: first .. last-1 */
} row_of_rays;

/* Of a target that is a parent. */
static float parent_position(const dpl_survey_level *level, ray_target target, int32_t probe) {
    int32_t parent =
        target == TARGET_NEAREST ? probe / 2 : dpl_lower_parent(probe) + (target == TARGET_UPPER);
    return dpl_probe_position(level->above, dpl_clamp_index(parent, level->above->probes_x));
}

static row_of_rays rays_of(const dpl_survey_task *t, int32_t ray, int32_t aim, int32_t row) {
    const dpl_survey_level *level = t->level;
    const float *direction = level->directions[2 * ray + 1];
    float t0 = (float)level->plan->t0, t1 = (float)level->plan->t1;
    float y = dpl_probe_position(level->plan, row), target_y = y;
    row_of_rays r = {.start_x = direction[0] * t0, .end_x = direction[0] * t1, .target = TARGET_SELF};
    if (level->above && level->merge != DPL_MERGE_BILINEAR) {
        bool nearest = level->merge == DPL_MERGE_NEAREST_FIX;
        int32_t parent = nearest ? row / 2 : dpl_lower_parent(row) + (aim >> 1);
        r.target = nearest ? TARGET_NEAREST : aim & 1 ? TARGET_UPPER : TARGET_LOWER;
        target_y = dpl_probe_position(level->above, dpl_clamp_index(parent, level->above->probes_y));
    }
    r.y0 = y + direction[1] * t0;
    r.y1 = target_y + direction[1] * t1;
    dpl_rays_near(level->plan, direction, row, &t->survey->box,
                  (double)level->reach + (double)t->survey->margin, &r.first, &r.last);
    return r;
}

static void add_word(const dpl_survey_level *level, const row_of_rays *r, int32_t base, dpl_traced_word word,
                     dpl_trace_batch *b) {
    int32_t first = b->ray_count, i = first;
    b->words[b->word_count++] = word;
    for (uint64_t rays = word.rays; rays; rays &= rays - 1, i++) {
        float x = dpl_probe_position(level->plan, base + dpl_bit_lowest(rays));
        b->x0[i] = x + r->start_x;
        b->x1[i] = x + r->end_x;
        b->y0[i] = r->y0;
        b->y1[i] = r->y1;
    }
    b->ray_count = i;
    if (r->target == TARGET_SELF)
        return;
    i = first;
    for (uint64_t rays = word.rays; rays; rays &= rays - 1, i++)
        b->x1[i] = parent_position(level, r->target, base + dpl_bit_lowest(rays)) + r->end_x;
}

/* ---- batches whose hits become bits and a list of cells ------------------------------------------- */

/* Sets the bits of a word's hits, and moves their cells from where those of all its rays begin to `out`,
 * which is no later in the same array. Returns how many there are. */
static int32_t write_hits(const dpl_traced_word *word, const int32_t *cell, int32_t *out) {
    int32_t count = 0;
    uint64_t hits = 0;
    for (uint64_t rays = word->rays; rays; rays &= rays - 1) {
        int32_t found = *cell++, hit = found >= 0;
        hits |= rays & (0 - rays) & (0 - (uint64_t)hit);
        out[count] = found;
        count += hit;
    }
    *word->hits = hits;
    return count;
}

static int64_t march_batch(const dpl_survey_task *t, dpl_trace_batch *b) {
    dpl_segments segments = {b->ray_count, b->x0, b->y0, b->x1, b->y1};
    t->kernels->march_to_cell(&t->grid, &segments, b->cell);
    return b->ray_count;
}

static int64_t finish(const dpl_survey_task *t, dpl_trace_batch *b) {
    int64_t marched = march_batch(t, b), at;
    const int32_t *cell = b->cell;
    int32_t w = 0, count = 0;
    for (int32_t i = 0; i < b->chunk_count; i++) {
        *b->chunks[i].cells_at = count;
        for (; w < b->chunks[i].word_end; w++) {
            count += write_hits(&b->words[w], cell, b->cell + count);
            cell += dpl_bit_count(b->words[w].rays);
        }
    }
    int32_t *out = dpl_survey_take_cells(t->survey, count, &at);
    if (out)
        memcpy(out, b->cell, (size_t)count * sizeof *out);
    for (int32_t i = 0; i < b->chunk_count; i++)
        *b->chunks[i].cells_at += at;
    b->ray_count = b->word_count = b->chunk_count = 0;
    return marched;
}

static int64_t trace_row(const dpl_survey_task *t, int32_t slot, int32_t row, dpl_trace_batch *b) {
    const dpl_survey_level *level = t->level;
    const uint64_t *live = dpl_mask_row(&level->live, slot, row);
    int32_t chunks = dpl_survey_chunks(level), words = level->live.words, aims = level->aims;
    row_of_rays rays[DPL_BRANCHING * 4];
    int64_t marched = 0;
    for (int32_t i = 0; i < DPL_BRANCHING * aims; i++)
        rays[i] = rays_of(t, slot * DPL_BRANCHING + i / aims, i % aims, row);
    for (int32_t chunk = 0; chunk < chunks; chunk++) {
        if (b->ray_count > DPL_TRACE_RAYS - CHUNK_RAYS || b->word_count > DPL_TRACE_WORDS - CHUNK_WORDS ||
            b->chunk_count == DPL_TRACE_CHUNKS)
            marched += finish(t, b);
        for (int32_t i = 0; i < DPL_BRANCHING * aims; i++) {
            uint64_t *hits = dpl_mask_row(&level->hits, slot * DPL_BRANCHING * aims + i, row);
            for (int32_t w = chunk * DPL_CHUNK_WORDS; w < (chunk + 1) * DPL_CHUNK_WORDS && w < words; w++) {
                int32_t base = w * DPL_MASK_BITS;
                uint64_t traced = live[w] & dpl_mask_range(base, rays[i].first, rays[i].last);
                hits[w] = 0;
                if (traced)
                    add_word(level, &rays[i], base, (dpl_traced_word){traced, &hits[w], NULL}, b);
            }
        }
        b->chunks[b->chunk_count++] =
            (dpl_traced_chunk){b->word_count, dpl_survey_cells_at(level, slot, row, chunk)};
    }
    return marched;
}

dpl_trace_batch *dpl_trace_begin(const dpl_survey_task *t, int32_t worker) {
    dpl_trace_batch *b = dpl_survey_scratch(t->survey, worker);
    b->ray_count = b->word_count = b->chunk_count = 0;
    return b;
}

void dpl_survey_trace(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_survey_task *t = task;
    dpl_trace_batch *b = dpl_trace_begin(t, worker);
    int64_t marched = 0;
    for (int32_t item = begin; item < end; item++)
        marched += trace_row(t, item / t->level->plan->probes_y, item % t->level->plan->probes_y, b);
    t->counters[worker].rays += marched + finish(t, b);
}

/* ---- batches whose results are written down for every ray ----------------------------------------- */

int64_t dpl_trace_end(const dpl_survey_task *t, dpl_trace_batch *b) {
    int64_t marched = march_batch(t, b);
    const int32_t *cell = b->cell;
    for (int32_t w = 0; w < b->word_count; w++)
        for (uint64_t rays = b->words[w].rays; rays; rays &= rays - 1)
            b->words[w].results[dpl_bit_lowest(rays)] = *cell++;
    b->ray_count = b->word_count = 0;
    return marched;
}

int64_t dpl_trace_add(const dpl_survey_task *t, dpl_trace_batch *b, int32_t ray, int32_t aim, int32_t row,
                      const uint64_t *rays, int32_t *results) {
    const dpl_survey_level *level = t->level;
    row_of_rays r = {.last = -1};
    int64_t marched = 0;
    for (int32_t w = 0; w < level->live.words; w++) {
        int32_t base = w * DPL_MASK_BITS;
        if (!rays[w])
            continue;
        if (r.last < 0)
            r = rays_of(t, ray, aim, row);
        uint64_t near = rays[w] & dpl_mask_range(base, r.first, r.last);
        for (uint64_t far = rays[w] & ~near; far; far &= far - 1)
            results[base + dpl_bit_lowest(far)] = -1;
        if (b->ray_count > DPL_TRACE_RAYS - DPL_MASK_BITS || b->word_count == DPL_TRACE_WORDS)
            marched += dpl_trace_end(t, b);
        if (near)
            add_word(level, &r, base, (dpl_traced_word){near, NULL, results + base}, b);
    }
    return marched;
}
