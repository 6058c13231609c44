/* Proofs that rays hit nothing, from the distance field. Part of the survey, see survey.h.
 *
 * First per probe: nothing is as near as any of its rays reaches. Then per cone: a block of neighbouring
 * probes and a run of neighbouring directions. All their rays lie in a strip around the cone's axis; where
 * the strip is empty, none of them hits anything. Where that cannot be shown, the block or the run is split,
 * down to cones of so few rays that it is quicker to march them. Each strip that is swept counts as a ray. */
#include "cascade/aim.h"
#include "cascade/survey.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* A pixel that a ray touches has its centre within half a diagonal of the ray [px]. */
#define HALF_DIAGONAL 0.70710678f

/* ---- empty probes --------------------------------------------------------------------------------- */

/* Distance from a probe to what is nearest to the pixel that it stands in, less what the two may be apart. */
static float distance_at_probe(const dpl_survey *survey, float x, float y) {
    const dpl_clearances *d = &survey->distances;
    int32_t column = dpl_clamp_index((int32_t)x, d->width), row = dpl_clamp_index((int32_t)y, d->height);
    return d->plane[((size_t)row * (size_t)d->width + (size_t)column) * (size_t)d->stride];
}

/* What is so far from one probe is nearly as far from its neighbours: one look settles many. */
static void find_empty_row(const dpl_survey *survey, const dpl_schedule_level *plan, int32_t row, float least,
                           const dpl_mask *empty) {
    uint64_t *words = dpl_mask_row(empty, 0, row);
    float y = dpl_probe_position(plan, row), probes_a_pixel = 0.9999f / (float)plan->spacing;
    memset(words, 0, (size_t)empty->words * sizeof *words);
    for (int32_t i = 0; i < plan->probes_x;) {
        float distance = distance_at_probe(survey, dpl_probe_position(plan, i), y);
        if (distance > least) {
            int32_t left = plan->probes_x - i;
            float more = (distance - least) * probes_a_pixel;
            int32_t run = more < (float)(left - 1) ? 1 + (int32_t)more : left;
            dpl_mask_fill(words, i, i + run);
            i += run;
        } else {
            i++;
        }
    }
}

void dpl_survey_find_empty(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const dpl_survey_task *t = task;
    const dpl_survey_level *level = t->level;
    /* A probe outside the picture is further from everything than the border pixel that is looked up. */
    float furthest = (float)level->plan->t1 + level->reach * 1.41421368f;
    float least = (furthest + t->survey->distances.spare + HALF_DIAGONAL) * 1.0001f;
    bool nothing = t->survey->box.x0 > t->survey->box.x1;
    for (int32_t row = begin; row < end; row++)
        if (nothing)
            for (int32_t w = 0; w < level->empty.words; w++)
                dpl_mask_row(&level->empty, 0, row)[w] = dpl_mask_all(&level->empty, w);
        else
            find_empty_row(t->survey, level->plan, row, least, &level->empty);
}

/* ---- cones ---------------------------------------------------------------------------------------- */

#define BATCH 64        /* strips swept at once */
#define MOST_CONES 2048 /* waiting to be swept; what finds no room is traced */
#define BLOCK 4         /* probes along the side of the largest block */
#define MOST_SLOTS 64   /* of the widest cone */
#define SLOT_POWERS 4   /* 1, 4, 16 and 64 */
#define BLOCK_POWERS 3  /* 1, 2 and 4 probes along the side */
#define SHARES 4        /* kinds of cones by how far their parent's strip was empty */
#define FIRST_SWEEPS 12 /* of a kind in an item of work: to see whether it is worth it */
#define LATER_SWEEPS 16 /* and one in so many after that, when it was not */
#define GAIN 8          /* rays that an empty cone saves, a little off for the time that a sweep takes */
/* It takes longer to sweep cones of fewer rays, or of shorter ones [px], than to march the rays. */
#define LEAST_RAYS 16
#define LEAST_LENGTH 8.0

/* A block of probes and a run of slots. */
typedef struct cone {
    int32_t x, y;
    int32_t columns, rows;
    int32_t slot, slots;
    float share; /* of its parent's strip that was empty */
} cone;

/* How often a kind of cone was swept, and was empty. */
typedef struct record {
    int32_t met, swept, empty;
} record;

