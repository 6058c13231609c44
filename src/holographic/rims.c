/* Light from near: what a pixel beside lamps receives straight from opaque pixels a few pixels away, as the
 * truth finds it. It falls off so steeply there that the filter would bend it, so finish.c has it taken off
 * before and put back after (docs/algorithms/holographic.md, "Rims"). */
#include "holographic/holographic.h"

#include "kernel/bits.h"

#include <float.h>
#include <math.h>

/* Directions in which a pixel looks around, half a step off the axes: no corner of a pixel near lies in one
 * of them. */
#define DIRECTIONS 120

/* How much larger than they are the sums show lamps near; see add_pixel(). */
#define SHOWN_LARGER 0.25f

#define BRIGHTEST_HALF 65504.0f

#define TURN 6.283185307179586

/* Pixels near are a square of so many. */
enum { SIDE = 2 * DPL_HRC_NEAR + 1 };

/* Directions, a bit each: those in which a pixel near is seen, of which the table has one for each place. */
typedef struct dpl_hrc_sight {
    uint64_t half[2];
} dpl_hrc_sight;

/* ---- sights --------------------------------------------------------------------------------------- */

/* Does a ray from a pixel's centre in the direction (along, down) meet the pixel (x, y) away? It passes that
 * one's centre nearer than its corners lie to either side. */
static bool is_met(double along, double down, int32_t x, int32_t y) {
    return along * x + down * y > 0.0 && fabs(along * y - down * x) < 0.5 * (fabs(along) + fabs(down));
}

size_t dpl_hrc_sight_bytes(void) {
    return SIDE * SIDE * sizeof(dpl_hrc_sight);
}

static dpl_hrc_sight *sights_of(const dpl_hrc *hrc) {
    return (dpl_hrc_sight *)(void *)((char *)hrc->arena.data + hrc->layout.sights);
}

/* ---- sets ----------------------------------------------------------------------------------------- */

/* Sets of pixels, a bit each. Rows have a word more at each end, and there are rows around the world: all of
 * these stay empty. */
typedef enum dpl_hrc_set { OPAQUE, LAMPS, SETS } dpl_hrc_set;

static size_t words_of(const dpl_hrc_layout *layout) {
    return ((size_t)layout->axes[0].width + 63) / 64 + 2;
}

static size_t rows_of(const dpl_hrc_layout *layout) {
    return (size_t)layout->axes[1].width + 2 * (DPL_HRC_NEAR + 1);
}

size_t dpl_hrc_set_bytes(const dpl_hrc_layout *layout) {
    return SETS * rows_of(layout) * words_of(layout) * sizeof(uint64_t);
}

/* The first word of row y, from -DPL_HRC_NEAR - 1 on. */
static uint64_t *set_row(const dpl_hrc *hrc, dpl_hrc_set set, int32_t y) {
    size_t row = (size_t)set * rows_of(&hrc->layout) + (size_t)(y + DPL_HRC_NEAR + 1);
    return (uint64_t *)(void *)((char *)hrc->arena.data + hrc->layout.sets) + row * words_of(&hrc->layout) +
           1;
}

void dpl_hrc_prepare_near(dpl_hrc *hrc) {
    dpl_hrc_sight *sights = sights_of(hrc);
    memset((char *)hrc->arena.data + hrc->layout.sets, 0, dpl_hrc_set_bytes(&hrc->layout));
    memset(sights, 0, dpl_hrc_sight_bytes());
    for (int32_t i = 0; i < DIRECTIONS; i++) {
        double angle = (i + 0.5) * TURN / DIRECTIONS, along = cos(angle), down = sin(angle);
        for (int32_t place = 0; place < SIDE * SIDE; place++)
            if (is_met(along, down, place % SIDE - DPL_HRC_NEAR, place / SIDE - DPL_HRC_NEAR))
                sights[place].half[i / 64] |= (uint64_t)1 << i % 64;
    }
}

