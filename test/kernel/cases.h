/* Kernels on inputs as frames have them: rows of 512 values, rays of a cascade's levels, a picture's world.
 * Each case says how to run one kernel and what it moves. The same cases are held against the scalar
 * reference and timed, so what is timed is known to be right (the idea of dav1d's checkasm). Used by
 * test_kernel_cases.c and timing.c; cases_*.c hold the tables. */
#ifndef DPL_TEST_KERNEL_CASES_H
#define DPL_TEST_KERNEL_CASES_H

#include "field/field.h"
#include "kernel/kernel.h"

enum {
    DPL_CASE_ROW = 512,     /* values in a row, pixels along a side of the world */
    DPL_CASE_PROBES = 128,  /* whose rays cascades march together, */
    DPL_CASE_CHUNK = 512,   /* each four: rays per call */
    DPL_CASE_RAYS = 16384,  /* per run */
    DPL_CASE_MAP_RAYS = 56, /* of a light's ray map */
    DPL_CASE_BINS = 2048,
    DPL_CASE_PLANES = 8,
    DPL_CASE_ROWS = 6,
    DPL_CASE_BAND = 32, /* rows of the distance transform that a task works on */
    DPL_CASE_OUT = DPL_CASE_MAP_RAYS * DPL_CASE_BINS * 4 /* most that a case writes [byte] */
};

/* Worlds: ARC scene 5, and noise in a medium. */
enum { DPL_CASE_ARC, DPL_CASE_MIST, DPL_CASE_WORLDS };

/* Lengths of rays: of levels 1 and 3 of a cascade, and from anywhere to anywhere in the picture. */
enum { DPL_CASE_LEVEL_1, DPL_CASE_LEVEL_3, DPL_CASE_ACROSS, DPL_CASE_SPANS };

/* Walls around a band of rows: ARC scene 5 again, and noise with a wall on every eighth pixel. */
enum { DPL_CASE_ARC_WALLS, DPL_CASE_NOISE_WALLS, DPL_CASE_WALLS };

typedef struct dpl_case_band {
    uint8_t kind[DPL_CASE_BAND][DPL_CASE_ROW];
    int32_t runs[DPL_CASE_BAND][DPL_CASE_ROW]; /* distances along columns */
} dpl_case_band;

/* What all cases read. */
typedef struct dpl_case_inputs {
    dpl_context *context;
    dpl_field *fields[DPL_CASE_WORLDS];
    dpl_grid grids[DPL_CASE_WORLDS];
    float ends[DPL_CASE_SPANS][4][DPL_CASE_RAYS];
    float planes[DPL_CASE_PLANES][DPL_CASE_ROW + 2 * DPL_ROW_PAD]; /* 0 .. 1 */
    float texels[DPL_CASE_ROW][4];
    uint16_t halves[DPL_CASE_ROW];
    uint8_t kinds[DPL_CASE_ROW];
    int32_t runs[DPL_CASE_ROW];
    dpl_case_band bands[DPL_CASE_WALLS];
    dpl_srgb_steps steps;
    float bins[DPL_CASE_BINS][3];
    float offsets[DPL_CASE_MAP_RAYS];
    float reach[DPL_CASE_MAP_RAYS][DPL_CASE_BINS];
    float receivers[2][DPL_CASE_ROW];
    unsigned char *rows[DPL_ROWS_STORAGES][DPL_CASE_ROWS]; /* of T, no block empty: see dpl_case_row() */
} dpl_case_inputs;

typedef struct dpl_kernel_case {
    const char *kernel; /* as dpl_kernels or dpl_row_kernels has it */
    const char *input;
    const char *item; /* what times are per */
    int32_t items;    /* per run */
    double bytes;     /* that an item reads and writes, each once; 0: it gathers, and nobody knows */
    size_t out_bytes; /* written per run */
    void (*run)(const struct dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                void *out);
    void (*fill)(void *out); /* before the first run; NULL: every float is 1/4 */
    int32_t world;
    int32_t span;
    int32_t storage;
} dpl_kernel_case;

/* Makes what cases read; fails the test where it cannot. */
dpl_case_inputs *dpl_case_inputs_create(void);

void dpl_case_inputs_free(dpl_case_inputs *inputs);

/* The shape of rows, and bytes of a row of T with its mask and pads. */
dpl_row_shape dpl_case_shape(void);
size_t dpl_case_row_bytes(int32_t storage);

/* Element 0 of the first plane of a row that begins at `memory` with its mask. */
void *dpl_case_row(void *memory, int32_t storage);

/* All bits of the mask that a row begins with. */
void dpl_case_fill_mask(void *memory);

/* Fills `out_bytes` of memory as the case wants it before its first run. */
void dpl_case_fill_out(const dpl_kernel_case *c, void *out);

/* Number n of all cases; NULL behind the last. */
const dpl_kernel_case *dpl_kernel_case_at(int32_t number);

/* Tables, one per file. */
const dpl_kernel_case *dpl_cases_of_marches(int32_t *count);
const dpl_kernel_case *dpl_cases_of_pixels(int32_t *count);
const dpl_kernel_case *dpl_cases_of_rows(int32_t *count);
const dpl_kernel_case *dpl_cases_of_lights(int32_t *count);

#endif
