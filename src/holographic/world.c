/* The world as the solver's rows: per pixel the light and the transmittance of a chord through it, once in
 * rows along x for the quadrants that gather along y, and once in columns for the others. */
#include "holographic/holographic.h"

#include "kernel/exponential.h"

#include <math.h>

/* ---- clearing ------------------------------------------------------------------------------------- */

/* Makes rows of T that let everything through, masks and pads included. */
static void clear_rows(const dpl_hrc *hrc, const dpl_hrc_axis *axis, char *at, size_t rows) {
    const dpl_hrc_layout *l = &hrc->layout;
    size_t stride = (size_t)axis->shape.stride, mask = (size_t)axis->shape.words * sizeof(uint64_t);
    for (size_t row = 0; row < rows; row++) {
        memset(at, 0, mask);
        at += mask;
        memset(at, 0, 3 * stride * l->element);
        at += 3 * stride * l->element;
        for (size_t i = 0; i < (size_t)(l->planes - 3) * stride; i++, at += l->element) {
            float one = 1.0f;
            uint16_t half = 0x3c00;
            memcpy(at, l->half ? (const void *)&half : (const void *)&one, l->element);
        }
    }
}

static void clear_scratch(const dpl_hrc *hrc, const dpl_hrc_axis *axis, char *scratch) {
    for (int32_t n = DPL_HRC_TRACED_LEVEL; n < axis->strip_level; n++)
        clear_rows(hrc, axis, scratch + axis->strip[n], (size_t)((1 << n) + 1) << (axis->strip_level - n));
    for (int32_t n = axis->strip_level + 1; n < axis->levels; n++)
        clear_rows(hrc, axis, scratch + axis->wedge_segments[n],
                   (size_t)dpl_hrc_wedge_rays(axis, n) * (size_t)dpl_hrc_columns(axis, n));
    clear_rows(hrc, axis, scratch + axis->traced, DPL_HRC_TRACED_ROWS);
}

void dpl_hrc_clear_faces(dpl_hrc *hrc) {
    for (int a = 0; a < 2; a++) {
        const dpl_hrc_axis *axis = &hrc->layout.axes[a];
        memset((char *)hrc->arena.data + axis->faces, 0, (size_t)axis->width * axis->faces_bytes);
    }
}

void dpl_hrc_clear_segments(dpl_hrc *hrc) {
    const dpl_hrc_layout *l = &hrc->layout;
    char *arena = hrc->arena.data;
    size_t sets = l->media ? DPL_CHORDS : 1;
    for (int a = 0; a < 2; a++) {
        const dpl_hrc_axis *axis = &l->axes[a];
        size_t columns = (size_t)dpl_hrc_columns(axis, axis->strip_level);
        clear_rows(hrc, axis, arena + axis->world, (size_t)axis->width * sets);
        clear_rows(hrc, axis, arena + axis->outside, sets);
        clear_rows(hrc, axis, arena + axis->segments,
                   (l->keeps ? 2 : 1) * (((size_t)1 << axis->strip_level) + 1) * columns);
        for (int32_t worker = 0; worker < l->workers; worker++)
            clear_scratch(hrc, axis, arena + l->scratch + (size_t)worker * l->scratch_bytes);
    }
}

/* ---- runs of blocks ------------------------------------------------------------------------------- */

/* Words of a row's mask, at most. */
enum { MOST_WORDS = 2 * DPL_MAX_SIZE / DPL_ROW_BLOCK / 64 };

/* Pixels first .. behind-1 of a row, beginning with a block. */
typedef struct pixel_run {
    int32_t first;
    int32_t behind;
} pixel_run;

static bool has_block(const uint64_t *bits, int32_t x) {
    return bits[x / DPL_ROW_BLOCK / 64] >> x / DPL_ROW_BLOCK % 64 & 1;
}

/* The next blocks whose bits are set, from the one of pixel x on; empty behind the last. */
static pixel_run next_run(const uint64_t *bits, int32_t width, int32_t x) {
    while (x < width && !has_block(bits, x))
        x += DPL_ROW_BLOCK;
    pixel_run run = {x, x};
    while (run.behind < width && has_block(bits, run.behind))
        run.behind += DPL_ROW_BLOCK;
    run.behind = run.behind < width ? run.behind : width;
    return run;
}

/* ---- loading -------------------------------------------------------------------------------------- */

/* Half of the way through a pixel, by slope [px]. Corners have no length: only what is opaque shows there. */
static const float half_chords[DPL_CHORDS] = {
    [DPL_CHORD_STRAIGHT] = 0.5f, [DPL_CHORD_HALF] = 0.559016994f, [DPL_CHORD_DIAGONAL] = 0.707106781f};

