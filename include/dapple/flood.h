/** @file
 * Flood-fill light for tile worlds in 2D and 3D: light that steps from cell to cell and loses some of itself
 * with each step. Blocks and lights change one by one, and only what they touch is worked out again.
 *
 * A level is an integer, 0 .. DPL_FLOOD_FULL, per channel. A cell's light is the greatest of its own sources
 * and of what each neighbour hands on. That has exactly one solution, whatever the order of work, so an
 * update gives the same bytes as a solve from scratch (docs/algorithms/flood-fill.md has the proof).
 */
#ifndef DAPPLE_FLOOD_H
#define DAPPLE_FLOOD_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/image.h>
#include <dapple/status.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The brightest level. */
#define DPL_FLOOD_FULL 32767
/** An attenuation that lets nothing in. */
#define DPL_FLOOD_OPAQUE 32767
/** Most cells along x, y or z. */
#define DPL_FLOOD_MAX_SIZE 16384
/** Most channels. */
#define DPL_FLOOD_MAX_CHANNELS 4
/** Most kinds of cells. */
#define DPL_FLOOD_MAX_MATERIALS 127

/** How much light a step takes. Light enters a cell with attenuation a (per channel). */
typedef enum dpl_flood_falloff {
    /** level - step - a, to the 4 (3D: 6) nearest neighbours: diamonds, as most tile games have them. */
    DPL_FLOOD_SUBTRACTIVE = 0,
    /** floor(level * t / 32768) with t = floor(keep * (32768 - a) / 32768), to the same neighbours: a
     * constant share is lost, as in fog. */
    DPL_FLOOD_MULTIPLICATIVE = 1,
    /** level - w * (step + a), to all 8 (26) neighbours with w = 1, sqrt(2), sqrt(3): nearly round. A
     * diagonal step loses as much as its best way round the corner lets through, so it leaks through nothing
     * that steps along the axes cannot pass. */
    DPL_FLOOD_EUCLIDEAN = 2,
    /** floor(level * t / 32768) with t = floor(32768 * (keep * (32768 - a) / 2^30)^w), to the neighbours and
     * round the corners of DPL_FLOOD_EUCLIDEAN: nearly round light that keeps its hue. */
    DPL_FLOOD_ROUND = 3
} dpl_flood_falloff;

/** Where the sun stands, if it shines: it falls without loss through cells that attenuate nothing. */
typedef enum dpl_flood_sun {
    DPL_FLOOD_SUN_NONE = 0,   /**< no sun */
    DPL_FLOOD_SUN_X_UP = 1,   /**< falls from x = 0 towards greater x */
    DPL_FLOOD_SUN_X_DOWN = 2, /**< falls from the greatest x towards 0 */
    DPL_FLOOD_SUN_Y_UP = 3,   /**< falls from y = 0 towards greater y: down the picture */
    DPL_FLOOD_SUN_Y_DOWN = 4, /**< falls from the greatest y towards 0 */
    DPL_FLOOD_SUN_Z_UP = 5,   /**< falls from z = 0 towards greater z */
    DPL_FLOOD_SUN_Z_DOWN = 6  /**< falls from the greatest z towards 0 */
} dpl_flood_sun;

/** A kind of cell. */
typedef struct dpl_flood_material {
    /** Loss on entering such a cell, besides the step's own, per channel: 0 = as air. The falloffs say
     * what it does; DPL_FLOOD_OPAQUE blocks. Red glass lets the first channel of three pass: {0, 32767,
     * 32767}. */
    uint16_t attenuation[DPL_FLOOD_MAX_CHANNELS];
} dpl_flood_material;

/** A world's size and rules. Start from dpl_flood_desc_default(). */
typedef struct dpl_flood_desc {
    uint32_t struct_size;      /**< stamped by the default function */
    uint32_t cookie;           /**< stamped by the default function */
    int32_t width;             /**< x, 1 .. DPL_FLOOD_MAX_SIZE [cell], default 256 */
    int32_t height;            /**< y, 1 .. DPL_FLOOD_MAX_SIZE [cell], default 256 */
    int32_t depth;             /**< z, 1 .. DPL_FLOOD_MAX_SIZE [cell]; default 1, a 2D world. With a border of
                                    one cell all round, width x height x depth must stay below 2^31 */
    int32_t channels;          /**< 1 .. DPL_FLOOD_MAX_CHANNELS, default 3 (RGB) */
    dpl_flood_falloff falloff; /**< default DPL_FLOOD_SUBTRACTIVE */
    int32_t step;              /**< lost per step, 1 .. 32767 [level], default 2048: 15 steps of range. For
                                    DPL_FLOOD_SUBTRACTIVE and _EUCLIDEAN */
    int32_t keep;              /**< kept per step, 1 .. 32767 [1/32768], default 26214 (0.8). For
                                    DPL_FLOOD_MULTIPLICATIVE and _ROUND */
    dpl_flood_sun sun;         /**< where the sun stands, default none */
    uint16_t sun_level[DPL_FLOOD_MAX_CHANNELS]; /**< of sunlight, default full in all channels */
    const dpl_flood_material *materials;        /**< shape [material_count], copied. Number 0 is air and must
                                                     attenuate nothing. NULL (default): 0 air, 1 opaque */
    int32_t material_count; /**< 1 .. DPL_FLOOD_MAX_MATERIALS; ignored when `materials` is NULL */
    /** Room for this many cells in the queue and half as many in the list of removals, 0 .. 2^31-1; all
     * memory is taken at creation. 0 (default): an eighth of the world, at least 4096. When the queue is
     * full, the world is searched for what was left out; when a removal is larger than its list, the update
     * solves from scratch: more time, the same light. */
    int32_t reserve;
} dpl_flood_desc;