/* Cones that wait, and a batch of strips. One per worker. */
typedef struct proof {
    /* What is to be proved: that strips are empty of what `distances` measure, in pixels times `scale`. Bits
     * of `open` are cleared where they are; cones with less than `least_slots` are not looked at. */
    const dpl_clearances *distances;
    float scale;
    const dpl_mask *open;
    int32_t least_slots;
    float sines[SLOT_POWERS], cosines[SLOT_POWERS]; /* of half_angle(), for runs of 4^i slots */
    record records[SLOT_POWERS][BLOCK_POWERS][SHARES];
    int32_t count;
    cone waiting[MOST_CONES];
    cone batch[BATCH];
    /* Of cones: where the block is and half its size, the axis, and of the half angle. */
    float x[BATCH], y[BATCH], half_x[BATCH], half_y[BATCH], dx[BATCH], dy[BATCH], sine[BATCH], cosine[BATCH];
    /* Of strips. */
    float x0[BATCH], y0[BATCH], x1[BATCH], y1[BATCH];
    float width0[BATCH], width1[BATCH], share[BATCH];
} proof;

size_t dpl_survey_proof_bytes(void) {
    return sizeof(proof);
}

/* Half the angle between the first and the last ray of a run of slots. */
static double half_angle(const dpl_survey_level *level, int32_t slots) {
    return (2.0 * slots - 0.5) * 2.0 * PI / level->plan->directions;
}

/* The widest run: a power of four that divides the slots, at most an eighth of a turn to either side. 0 where
 * one slot is wider than that. */
static int32_t widest_run(const dpl_survey_level *level) {
    int32_t slots = 1;
    if (half_angle(level, 1) > PI / 4)
        return 0;
    while (4 * slots <= MOST_SLOTS && level->plan->slots % (4 * slots) == 0 &&
           half_angle(level, 4 * slots) <= PI / 4)
        slots *= 4;
    return slots;
}

/* i of 4^i. */
static int32_t power_of(int32_t slots) {
    return dpl_bit_lowest((uint64_t)slots) / 2;
}

static void note_angles(const dpl_survey_level *level, proof *p) {
    for (int32_t i = 0; i < SLOT_POWERS; i++) {
        p->sines[i] = (float)sin(half_angle(level, 1 << 2 * i));
        p->cosines[i] = (float)cos(half_angle(level, 1 << 2 * i));
    }
}

static void add_cone(const dpl_survey_level *level, const cone *k, proof *p, int32_t i) {
    const dpl_schedule_level *plan = level->plan;
    const float *axis = level->directions[2 * DPL_BRANCHING * k->slot + DPL_BRANCHING * k->slots];
    float spacing = (float)plan->spacing;
    p->batch[i] = *k;
    p->dx[i] = axis[0];
    p->dy[i] = axis[1];
    p->x[i] = ((float)k->x + 0.5f * (float)k->columns) * spacing;
    p->y[i] = ((float)k->y + 0.5f * (float)k->rows) * spacing;
    p->half_x[i] = 0.5f * (float)(k->columns - 1) * spacing;
    p->half_y[i] = 0.5f * (float)(k->rows - 1) * spacing;
    p->sine[i] = p->sines[power_of(k->slots)];
    p->cosine[i] = p->cosines[power_of(k->slots)];
}

/* The strips that hold every ray of their cones. With the axis as first coordinate, rays begin between t0 cos
 * a and t0 (a: half angle), give or take the block, and end likewise; their distance from the axis is at most
 * t sin a plus the block's. The width grows from where the first ray begins to where the first one may end,
 * and on at the same slope to where the last one may; where a fix may turn rays round, so that they end
 * before they begin, the strip begins there and its width is the greatest all along. Rounding is within what
 * `margin` of the survey allows for. */
static void lay_strips(const dpl_survey_level *level, proof *p, int32_t count) {
    float t0 = (float)level->plan->t0, t1 = (float)level->plan->t1, scale = p->scale;
    for (int32_t i = 0; i < count; i++) {
        float dx = p->dx[i], dy = p->dy[i], across_x = fabsf(dx), across_y = fabsf(dy);
        float along = across_x * p->half_x[i] + across_y * p->half_y[i];
        float across = across_y * p->half_x[i] + across_x * p->half_y[i];
        float reach = level->reach * (across_x + across_y);
        float begin = t0 * p->cosine[i] - along, end = t1 * p->cosine[i] - along - reach;
        float from = end < begin ? end : begin, to = t1 + along + reach;
        float width0 = t0 * p->sine[i] + across, width1 = t1 * p->sine[i] + across + reach;
        float stretch = (to - from) / (end - begin);
        bool grows = stretch > 0.0f;
        p->x0[i] = scale * (p->x[i] + dx * from);
        p->y0[i] = scale * (p->y[i] + dy * from);
        p->x1[i] = scale * (p->x[i] + dx * to);
        p->y1[i] = scale * (p->y[i] + dy * to);
        p->width0[i] = scale * (grows ? width0 : width1);
        p->width1[i] = scale * (grows ? width0 + (width1 - width0) * stretch : width1);
    }
}

