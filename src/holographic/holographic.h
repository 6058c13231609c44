/* The holographic solver: its state, and what its files offer each other. docs/algorithms/holographic.md has
 * the method; in short, for each of four quadrants (gather along +x, -x, +y, -y):
 *
 *   T(n, p, k)  light and transmittance of the segment from column p*2^n, across from every pixel of it, by
 *               the vector (2^n, 2k - 2^n); levels 0 to 2 are traced through pixels, each further level is
 *               put together from two segments of the one before (a part of half of level 3 is traced)
 *   R(n, p, i)  mean radiance that arrives at column p*2^n through cone i, between rays i and i+1 of level n;
 *               beyond the top level there is the sky, and every level is merged from the one above
 *
 * The levels are cut at level S. Below it T depends on a strip of 2^S columns, above it on a wedge between
 * two rays of level S: both fit into a processor's own cache.
 *   strip.c   T of a strip, from pixels to level S      wedge.c   T and R of a wedge, from level S up and
 * back gather.c  R of a strip, from level S to pixels      column.c  the two steps that these are made of
 *   world.c   field -> rows of pixels                   finish.c  sums of quadrants -> filter -> output
 *   layout.c  sizes and places of everything            lens.c    weights of cones, the sky through them
 *   band.c    a few filtered rows of the sums           faces.c   what walls reflect, from those and lights
 *   rims.c    light of lamps a few pixels away, for the filter beside them
 *   kept.c    strips that the last frame's T, R and sums are still good for
 */
#ifndef DPL_HOLOGRAPHIC_HOLOGRAPHIC_H
#define DPL_HOLOGRAPHIC_HOLOGRAPHIC_H

#include "holographic/resolution.h"
#include "kernel/half.h"
#include "solver/solver.h"

/* S, at most: strips are 32 columns wide. */
#define DPL_HRC_STRIP_LEVEL 5

/* What the columns of R that such a strip is gathered through may take of a core's own cache; else strips are
 * 16 columns wide [byte]. */
#define DPL_HRC_STRIP_BYTES ((size_t)7 << 18)

/* ceil(log2(2 * DPL_MAX_SIZE)): the world may be solved at twice its size. */
#define DPL_HRC_MAX_LEVELS 15

/* Highest level that is traced through pixels. */
#define DPL_HRC_TRACED_LEVEL 2

/* The level whose rays in between, those of odd k, are partly traced. */
#define DPL_HRC_BETWEEN_LEVEL 3

/* Rows of T that are traced for one column of level 0 or 1: two forks with two rows each, or three rays. */
#define DPL_HRC_TRACED_ROWS 4

/* What a wedge that is solved whole may take of a processor's own cache [byte]. */
#define DPL_HRC_WEDGE_BYTES ((size_t)1 << 20)

/* Where sums of an axis take more, they and R of level S are stored past the caches: what is read so much
 * later is not found there any more [byte]. */
#define DPL_HRC_CACHED_BYTES ((size_t)16 << 20)

/* Rows of pixels that are loaded or finished together. */
#define DPL_HRC_BAND 16

/* Planes of a band, each with a row above it and one below; and one row filtered, in three channels. A row of
 * the world, while it is loaded, needs less. */
typedef enum dpl_hrc_plane {
    DPL_PLANE_LIGHT,                        /* three channels of the sums */
    DPL_PLANE_FREE = 3,                     /* 1 where a pixel is free, else 0 */
    DPL_PLANE_ROOM,                         /* for the sums of an axis on their way; then, at rims alone: */
    DPL_PLANE_OPEN = DPL_PLANE_ROOM,        /* directions without a lamp near, or less than 0: see rims.c */
    DPL_PLANE_NEAR,                         /* and three channels of light from those that are */
    DPL_PLANE_FILTERED = DPL_PLANE_NEAR + 3 /* not a whole plane: a row for each channel */
} dpl_hrc_plane;
#define DPL_HRC_BAND_PLANES (DPL_PLANE_FILTERED * (DPL_HRC_BAND + 2) + 3)

/* Near is what is at most so many rows and columns away; a pixel's rim is what is at most so many away. */
#define DPL_HRC_NEAR 7
#define DPL_HRC_RIM 2

/* How a segment's slope and a pixel make a chord: one set of world rows for each, where media are. */
typedef enum dpl_hrc_chord {
    DPL_CHORD_STRAIGHT, /* along the axis */
    DPL_CHORD_HALF,     /* one across for two along */
    DPL_CHORD_DIAGONAL,
    DPL_CHORD_POINT, /* a corner: only what is opaque counts */
    DPL_CHORDS
} dpl_hrc_chord;