/* Only blocks that are not empty are looked at. */
void dpl_hrc_mark_sets(dpl_hrc *hrc, const dpl_field *field, int32_t y) {
    const dpl_hrc_axis *axis = &hrc->layout.axes[1];
    const char *row = (const char *)hrc->arena.data + axis->world + (size_t)y * axis->column_bytes;
    const uint64_t *mask = (const uint64_t *)(const void *)row;
    size_t cell = dpl_field_cell(field, 0, y);
    const uint8_t *kind = (const uint8_t *)field->kind.data + cell;
    const float(*emission)[4] = (const float(*)[4])field->emission.data + cell;
    uint64_t *opaque = set_row(hrc, OPAQUE, y), *lamps = set_row(hrc, LAMPS, y);
    for (int32_t x = 0; x < field->width; x++) {
        if (x % 64 == 0)
            opaque[x / 64] = lamps[x / 64] = 0;
        if (x % DPL_ROW_BLOCK == 0 && !(mask[x / DPL_ROW_BLOCK / 64] >> x / DPL_ROW_BLOCK % 64 & 1)) {
            x += DPL_ROW_BLOCK - 1;
            continue;
        }
        if (kind[x] != DPL_PIXEL_OPAQUE)
            continue;
        uint64_t bit = (uint64_t)1 << x % 64;
        opaque[x / 64] |= bit;
        if (emission[x][0] + emission[x][1] + emission[x][2] > 0.0f)
            lamps[x / 64] |= bit;
    }
}

/* Word `index` of rows y - reach to y + reach of lamps, all in one. */
static uint64_t lamps_beside(const dpl_hrc *hrc, int32_t y, int32_t reach, int32_t index) {
    ptrdiff_t step = (ptrdiff_t)words_of(&hrc->layout);
    const uint64_t *word = set_row(hrc, LAMPS, y - reach) + index;
    uint64_t lamps = 0;
    for (int32_t row = 0; row <= 2 * reach; row++, word += step)
        lamps |= *word;
    return lamps;
}

/* A word of those that have a bit at most `reach` places away; `left` and `right` are the words beside it. */
static uint64_t widened(uint64_t left, uint64_t here, uint64_t right, int32_t reach) {
    uint64_t found = here;
    for (int32_t step = 1; step <= reach; step++)
        found |= here << step | here >> step | left >> (64 - step) | right << (64 - step);
    return found;
}

/* ---- looking around ------------------------------------------------------------------------------- */

/* A pixel that looks around. */
typedef struct looker {
    const float (*around)[4];    /* emission, from its own pixel's on */
    int32_t width;               /* from a row of that to the next */
    const uint64_t *words[SETS]; /* of its row, where the row of the window begins */
    int32_t shift;               /* of that in its word */
    ptrdiff_t step;              /* to the next row [word] */
    const dpl_hrc_sight *sights; /* of the looker's own place */
    dpl_hrc_sight open;          /* directions in which nothing was met so far */
    dpl_hrc_sight seen;          /* in which lamps of this emission were met */
    float emission[3];
    float brightest; /* that the solver knows */
    float rgb[3];
    int32_t count; /* of directions that rgb comes from */
    uint32_t some; /* columns of lamps in any row */
    uint32_t all;  /* columns of lamps in all rows that have some */
    bool touches;  /* a lamp's side */
} looker;

/* Pixels of a set in the row that is dy away, near: bit DPL_HRC_NEAR stands for the looker's column. */
static uint32_t row_near(const looker *l, dpl_hrc_set set, int32_t dy) {
    const uint64_t *words = l->words[set] + dy * l->step;
    return (uint32_t)(words[0] >> l->shift | words[1] << 1 << (63 - l->shift)) & ((1u << SIDE) - 1);
}

/* Adds the light of what was seen of one emission, unless that is none. */
static void add_seen(looker *l) {
    int32_t count = dpl_bit_count(l->seen.half[0]) + dpl_bit_count(l->seen.half[1]);
    if (l->emission[0] + l->emission[1] + l->emission[2] > 0.0f)
        l->count += count;
    for (int c = 0; c < 3; c++)
        l->rgb[c] += (float)count * (1.0f / DIRECTIONS) *
                     (l->emission[c] < l->brightest ? l->emission[c] : l->brightest);
}

/* What is behind an opaque pixel is not seen any more. Most lamps near are alike: to count directions takes
 * longer than to compare. */
static void meet(looker *l, int32_t dx, int32_t dy) {
    const dpl_hrc_sight *sight = l->sights + dy * SIDE + dx;
    uint64_t first = sight->half[0] & l->open.half[0], last = sight->half[1] & l->open.half[1];
    if (!(first | last))
        return;
    l->open.half[0] ^= first;
    l->open.half[1] ^= last;
    const float *emission = l->around[dy * l->width + dx];
    if (memcmp(emission, l->emission, sizeof l->emission) != 0) {
        add_seen(l);
        l->seen = (dpl_hrc_sight){{0, 0}};
        memcpy(l->emission, emission, sizeof l->emission);
    }
    l->seen.half[0] |= first;
    l->seen.half[1] |= last;
}

