/* Pictures and raw buffers to pixels. Called by src/api/field.c with a layer whose shape (sizes, strides,
 * channels) has been checked; the values are checked here, all of them before the first pixel is drawn.
 *
 * Games call this every frame with every pixel: rows are worked off in runs that stay in the innermost cache,
 * with loops over one thing at a time, and bytes are looked up in tables. */
#include "field/field.h"
#include "field/reader.h"
#include "job/jobs.h"

#include <stdatomic.h>

typedef enum layer_part { PART_EMISSION, PART_EXTINCTION, PART_ALBEDO, PART_COUNT } layer_part;

/* One picture of the layer, and which of its channels are read: the colour, or one that is the opacity. */
typedef struct part_source {
    const char *name;
    dpl_pixels pixels;
    float highest;         /* that a value may be */
    int32_t first;         /* channel */
    int32_t count;         /* of channels from there: 1 or 3 */
    int32_t step;          /* to the next colour's channel: 0 for grey */
    int32_t alpha;         /* channel of the emission's alpha where that decides what is there, else -1 */
    bool opacities;        /* the values (of `alpha`, if that is there) are opacities, to become extinction */
    dpl_byte_values bytes; /* with opacities made extinction already */
} part_source;

typedef struct laying {
    dpl_field *field;
    const dpl_layer *layer;
    part_source parts[PART_COUNT];
    int32_t x0, x1, y0, y1;   /* the part of the pictures that lies in the field [px of the pictures] */
    atomic_int first_bad_row; /* lowest row with a bad value, else INT32_MAX */
    atomic_bool media;        /* some pixel is a medium */
    atomic_bool albedo;       /* some pixel has albedo */
} laying;

/* Neighbouring pixels of a row, as the pictures have them; then with opacities made extinction. */
typedef struct run {
    int32_t x, y, count;
    float channels[PART_COUNT][4 * DPL_RUN];
} run;

/* ---- sources -------------------------------------------------------------------------------------- */

static float extinction_of_opacity(float opacity) {
    return opacity >= 1.0f ? INFINITY : opacity > 0.0f ? (float)-log1p(-(double)opacity) : 0.0f;
}

static part_source source_of(const char *name, const dpl_pixels *pixels, float highest) {
    part_source s = {.name = name, .pixels = *pixels, .highest = highest, .alpha = -1};
    s.count = pixels->channels < 3 ? 1 : 3;
    s.step = pixels->channels < 3 ? 0 : 1;
    if (pixels->data)
        dpl_byte_values_fill(&s.bytes, pixels->format);
    return s;
}

static part_source emission_source(const dpl_layer *layer) {
    part_source s = source_of("emission", &layer->emission, 3e38f / fmaxf(layer->intensity, 1.0f));
    if (layer->extinction.data || !dpl_pixels_have_alpha(&s.pixels))
        return s;
    s.alpha = s.pixels.channels - 1;
    s.opacities = true;
    for (int i = 0; i < 256; i++)
        s.bytes.alpha[i] = extinction_of_opacity(s.bytes.alpha[i]);
    return s;
}

static part_source extinction_source(const dpl_layer *layer) {
    bool opacities = layer->extinction_is_opacity;
    part_source s = source_of("extinction", &layer->extinction, opacities ? 1.0f : INFINITY);
    s.opacities = opacities;
    if (dpl_pixels_have_alpha(&s.pixels)) {
        s.first = s.pixels.channels - 1;
        s.count = 1;
        s.step = 0;
    }
    for (int i = 0; i < 256 && opacities; i++) {
        s.bytes.colour[i] = extinction_of_opacity(s.bytes.colour[i]);
        s.bytes.alpha[i] = extinction_of_opacity(s.bytes.alpha[i]);
    }
    return s;
}

static bool holds_bytes(const part_source *s) {
    return s->pixels.format == DPL_FORMAT_UNORM8 || s->pixels.format == DPL_FORMAT_SRGB8;
}

/* ---- reading -------------------------------------------------------------------------------------- */

