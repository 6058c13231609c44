/* Makes what the cases read, and strings their tables together. Called by test_kernel_cases.c and timing.c.
 */
#include "kernel/cases.h"

#include "testing.h"

#include "../../bench/common/random.h"
#include "../../bench/common/world.h"
#include "../../scenes/families.h"

#include "kernel/half.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- worlds and rays ------------------------------------------------------------------------------ */

/* ARC scene 5 with the distances of shapes that march_surface() wants. */
static void make_arc(dpl_case_inputs *in) {
    dpl_scene scene = {0};
    dpl_error error;
    assert_true(dpl_scene_family_find("arc")->make(1, 5, DPL_CASE_ROW, &scene, &error));
    assert_true(dpl_scene_build_field(&scene, in->context, true, &in->fields[DPL_CASE_ARC], &error));
    dpl_scene_free(&scene);
}

static void make_worlds(dpl_case_inputs *in) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_error error;
    desc.thread_count = 1;
    assert_ok(dpl_context_create(&desc, &in->context));
    make_arc(in);
    assert_true(
        dpl_bench_world_make(DPL_BENCH_MIST, DPL_CASE_ROW, in->context, &in->fields[DPL_CASE_MIST], &error));
    for (int w = 0; w < DPL_CASE_WORLDS; w++) {
        assert_ok(dpl_field_measure(in->fields[w]));
        in->grids[w] = dpl_field_grid(in->fields[w]);
    }
}

/* Four directions side by side from a run of neighbouring probes, as a level marches them; or rays that have
 * nothing in common. */
static void fill_rays(float ends[4][DPL_CASE_RAYS], int32_t span, uint64_t *state) {
    static const float spacing[] = {2, 8}, from[] = {2, 32}, to[] = {8, 128};
    static const double directions[] = {16, 256};
    double angle = 0, dx = 0, dy = 0, y = 0;
    for (int32_t i = 0; i < DPL_CASE_RAYS; i++) {
        if (span == DPL_CASE_ACROSS) {
            for (int32_t e = 0; e < 4; e++)
                ends[e][i] = (float)dpl_bench_random(state, 0, DPL_CASE_ROW);
            continue;
        }
        if (i % DPL_CASE_CHUNK == 0) {
            angle = dpl_bench_random(state, 0, 6.283185);
            y = dpl_bench_random(state, 0, DPL_CASE_ROW);
        }
        if (i % DPL_CASE_PROBES == 0) {
            dx = cos(angle);
            dy = sin(angle);
            angle += 6.283185 / directions[span];
        }
        double x = fmod(((i % DPL_CASE_PROBES) + 0.5) * spacing[span], DPL_CASE_ROW);
        ends[0][i] = (float)(x + from[span] * dx);
        ends[1][i] = (float)(y + from[span] * dy);
        ends[2][i] = (float)(x + to[span] * dx);
        ends[3][i] = (float)(y + to[span] * dy);
    }
}

/* ---- bands of the distance transform -------------------------------------------------------------- */

static uint8_t kind_at(const dpl_case_inputs *in, int32_t walls, int32_t x, int32_t y, uint64_t *state) {
    if (walls == DPL_CASE_NOISE_WALLS)
        return dpl_bench_random(state, 0, 8) < 1 ? 2 : 0;
    float clearance = in->grids[DPL_CASE_ARC].clearance[y * DPL_CASE_ROW + x];
    return clearance < 0.0f ? 2 : clearance > 0.0f ? 0 : 1;
}

/* Column by column through the whole picture; the band is in its middle. */
static void fill_bands(dpl_case_inputs *in, uint64_t *state) {
    enum { FIRST = (DPL_CASE_ROW - DPL_CASE_BAND) / 2 };
    for (int32_t walls = 0; walls < DPL_CASE_WALLS; walls++)
        for (int32_t x = 0; x < DPL_CASE_ROW; x++) {
            dpl_case_band *band = &in->bands[walls];
            int32_t runs[DPL_CASE_ROW], run = 2 * DPL_CASE_ROW;
            for (int32_t y = 0; y < DPL_CASE_ROW; y++) {
                uint8_t kind = kind_at(in, walls, x, y, state);
                runs[y] = run = kind ? 0 : run + 1;
                if (y >= FIRST && y < FIRST + DPL_CASE_BAND)
                    band->kind[y - FIRST][x] = kind;
            }
            for (int32_t y = DPL_CASE_ROW - 2; y >= 0; y--)
                runs[y] = runs[y] < runs[y + 1] + 1 ? runs[y] : runs[y + 1] + 1;
            for (int32_t y = 0; y < DPL_CASE_BAND; y++)
                band->runs[y][x] = runs[FIRST + y];
        }
}

/* ---- planes, lights and rows ---------------------------------------------------------------------- */

static void fill_planes(dpl_case_inputs *in, uint64_t *state) {
    for (int p = 0; p < DPL_CASE_PLANES; p++)
        for (int i = 0; i < DPL_CASE_ROW + 2 * DPL_ROW_PAD; i++)
            in->planes[p][i] = (float)dpl_bench_random(state, 0, 1);
    for (int i = 0; i < DPL_CASE_ROW; i++) {
        for (int c = 0; c < 4; c++)
            in->texels[i][c] = (float)dpl_bench_random(state, 0, 4);
        in->halves[i] = dpl_half_from_float(in->planes[0][i]);
        in->kinds[i] = (uint8_t)(dpl_bench_random(state, 0, 1) < 0.1 ? 2 : 0);
        in->runs[i] = (int32_t)dpl_bench_random(state, 0, 500);
    }
    dpl_srgb_steps_fill(&in->steps);
}