static bool is_open(const proof *p, const cone *k) {
    int32_t word = k->x / DPL_MASK_BITS; /* a block does not cross words */
    uint64_t bits = dpl_mask_range(word * DPL_MASK_BITS, k->x, k->x + k->columns), found = 0;
    size_t of_row = (size_t)p->open->words, of_slot = of_row * (size_t)p->open->rows;
    const uint64_t *first = dpl_mask_row(p->open, k->slot, k->y) + word;
    for (int32_t s = 0; s < k->slots && !(found & bits); s++, first += of_slot) {
        const uint64_t *row = first;
        for (int32_t y = 0; y < k->rows; y++, row += of_row)
            found |= *row;
    }
    return (found & bits) != 0;
}

static void close_cone(const proof *p, const cone *k) {
    int32_t word = k->x / DPL_MASK_BITS;
    uint64_t bits = dpl_mask_range(word * DPL_MASK_BITS, k->x, k->x + k->columns);
    for (int32_t s = k->slot; s < k->slot + k->slots; s++)
        for (int32_t y = k->y; y < k->y + k->rows; y++)
            dpl_mask_row(p->open, s, y)[word] &= ~bits;
}

static record *record_of(proof *p, const cone *k) {
    int32_t side = k->columns > k->rows ? k->columns : k->rows;
    return &p->records[power_of(k->slots)][side / 2][(int)(k->share * SHARES)];
}

static int32_t rays_of(const dpl_survey_level *level, const cone *k) {
    return k->columns * k->rows * k->slots * DPL_BRANCHING * level->aims;
}

/* Are all parts of a cone too small to be swept? */
static bool is_last(const dpl_survey_level *level, const cone *k) {
    return rays_of(level, k) < 4 * LEAST_RAYS;
}

/* Has it paid so far to sweep cones like this one? What was learnt in other items does not count: the answer
 * may not depend on who did them. */
static bool is_worth_a_sweep(proof *p, const cone *k) {
    record *r = record_of(p, k);
    return r->met++ % LATER_SWEEPS == 0 || r->swept < FIRST_SWEEPS || r->empty * GAIN > r->swept;
}

/* The smallest cones are asked before they wait whether they are worth it, the others when their turn comes.
 */
static void wait_for_sweep(const dpl_survey_level *level, proof *p, cone k) {
    if (k.columns <= 0 || k.rows <= 0 || p->count == MOST_CONES)
        return;
    if (is_last(level, &k) && !is_worth_a_sweep(p, &k))
        return;
    if (is_open(p, &k))
        p->waiting[p->count++] = k;
}

static void split_block(const dpl_survey_level *level, proof *p, const cone *k) {
    int32_t columns = (k->columns + 1) / 2, rows = (k->rows + 1) / 2;
    for (int32_t part = 0; part < 4; part++) {
        cone child = *k;
        child.x += part % 2 ? columns : 0;
        child.y += part / 2 ? rows : 0;
        child.columns = part % 2 ? k->columns - columns : columns;
        child.rows = part / 2 ? k->rows - rows : rows;
        wait_for_sweep(level, p, child);
    }
}

/* Splits the greater of what the block and what the angle add to the width. */
static void split(const dpl_survey_level *level, proof *p, const cone *k) {
    if (is_last(level, k))
        return;
    double block = 0.5 * (k->columns > k->rows ? k->columns - 1 : k->rows - 1) * level->plan->spacing;
    double angle = k->slots > 1 ? level->plan->t1 * (double)p->sines[power_of(k->slots)] : 0.0;
    if (block > 0.0 && block >= angle) {
        split_block(level, p, k);
        return;
    }
    for (int32_t part = 0; part < 4 && k->slots > p->least_slots; part++) {
        cone child = *k;
        child.slots = k->slots / 4;
        child.slot += part * child.slots;
        wait_for_sweep(level, p, child);
    }
}

/* Takes cones that wait, last come first, into the batch of strips. Those not worth it are split at once. */
static int32_t fill_batch(const dpl_survey_level *level, proof *p, int32_t rest) {
    int32_t count = 0;
    while (count < BATCH && p->count > rest) {
        cone k = p->waiting[--p->count];
        if (is_last(level, &k) || is_worth_a_sweep(p, &k))
            add_cone(level, &k, p, count++);
        else
            split(level, p, &k);
    }
    lay_strips(level, p, count);
    return count;
}

