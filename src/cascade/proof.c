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
#define MOST_CONES 2048 /* waiting to be split; what finds no room is traced */
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

/* A block of probes and a run of 4^power slots. */
typedef struct cone {
    int32_t x, y;
    int32_t columns, rows;
    int32_t slot, power;
    int32_t share; /* of its parent's strip that was empty, 0 .. SHARES-1 */
} cone;

/* What cones of as many slots and as large blocks have in common. */
typedef struct cone_kind {
    float sine, cosine; /* of half the angle between the first ray and the last */
    bool splits_block;  /* into four smaller ones; else the run of slots */
    bool is_last;       /* its parts are too small to be swept */
} cone_kind;

/* How often a kind of cone was swept, and was empty. */
typedef struct record {
    int32_t met, swept, empty;
} record;

/* A batch of strips, and cones that wait to be split. One per worker. */
typedef struct proof {
    /* What is to be proved: that strips are empty of what `distances` measure, in pixels times `scale`. Bits
     * of `open` are cleared where they are; runs of 4^least_power slots are not split. */
    const dpl_clearances *distances;
    float scale;
    const dpl_mask *open;
    int32_t least_power;
    cone_kind kinds[SLOT_POWERS][BLOCK_POWERS];
    record records[SLOT_POWERS][BLOCK_POWERS][SHARES];
    int32_t waiting_count, count;
    cone waiting[MOST_CONES];
    cone batch[BATCH];
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

static void note_kinds(const dpl_survey_level *level, proof *p) {
    for (int32_t i = 0; i < SLOT_POWERS; i++)
        for (int32_t k = 0; k < BLOCK_POWERS; k++) {
            int32_t slots = 1 << 2 * i, side = 1 << k;
            double half = half_angle(level, slots), block = 0.5 * (side - 1) * level->plan->spacing;
            p->kinds[i][k] = (cone_kind){
                .sine = (float)sin(half),
                .cosine = (float)cos(half),
                .splits_block = side > 1 && (slots == 1 || block >= level->plan->t1 * sin(half)),
                .is_last = side * side * slots * DPL_BRANCHING * level->aims < 4 * LEAST_RAYS,
            };
        }
}

/* Number of a block's kind: 1, 2 or 4 probes along its side, or a little less than 4. */
static int32_t block_kind(const cone *k) {
    return (k->columns > k->rows ? k->columns : k->rows) / 2;
}

/* Strip i becomes the one that holds every ray of a cone. With the axis as first coordinate, rays begin
 * between t0 cos a and t0 (a: half angle), give or take the block, and end likewise; their distance from the
 * axis is at most t sin a plus the block's. The width grows from where the first ray begins to where the
 * first one may end, and on at the same slope to where the last one may; where a fix may turn rays round, so
 * that they end before they begin, the strip begins there and its width is the greatest all along. Rounding
 * is within what `margin` of the survey allows for. */
static void lay_strip(const dpl_survey_level *level, const cone *k, const cone_kind *kind, proof *p,
                      int32_t i) {
    const dpl_schedule_level *plan = level->plan;
    const float *axis = level->directions[2 * DPL_BRANCHING * k->slot + (DPL_BRANCHING << 2 * k->power)];
    float t0 = (float)plan->t0, t1 = (float)plan->t1, scale = p->scale, spacing = (float)plan->spacing;
    float dx = axis[0], dy = axis[1], across_x = fabsf(dx), across_y = fabsf(dy);
    float x = ((float)k->x + 0.5f * (float)k->columns) * spacing;
    float y = ((float)k->y + 0.5f * (float)k->rows) * spacing;
    float half_x = 0.5f * (float)(k->columns - 1) * spacing, half_y = 0.5f * (float)(k->rows - 1) * spacing;
    float along = across_x * half_x + across_y * half_y, across = across_y * half_x + across_x * half_y;
    float reach = level->reach * (across_x + across_y);
    float begin = t0 * kind->cosine - along, end = t1 * kind->cosine - along - reach;
    float from = end < begin ? end : begin, to = t1 + along + reach;
    float width0 = t0 * kind->sine + across, width1 = t1 * kind->sine + across + reach;
    float stretch = (to - from) / (end - begin);
    bool grows = stretch > 0.0f;
    p->x0[i] = scale * (x + dx * from);
    p->y0[i] = scale * (y + dy * from);
    p->x1[i] = scale * (x + dx * to);
    p->y1[i] = scale * (y + dy * to);
    p->width0[i] = scale * (grows ? width0 : width1);
    p->width1[i] = scale * (grows ? width0 + (width1 - width0) * stretch : width1);
}

static bool is_open(const proof *p, const cone *k) {
    int32_t word = k->x / DPL_MASK_BITS, slots = 1 << 2 * k->power; /* a block does not cross words */
    uint64_t bits = dpl_mask_range(word * DPL_MASK_BITS, k->x, k->x + k->columns), found = 0;
    size_t of_row = (size_t)p->open->words, of_slot = of_row * (size_t)p->open->rows;
    const uint64_t *first = dpl_mask_row(p->open, k->slot, k->y) + word;
    for (int32_t s = 0; s < slots && !(found & bits); s++, first += of_slot) {
        const uint64_t *row = first;
        for (int32_t y = 0; y < k->rows; y++, row += of_row)
            found |= *row;
    }
    return (found & bits) != 0;
}

static void close_cone(const proof *p, const cone *k) {
    int32_t word = k->x / DPL_MASK_BITS, slots = 1 << 2 * k->power;
    uint64_t bits = dpl_mask_range(word * DPL_MASK_BITS, k->x, k->x + k->columns);
    for (int32_t s = k->slot; s < k->slot + slots; s++)
        for (int32_t y = k->y; y < k->y + k->rows; y++)
            dpl_mask_row(p->open, s, y)[word] &= ~bits;
}

/* Has it paid so far to sweep cones like this one? What was learnt in other items does not count: the answer
 * may not depend on who did them. */
static bool is_worth_a_sweep(record *r) {
    return r->met++ % LATER_SWEEPS == 0 || r->swept < FIRST_SWEEPS || r->empty * GAIN > r->swept;
}

/* Takes a cone into the batch, which has room, if any of it is open. One that is not worth it waits to be
 * split, and what finds no room there is traced. */
static void offer(const dpl_survey_level *level, proof *p, const cone *k) {
    int32_t block = block_kind(k);
    const cone_kind *kind = &p->kinds[k->power][block];
    if (k->columns <= 0 || k->rows <= 0 || !is_open(p, k))
        return;
    if (is_worth_a_sweep(&p->records[k->power][block][k->share])) {
        p->batch[p->count] = *k;
        lay_strip(level, k, kind, p, p->count++);
    } else if (!kind->is_last && p->waiting_count < MOST_CONES) {
        p->waiting[p->waiting_count++] = *k;
    }
}

/* Offers the four parts of a cone: of its block, or of its run, whichever adds more to the width. */
static void split(const dpl_survey_level *level, proof *p, const cone *k) {
    int32_t columns = (k->columns + 1) / 2, rows = (k->rows + 1) / 2;
    bool splits_block = p->kinds[k->power][block_kind(k)].splits_block;
    for (int32_t part = 0; part < 4; part++) {
        cone child = *k;
        if (splits_block) {
            child.x += part % 2 ? columns : 0;
            child.y += part / 2 ? rows : 0;
            child.columns = part % 2 ? k->columns - columns : columns;
            child.rows = part / 2 ? k->rows - rows : rows;
        } else if (k->power > p->least_power) {
            child.power--;
            child.slot += part << 2 * child.power;
        } else {
            return;
        }
        offer(level, p, &child);
    }
}

/* Sweeps the batch. Cones that are not empty wait to be split. */
static int64_t sweep_batch(const dpl_survey_task *t, proof *p) {
    dpl_strips strips = {{p->count, p->x0, p->y0, p->x1, p->y1}, p->width0, p->width1};
    int32_t count = p->count;
    t->kernels->sweep(p->distances, &strips, p->share);
    p->count = 0;
    for (int32_t i = 0; i < count; i++) {
        cone *k = &p->batch[i];
        int32_t block = block_kind(k);
        record *r = &p->records[k->power][block][k->share];
        r->swept++;
        if (p->share[i] >= 1.0f) {
            r->empty++;
            close_cone(p, k);
        } else if (!p->kinds[k->power][block].is_last && p->waiting_count < MOST_CONES) {
            k->share = (int32_t)(p->share[i] * SHARES);
            p->waiting[p->waiting_count++] = *k;
        }
    }
    return count;
}

/* Splits what waits, last come first, until the batch is full or nothing waits. */
static void split_waiting(const dpl_survey_level *level, proof *p) {
    while (p->waiting_count > 0 && p->count <= BATCH - 4) {
        cone k = p->waiting[--p->waiting_count];
        split(level, p, &k);
    }
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
    p->count = p->waiting_count = 0;
    memset(p->records, 0, sizeof p->records);
    for (; first.x < probes; first.x += BLOCK) {
        first.columns = probes - first.x < BLOCK ? probes - first.x : BLOCK;
        offer(t->level, p, &first);
        while (p->count > BATCH - 4) {
            swept += sweep_batch(t, p);
            split_waiting(t->level, p);
        }
    }
    for (split_waiting(t->level, p); p->count > 0; split_waiting(t->level, p))
        swept += sweep_batch(t, p);
    return swept;
}

static int64_t prove_empty(const dpl_survey_task *t, proof *p, const cone *band) {
    p->distances = &t->survey->distances;
    p->scale = 1.0f;
    p->open = &t->level->live;
    p->least_power = 0;
    return sweep_band(t, p, *band);
}

/* Of the cones that are left: which cannot see a lamp. Half as fine will do. */
static int64_t prove_dark(const dpl_survey_task *t, proof *p, const cone *band) {
    const dpl_survey_level *level = t->level;
    for (int32_t s = band->slot; s < band->slot + (1 << 2 * band->power); s++)
        for (int32_t y = band->y; y < band->y + band->rows; y++)
            for (int32_t w = 0; w < level->lit.words; w++)
                dpl_mask_row(&level->lit, s, y)[w] =
                    t->survey->has_lamps ? dpl_mask_row(&level->live, s, y)[w] : 0;
    if (!t->survey->has_lamps || !sweeps_cones(level))
        return 0;
    p->distances = &t->survey->lamps;
    p->scale = 1.0f / DPL_LAMP_TILE;
    p->open = &level->lit;
    p->least_power = band->power < 1 ? 0 : 1;
    return sweep_band(t, p, *band);
}

void dpl_survey_prove(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_survey_task *t = task;
    const dpl_survey_level *level = t->level;
    proof *p = dpl_survey_scratch(t->survey, worker);
    int32_t run = run_of(level), runs = level->plan->slots / run;
    bool sweeps = sweeps_cones(level);
    int64_t swept = 0;
    note_kinds(level, p);
    for (int32_t item = begin; item < end; item++) {
        /* What two workers do at a time are other slots, for bands of the same slot share cache lines. */
        int32_t slot = item % runs * run, y = item / runs * BLOCK, left = level->plan->probes_y - y;
        cone band = {.y = y,
                     .rows = left < BLOCK ? left : BLOCK,
                     .slot = slot,
                     .power = dpl_bit_lowest((uint64_t)run) / 2};
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