/* What is not extinguished on a half chord, in one channel. */
static float through(const dpl_field *field, size_t cell, int channel, dpl_hrc_chord chord) {
    const uint8_t *kind = field->kind.data;
    if (kind[cell] != DPL_PIXEL_MEDIUM)
        return kind[cell] == DPL_PIXEL_OPAQUE ? 0.0f : 1.0f;
    float extinction = ((const float(*)[4])field->extinction.data)[cell][channel];
    if (chord == DPL_CHORD_POINT)
        return extinction < DPL_EXTINCTION_MAX ? 1.0f : 0.0f;
    return dpl_exp_negative(extinction * half_chords[chord]);
}

/* Pixels first .. behind-1 of a row of one set: planes of floats, `stride` apart. */
static void load_media(const dpl_hrc *hrc, const dpl_field *field, int32_t y, pixel_run run,
                       dpl_hrc_chord chord, float *planes, size_t stride) {
    const float(*emission)[4] = (const float(*)[4])field->emission.data;
    for (int32_t x = run.first; x < run.behind; x++) {
        size_t cell = dpl_field_cell(field, x, y);
        for (int c = 0; c < 3; c++) {
            float t = through(field, cell, c, chord);
            planes[(size_t)c * stride + (size_t)x] = fminf(emission[cell][c], DPL_RADIANCE_MAX) * (1.0f - t);
            if (c < hrc->layout.planes - 3)
                planes[(size_t)(3 + c) * stride + (size_t)x] = t;
        }
    }
}

static void load_run(const dpl_hrc *hrc, const dpl_field *field, int32_t y, pixel_run run,
                     dpl_hrc_chord chord, float *planes, size_t stride) {
    if (hrc->layout.media) {
        load_media(hrc, field, y, run, chord, planes, stride);
        return;
    }
    size_t cell = dpl_field_cell(field, run.first, y);
    field->context->kernels->opaque_planes(run.behind - run.first, planes + run.first, stride,
                                           (const uint8_t *)field->kind.data + cell,
                                           (const float(*)[4])field->emission.data + cell);
}

/* ---- rows ----------------------------------------------------------------------------------------- */

/* Where row or column `index` of a set begins, element 0 of its first plane. */
static char *world_row(const dpl_hrc *hrc, const dpl_hrc_axis *axis, int32_t index, dpl_hrc_chord chord) {
    return (char *)hrc->arena.data + axis->world + (size_t)index * axis->column_bytes + axis->set[chord] +
           (size_t)axis->shape.words * sizeof(uint64_t) + DPL_ROW_PAD * hrc->layout.element;
}

/* Tells the masks of a row's sets which blocks have pixels that are not empty. */
static void set_masks(const dpl_hrc *hrc, const dpl_hrc_axis *axis, int32_t index, int32_t word,
                      uint64_t bits) {
    for (int chord = 0; chord < (hrc->layout.media ? DPL_CHORDS : 1); chord++)
        dpl_row_mask(&axis->shape, world_row(hrc, axis, index, (dpl_hrc_chord)chord),
                     hrc->layout.element)[word] = bits;
}

/* Row y of one set, along x, where it is touched. Halves pass through `floats`. */
static void store_row(const dpl_hrc *hrc, const dpl_field *field, int32_t y, dpl_hrc_chord chord,
                      const uint64_t *touched, float *floats) {
    const dpl_hrc_layout *l = &hrc->layout;
    size_t stride = (size_t)l->axes[1].shape.stride;
    char *row = world_row(hrc, &l->axes[1], y, chord);
    for (pixel_run run = next_run(touched, field->width, 0); run.first < run.behind;
         run = next_run(touched, field->width, run.behind)) {
        if (!l->half) {
            load_run(hrc, field, y, run, chord, (float *)(void *)row, stride);
            continue;
        }
        load_run(hrc, field, y, run, chord, floats, stride);
        for (size_t plane = 0; plane < (size_t)l->planes; plane++) {
            size_t at = plane * stride + (size_t)run.first;
            hrc->solver.context->kernels->half_from_float(run.behind - run.first,
                                                          (uint16_t *)(void *)row + at, floats + at);
        }
    }
}

/* Is a pixel of a block not empty? The last block of a row may be short. */
static bool is_occupied(const uint8_t *kind, int32_t count) {
    uint8_t any = 0;
    for (int32_t i = 0; i < count; i++)
        any |= kind[i];
    return any != DPL_PIXEL_EMPTY;
}

/* Masks of row y, and what it adds to those of the columns it crosses. Touched are the blocks that are not
 * empty, and those that were not: all others are in memory what they were. */