/* What level 0 receives per quadrant and what the sums hold, three channels each: light from both ways along
 * the axis and from all angles; and, where direction matters, weighed by the cosine of the angle to one of
 * the four ways. Sums of both axes added make 4 means of the half circle around a way. */
typedef enum dpl_hrc_group {
    DPL_GROUP_MEAN,
    DPL_GROUP_FORWARD,  /* from where the axis goes */
    DPL_GROUP_BACKWARD, /* from where it comes */
    DPL_GROUP_BELOW,    /* from across, from where rows begin */
    DPL_GROUP_ABOVE,    /* from across, from where rows end */
    DPL_GROUPS
} dpl_hrc_group;

/* Sides of an opaque pixel by the way they look, named as the groups of sums. */
typedef enum dpl_hrc_face {
    DPL_FACE_FORWARD,
    DPL_FACE_BACKWARD,
    DPL_FACE_BELOW,
    DPL_FACE_ABOVE,
    DPL_FACES
} dpl_hrc_face;

/* One gather axis: the world as columns across it. Offsets count bytes from the start of the memory that they
 * are in: `arena`, or a worker's scratch. */
typedef struct dpl_hrc_axis {
    int32_t width;       /* columns [px] */
    dpl_row_shape shape; /* of rows, across */
    int32_t levels;      /* 2^levels >= width */
    int32_t strip_level; /* S, or `levels` where that is less */
    int32_t wedge_level; /* wedges between rays of this level, S or above, are solved whole */
    /* in the arena */
    size_t world;           /* [column]: sets of rows of T */
    size_t set[DPL_CHORDS]; /* from a column's start; all the same where there are no media */
    size_t column_bytes;    /* from a column of the world to the next */
    size_t sums;            /* float [column][group][3][stride] */
    size_t faces;           /* [column][dpl_hrc_face][3]: what faces reflect */
    size_t faces_bytes;     /* from a column to the next */
    size_t outside;         /* a column of the world outside the picture */
    size_t segments;        /* T of level S: [ray][p], for one quadrant; where frames are kept, for two */
    size_t radiance;        /* R of level S: [cone][p], likewise */
    size_t ways;            /* where frames are kept, sums of each quadrant: float [way][column][3][stride] */
    /* in a worker's scratch */
    size_t strip[DPL_HRC_STRIP_LEVEL];         /* T of level n: [slot][ray] */
    size_t column[DPL_HRC_STRIP_LEVEL + 1][2]; /* R of level n, odd and even columns: [cone] */
    size_t traced;                             /* T of level 1, [ray]; forks of level 0, see strip.c */
    size_t beyond;                             /* two rows of R that stand for outside, and room for one */
    size_t wedge_segments[DPL_HRC_MAX_LEVELS]; /* T of level n in a wedge: [p][ray] */
    size_t wedge_radiance[DPL_HRC_MAX_LEVELS]; /* R of level n in a wedge: [p][cone] */
    size_t band;                               /* float [DPL_HRC_BAND_PLANES][stride]: rows in finish.c */
} dpl_hrc_axis;

typedef struct dpl_hrc_layout {
    bool half;
    bool rgb;         /* three planes of t */
    bool media;       /* a set of world rows for each chord */
    bool directional; /* all groups of sums, not the mean alone */
    bool faces;       /* walls reflect */
    bool streams;     /* sums, and R of level S in floats, go past the caches */
    bool keeps;       /* T and R of level S and sums of each quadrant, for the next frame */
    int32_t workers;
    size_t strip_bytes; /* most for columns of R of a strip of level 5 */
    size_t wedge_bytes; /* most for a wedge that is solved whole */
    size_t element;     /* [byte] */
    int32_t planes;     /* of a row of T */
    dpl_hrc_axis axes[2];
    int32_t levels; /* the greater of both axes; at least 2 */
    /* in the arena */
    size_t occupied; /* uint8_t [band][x]: not 0 where a pixel of the band is not empty */
    size_t sets;     /* uint64_t [dpl_hrc_set][y][word]: see rims.c */
    size_t sights;   /* dpl_hrc_sight [dy][dx], likewise */
    size_t weights;  /* float [cone], see lens.c */
    size_t sky;      /* float [quadrant][cone][3] */
    size_t lenses;   /* dpl_hrc_lens_table [quadrant][DPL_HRC_TABLES] */
    size_t flags;    /* uint8_t, where frames are kept: see dpl_hrc_flags */
    size_t scratch;  /* of the first worker */
    size_t scratch_bytes;
    size_t total; /* of the arena */
} dpl_hrc_layout;