static void place_run(const laying *l, int32_t x, int32_t y, run *r) {
    r->x = x;
    r->y = y;
    r->count = l->x1 - x < DPL_RUN ? l->x1 - x : DPL_RUN;
}

/* Fills in the channels of one part, if it has a picture. */
static void read_part(const laying *l, layer_part part, run *r) {
    const part_source *s = &l->parts[part];
    if (s->pixels.data)
        dpl_read_run(l->field->context->kernels, &s->pixels, &s->bytes, r->x, r->y, r->count,
                     r->channels[part]);
}

/* Opacities that were not bytes become extinction. */
static void make_extinction(const laying *l, run *r) {
    for (int part = 0; part < PART_COUNT; part++) {
        const part_source *s = &l->parts[part];
        if (!s->pixels.data || !s->opacities || holds_bytes(s))
            continue;
        int32_t first = s->alpha >= 0 ? s->alpha : s->first, count = s->alpha >= 0 ? 1 : s->count;
        for (int32_t i = 0; i < r->count; i++)
            for (int32_t c = first; c < first + count; c++) {
                float *v = &r->channels[part][i * s->pixels.channels + c];
                *v = extinction_of_opacity(*v);
            }
    }
}

/* A part's three values at a pixel of the run. */
static inline void values_at(const part_source *s, const float *channels, int32_t i, float values[3]) {
    const float *at = channels + i * s->pixels.channels + s->first;
    for (int c = 0; c < 3; c++)
        values[c] = at[c * s->step];
}

static inline bool any_above_zero(const float values[3]) {
    return values[0] > 0.0f || values[1] > 0.0f || values[2] > 0.0f;
}

/* Where a run's extinctions are. Where there is no extinction picture the emission picture decides: by its
 * alpha, else opaque where not black. */
typedef struct extinctions {
    const float *values; /* of the first pixel */
    int32_t step;        /* to the next colour: 0 for grey */
    int32_t stride;      /* to the next pixel */
    bool lamps;          /* these are colours: opaque where one is not 0 */
} extinctions;

static extinctions extinctions_of(const laying *l, const run *r) {
    layer_part part = l->parts[PART_EXTINCTION].pixels.data ? PART_EXTINCTION : PART_EMISSION;
    const part_source *s = &l->parts[part];
    if (s->alpha >= 0)
        return (extinctions){r->channels[part] + s->alpha, 0, s->pixels.channels, false};
    return (extinctions){r->channels[part] + s->first, s->step, s->pixels.channels, part == PART_EMISSION};
}

/* What the pixels of a run are. Returns the union of all kinds. */
static uint8_t find_kinds(const extinctions *e, int32_t count, uint8_t kinds[DPL_RUN]) {
    uint8_t any = DPL_PIXEL_EMPTY;
    const float *at = e->values;
    const int32_t step = e->step, stride = e->stride;
    for (int32_t i = 0; i < count; i++, at += stride) {
        bool some = (at[0] > 0.0f) | (at[step] > 0.0f) | (at[2 * step] > 0.0f);
        bool all = (at[0] == INFINITY) & (at[step] == INFINITY) & (at[2 * step] == INFINITY);
        kinds[i] = (uint8_t)(some + (some & (all | e->lamps)));
        any |= kinds[i];
    }
    return any;
}

/* ---- checking ------------------------------------------------------------------------------------- */

/* Index of the first of `count` values, `step` apart, that is not 0 .. highest; `count` if all are. */
static int32_t find_bad(const float *values, int32_t count, int32_t step, float highest) {
    for (int32_t i = 0; i < count; i++)
        if (!(values[i * step] >= 0.0f && values[i * step] <= highest))
            return i;
    return count;
}

/* A bad value of a part in the run, the first if the run is one pixel; NULL if all are good. */
static const float *find_bad_value(const dpl_kernels *kernels, const part_source *s, const float *channels,
                                   int32_t count) {
    int32_t step = s->pixels.channels, i;
    if (!s->pixels.data || holds_bytes(s)) /* any byte will do */
        return NULL;
    /* Every channel in one sweep; a channel that does not count may be anything, though, and alpha is at most
     * 1. */
    if (kernels->all_within(count * step, channels, s->alpha < 0 ? s->highest : fminf(s->highest, 1.0f)))
        return NULL;
    for (int32_t c = s->first; c < s->first + s->count; c++) {
        i = find_bad(channels + c, count, step, s->highest);
        if (i < count)
            return channels + c + i * step;
    }
    if (s->alpha < 0)
        return NULL;
    i = find_bad(channels + s->alpha, count, step, 1.0f);
    return i < count ? channels + s->alpha + i * step : NULL;
}