static void fill_light(dpl_case_inputs *in, uint64_t *state) {
    for (int i = 0; i < DPL_CASE_BINS; i++)
        for (int k = 0; k < 3; k++)
            in->bins[i][k] = (float)dpl_bench_random(state, 0, 90000 * (k + 1));
    for (int k = 0; k < DPL_CASE_MAP_RAYS; k++) {
        in->offsets[k] = (2.0f * (float)k + 1.0f) / DPL_CASE_MAP_RAYS - 1.0f;
        for (int i = 0; i < DPL_CASE_BINS; i++)
            in->reach[k][i] = (float)dpl_bench_random(state, 0, 200000);
    }
    for (int i = 0; i < DPL_CASE_ROW; i++) { /* a row of pixels below a light */
        in->receivers[0][i] = (float)i - 200.0f;
        in->receivers[1][i] = 77.0f;
    }
}

dpl_row_shape dpl_case_shape(void) {
    return (dpl_row_shape){.length = DPL_CASE_ROW, .stride = DPL_CASE_ROW + 2 * DPL_ROW_PAD, .words = 8};
}

static size_t element_of(int32_t storage) {
    return storage == DPL_ROWS_HALF ? sizeof(uint16_t) : sizeof(float);
}

size_t dpl_case_row_bytes(int32_t storage) {
    dpl_row_shape shape = dpl_case_shape();
    return (size_t)shape.words * sizeof(uint64_t) + 4 * (size_t)shape.stride * element_of(storage);
}

void *dpl_case_row(void *memory, int32_t storage) {
    dpl_row_shape shape = dpl_case_shape();
    return (unsigned char *)memory + (size_t)shape.words * sizeof(uint64_t) +
           DPL_ROW_PAD * element_of(storage);
}

void dpl_case_fill_mask(void *memory) {
    uint64_t *mask = memory;
    int32_t blocks = DPL_CASE_ROW / DPL_ROW_BLOCK;
    memset(mask, 0, (size_t)dpl_case_shape().words * sizeof *mask);
    mask[0] = blocks < 64 ? ((uint64_t)1 << blocks) - 1 : UINT64_MAX;
}

/* Walls and lamps by chance in every block; <0, 1> in the pads. */
static void fill_row(unsigned char *memory, int32_t storage, uint64_t *state) {
    dpl_row_shape shape = dpl_case_shape();
    void *row = dpl_case_row(memory, storage);
    dpl_case_fill_mask(memory);
    for (int p = 0; p < 4; p++)
        for (int32_t i = -DPL_ROW_PAD; i < DPL_CASE_ROW + DPL_ROW_PAD; i++) {
            bool used = i >= 0 && i < DPL_CASE_ROW;
            float value = used ? (float)dpl_bench_random(state, 0, 1) : p < 3 ? 0.0f : 1.0f;
            if (storage == DPL_ROWS_HALF)
                ((uint16_t *)row)[p * shape.stride + i] = dpl_half_from_float(value);
            else
                ((float *)row)[p * shape.stride + i] = value;
        }
}

dpl_case_inputs *dpl_case_inputs_create(void) {
    dpl_case_inputs *in = calloc(1, sizeof *in);
    uint64_t state = 1;
    assert_non_null(in);
    make_worlds(in);
    for (int32_t span = 0; span < DPL_CASE_SPANS; span++)
        fill_rays(in->ends[span], span, &state);
    fill_planes(in, &state);
    fill_light(in, &state);
    fill_bands(in, &state);
    for (int32_t storage = 0; storage < DPL_ROWS_STORAGES; storage++)
        for (int r = 0; r < DPL_CASE_ROWS; r++) {
            size_t bytes = (dpl_case_row_bytes(storage) + 63) / 64 * 64;
            in->rows[storage][r] = aligned_alloc(64, bytes);
            assert_non_null(in->rows[storage][r]);
            fill_row(in->rows[storage][r], storage, &state);
        }
    return in;
}

void dpl_case_inputs_free(dpl_case_inputs *in) {
    for (int32_t storage = 0; storage < DPL_ROWS_STORAGES; storage++)
        for (int r = 0; r < DPL_CASE_ROWS; r++)
            free(in->rows[storage][r]);
    for (int w = 0; w < DPL_CASE_WORLDS; w++)
        dpl_field_destroy(in->fields[w]);
    dpl_context_destroy(in->context);
    free(in);
}

void dpl_case_fill_out(const dpl_kernel_case *c, void *out) {
    float *values = out;
    for (size_t i = 0; i < c->out_bytes / sizeof *values; i++)
        values[i] = 0.25f;
    if (c->fill)
        c->fill(out);
}

/* ---- tables --------------------------------------------------------------------------------------- */

const dpl_kernel_case *dpl_kernel_case_at(int32_t number) {
    static const dpl_kernel_case *(*const tables[])(int32_t * count) = {
        dpl_cases_of_marches, dpl_cases_of_pixels, dpl_cases_of_rows, dpl_cases_of_lights};
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        int32_t count;
        const dpl_kernel_case *cases = tables[t](&count);
        if (number < count)
            return &cases[number];
        number -= count;
    }
    return NULL;
}