static void mark_row(const dpl_hrc *hrc, const dpl_field *field, int32_t y, uint64_t *touched) {
    const dpl_hrc_axis *axis = &hrc->layout.axes[1];
    const uint8_t *kind = (const uint8_t *)field->kind.data + dpl_field_cell(field, 0, y);
    uint8_t *occupied =
        (uint8_t *)hrc->arena.data + hrc->layout.occupied + (size_t)(y / DPL_HRC_BAND) * (size_t)field->width;
    const uint64_t *before = dpl_row_mask(&axis->shape, world_row(hrc, axis, y, 0), hrc->layout.element);
    if (y % DPL_HRC_BAND == 0)
        memset(occupied, 0, (size_t)field->width);
    for (int32_t x = 0; x < field->width; x++)
        occupied[x] |= kind[x];
    int32_t whole = field->width / DPL_ROW_BLOCK, rest = field->width % DPL_ROW_BLOCK;
    for (int32_t word = 0; word < axis->shape.words; word++) {
        uint64_t bits = 0;
        for (int32_t b = 64 * word; b < whole && b < 64 * (word + 1); b++)
            bits |= (uint64_t)is_occupied(kind + b * DPL_ROW_BLOCK, DPL_ROW_BLOCK) << (b & 63);
        if (rest > 0 && whole / 64 == word)
            bits |= (uint64_t)is_occupied(kind + whole * DPL_ROW_BLOCK, rest) << (whole & 63);
        touched[word] = bits | before[word];
        set_masks(hrc, axis, y, word, bits);
    }
}

void dpl_hrc_mark_columns(dpl_hrc *hrc) {
    const dpl_hrc_axis *axis = &hrc->layout.axes[0];
    const uint8_t *occupied = (const uint8_t *)hrc->arena.data + hrc->layout.occupied;
    int32_t blocks = dpl_row_padded(axis->shape.length) / DPL_ROW_BLOCK;
    for (int32_t x = 0; x < axis->width; x++)
        for (int32_t word = 0; word < axis->shape.words; word++) {
            uint64_t bits = 0;
            for (int32_t b = 64 * word; b < blocks && b < 64 * (word + 1); b++)
                bits |= (uint64_t)(occupied[(size_t)b * (size_t)axis->width + (size_t)x] != 0) << (b & 63);
            set_masks(hrc, axis, x, word, bits);
        }
}

/* What is touched in rows y .. y+count-1, into the columns of the other axis. */
static void transpose_band(const dpl_hrc *hrc, int32_t y, int32_t count, dpl_hrc_chord chord,
                           const uint64_t *touched) {
    const dpl_hrc_layout *l = &hrc->layout;
    const dpl_kernels *kernels = hrc->solver.context->kernels;
    const dpl_hrc_axis *columns = &l->axes[0], *rows = &l->axes[1];
    size_t to_step = columns->column_bytes / l->element, from_step = rows->column_bytes / l->element;
    for (size_t plane = 0; plane < (size_t)l->planes; plane++)
        for (pixel_run run = next_run(touched, columns->width, 0); run.first < run.behind;
             run = next_run(touched, columns->width, run.behind)) {
            const char *from = world_row(hrc, rows, y, chord) +
                               (plane * (size_t)rows->shape.stride + (size_t)run.first) * l->element;
            char *to = world_row(hrc, columns, run.first, chord) +
                       (plane * (size_t)columns->shape.stride + (size_t)y) * l->element;
            int32_t wide = run.behind - run.first;
            if (l->half)
                kernels->transpose_halves(count, wide, (uint16_t *)(void *)to, to_step,
                                          (const uint16_t *)(const void *)from, from_step);
            else
                kernels->transpose(count, wide, (float *)(void *)to, to_step,
                                   (const float *)(const void *)from, from_step);
        }
}

/* Rows y .. y+count-1. `floats`: room for one of them. */
static void load_band(const dpl_hrc_frame *f, int32_t y, int32_t count, float *floats) {
    uint64_t touched[DPL_HRC_BAND][MOST_WORDS], any[MOST_WORDS] = {0};
    int32_t words = f->hrc->layout.axes[1].shape.words;
    for (int32_t i = 0; i < count; i++) {
        mark_row(f->hrc, f->field, y + i, touched[i]);
        for (int32_t word = 0; word < words; word++)
            any[word] |= touched[i][word];
        dpl_hrc_mark_sets(f->hrc, f->field, y + i);
    }
    for (int chord = 0; chord < (f->hrc->layout.media ? DPL_CHORDS : 1); chord++) {
        for (int32_t i = 0; i < count; i++)
            store_row(f->hrc, f->field, y + i, (dpl_hrc_chord)chord, touched[i], floats);
        transpose_band(f->hrc, y, count, (dpl_hrc_chord)chord, any);
    }
}

void dpl_hrc_load_task(int32_t begin, int32_t end, int32_t worker, void *frame) {
    const dpl_hrc_frame *f = frame;
    const dpl_hrc_layout *l = &f->hrc->layout;
    float *floats = (float *)(void *)((char *)f->hrc->arena.data + l->scratch +
                                      (size_t)worker * l->scratch_bytes + l->axes[1].band);
    for (int32_t item = begin; item < end; item++) {
        int32_t y = item * DPL_HRC_BAND, left = f->field->height - y;
        load_band(f, y, left < DPL_HRC_BAND ? left : DPL_HRC_BAND, floats);
    }
}