static bool run_is_good(const laying *l, run *r) {
    for (int part = 0; part < PART_COUNT; part++) {
        if (holds_bytes(&l->parts[part]))
            continue;
        read_part(l, (layer_part)part, r);
        if (find_bad_value(l->field->context->kernels, &l->parts[part], r->channels[part], r->count))
            return false;
    }
    return true;
}

static void note_bad_row(laying *l, int32_t y) {
    int known = atomic_load(&l->first_bad_row);
    while (y < known && !atomic_compare_exchange_weak(&l->first_bad_row, &known, y))
        ;
}

/* Is some pixel of the run a medium? */
static bool has_media(const laying *l, run *r) {
    bool decides = !l->parts[PART_EXTINCTION].pixels.data;
    read_part(l, decides ? PART_EMISSION : PART_EXTINCTION, r);
    make_extinction(l, r);
    const extinctions e = extinctions_of(l, r);
    uint8_t kinds[DPL_RUN];
    return find_kinds(&e, r->count, kinds) & DPL_PIXEL_MEDIUM;
}

static bool has_albedo(const laying *l, run *r) {
    const part_source *source = &l->parts[PART_ALBEDO];
    read_part(l, PART_ALBEDO, r);
    for (int32_t i = 0; i < r->count && source->pixels.data; i++) {
        float values[3];
        values_at(source, r->channels[PART_ALBEDO], i, values);
        if (any_above_zero(values))
            return true;
    }
    return false;
}

/* Checks values, and looks for what needs planes that the field has not got yet. */
static void check_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    laying *l = task;
    bool media = l->field->extinction.data != NULL, albedo = l->field->albedo.data != NULL;
    run r;
    for (int32_t y = begin + l->y0; y < end + l->y0; y++)
        for (int32_t x = l->x0; x < l->x1; x += DPL_RUN) {
            place_run(l, x, y, &r);
            if (!run_is_good(l, &r)) {
                note_bad_row(l, y);
                return;
            }
            media = media || has_media(l, &r);
            albedo = albedo || has_albedo(l, &r);
        }
    if (media)
        atomic_store(&l->media, true);
    if (albedo)
        atomic_store(&l->albedo, true);
}

static dpl_status report_bad_row(const laying *l, int32_t y) {
    run r;
    for (int32_t x = l->x0; x < l->x1; x++) {
        place_run(l, x, y, &r);
        r.count = 1;
        for (int part = 0; part < PART_COUNT; part++) {
            read_part(l, (layer_part)part, &r);
            const float *bad =
                find_bad_value(l->field->context->kernels, &l->parts[part], r.channels[part], 1);
            if (bad)
                return dpl_fail(l->field->context, DPL_ERROR_ARGUMENT,
                                "%s of pixel (%d, %d) of the layer is %g", l->parts[part].name, x, y,
                                (double)*bad);
        }
    }
    return DPL_OK;
}

/* ---- drawing -------------------------------------------------------------------------------------- */

/* Puts a part's colours into a plane where the run is not empty; black if the layer lacks that picture. */
static void put_colours(const part_source *s, const float *channels, float scale, int32_t count,
                        const uint8_t *kinds, float (*plane)[4]) {
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    const float *at = s->pixels.data ? channels + s->first : black;
    const int32_t step = s->step, stride = s->pixels.data ? s->pixels.channels : 0;
    for (int32_t i = 0; i < count; i++, at += stride) {
        if (kinds[i] == DPL_PIXEL_EMPTY)
            continue;
        plane[i][0] = at[0] * scale;
        plane[i][1] = at[step] * scale;
        plane[i][2] = at[2 * step] * scale;
    }
}

