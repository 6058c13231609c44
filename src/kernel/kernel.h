/* The hot loops: every signature declared once. ref.c is the plain C reference; a build for an instruction
 * set fills the same table and must equal it bit for bit. dispatch.c picks a table at run time.
 *
 * Only + - * / sqrt, compare and select are used, in a stated order, with contraction off: that is what
 * makes equality to the bit possible. Kernels trust their arguments; the rooms above have checked them. */
#ifndef DPL_KERNEL_KERNEL_H
#define DPL_KERNEL_KERNEL_H

#include "kernel/depth_view.h"
#include "kernel/disc.h"
#include "kernel/distance.h"
#include "kernel/probes.h"
#include "kernel/ray_words.h"
#include "kernel/rows.h"
#include "kernel/srgb.h"

#include <dapple/context.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Extinction stored for "infinite in one channel": opaque to the last bit over any path, and no inf * 0. */
#define DPL_EXTINCTION_MAX 1e30f

/* The brightest light in rows of the holographic solver: sums of some stay finite, so there is no 0 * inf. */
#define DPL_RADIANCE_MAX 1e37f

/* The pixel world as kernels see it. Planes have width*height entries, row by row. */
typedef struct dpl_grid {
    int32_t width;
    int32_t height;
    /* Above 0: empty, and the distance to the nearest pixel that is not [px]; 0: medium; below 0: opaque. */
    const float *clearance;
    /* RGB and one that is not used. */
    const float (*emission)[4];
    /* RGB [1/px] and one that is not used. Read only where clearance is 0; NULL if that is nowhere. */
    const float (*extinction)[4];
    /* Signed distance to the nearest shape [px], and its RGB emission. NULL unless the field keeps it. */
    const float (*surface)[4];
} dpl_grid;

/* Straight pieces of rays, from (x0, y0) to (x1, y1) [px]. */
typedef struct dpl_segments {
    int32_t count;
    const float *x0;
    const float *y0;
    const float *x1;
    const float *y1;
} dpl_segments;

/* Shadow maps of one disc of light: for each of `rays` signed distances from its centre, and for each of
 * `bins` directions, how far a ray that passes the centre at that distance gets. */
typedef struct dpl_ray_map {
    int32_t rays;         /* an even number; ray k and the k-th from behind have opposite offsets */
    int32_t bins;         /* a power of two, at most 2^20; bin i looks along (i + 1/2) 2 pi / bins */
    float radius;         /* of the disc [px] */
    const float *offsets; /* per ray: its distance from the centre / radius, -1 .. 1 */
    float *reach;         /* shape [rays][bins]: squared distance from the centre to what the ray meets */
} dpl_ray_map;

/* Around a disc of light, by direction: as horizon.h of the shadow room has it. */
typedef struct dpl_horizon_table {
    const float (*bins)[3]; /* squared distances: lit up to here, dark from here on, and up to here */
    int32_t count;          /* of bins, a power of two */
} dpl_horizon_table;

/* Receivers that stand in one line across the way to a disc of light, and what is covered of it. Slopes are
 * distances across per distance along; all of the line is behind what covers the disc. */
enum { DPL_RECEIVERS = 32, DPL_RECEIVER_SPANS = 4 };

typedef struct dpl_receivers {
    float along;                 /* from the line to the disc's centre, above 0 [px] */
    float radius;                /* of the disc [px] */
    float across[DPL_RECEIVERS]; /* where each stands [px] */
    float toward[DPL_RECEIVERS]; /* from there to the disc's centre, across [px] */
    /* slopes of the disc's sides, and of what is covered between them: spans that do not touch, in any order,
     * empty where low > high */
    float from[DPL_RECEIVERS];
    float to[DPL_RECEIVERS];
    float low[DPL_RECEIVER_SPANS][DPL_RECEIVERS];
    float high[DPL_RECEIVER_SPANS][DPL_RECEIVERS];
    int32_t lost[DPL_RECEIVERS]; /* -1: the disc is too wide, or has more spans than there is room for */
} dpl_receivers;

/* Rectangles before receivers, each touching one before it: from `first` to `end` across, and at distances
 * from 1 / near to 1 / far along. */
typedef struct dpl_runs {
    int32_t count;
    const float *first;
    const float *end;
    const float *near;
    const float *far;
} dpl_runs;

/* What a ray gathers on its segment, per channel: radiance, and the share that passes what lies behind. */
typedef struct dpl_intervals {
    float *radiance[3];
    float *transmittance[3];
} dpl_intervals;

