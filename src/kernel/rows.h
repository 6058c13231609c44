/* The kernels of the holographic solver. They work on *rows*: runs of values across the gather axis, one
 * value for each pixel of a column, contiguous, so that every load is a plain one at a constant offset.
 *
 * A row of transmission is T = <radiance r, transmittance t> of one straight segment from every pixel of a
 * column: planes r, g, b and then one t (grey) or three. A row of radiance R has planes r, g, b. Planes lie
 * `stride` elements apart; before and behind each there are DPL_ROW_PAD elements that hold what is outside
 * the picture: nothing, <0, 1>, in transmission, the sky in radiance. So a shifted load needs no test: its
 * place is clamped, and what it then reads is the pad. Behind `length` a plane is filled up to a multiple of
 * DPL_ROW_PAD with the same.
 *
 * Elements are floats or halves (arithmetic is in floats); a table per storage and number of t planes.
 * Source: Freeman, Sannikov, Margel 2025, "Holographic Radiance Cascades for 2D Global Illumination"
 * (arXiv 2505.02041); T, R, the extension and the merges are theirs. */
#ifndef DPL_KERNEL_ROWS_H
#define DPL_KERNEL_ROWS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Elements of padding at each end of a row; at least the widest vector. */
#define DPL_ROW_PAD 16

/* A shift that leaves the picture whatever the row: every load reads the pad. */
#define DPL_ROW_OUTSIDE (-(1 << 24))

typedef struct dpl_row_shape {
    int32_t length; /* pixels across the gather axis, 1 .. 16384 */
    int32_t stride; /* elements from a plane to the next */
    int32_t words;  /* of the mask before a row of T, 64 bits each; a multiple of 8 keeps rows aligned */
    bool streams;   /* what is merged, or collected first, is stored past the caches, where a processor can:
                       for what is too much to be found there when it is read */
} dpl_row_shape;

/* Most of a scene is empty, so a row of T has a mask before its first pad: a bit for each block of
 * DPL_ROW_BLOCK values, clear where all of them are <0, 1>. Blocks that are clear in every input are neither
 * read nor computed; what is in memory is always true to the mask. The scalar reference ignores masks. */
#define DPL_ROW_BLOCK DPL_ROW_PAD

static inline uint64_t *dpl_row_mask(const dpl_row_shape *shape, void *row, size_t element) {
    return (uint64_t *)(void *)((char *)row - DPL_ROW_PAD * element) - shape->words;
}

/* How a traced segment meets a pixel. */
typedef enum dpl_tap_kind {
    DPL_TAP_HALF,  /* from its centre to its edge, or as far as that */
    DPL_TAP_FULL,  /* twice as far */
    DPL_TAP_CORNER /* at a corner: one of the two pixels beside it */
} dpl_tap_kind;

/* One pixel on the way of a traced segment: the row of T of its column, how far to shift it, and what its
 * face reflects on top of r (rows of three planes; NULL: nothing).
 *
 * A segment at 45 degrees passes through corners. It stands for two that lie a hair beside it, one on either
 * side: these are its ways. On the other one it meets the other pixel beside each corner, and comes into the
 * pixels behind through another face. */
typedef struct dpl_tap {
    dpl_tap_kind kind;
    int32_t shift;
    const void *row;
    const void *face;
    const void *other_face; /* on the other way */
    const void *other_row;  /* of corners alone, as is the next */
    int32_t other_shift;
} dpl_tap;

/* A pixel of a fork: its row of T, and what its face reflects (NULL: nothing). */
typedef struct dpl_fork_cell {
    const void *row;
    const void *face;
} dpl_fork_cell;

/* The first step of half a pixel's quadrant. From the pixel beside it, `start`, light comes through the one
 * `ahead` or through the one `aside`, and on both ways through the one behind these, `end`. Rows of `aside`
 * and `end` are shifted. */
