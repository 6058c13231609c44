/* Pictures and raw buffers to pixels. Called by src/api/field.c with a layer whose shape (sizes, strides,
 * channels) has been checked; the values are checked here, all of them before the first pixel is drawn. */
#include "field/field.h"
#include "job/jobs.h"

#include <stdatomic.h>

/* What the values of one picture may be. */
typedef struct value_rule {
    const char *picture;
    float highest;
    bool infinity; /* INFINITY is fine too */
} value_rule;

typedef enum layer_part { PART_EMISSION, PART_EXTINCTION, PART_ALBEDO, PART_COUNT } layer_part;

typedef struct laying {
    dpl_field *field;
    const dpl_layer *layer;
    const dpl_pixels *pictures[PART_COUNT];
    value_rule rules[PART_COUNT];
    float srgb[256];          /* decoded sRGB bytes */
    int32_t x0, x1, y0, y1;   /* the part of the pictures that lies in the field [px of the pictures] */
    atomic_int first_bad_row; /* lowest row with a bad value, else INT32_MAX */
    atomic_bool media;        /* some pixel is a medium */
    atomic_bool albedo;       /* some pixel has albedo */
} laying;

/* ---- reading -------------------------------------------------------------------------------------- */

static void fill_srgb_table(float table[256]) {
    for (int i = 0; i < 256; i++) {
        double v = i / 255.0;
        table[i] = (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
}

/* One pixel's stored channels as floats. */
static void read_channels(const laying *l, const dpl_pixels *p, int32_t x, int32_t y, float out[4]) {
    const char *row = (const char *)p->data + p->row_stride * y;
    size_t first = (size_t)x * (size_t)p->channels;
    bool has_alpha = p->channels == 2 || p->channels == 4;
    for (int32_t c = 0; c < p->channels; c++) {
        if (p->format == DPL_FORMAT_F32) {
            memcpy(&out[c], row + (first + (size_t)c) * sizeof(float), sizeof(float));
            continue;
        }
        uint8_t byte = ((const uint8_t *)row)[first + (size_t)c];
        bool is_alpha = has_alpha && c == p->channels - 1;
        out[c] = p->format == DPL_FORMAT_SRGB8 && !is_alpha ? l->srgb[byte] : (float)byte / 255.0f;
    }
}

/* Grey is the same in all three; alpha is left out. */
static void colour_of(const dpl_pixels *p, const float channels[4], float rgb[3]) {
    bool grey = p->channels < 3;
    for (int c = 0; c < 3; c++)
        rgb[c] = channels[grey ? 0 : c];
}

/* The channels of an extinction picture that count: its alpha if it has one. */
static void extinction_values(const dpl_pixels *p, const float channels[4], float values[3]) {
    if (p->channels == 2 || p->channels == 4)
        values[0] = values[1] = values[2] = channels[p->channels - 1];
    else
        colour_of(p, channels, values);
}

static float extinction_of_opacity(float opacity) {
    return opacity >= 1.0f ? INFINITY : opacity > 0.0f ? (float)-log1p(-(double)opacity) : 0.0f;
}

static void part_values(layer_part part, const dpl_pixels *p, const float channels[4], float values[3]) {
    if (part == PART_EXTINCTION)
        extinction_values(p, channels, values);
    else
        colour_of(p, channels, values);
}

/* Where there is no extinction picture the emission picture decides: by alpha, else opaque where not black.
 */
static void extinction_from_emission(const dpl_pixels *p, const float channels[4], const float rgb[3],
                                     float extinction[3]) {
    float s;
    if (p->channels == 2 || p->channels == 4)
        s = extinction_of_opacity(channels[p->channels - 1]);
    else
        s = rgb[0] > 0.0f || rgb[1] > 0.0f || rgb[2] > 0.0f ? INFINITY : 0.0f;
    extinction[0] = extinction[1] = extinction[2] = s;
}

/* The material that the layer has at one pixel of its pictures. */
static dpl_material material_at(const laying *l, int32_t x, int32_t y) {
    const dpl_layer *layer = l->layer;
    dpl_material m;
    float channels[4], values[3];
    memset(&m, 0, sizeof m);
    if (layer->emission.data) {
        read_channels(l, &layer->emission, x, y, channels);
        colour_of(&layer->emission, channels, values);
        for (int c = 0; c < 3; c++)
            m.emission[c] = values[c] * layer->intensity;
        if (!layer->extinction.data)
            extinction_from_emission(&layer->emission, channels, values, m.extinction);
    }
    if (layer->extinction.data) {
        read_channels(l, &layer->extinction, x, y, channels);
        extinction_values(&layer->extinction, channels, values);
        for (int c = 0; c < 3; c++)
            m.extinction[c] = layer->extinction_is_opacity ? extinction_of_opacity(values[c]) : values[c];
    }
    if (layer->albedo.data) {
        read_channels(l, &layer->albedo, x, y, channels);
        colour_of(&layer->albedo, channels, m.albedo);
    }
    return m;
}

/* ---- checking ------------------------------------------------------------------------------------- */

static bool value_is_good(const value_rule *rule, float v) {
    return (v >= 0.0f && v <= rule->highest) || (rule->infinity && v == INFINITY);
}

/* Returns the part whose value is bad at this pixel, or PART_COUNT; the value goes to `bad`. */
static layer_part find_bad_value(const laying *l, int32_t x, int32_t y, float *bad) {
    for (int part = 0; part < PART_COUNT; part++) {
        const dpl_pixels *p = l->pictures[part];
        float channels[4], values[3];
        if (!p->data)
            continue;
        read_channels(l, p, x, y, channels);
        part_values((layer_part)part, p, channels, values);
        for (int c = 0; c < 3; c++)
            if (!value_is_good(&l->rules[part], values[c])) {
                *bad = values[c];
                return (layer_part)part;
            }
        if (part == PART_EMISSION && !l->layer->extinction.data && (p->channels == 2 || p->channels == 4) &&
            !(channels[p->channels - 1] >= 0.0f && channels[p->channels - 1] <= 1.0f)) {
            *bad = channels[p->channels - 1];
            return PART_EMISSION;
        }
    }
    return PART_COUNT;
}

static void note_bad_row(laying *l, int32_t y) {
    int known = atomic_load(&l->first_bad_row);
    while (y < known && !atomic_compare_exchange_weak(&l->first_bad_row, &known, y))
        ;
}

static void check_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    laying *l = task;
    bool media = false, albedo = false;
    for (int32_t y = begin + l->y0; y < end + l->y0; y++)
        for (int32_t x = l->x0; x < l->x1; x++) {
            float bad;
            if (find_bad_value(l, x, y, &bad) != PART_COUNT) {
                note_bad_row(l, y);
                return;
            }
            dpl_material m = material_at(l, x, y);
            media |= dpl_material_kind(&m) == DPL_PIXEL_MEDIUM;
            albedo |= dpl_material_has_albedo(&m);
        }
    if (media)
        atomic_store(&l->media, true);
    if (albedo)
        atomic_store(&l->albedo, true);
}

static dpl_status report_bad_row(const laying *l, int32_t y) {
    for (int32_t x = l->x0; x < l->x1; x++) {
        float bad;
        layer_part part = find_bad_value(l, x, y, &bad);
        if (part != PART_COUNT)
            return dpl_fail(l->field->context, DPL_ERROR_ARGUMENT, "%s of pixel (%d, %d) of the layer is %g",
                            l->rules[part].picture, x, y, (double)bad);
    }
    return DPL_OK;
}

/* ---- drawing -------------------------------------------------------------------------------------- */

static void draw_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const laying *l = task;
    dpl_field *field = l->field;
    for (int32_t y = begin + l->y0; y < end + l->y0; y++)
        for (int32_t x = l->x0; x < l->x1; x++) {
            dpl_material m = material_at(l, x, y);
            if (dpl_material_kind(&m) == DPL_PIXEL_EMPTY)
                continue;
            int64_t cell = (int64_t)(l->layer->y + y) * field->width + l->layer->x + x;
            dpl_field_put(field, (size_t)cell, &m);
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
        .pictures = {&layer->emission, &layer->extinction, &layer->albedo},
        .rules = {{"emission", 3e38f / fmaxf(layer->intensity, 1.0f), false},
                  {"extinction", layer->extinction_is_opacity ? 1.0f : 3e38f, !layer->extinction_is_opacity},
                  {"albedo", 1.0f, false}},
    };
    atomic_init(&l.first_bad_row, INT32_MAX);
    atomic_init(&l.media, false);
    atomic_init(&l.albedo, false);
    fill_srgb_table(l.srgb);
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
    dpl_field_touch(field);
    return DPL_OK;
}
