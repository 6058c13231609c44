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

static void read_run(const laying *l, int32_t x, int32_t y, int32_t count, run *r) {
    r->x = x;
    r->y = y;
    r->count = count;
    for (int part = 0; part < PART_COUNT; part++) {
        const part_source *s = &l->parts[part];
        if (s->pixels.data)
            dpl_read_run(l->field->context->kernels, &s->pixels, &s->bytes, x, y, count, r->channels[part]);
    }
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

/* Where there is no extinction picture the emission picture decides: by alpha, else opaque where not black.
 */
static inline void extinction_at(const laying *l, const run *r, int32_t i, float values[3]) {
    const part_source *extinction = &l->parts[PART_EXTINCTION], *emission = &l->parts[PART_EMISSION];
    if (extinction->pixels.data) {
        values_at(extinction, r->channels[PART_EXTINCTION], i, values);
        return;
    }
    float s;
    if (emission->alpha >= 0)
        s = r->channels[PART_EMISSION][i * emission->pixels.channels + emission->alpha];
    else {
        values_at(emission, r->channels[PART_EMISSION], i, values);
        s = any_above_zero(values) ? INFINITY : 0.0f;
    }
    values[0] = values[1] = values[2] = s;
}

/* ---- checking ------------------------------------------------------------------------------------- */

/* Index of the first of `count` values, `step` apart, that is not 0 .. highest; `count` if all are. */
static int32_t find_bad(const float *values, int32_t count, int32_t step, float highest) {
    int32_t bad = 0; /* without a branch first: almost always all are good */
    for (int32_t i = 0; i < count; i++)
        bad |= (values[i * step] < 0.0f) | !(values[i * step] <= highest);
    if (!bad)
        return count;
    for (int32_t i = 0; i < count; i++)
        if (!(values[i * step] >= 0.0f && values[i * step] <= highest))
            return i;
    return count;
}

/* A bad value of a part in the run, the first if the run is one pixel; NULL if all are good. */
static const float *find_bad_value(const part_source *s, const float *channels, int32_t count) {
    int32_t step = s->pixels.channels, i;
    if (!s->pixels.data || holds_bytes(s))
        return NULL;
    if (s->count == step) { /* every channel counts: one sweep */
        i = find_bad(channels, count * step, 1, s->highest);
        return i < count * step ? channels + i : NULL;
    }
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

static bool run_is_good(const laying *l, const run *r) {
    for (int part = 0; part < PART_COUNT; part++)
        if (find_bad_value(&l->parts[part], r->channels[part], r->count))
            return false;
    return true;
}

static void note_bad_row(laying *l, int32_t y) {
    int known = atomic_load(&l->first_bad_row);
    while (y < known && !atomic_compare_exchange_weak(&l->first_bad_row, &known, y))
        ;
}

/* Which planes does the field lack that this run needs? A plane that is there needs no more looking. */
static void note_needs(laying *l, run *r, bool *media, bool *albedo) {
    if (!*media) {
        make_extinction(l, r);
        for (int32_t i = 0; i < r->count && !*media; i++) {
            float s[3];
            extinction_at(l, r, i, s);
            *media = dpl_extinction_kind(s) == DPL_PIXEL_MEDIUM;
        }
    }
    const part_source *source = &l->parts[PART_ALBEDO];
    for (int32_t i = 0; i < r->count && !*albedo && source->pixels.data; i++) {
        float values[3];
        values_at(source, r->channels[PART_ALBEDO], i, values);
        *albedo = any_above_zero(values);
    }
}

static void check_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    laying *l = task;
    bool media = l->field->extinction.data != NULL, albedo = l->field->albedo.data != NULL;
    run r;
    for (int32_t y = begin + l->y0; y < end + l->y0; y++)
        for (int32_t x = l->x0; x < l->x1; x += DPL_RUN) {
            read_run(l, x, y, l->x1 - x < DPL_RUN ? l->x1 - x : DPL_RUN, &r);
            if (!run_is_good(l, &r)) {
                note_bad_row(l, y);
                return;
            }
            note_needs(l, &r, &media, &albedo);
        }
    if (media)
        atomic_store(&l->media, true);
    if (albedo)
        atomic_store(&l->albedo, true);
}

static dpl_status report_bad_row(const laying *l, int32_t y) {
    run r;
    for (int32_t x = l->x0; x < l->x1; x++) {
        read_run(l, x, y, 1, &r);
        for (int part = 0; part < PART_COUNT; part++) {
            const float *bad = find_bad_value(&l->parts[part], r.channels[part], 1);
            if (bad)
                return dpl_fail(l->field->context, DPL_ERROR_ARGUMENT,
                                "%s of pixel (%d, %d) of the layer is %g", l->parts[part].name, x, y,
                                (double)*bad);
        }
    }
    return DPL_OK;
}

/* ---- drawing -------------------------------------------------------------------------------------- */

static void draw_run(const laying *l, const run *r) {
    dpl_field *field = l->field;
    size_t cell = (size_t)((int64_t)(l->layer->y + r->y) * field->width + l->layer->x + r->x);
    dpl_material m = {0};
    for (int32_t i = 0; i < r->count; i++) {
        extinction_at(l, r, i, m.extinction);
        if (dpl_extinction_kind(m.extinction) == DPL_PIXEL_EMPTY)
            continue;
        if (l->parts[PART_EMISSION].pixels.data) {
            values_at(&l->parts[PART_EMISSION], r->channels[PART_EMISSION], i, m.emission);
            for (int c = 0; c < 3; c++)
                m.emission[c] *= l->layer->intensity;
        }
        if (l->parts[PART_ALBEDO].pixels.data)
            values_at(&l->parts[PART_ALBEDO], r->channels[PART_ALBEDO], i, m.albedo);
        dpl_field_put(field, cell + (size_t)i, &m);
    }
}

static void draw_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const laying *l = task;
    run r;
    for (int32_t y = begin + l->y0; y < end + l->y0; y++)
        for (int32_t x = l->x0; x < l->x1; x += DPL_RUN) {
            read_run(l, x, y, l->x1 - x < DPL_RUN ? l->x1 - x : DPL_RUN, &r);
            make_extinction(l, &r);
            draw_run(l, &r);
        }
}

/* [low, high) of the picture's pixels that fall into a field of `field_size` when it is laid at `at`. */
static void cut(int32_t at, int32_t size, int32_t field_size, int32_t *low, int32_t *high) {
    int64_t first = at < 0 ? -(int64_t)at : 0, last = (int64_t)field_size - at;
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
    cut(layer->x, size->width, field->width, &l.x0, &l.x1);
    cut(layer->y, size->height, field->height, &l.y0, &l.y1);
    DPL_TRY(dpl_jobs_run(field->context, check_rows, l.y1 - l.y0, 16, &l));
    if (atomic_load(&l.first_bad_row) != INT32_MAX)
        return report_bad_row(&l, atomic_load(&l.first_bad_row));
    if (atomic_load(&l.media))
        DPL_TRY(dpl_field_hold_media(field));
    if (atomic_load(&l.albedo))
        DPL_TRY(dpl_field_hold_albedo(field));
    DPL_TRY(dpl_jobs_run(field->context, draw_rows, l.y1 - l.y0, 16, &l));
    field->measured = false;
    return DPL_OK;
}