/* Pixels of a row from the looker's column outwards, for what is nearer hides what is further. */
static void meet_row(looker *l, int32_t dy, uint32_t row) {
    for (uint32_t right = row >> DPL_HRC_NEAR; right; right &= right - 1)
        meet(l, dpl_bit_lowest(right), dy);
    for (uint32_t left = row & ((1u << DPL_HRC_NEAR) - 1); left;) {
        int32_t last = dpl_bit_highest(left);
        meet(l, last - DPL_HRC_NEAR, dy);
        left ^= 1u << last;
    }
}

/* The columns from the looker's to those of lamps: only what is there can hide them. */
static uint32_t columns_to(uint32_t lamps) {
    lamps |= 1u << DPL_HRC_NEAR;
    return (2u << dpl_bit_highest(lamps)) - (1u << dpl_bit_lowest(lamps));
}

/* What of a row is not hidden whole: a pixel with opaque ones before it, in its row and in the row before,
 * can only be seen through these. */
static uint32_t uncovered(uint32_t row, uint32_t row_before) {
    const uint32_t middle = 1u << DPL_HRC_NEAR, left = middle - 1, right = left << (DPL_HRC_NEAR + 1);
    uint32_t has_before = (row << 1 & right) | (row >> 1 & left) | middle;
    return row & ~(has_before & row_before);
}

/* The looker's row and those above it (way -1) or below it (1), outwards: a ray never turns back, so what it
 * meets first comes first. Behind the last lamp nothing matters. */
static void look_along(looker *l, int32_t way) {
    const uint32_t middle = 1u << DPL_HRC_NEAR;
    uint32_t behind[DPL_HRC_NEAR + 2]; /* lamps of a row and of all further ones */
    behind[DPL_HRC_NEAR + 1] = 0;
    for (int32_t reach = DPL_HRC_NEAR; reach >= 0; reach--) {
        uint32_t lamps = row_near(l, LAMPS, way * reach);
        behind[reach] = behind[reach + 1] | lamps;
        l->all &= lamps ? lamps : UINT32_MAX;
        l->some |= lamps;
        l->touches |= reach < 2 && lamps & (reach == 0 ? middle << 1 | middle >> 1 : middle);
    }
    uint32_t before = UINT32_MAX;
    for (int32_t reach = 0; behind[reach]; reach++) {
        uint32_t row = row_near(l, OPAQUE, way * reach);
        meet_row(l, way * reach, uncovered(row, before) & columns_to(behind[reach]));
        before = row;
    }
}

/* What pixel (x, y) receives from near. */
static void light_pixel(const dpl_hrc_frame *f, const dpl_hrc_band *band, int32_t x, int32_t y) {
    int32_t from = x - DPL_HRC_NEAR + 64;
    looker l = {.around = (const float(*)[4])f->field->emission.data + dpl_field_cell(f->field, x, y),
                .width = f->field->width,
                .shift = from % 64,
                .step = (ptrdiff_t)words_of(&f->hrc->layout),
                .sights = sights_of(f->hrc) + DPL_HRC_NEAR * SIDE + DPL_HRC_NEAR,
                .open = {{UINT64_MAX, UINT64_MAX}},
                .all = UINT32_MAX,
                .brightest = f->hrc->layout.half ? BRIGHTEST_HALF : DPL_RADIANCE_MAX};
    for (int set = 0; set < SETS; set++)
        l.words[set] = set_row(f->hrc, (dpl_hrc_set)set, y) - 1 + from / 64;
    look_along(&l, 1);
    look_along(&l, -1);
    add_seen(&l);
    int32_t row = y - band->first + 1;
    for (int c = 0; c < 3; c++)
        dpl_hrc_band_row(band, DPL_PLANE_NEAR + c, row)[x] = l.rgb[c];
    /* Negative where the sums show lamps near as they are: so they do where the looker touches one, and where
     * all are one box along the axes, whose sides have no stairs. */
    float open = (float)(DIRECTIONS - l.count);
    dpl_hrc_band_row(band, DPL_PLANE_OPEN, row)[x] = l.touches || l.some == l.all ? -open : open;
}

/* ---- rims ----------------------------------------------------------------------------------------- */

/* Calls for each free pixel of row y that has a lamp at most `reach` rows and columns away. */
typedef void visit(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t x, int32_t y);

