/* Light solved on another grid than the picture's: the world as coarser or finer pixels, and its light
 * brought back to the picture. Used by holographic.c, which lights the world in between.
 * docs/algorithms/resolution.md has the rules and why they are so.
 *
 *   resolution.c   memory, and who does what when
 *   coarsen.c      2x2 or 4x4 pixels -> one block
 *   refine.c       light of blocks -> pixels
 *   mend.c         pixels beside thin walls
 *   walls.c        what opaque pixels show
 *   double.c       a pixel -> 2x2 of them, and back
 */
#ifndef DPL_HOLOGRAPHIC_RESOLUTION_H
#define DPL_HOLOGRAPHIC_RESOLUTION_H

#include "solver/solver.h"

/* Most targets of a solve: mean, cosine, sine. */
#define DPL_HRC_TARGETS 3

/* What a block of pixels holds. */
enum {
    DPL_BLOCK_OPAQUE = 1,  /* at least one of its pixels is */
    DPL_BLOCK_SOLID = 2,   /* most of them are */
    DPL_BLOCK_STOPS_X = 4, /* no row of it lets a ray along x through */
    DPL_BLOCK_STOPS_Y = 8, /* no column, along y */
    DPL_BLOCK_FREE = 16,   /* at least one of its pixels is not opaque */
    DPL_BLOCK_MEDIUM = 32, /* at least one is a medium */
};

/* The memory of it. */
typedef enum dpl_hrc_memory {
    DPL_MEMORY_KIND, /* planes of the field, as dpl_field has them */
    DPL_MEMORY_EMISSION,
    DPL_MEMORY_EXTINCTION,
    DPL_MEMORY_ALBEDO,
    DPL_MEMORY_BLOCKS, /* uint8_t per block: the bits above */
    DPL_MEMORY_MENDS,  /* uint8_t per block: see dpl_hrc_mend_row() */
    DPL_MEMORY_LIGHT,  /* float [target][y][x][3]: what the solver says */
    DPL_MEMORY_PLANES, /* float [plane][y][1 + x + 1]: see dpl_hrc_plane_row() */
    DPL_MEMORY_ROWS,   /* float, of workers */
    DPL_MEMORIES
} dpl_hrc_memory;

typedef struct dpl_hrc_resolution {
    dpl_resolution kind;
    int32_t scale;        /* pixels of the caller's field along a side of a block; of DOUBLE 1 */
    int32_t target_count; /* that are wanted */
    bool reflects;        /* walls of the solved world do */
    /* The world on its own grid, filled in anew for each frame; its planes are lent from the memory. */
    dpl_field field;
    dpl_targets targets;
    dpl_buffer memory[DPL_MEMORIES];
} dpl_hrc_resolution;

/* What tasks are handed. `field` is the caller's. */
typedef struct dpl_hrc_resampling {
    dpl_hrc_resolution *resolution;
    const dpl_field *field;
    const dpl_targets *targets;
} dpl_hrc_resampling;

/* Light of a pixel of the world on its own grid, RGB. */
static inline float *dpl_hrc_light(const dpl_hrc_resolution *r, int32_t target, int32_t x, int32_t y) {
    float *light = r->memory[DPL_MEMORY_LIGHT].data;
    return light + ((size_t)target * dpl_field_pixels(&r->field) + dpl_field_cell(&r->field, x, y)) * 3;
}

/* Planes that are interpolated: channels of targets, and their weight. */
static inline int32_t dpl_hrc_plane_count(const dpl_hrc_resolution *r) {
    return r->target_count * 3 + 1;
}

/* Floats from a row of one to the next: a block more at either end. */
static inline int32_t dpl_hrc_plane_stride(const dpl_hrc_resolution *r) {
    return r->field.width + 2;
}

static inline float *dpl_hrc_plane_row(const dpl_hrc_resolution *r, int32_t plane, int32_t y) {
    float *planes = r->memory[DPL_MEMORY_PLANES].data;
    return planes + ((size_t)plane * (size_t)r->field.height + (size_t)y) * (size_t)dpl_hrc_plane_stride(r) +
           1;
}

/* Is there such a block, and has it light of its own? */
static inline bool dpl_hrc_is_free(const dpl_hrc_resolution *r, int32_t x, int32_t y) {
    return x >= 0 && y >= 0 && x < r->field.width && y < r->field.height &&
           !dpl_field_is_opaque(&r->field, x, y);
}

/* Neighbours of a block, in a ring: even ones are its sides, odd ones its corners; i ^ 4 is the opposite. */
enum { DPL_AROUND = 8 };
extern const int32_t dpl_hrc_around[DPL_AROUND][2]; /* mend.c */

/* Bits of a mend: the block is a thin wall; or, bit i, its light must not mix with that of corner i. */
enum { DPL_MEND_SHUT = 1 };

/* resolution.c */
/* Fills resolution->field from `field` and points resolution->targets at memory of its size. */
DPL_MUST_CHECK dpl_status dpl_hrc_scale_field(dpl_hrc_resolution *resolution, const dpl_field *field,
                                              const dpl_targets *targets);
/* What is then in resolution->targets, to the caller's. */
DPL_MUST_CHECK dpl_status dpl_hrc_scale_light(dpl_hrc_resolution *resolution, const dpl_field *field,
                                              const dpl_targets *targets);
int64_t dpl_hrc_resolution_bytes(const dpl_hrc_resolution *resolution);
void dpl_hrc_resolution_free(dpl_context *context, dpl_hrc_resolution *resolution);
/* A row of the world, as planes [target*3 + channel], to the caller's targets. Opaque pixels are filled in
 * first: what they show, and 0 as cosine and sine. */
void dpl_hrc_write_targets(const dpl_hrc_resampling *resampling, int32_t y, float *const planes[]);

/* coarsen.c. Items: rows of blocks; all of the first before any of the second. */
void dpl_hrc_survey_task(int32_t begin, int32_t end, int32_t worker, void *resampling);
void dpl_hrc_coarsen_task(int32_t begin, int32_t end, int32_t worker, void *resampling);

/* refine.c. Items: rows of blocks, then rows of the picture. */
void dpl_hrc_weigh_task(int32_t begin, int32_t end, int32_t worker, void *resampling);
void dpl_hrc_refine_task(int32_t begin, int32_t end, int32_t worker, void *resampling);
/* Floats that a worker needs for the second. */
size_t dpl_hrc_refine_floats(const dpl_hrc_resolution *resolution);

/* mend.c */
/* Does a straight way lead from every free pixel of an opaque block to light, in a block beside it? */
bool dpl_hrc_is_open(const dpl_hrc_resampling *resampling, int32_t block_x, int32_t block_y);
/* Pixels of a row of the world that need it, in planes [target*3 + channel]. */
void dpl_hrc_mend_row(const dpl_hrc_resampling *resampling, int32_t y, float *const planes[]);

/* walls.c */
/* Opaque pixels of a row of the world, in planes of the mean: their emission and what they reflect. */
void dpl_hrc_show_walls(const dpl_hrc_resampling *resampling, int32_t y, float *const planes[3]);

/* double.c. Items: rows of the field; rows of the picture. */
void dpl_hrc_split_task(int32_t begin, int32_t end, int32_t worker, void *resampling);
void dpl_hrc_join_task(int32_t begin, int32_t end, int32_t worker, void *resampling);
/* Floats that a worker needs for the second. */
size_t dpl_hrc_join_floats(const dpl_hrc_resolution *resolution, const dpl_field *field);

#endif