/* Faces that reflect, and what the solver's lights give them. Filled in for each solve that has both. */
typedef struct dpl_hrc_lit {
    int32_t count;    /* of faces; 0: no light to add */
    dpl_buffer first; /* int32_t [y][side]: number of the first face of a side of a row */
    dpl_buffer faces; /* dpl_face each */
    dpl_buffer rgb;   /* float[3] each */
} dpl_hrc_lit;

typedef struct dpl_hrc {
    dpl_solver solver;
    dpl_hrc_layout layout;
    const dpl_row_kernels *rows;
    dpl_buffer arena;
    dpl_ray_counter counters[DPL_HRC_BETWEEN_LEVEL + 1][DPL_MAX_THREADS];
    bool faces_lit; /* faces hold something to add */
    dpl_hrc_lit lit;
    bool kept;    /* the arena holds all of a frame */
    bool partial; /* and this frame is made from it */
    dpl_hrc_resolution resolution;
} dpl_hrc;

/* How the cones of a level are weighed when they are merged from the level above, by cone: the weight of what
 * the cone's segment emits and of what it passes on, and the sky seen through the cone. The plain one knows
 * every level; those that weigh by a cosine only levels 0 to 2. */
typedef struct dpl_hrc_lens {
    const float *emitted;
    const float *passed;
    const float (*sky)[3];
} dpl_hrc_lens;

enum { DPL_HRC_LENS_CONES = 8 }; /* of levels 0 to 2 */

typedef struct dpl_hrc_lens_table {
    float emitted[DPL_HRC_LENS_CONES];
    float passed[DPL_HRC_LENS_CONES];
    float sky[DPL_HRC_LENS_CONES][3];
} dpl_hrc_lens_table;

/* The tables of a quadrant: along the axis, across it, and the halves of that. */
enum { DPL_TABLE_ALONG, DPL_TABLE_ACROSS, DPL_TABLE_BELOW, DPL_TABLE_ABOVE, DPL_HRC_TABLES };

/* Rows one behind the other in memory: successive rays or cones. `first` is NULL where all is outside. */
typedef struct dpl_hrc_rows {
    char *first;
    size_t step; /* [byte] */
} dpl_hrc_rows;

static inline char *dpl_hrc_row(dpl_hrc_rows rows, int32_t index) {
    return rows.first + (size_t)index * rows.step;
}

/* Columns of level n. */
static inline int32_t dpl_hrc_columns(const dpl_hrc_axis *axis, int32_t level) {
    return (axis->width + (1 << level) - 1) >> level;
}

/* Rays of level n, above S, that a wedge holds in each column: the fan of a wedge that is solved whole, or
 * two cones. */
static inline int32_t dpl_hrc_wedge_rays(const dpl_hrc_axis *axis, int32_t level) {
    return (1 << (level > axis->wedge_level ? level - axis->wedge_level : 1)) + 1;
}

/* Planes of sums per column. */
static inline size_t dpl_hrc_sums_planes(const dpl_hrc_layout *layout) {
    return layout->directional ? 3 * DPL_GROUPS : 3;
}

/* Cones of all levels in one array: cone i of level n. */
static inline int32_t dpl_hrc_cone(int32_t level, int32_t cone) {
    return (1 << level) + cone;
}

/* What of a quadrant is out of date, by strip; a strip more stands for what is behind the last. */
typedef struct dpl_hrc_flags {
    uint8_t *world;    /* pixels that its T is made from */
    uint8_t *radiance; /* [cone][strip]: R of level S */
    uint8_t *gather;   /* its sums */
    uint8_t *columns;  /* of the axis: sums that were written in this frame, in either quadrant */
    int32_t strips;    /* from a cone to the next */
} dpl_hrc_flags;

/* layout.c */
/* Places everything for a world of this size and sets `total`; false when that is more than a size_t. */
bool dpl_hrc_arrange(dpl_hrc_layout *layout, int32_t width, int32_t height);

/* One quadrant at work. */
typedef struct dpl_hrc_quadrant {
    dpl_hrc *hrc;
    const dpl_hrc_axis *axis;
    bool mirrored;        /* the second of its axis: adds to the sums of the first */
    const char *world;    /* the first column's first set */
    ptrdiff_t world_step; /* to the next column; below zero where the quadrant is mirrored [byte] */
    const char *outside;
    float *sums;          /* the first column's */
    ptrdiff_t sums_step;  /* [float] */
    const char *faces;    /* the first column's; NULL where nothing reflects */
    ptrdiff_t faces_step; /* [byte] */
    dpl_hrc_lens lens;    /* the plain one */
    const dpl_hrc_lens_table *tables;
    dpl_hrc_rows segments; /* of level S, by ray; columns are row_bytes apart */
    dpl_hrc_rows radiance; /* of level S, by cone */
    size_t segment_bytes;  /* of a row of T */
    size_t radiance_bytes; /* of a row of R */
    bool partial;          /* T, R and sums are the last frame's, out of date where the flags say so */
    dpl_hrc_flags flags;   /* where frames are kept */
} dpl_hrc_quadrant;