/* Sweeps what waits until no more than `rest` is left. */
static int64_t sweep_waiting(const dpl_survey_task *t, proof *p, int32_t rest) {
    dpl_strips strips = {{0, p->x0, p->y0, p->x1, p->y1}, p->width0, p->width1};
    int64_t swept = 0;
    while (p->count > rest) {
        strips.axis.count = fill_batch(t->level, p, rest);
        t->kernels->sweep(p->distances, &strips, p->share);
        swept += strips.axis.count;
        for (int32_t i = 0; i < strips.axis.count; i++) {
            cone *k = &p->batch[i];
            record *r = record_of(p, k);
            r->swept++;
            if (p->share[i] >= 1.0f) {
                r->empty++;
                close_cone(p, k);
            } else {
                k->share = p->share[i];
                split(t->level, p, k);
            }
        }
    }
    return swept;
}

static void start_live(const dpl_survey_task *t, int32_t slot, int32_t row) {
    const dpl_survey_level *level = t->level;
    const uint64_t *needed = dpl_mask_row(&level->needed, slot, row),
                   *empty = dpl_mask_row(&level->empty, 0, row);
    uint64_t *live = dpl_mask_row(&level->live, slot, row);
    for (int32_t w = 0; w < level->live.words; w++)
        live[w] = needed[w] & ~empty[w];
}

static bool sweeps_cones(const dpl_survey_level *level) {
    return widest_run(level) > 0 && level->plan->t1 - level->plan->t0 >= LEAST_LENGTH;
}

static int32_t run_of(const dpl_survey_level *level) {
    int32_t run = widest_run(level);
    return run > 0 ? run : 1;
}

static int32_t bands_of(const dpl_survey_level *level) {
    return (level->plan->probes_y + BLOCK - 1) / BLOCK;
}

int32_t dpl_survey_proof_items(const dpl_survey_level *level) {
    return level->plan->slots / run_of(level) * bands_of(level);
}

/* A band of blocks and a run of slots: sweeps all that is open. */
static int64_t sweep_band(const dpl_survey_task *t, proof *p, cone first) {
    int32_t probes = t->level->plan->probes_x;
    int64_t swept = 0;
    p->count = 0;
    memset(p->records, 0, sizeof p->records);
    for (first.x = 0; first.x < probes; first.x += BLOCK) {
        first.columns = probes - first.x < BLOCK ? probes - first.x : BLOCK;
        wait_for_sweep(t->level, p, first);
        if (p->count >= BATCH)
            swept += sweep_waiting(t, p, BATCH - 1);
    }
    return swept + sweep_waiting(t, p, 0);
}

static int64_t prove_empty(const dpl_survey_task *t, proof *p, const cone *band) {
    p->distances = &t->survey->distances;
    p->scale = 1.0f;
    p->open = &t->level->live;
    p->least_slots = 1;
    return sweep_band(t, p, *band);
}

/* Of the cones that are left: which cannot see a lamp. Half as fine will do. */
static int64_t prove_dark(const dpl_survey_task *t, proof *p, const cone *band) {
    const dpl_survey_level *level = t->level;
    for (int32_t s = band->slot; s < band->slot + band->slots; s++)
        for (int32_t y = band->y; y < band->y + band->rows; y++)
            for (int32_t w = 0; w < level->lit.words; w++)
                dpl_mask_row(&level->lit, s, y)[w] =
                    t->survey->has_lamps ? dpl_mask_row(&level->live, s, y)[w] : 0;
    if (!t->survey->has_lamps || !sweeps_cones(level))
        return 0;
    p->distances = &t->survey->lamps;
    p->scale = 1.0f / DPL_LAMP_TILE;
    p->open = &level->lit;
    p->least_slots = band->slots < 4 ? 1 : 4;
    return sweep_band(t, p, *band);
}

void dpl_survey_prove(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_survey_task *t = task;
    const dpl_survey_level *level = t->level;
    proof *p = dpl_survey_scratch(t->survey, worker);
    int32_t run = run_of(level), runs = level->plan->slots / run;
    bool sweeps = sweeps_cones(level);
    int64_t swept = 0;
    note_angles(level, p);
    for (int32_t item = begin; item < end; item++) {
        /* What two workers do at a time are other slots, for bands of the same slot share cache lines. */
        int32_t slot = item % runs * run, y = item / runs * BLOCK, left = level->plan->probes_y - y;
        cone band = {.y = y, .rows = left < BLOCK ? left : BLOCK, .slot = slot, .slots = run};
        for (int32_t s = slot; s < slot + run; s++)
            for (int32_t row = y; row < y + band.rows; row++)
                start_live(t, s, row);
        if (sweeps)
            swept += prove_empty(t, p, &band);
        if (t->guesses)
            swept += prove_dark(t, p, &band);
    }
    t->counters[worker].rays += swept;
}