typedef struct dpl_fork {
    dpl_fork_cell start;
    dpl_fork_cell ahead;
    dpl_fork_cell aside;
    dpl_fork_cell end;
    const void *end_corner; /* T of the end where only what is opaque counts */
    int32_t shift;
} dpl_fork;

/* The part of half a quadrant that a pixel two steps ahead fills, atan(1/3) / atan(1) = 0.409666, as a
 * fraction that leaves 1 exactly with the part of the pixel aside. */
#define DPL_FORK_AHEAD 0.40966796875f
#define DPL_FORK_ASIDE (1.0f - DPL_FORK_AHEAD)

/* What one ray of a merge contributes: its segment's T, and the radiance R that waits at its far end,
 * shifted. `emitted` weighs r, `passed` weighs t R, and, where `near` is not NULL, R at the near end. Of what
 * `straight` (NULL: all) does not let through, R comes from the far end without the shift. */
typedef struct dpl_merge_ray {
    const void *segment;
    const void *far;
    const void *near;
    const void *straight;
    int32_t shift;
    float emitted;
    float passed;
} dpl_merge_ray;

/* What a traced segment counts beside the mean of two ways with a bend; with the rest it makes exactly 1. */
#define DPL_STRAIGHT_PART 0.3125f
#define DPL_BENT_PART (1.0f - DPL_STRAIGHT_PART)

/* What becomes of a traced segment. */
typedef enum dpl_trace_into {
    DPL_TRACE_ONE_WAY,  /* it is the result */
    DPL_TRACE_TWO_WAYS, /* the result is the mean of both of its ways */
    DPL_TRACE_A_PART    /* the result is DPL_STRAIGHT_PART of it, and for the rest what was there */
} dpl_trace_into;

typedef struct dpl_row_kernels {
    /* The taps one behind the other, starting with <0, 1>, into `out`. */
    void (*trace)(const dpl_row_shape *shape, void *out, const dpl_tap *taps, int32_t tap_count,
                  dpl_trace_into into);

    /* out = a fork: the mean of both ways by the parts they fill, but the way ahead does not meet an end that
     * is opaque. It passes beside it: straight = <0, 1 - what does>. */
    void (*fork)(const dpl_row_shape *shape, void *out, void *straight, const dpl_fork *fork);

    /* Extension of two neighbouring rays of a level to rays of twice the length, with M(<r1, t1>, <r2, t2>) =
     * <r1 + t1 r2, t1 t2>: even = M(near[0], far[0] shifted), and
     * odd = (M(near[0], far[1] shifted) + M(near[1], far[0] shifted by 2 more)) / 2.
     * Without `odd` (NULL) only near[0] and far[0] are read. */
    void (*extend)(const dpl_row_shape *shape, void *even, void *odd, const void *const near[2],
                   const void *const far[2], int32_t shift);

    /* out = sum of the two rays. Fills the pads of `out` with `sky`. */
    void (*merge)(const dpl_row_shape *shape, void *out, const dpl_merge_ray rays[2], const float sky[3]);

    /* The same light everywhere, pads included, into a row of R; and into its pads alone. */
    void (*fill)(const dpl_row_shape *shape, void *out, const float light[3]);
    void (*fill_pads)(const dpl_row_shape *shape, void *out, const float light[3]);

    /* sum = emitted * r + t R, or sum += that, in three planes of floats `stride` apart; without a segment
     * (NULL) it is R alone. */
    void (*collect)(const dpl_row_shape *shape, float *sum, const void *segment, float emitted,
                    const void *radiance, bool add);
} dpl_row_kernels;

/* Values of a plane without its pads: `length` filled up to whole blocks. */
static inline int32_t dpl_row_padded(int32_t length) {
    return (length + DPL_ROW_PAD - 1) / DPL_ROW_PAD * DPL_ROW_PAD;
}

/* Which table: storage, and planes of t. */
enum { DPL_ROWS_FLOAT, DPL_ROWS_HALF, DPL_ROWS_STORAGES };
enum { DPL_ROWS_GREY, DPL_ROWS_RGB, DPL_ROWS_COLOURS };

#endif