dpl_hrc_quadrant dpl_hrc_quadrant_of(dpl_hrc *hrc, int32_t index);

/* A worker in a quadrant. */
typedef struct dpl_hrc_worker {
    const dpl_hrc_quadrant *quadrant;
    char *scratch;
    int64_t traced[DPL_HRC_BETWEEN_LEVEL + 1]; /* segments, by level */
} dpl_hrc_worker;

dpl_hrc_worker dpl_hrc_worker_of(const dpl_hrc_quadrant *quadrant, int32_t index);

/* Adds what a worker has traced to its counters, at the end of a task. */
void dpl_hrc_worker_count(const dpl_hrc_worker *worker, int32_t index);

/* Rows of T or R that begin at an offset of the scratch. */
dpl_hrc_rows dpl_hrc_segment_rows(const dpl_hrc_worker *worker, size_t offset, int32_t index);
dpl_hrc_rows dpl_hrc_radiance_rows(const dpl_hrc_worker *worker, size_t offset, int32_t index);

/* column.c */
/* Rays 2*first .. 2*(first+count) of level+1 from rays first .. first+count of `level`: `near` is column 2p,
 * `far` column 2p+1. Rows of all three begin at their first ray. */
void dpl_hrc_extend(const dpl_hrc_worker *worker, int32_t level, int32_t first, int32_t count,
                    dpl_hrc_rows near, dpl_hrc_rows far, dpl_hrc_rows out);

/* Cones first .. first+count-1 of `level` in one column, weighed by a lens. For an odd column: `segments` are
 * T of that level, on level 0 as dpl_hrc_fork() leaves them, `near` is NULL. For an even one: `segments` are
 * every other ray of the level above, `near` is R of the same place there. `far` is R of the level above at
 * the segments' ends. Rows of all begin at their first. */
void dpl_hrc_merge(const dpl_hrc_worker *worker, const dpl_hrc_lens *lens, int32_t level, int32_t first,
                   int32_t count, dpl_hrc_rows segments, dpl_hrc_rows near, dpl_hrc_rows far,
                   dpl_hrc_rows out);

/* strip.c */
/* T(level, x / 2^level, ray) for levels 1 and 2 from the pixels of columns x and on. */
void dpl_hrc_trace(dpl_hrc_worker *worker, int32_t level, int32_t x, int32_t ray, char *out);
/* The first step of what the pixels before column x see, in one half of the quadrant (ray 0 or 1 of level 0):
 * for an odd x a fork, out[ray] and what passes beside its end, out[2 + ray]; for an even one T of twice the
 * length, by the pixels aside, for R of column x itself sees those ahead. */
void dpl_hrc_fork(dpl_hrc_worker *worker, int32_t x, int32_t ray, dpl_hrc_rows out);
void dpl_hrc_trace_aside(dpl_hrc_worker *worker, int32_t x, int32_t ray, char *out);
/* T from column x straight to the next. */
void dpl_hrc_trace_step(dpl_hrc_worker *worker, int32_t x, char *out);
/* T of levels 2 to S-1 for columns of strip p, kept in the scratch; dpl_hrc_strip_rows() finds them. */
void dpl_hrc_build_strip(dpl_hrc_worker *worker, int32_t p);
dpl_hrc_rows dpl_hrc_strip_rows(const dpl_hrc_worker *worker, int32_t level, int32_t p);
/* Item: T of level S for strip item+1. */
void dpl_hrc_strip_task(int32_t begin, int32_t end, int32_t worker, void *quadrant);

/* wedge.c. Item: one cone of level S. */
void dpl_hrc_wedge_task(int32_t begin, int32_t end, int32_t worker, void *quadrant);

/* gather.c. Item: a run of strips; as many items as dpl_hrc_gather_items() says. */
void dpl_hrc_gather_task(int32_t begin, int32_t end, int32_t worker, void *quadrant);
int32_t dpl_hrc_gather_items(const dpl_hrc_quadrant *quadrant);