/* Where nothing is, as distances: a plane of one distance per pixel, `stride` floats from one to the next. A
 * disc of radius (distance - how far its centre is from the pixel's - spare) holds nothing that a ray could
 * meet. */
typedef struct dpl_clearances {
    int32_t width;
    int32_t height;
    const float *plane;
    int32_t stride;
    float spare; /* [px] */
} dpl_clearances;

/* Straight strips around segments, whose half width changes evenly from one end to the other [px]. */
typedef struct dpl_strips {
    dpl_segments axis;
    const float *width0;
    const float *width1;
} dpl_strips;

typedef struct dpl_kernels {
    dpl_isa isa;

    /* Marches every segment through the grid: exact traversal of pixels, jumping over what `clearance` proves
     * empty. Parts outside the picture are empty. A pixel belongs to a segment when it is entered before the
     * segment's end. */
    void (*march)(const dpl_grid *grid, const dpl_segments *segments, const dpl_intervals *intervals);

    /* Where march() ends at an opaque pixel: the number of that pixel, or -1. For grids without media. */
    void (*march_to_cell)(const dpl_grid *grid, const dpl_segments *segments, int32_t *cell);

    /* The rays that words say are marched, as segments, side by side: ends are x0, y0, x1, y1. Returns how
     * many there are. DPL_RAY_WORDS_PAD. */
    int32_t (*aim)(const dpl_ray_axis *axis, int32_t count, const dpl_ray_word *words, float *const ends[4]);

    /* What the rays of words hit, from what march_to_cell() found of those that are marched: fills in `hits`
     * and `at` of each, and lists the pixels of all hits in order. Returns how many there are. Reads and
     * writes DPL_RAY_WORDS_PAD more. */
    int32_t (*list_hits)(int32_t count, dpl_ray_word *words, const int32_t *cell, int32_t *list);

    /* Which share of each strip is proved to hold nothing, from its beginning on: 1 is all of it. Covers the
     * strip with discs that are read from `distances`, and never finds more than there is. */
    void (*sweep)(const dpl_clearances *distances, const dpl_strips *strips, float *share);

    /* march() through `surface`, by the rule of the ARC paper's own code: advance by the distance read at the
     * pixel, hit when that was below one pixel. Start in a solid: its emission. Never partly transparent.
     */
    void (*march_surface)(const dpl_grid *grid, const dpl_segments *segments, const dpl_intervals *intervals);

    /* Rays of probes in a row that all go the same way, as x0, y0, x1, y1: from x[i] + start[0] and start[1]
     * to target_x[i] + end[0] and end[1]. */
    void (*aim_row)(int32_t count, float *const ends[4], const float *x, const float start[2],
                    const float *target_x, const float end[2]);

    /* Adds what rays of probes gather on their way, and what they let through of the parents' light behind:
     * radiance + transmittance * seen. */
    void (*merge)(const dpl_probe_sums *sums, const dpl_parents *parents, const dpl_intervals *intervals);

    /* The same for rays that gather nothing on their way, and let all through or, where bit i % 64 of
     * hits[i / 64] is set, nothing. */
    void (*merge_hits)(const dpl_probe_sums *sums, const dpl_parents *parents, const uint64_t *hits);

    /* What `count` probes see of DPL_PARENTS_FOUR, in one channel. Reads count/2 + 2 values of either row. */
    void (*spread)(int32_t count, float *out, const float *row, const float *next_row, float between);

    /* Column pass of the distance transform, one row of columns at a time.
     * Down: run = occupied ? 0 : before + 1. Up: run = min(run, after + 1). */
    void (*distance_down)(int32_t count, int32_t *run, const uint8_t *occupied, const int32_t *before);
    void (*distance_up)(int32_t count, int32_t *run, const int32_t *after);

    /* Row pass, a band of rows: clearances from the columns' distances. Where the kind is 0 the root of the
     * least (x - i)^2 + runs[i]^2 over the row, elsewhere 0 or, opaque, -1. `scratch` has room for
     * dpl_distance_scratch() bytes. */
    void (*distance_along)(const dpl_distance_rows *rows, void *scratch);

    /* 8-bit tone map of `count` floats: 1 - 1/(1 + 2pi m)^2.5. */
    void (*tonemap)(int32_t count, uint8_t *out, const float *mean);

    /* Is every value 0 .. highest? Not-a-number is not. */
    bool (*all_within)(int32_t count, const float *values, float highest);

    /* IEEE half precision, as half.h has it: to half rounds to nearest even, clamps to +-65504 and makes 0 of
     * not-a-number; from half is exact. */
    void (*half_from_float)(int32_t count, uint16_t *out, const float *in);
    void (*float_from_half)(int32_t count, float *out, const uint16_t *in);

    /* Linear 0 .. 1 to the nearest byte, as it is or sRGB-encoded as srgb.h has it; outside it is clamped,
     * not-a-number is 0. */
    void (*bytes_from_linear)(int32_t count, uint8_t *out, const float *in);
    void (*srgb_from_linear)(int32_t count, uint8_t *out, const float *in, const dpl_srgb_steps *steps);

    /* Planes r, g, b, t, `stride` apart: opaque pixels (kind 2) have their emission, at most
     * DPL_RADIANCE_MAX, and t = 0, others 0 and 1. */
    void (*opaque_planes)(int32_t count, float *planes, size_t stride, const uint8_t *kind,
                          const float (*emission)[4]);

    /* out[column*out_step + row] = in[row*in_step + column]. */
    void (*transpose)(int32_t rows, int32_t columns, float *out, size_t out_step, const float *in,
                      size_t in_step);
    void (*transpose_halves)(int32_t rows, int32_t columns, uint16_t *out, size_t out_step,
                             const uint16_t *in, size_t in_step);

    /* Three planes to pixels; with `streams` past the caches, where a processor can. */
    void (*interleave)(int32_t count, float (*rgb)[3], const float *const planes[3], bool streams);

    /* out[i] = weight * in[i], or out[i] += that. */
    void (*add_scaled)(int32_t count, float *out, const float *in, float weight, bool add);

    /* Mean of a value, weighed 4, and its four neighbours: those above and below weigh 1 where both are free
     * (1, not 0), so do those left and right. One alone would pull light that falls off to its side. Rows
     * above, at and below; those of `is_free` and `values` also have an element at -1 and at `count`. */
    void (*filter_cross)(int32_t count, float *out, const float *const values[3],
                         const float *const is_free[3]);

    /* Class of pixels at (dx + i, dy) from a light: 0 lit, 1 dark, 2 open. */
    void (*look_round)(const dpl_horizon_table *table, int32_t count, uint8_t *class, float dx, float dy);

    /* Draws opaque pixels, whose centres are at (x[i], y) from the light and outside its disc, into rays
     * first .. first + rays - 1 of a map. */
    void (*draw_rays)(const dpl_ray_map *map, int32_t first, int32_t rays, int32_t count, const float *x,
                      float y);

    /* Share of the disc that receivers at (dx, dy) from its centre see, at least 1.5 radii away: rays that
     * come further than the receiver, each by the angle that it stands for. */
    void (*see_rays)(const dpl_ray_map *map, int32_t count, float *visible, const float *dx, const float *dy);

    /* Fills in what follows `toward`: nothing is covered. Receivers are at least 1.5 radii away. */
    void (*face_disc)(dpl_receivers *receivers);

    /* Adds what connected runs cover; `careful`: receivers of whose disc they cover anything are lost
     * instead. Returns whether no receiver is left that is not covered whole or lost. */
    bool (*cover_runs)(dpl_receivers *receivers, const dpl_runs *runs, bool careful);

    /* Share of the disc's angle that each sees, or -1 where it is lost. */
    void (*share_seen)(const dpl_receivers *receivers, float *visible);

    /* Of shadows in space, as is the next; NULL in a build whose size counts (DPL_WITHOUT_SOLID_SHADOWS).
     *
     * Marks, with -1, the points of a disc that some of the triangles cover: those that a line meets, but
     * not edge on. Returns whether any point is still open. */
    bool (*cover)(const dpl_disc_view *view, const dpl_disc_points *points,
                  const dpl_disc_triangles *triangles, int32_t *covered);

    /* Which receivers are surely lit or dark by a map of depths, and where they are in it. */
    void (*classify)(const dpl_depth_view *view, dpl_depth_receivers *receivers);

    /* Of the holographic solver: [storage][colour]. */
    const dpl_row_kernels (*rows)[DPL_ROWS_COLOURS];
} dpl_kernels;

/* The best table whose instruction set is in `isa_mask` and on this machine, or NULL. */
const dpl_kernels *dpl_kernels_select(uint32_t isa_mask);

/* The instruction sets that this build has tables for and this machine can run. */
uint32_t dpl_kernels_available(void);

extern const dpl_kernels dpl_kernels_ref;

#endif