static void put_extinction(const extinctions *e, int32_t count, const uint8_t *kinds, float (*plane)[4]) {
    const float *at = e->values;
    const int32_t step = e->step, stride = e->stride;
    for (int32_t i = 0; i < count; i++, at += stride)
        for (int c = 0; c < 3 && kinds[i] == DPL_PIXEL_MEDIUM; c++)
            plane[i][c] = at[c * step] < DPL_EXTINCTION_MAX ? at[c * step] : DPL_EXTINCTION_MAX;
}

static void draw_run(const laying *l, const run *r) {
    dpl_field *field = l->field;
    size_t cell = dpl_field_picture_cell(field, l->layer->x + r->x, l->layer->y + r->y);
    uint8_t *kind = (uint8_t *)field->kind.data + cell, kinds[DPL_RUN];
    const extinctions e = extinctions_of(l, r);
    uint8_t any = find_kinds(&e, r->count, kinds);
    if (any == DPL_PIXEL_EMPTY)
        return;
    for (int32_t i = 0; i < r->count; i++)
        kind[i] = kinds[i] == DPL_PIXEL_EMPTY ? kind[i] : kinds[i];
    put_colours(&l->parts[PART_EMISSION], r->channels[PART_EMISSION], l->layer->intensity, r->count, kinds,
                (float(*)[4])field->emission.data + cell);
    if (any & DPL_PIXEL_MEDIUM)
        put_extinction(&e, r->count, kinds, (float(*)[4])field->extinction.data + cell);
    if (field->albedo.data)
        put_colours(&l->parts[PART_ALBEDO], r->channels[PART_ALBEDO], 1.0f, r->count, kinds,
                    (float(*)[4])field->albedo.data + cell);
}

static void draw_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const laying *l = task;
    run r;
    for (int32_t y = begin + l->y0; y < end + l->y0; y++)
        for (int32_t x = l->x0; x < l->x1; x += DPL_RUN) {
            place_run(l, x, y, &r);
            for (int part = 0; part < PART_COUNT; part++)
                read_part(l, (layer_part)part, &r);
            make_extinction(l, &r);
            draw_run(l, &r);
        }
}

/* [low, high) of the picture's pixels that fall into a world of `field_size` when it is laid at `at`. */
static void cut(int64_t at, int32_t size, int32_t field_size, int32_t *low, int32_t *high) {
    int64_t first = at < 0 ? -at : 0, last = field_size - at;
    *high = last < 0 ? 0 : last < size ? (int32_t)last : size;
    *low = first < *high ? (int32_t)first : *high;
}

static const dpl_pixels *size_of_layer(const dpl_layer *layer) {
    return layer->emission.data     ? &layer->emission
           : layer->extinction.data ? &layer->extinction
                                    : &layer->albedo;
}

dpl_status dpl_field_lay(dpl_field *field, const dpl_layer *layer) {
    const dpl_pixels *size = size_of_layer(layer);
    laying l = {
        .field = field,
        .layer = layer,
        .parts = {emission_source(layer), extinction_source(layer),
                  source_of("albedo", &layer->albedo, 1.0f)},
    };
    atomic_init(&l.first_bad_row, INT32_MAX);
    atomic_init(&l.media, false);
    atomic_init(&l.albedo, false);
    cut((int64_t)layer->x + field->margin, size->width, field->width, &l.x0, &l.x1);
    cut((int64_t)layer->y + field->margin, size->height, field->height, &l.y0, &l.y1);
    DPL_TRY(dpl_jobs_run(field->context, check_rows, l.y1 - l.y0, 16, &l));
    if (atomic_load(&l.first_bad_row) != INT32_MAX)
        return report_bad_row(&l, atomic_load(&l.first_bad_row));
    if (atomic_load(&l.media))
        DPL_TRY(dpl_field_hold_media(field));
    if (atomic_load(&l.albedo))
        DPL_TRY(dpl_field_hold_albedo(field));
    DPL_TRY(dpl_jobs_run(field->context, draw_rows, l.y1 - l.y0, 16, &l));
    dpl_field_touch(field);
    return DPL_OK;
}