/** Defaults of a world: 256 x 256 cells of air in 2D, RGB, subtractive, no sun. */
static inline dpl_flood_desc dpl_flood_desc_default(void) {
    dpl_flood_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.width = desc.height = 256;
    desc.depth = 1;
    desc.channels = 3;
    desc.step = 2048;
    desc.keep = 26214;
    for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++)
        desc.sun_level[c] = DPL_FLOOD_FULL;
    return desc;
}

/** A box of cells: x .. x+width-1 and so on. A width of 0: no cell at all. */
typedef struct dpl_flood_box {
    int32_t x;      /**< first cell along x */
    int32_t y;      /**< first cell along y */
    int32_t z;      /**< first cell along z, 0 in 2D */
    int32_t width;  /**< [cell] */
    int32_t height; /**< [cell] */
    int32_t depth;  /**< [cell], 1 in 2D */
} dpl_flood_box;

/** Names a light. A generation of 0 names none; an id is never given out twice. */
typedef struct dpl_flood_light {
    uint32_t index;      /**< place in the world's list */
    uint32_t generation; /**< how often that place was given out */
} dpl_flood_light;

/** What the last update or solve did. The same calls give the same numbers on every machine. */
typedef struct dpl_flood_stats {
    int64_t visits;       /**< cells taken from the queue (or swept) that handed light to their neighbours */
    int64_t pushes;       /**< cells put into the queue */
    int64_t removals;     /**< cells whose light was taken away before it was filled in again */
    int32_t from_scratch; /**< 1: the whole world was solved */
    int64_t memory_bytes; /**< that the world holds [byte] */
} dpl_flood_stats;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_flood dpl_flood;

/**
 * Makes a world of air without lights, lit by the sun if there is one. Takes all memory that updates and
 * solves will need: 9 bytes per cell and, by default, 2.3 bytes per cell for the queues.
 * @param context the context, must outlive the world
 * @param desc    from dpl_flood_desc_default()
 * @param flood   receives the world, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _SIZE, _ARGUMENT, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_create(dpl_context *context, const dpl_flood_desc *desc,
                                                   dpl_flood **flood);

/** Frees a world. NULL is fine. */
DPL_API void dpl_flood_destroy(dpl_flood *flood);

/**
 * Reads the desc that the world was made from, with its present sun. `materials` points into the world.
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_read_desc(const dpl_flood *flood, dpl_flood_desc *desc);

/**
 * Places or breaks one block. Light follows at the next update.
 * @param x,y,z    inside the world
 * @param material 0 .. material_count-1
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_set_cell(dpl_flood *flood, int32_t x, int32_t y, int32_t z,
                                                     int32_t material);

/**
 * Sets a box of cells. All are checked before the first is set. Light follows at the next update.
 * @param box          inside the world
 * @param materials    shape [depth][height][width]
 * @param row_stride   from a row to the next [byte]; 0: tightly packed; may be negative
 * @param slice_stride from a z to the next [byte]; 0: height rows; may be negative
 * @return DPL_OK; DPL_ERROR_ARGUMENT, also for a material that does not exist, with the cell named
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_set_cells(dpl_flood *flood, const dpl_flood_box *box,
                                                      const uint8_t *materials, ptrdiff_t row_stride,
                                                      ptrdiff_t slice_stride);

/** Reads a box of cells; parameters as those of dpl_flood_set_cells(). @return DPL_OK; DPL_ERROR_ARGUMENT */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_read_cells(const dpl_flood *flood, const dpl_flood_box *box,
                                                       uint8_t *materials, ptrdiff_t row_stride,
                                                       ptrdiff_t slice_stride);