static void for_each_beside_lamps(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t y,
                                  int32_t reach, visit *call) {
    int32_t words = (int32_t)words_of(&frame->hrc->layout) - 2;
    const float *is_free = dpl_hrc_band_row(band, DPL_PLANE_FREE, y - band->first + 1);
    uint64_t left = 0, here = lamps_beside(frame->hrc, y, reach, 0);
    for (int32_t index = 0; index < words; index++) {
        uint64_t right = lamps_beside(frame->hrc, y, reach, index + 1);
        for (uint64_t rest = widened(left, here, right, reach); rest; rest &= rest - 1) {
            int32_t x = 64 * index + dpl_bit_lowest(rest);
            if (x < frame->field->width && is_free[x] > 0.0f)
                call(frame, band, x, y);
        }
        left = here;
        here = right;
    }
}

void dpl_hrc_light_near(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t count) {
    for (int32_t y = band->first - 1; y <= band->first + count; y++)
        if (y >= 0 && y < frame->field->height)
            for_each_beside_lamps(frame, band, y, DPL_HRC_RIM + 1, light_pixel);
}

/* Neighbours in pairs, opposite each other, and what each of a pair weighs where the pixel weighs 4. */
typedef struct pair {
    int8_t x;
    int8_t y;
    float weight;
} pair;

static const pair pairs[] = {{1, 0, 2.0f}, {0, 1, 2.0f}, {1, 1, 1.0f}, {1, -1, 1.0f}};

/* Walls that touch at a corner let nothing through: between two of them no neighbour is reached. */
static bool is_reached(const dpl_hrc_band *band, int32_t x, int32_t row, int32_t dx, int32_t dy) {
    const float *own = dpl_hrc_band_row(band, DPL_PLANE_FREE, row),
                *other = dpl_hrc_band_row(band, DPL_PLANE_FREE, row + dy);
    return other[x + dx] * (own[x + dx] + other[x]) > 0.0f;
}

/* What a pixel and its neighbours add up to. */
typedef struct total {
    float light[3];
    float near[3]; /* as large as `light` shows it */
    float open;    /* and what that leaves */
} total;

/* Lamps near that take a share of all directions are shown larger than they are, unless what is open is
 * negative: see light_pixel(). In the mean a quadrant is right, and all directions are no more than all; what
 * is between was fitted to discs (docs/algorithms/holographic.md, "Rims"). */
static void add_pixel(total *sums, const dpl_hrc_band *band, int32_t x, int32_t row, float weight) {
    float open = dpl_hrc_band_row(band, DPL_PLANE_OPEN, row)[x], open_share = fabsf(open) / DIRECTIONS,
          share = 1.0f - open_share, larger = open < 0.0f ? 0.0f : SHOWN_LARGER * (share - 0.25f);
    sums->open += weight * (fabsf(open) * (1.0f - share * larger));
    for (int c = 0; c < 3; c++) {
        sums->light[c] += weight * dpl_hrc_band_row(band, DPL_PLANE_LIGHT + c, row)[x];
        sums->near[c] +=
            weight * dpl_hrc_band_row(band, DPL_PLANE_NEAR + c, row)[x] * (1.0f + open_share * larger);
    }
}

/* What comes from further away comes through what is open; where nothing is, not here either. Where there is
 * less light than from near, there is a medium in between: what is left of it falls off all the same. */
static float filtered(const total *sums, const dpl_hrc_band *band, int32_t x, int32_t row, int channel) {
    float light = sums->light[channel], near = sums->near[channel],
          near_here = dpl_hrc_band_row(band, DPL_PLANE_NEAR + channel, row)[x],
          open_here = fabsf(dpl_hrc_band_row(band, DPL_PLANE_OPEN, row)[x]);
    if (light < near)
        return near_here * (light / near);
    return near_here + (light - near) * (open_here / (sums->open + FLT_MIN));
}

static void filter_pixel(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t x, int32_t y) {
    (void)frame;
    int32_t row = y - band->first + 1;
    total sums = {{0.0f}, {0.0f}, 0.0f};
    add_pixel(&sums, band, x, row, 4.0f);
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        const pair *p = &pairs[i];
        if (!is_reached(band, x, row, p->x, p->y) || !is_reached(band, x, row, -p->x, -p->y))
            continue;
        add_pixel(&sums, band, x + p->x, row + p->y, p->weight);
        add_pixel(&sums, band, x - p->x, row - p->y, p->weight);
    }
    for (int c = 0; c < 3; c++)
        dpl_hrc_band_row(band, DPL_PLANE_FILTERED, c)[x] = filtered(&sums, band, x, row, c);
}

void dpl_hrc_filter_rims(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t y) {
    for_each_beside_lamps(frame, band, y, DPL_HRC_RIM, filter_pixel);
}