/* kept.c */
size_t dpl_hrc_flag_bytes(const dpl_hrc_layout *layout);
dpl_hrc_flags dpl_hrc_flags_of(const dpl_hrc *hrc, int axis);
/* Before the first quadrant: no column is written yet. */
void dpl_hrc_start_frame(dpl_hrc *hrc);
/* Before a quadrant's strips: which of them changed pixels touch. */
void dpl_hrc_find_changed_world(dpl_hrc_quadrant *quadrant);
/* Stores R of level S in one strip and cone, and notes whether it has changed. */
void dpl_hrc_store_radiance(const dpl_hrc_quadrant *quadrant, int32_t cone, int32_t p, const char *row);
/* Before a quadrant is gathered: which strips must be. */
void dpl_hrc_find_gathers(dpl_hrc_quadrant *quadrant);
/* Items: columns of an axis. Sums of both quadrants become those of the axis. */
typedef struct dpl_hrc_ways {
    dpl_hrc *hrc;
    int axis;
} dpl_hrc_ways;
void dpl_hrc_add_ways_task(int32_t begin, int32_t end, int32_t worker, void *ways);

/* lens.c */
void dpl_hrc_fill_weights(dpl_hrc *hrc);
void dpl_hrc_fill_sky(dpl_hrc *hrc, const dpl_field *field);

/* world.c. Items: bands of the world. */
void dpl_hrc_clear_segments(dpl_hrc *hrc);
void dpl_hrc_clear_faces(dpl_hrc *hrc);
void dpl_hrc_load_task(int32_t begin, int32_t end, int32_t worker, void *frame);
void dpl_hrc_mark_columns(dpl_hrc *hrc); /* after the last of them */

/* What the band tasks are handed. */
typedef struct dpl_hrc_frame {
    dpl_hrc *hrc;
    const dpl_field *field;
    const dpl_targets *targets;
} dpl_hrc_frame;

/* band.c */
/* A weight for each axis' groups of sums. */
typedef struct dpl_hrc_mix {
    float weights[2][DPL_GROUPS];
} dpl_hrc_mix;

/* Rows of the world as planes of floats, in a worker's scratch. */
typedef struct dpl_hrc_band {
    float *values;
    size_t stride;
    int32_t first; /* row of the world that stands at row 1 */
} dpl_hrc_band;

/* Row of a plane; row 0 is the one above the band's first. */
static inline float *dpl_hrc_band_row(const dpl_hrc_band *band, int32_t plane, int32_t row) {
    return band->values + ((size_t)plane * (DPL_HRC_BAND + 2) + (size_t)row) * band->stride + DPL_ROW_PAD;
}

/* Rows first .. first+count-1 of a mix of the sums, at most DPL_HRC_BAND. */
dpl_hrc_band dpl_hrc_mix_rows(const dpl_hrc_frame *frame, int32_t worker, const dpl_hrc_mix *mix,
                              int32_t first, int32_t count);
/* One of these rows, filtered: three planes, valid until the next. */
void dpl_hrc_filter_row(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t y, float *planes[3]);

/* rims.c */
size_t dpl_hrc_sight_bytes(void);
size_t dpl_hrc_set_bytes(const dpl_hrc_layout *layout);
void dpl_hrc_prepare_near(dpl_hrc *hrc); /* the table of sights, and sets that are empty */
/* Puts pixels of row y into the sets; its masks are there. */
void dpl_hrc_mark_sets(dpl_hrc *hrc, const dpl_field *field, int32_t y);
/* Light from near for the rows of a band and those beside it, where a rim or its neighbours want it. */
void dpl_hrc_light_near(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t count);
/* Filters the row that dpl_hrc_filter_row() filtered last, y, once more where it is on a rim, without bending
 * the light from near. */
void dpl_hrc_filter_rims(const dpl_hrc_frame *frame, const dpl_hrc_band *band, int32_t y);

/* faces.c */
/* Has the solver's lights shine on the faces of `field`, the caller's at the solver's resolution; `margin` is
 * the caller's. */
DPL_MUST_CHECK dpl_status dpl_hrc_light_faces(dpl_hrc *hrc, const dpl_field *field, int32_t margin);
/* Items: bands of the world. */
void dpl_hrc_faces_task(int32_t begin, int32_t end, int32_t worker, void *frame);
/* What an opaque pixel shows: its emission, and the mean of what its exposed faces reflect. */
void dpl_hrc_show_opaque(const dpl_hrc_frame *frame, int32_t x, int32_t y, float rgb[3]);

/* finish.c. Items: bands of the picture. */
void dpl_hrc_finish_task(int32_t begin, int32_t end, int32_t worker, void *frame);

#endif