/**
 * Adds a light. Several may stand in one cell (the brightest counts, per channel), also in a block. It shines
 * from the next update on.
 * @param x,y,z inside the world
 * @param level shape [4], 0 .. DPL_FLOOD_FULL; channels that the world does not have are ignored
 * @param light receives the light's name
 * @return DPL_OK; DPL_ERROR_ARGUMENT; DPL_ERROR_MEMORY when the list of lights cannot grow (it doubles)
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_add_light(dpl_flood *flood, int32_t x, int32_t y, int32_t z,
                                                      const uint16_t level[DPL_FLOOD_MAX_CHANNELS],
                                                      dpl_flood_light *light);

/** Moves a light to another cell. @return DPL_OK; DPL_ERROR_ARGUMENT, also for a light that is gone */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_move_light(dpl_flood *flood, dpl_flood_light light, int32_t x,
                                                       int32_t y, int32_t z);

/** Removes a light. @return DPL_OK; DPL_ERROR_ARGUMENT, also for a light that is gone */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_remove_light(dpl_flood *flood, dpl_flood_light light);

/**
 * Changes the sun's level. The next update solves from scratch if it differs. To dim the sun by the hour keep
 * it in a channel of its own and change that channel's weight in dpl_flood_read_light(): that costs nothing.
 * @param level shape [4], 0 .. DPL_FLOOD_FULL
 * @return DPL_OK; DPL_ERROR_ARGUMENT, also where the desc has no sun
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_set_sun(dpl_flood *flood,
                                                    const uint16_t level[DPL_FLOOD_MAX_CHANNELS]);

/**
 * Brings the light up to date with all edits since the last update or solve. Allocates nothing.
 * @param changed receives the smallest box around all cells whose light has changed, or the whole world when
 * it was solved from scratch; may be NULL
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 * Source: the two queues (take away, then fill in) of voxel games; Dial 1969, "Algorithm 360: shortest-path
 * forest with topological ordering", for the bucket queue.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_update(dpl_flood *flood, dpl_flood_box *changed);

/** Works out all light from nothing: the same light as updates give. Allocates nothing.
 * @return DPL_OK; DPL_ERROR_ARGUMENT */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_solve(dpl_flood *flood);

/**
 * The same light as dpl_flood_solve(), found depth first, as the M.R.M.A. paper offers it ("DFS or BFS").
 * Kept as a warning: it visits cells again and again. The statistics say how often.
 * @return DPL_OK; DPL_ERROR_ARGUMENT; DPL_ERROR_MEMORY (first call only)
 * Source: the M.R.M.A. paper, section 1.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_solve_depth_first(dpl_flood *flood);

/**
 * Reads levels as of the last update or solve.
 * @param box          inside the world
 * @param levels       shape [depth][height][width][channels]
 * @param row_stride   from a row to the next [byte]; 0: tightly packed; may be negative
 * @param slice_stride from a z to the next [byte]; 0: height rows; may be negative
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_read_levels(const dpl_flood *flood, const dpl_flood_box *box,
                                                        uint16_t *levels, ptrdiff_t row_stride,
                                                        ptrdiff_t slice_stride);

/**
 * Reads one z of the world as linear RGB: the sum over channels of level / DPL_FLOOD_FULL * weight.
 * @param z       0 in 2D
 * @param weights shape [4][3], RGB of each channel, finite; NULL: one channel is white, two are white and
 * white, three are R, G, B, four are R, G, B and white
 * @param output  of the world's width and height
 * @return DPL_OK; DPL_ERROR_ARGUMENT, _SIZE
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_read_light(const dpl_flood *flood, int32_t z,
                                                       const float (*weights)[3], const dpl_output *output);

/** Counters of the last update or solve; zeros before the first. */
DPL_API void dpl_flood_read_stats(const dpl_flood *flood, dpl_flood_stats *stats);

/** Bytes that dpl_flood_save() will write now. 0 for NULL. */
DPL_API size_t dpl_flood_save_size(const dpl_flood *flood);

/**
 * Writes the world: rules, cells, lights and sun. Light itself is left out: it follows from the rest, so a
 * file cannot hold stale light. The bytes are the same on every machine.
 * @param bytes shape [size]
 * @param size  at least dpl_flood_save_size()
 * @return DPL_OK; DPL_ERROR_ARGUMENT, _SIZE
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_save(const dpl_flood *flood, void *bytes, size_t size);

/**
 * Makes a world from saved bytes and solves it. Lights keep their names. Bytes may come from anywhere: they
 * are checked, by a checksum too, and never ask for more than 16 times their size in memory (and 1 MiB).
 * @param bytes shape [size], as dpl_flood_save() wrote them
 * @param size  exactly what was written
 * @param flood receives the world, or NULL on failure
 * @return DPL_OK; DPL_ERROR_ARGUMENT (with a message that says what is wrong), _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_flood_restore(dpl_context *context, const void *bytes, size_t size,
                                                    dpl_flood **flood);

/** Name of a falloff as the command line spells it: "subtractive", "multiplicative", "euclidean", "round", or
 * "?". Thread-safe. */
DPL_API const char *dpl_flood_falloff_name(dpl_flood_falloff falloff);

#ifdef __cplusplus
}
#endif
#endif
