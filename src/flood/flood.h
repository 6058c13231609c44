/* A tile world: what its files share. Used by src/flood and src/api/flood.c.
 *
 *   queue    cells waiting to hand on their light, brightest first
 *   moves    how a world's light steps: neighbours, costs
 *   spread   fills light in             retract  takes it away
 *   edits    what has changed since the last update
 *   lights   lamps by name and by cell  sun      sunlit cells by column
 *   update   puts these together        depth_first, save */
#ifndef DPL_FLOOD_FLOOD_H
#define DPL_FLOOD_FLOOD_H

#include "base/context.h"
#include "flood/lanes.h"
#include "flood/queue.h"

#include <dapple/flood.h>

/* Marks of a cell, in the guard bits of its word of levels. The list of edits is used up when an update
 * begins to fill the list of removals, so they share a mark. */
#define DPL_MARK_QUEUED (UINT64_C(1) << 15)    /* has light that its neighbours have not been offered */
#define DPL_MARK_EDITED (UINT64_C(1) << 31)    /* between updates: is in the list of edits */
#define DPL_MARK_RETRACTED (UINT64_C(1) << 31) /* in an update: is in the list of removals */
#define DPL_MARK_SOLID (UINT64_C(1) << 47)     /* is not air: light that comes has to ask what it is */
#define DPL_MARK_DOOMED (UINT64_C(1) << 63)    /* edited so that its light may not stay */

/* Of the byte per cell: a lamp or the sun stands here. */
#define DPL_CELL_SOURCE 0x80
#define DPL_CELL_MATERIAL 0x7f
/* Material of the border around the world, which saves every test for its edge. */
#define DPL_MATERIAL_BORDER 127

#define DPL_FLOOD_MOVES 26

/* A step to a neighbour. Offsets are in cells of the padded planes; a neighbour below wraps round, as
 * unsigned numbers may. `via`: the cells that a diagonal step squeezes past, from where it starts: 2 for an
 * edge, 6 for a corner (x, y, z, then xy, xz, yz). */
typedef struct dpl_flood_move {
    uint32_t offset;
    int32_t axes; /* 1, 2 or 3 */
    uint32_t via[6];
} dpl_flood_move;

/* Light that was taken from a cell. */
typedef struct dpl_flood_removal {
    uint64_t taken;  /* lanes */
    uint64_t before; /* all lanes before the first taking in this update; DPL_REMOVAL_AGAIN: a later one */
    uint32_t cell;
} dpl_flood_removal;

#define DPL_REMOVAL_AGAIN UINT64_MAX

/* Cell number -> coordinates without division: floor(n * factor / 2^shift), exact for n < 2^31. */
typedef struct dpl_flood_divider {
    uint64_t factor;
    int32_t shift;
} dpl_flood_divider;

/* A place in the list of lamps. */
typedef struct dpl_flood_lamp {
    uint64_t level;      /* lanes */
    uint32_t cell;       /* DPL_NO_CELL: the place is free */
    uint32_t generation; /* of the lamp that stands here, or of the last one */
    uint32_t next;       /* in the chain of its hash, or of free places; DPL_NO_LAMP ends it */
} dpl_flood_lamp;

#define DPL_NO_CELL UINT32_MAX
#define DPL_NO_LAMP UINT32_MAX

typedef struct dpl_flood_lamps {
    dpl_flood_lamp *lamps;
    uint32_t *chains;  /* shape [capacity]: first lamp per hash of a cell */
    uint32_t capacity; /* a power of two, or 0 */
    uint32_t count;    /* places ever used */
    uint32_t free;     /* chain of places free again */
} dpl_flood_lamps;

struct dpl_flood {
    dpl_context *context;
    dpl_flood_desc desc; /* its materials are the array below */
    dpl_flood_material materials[DPL_FLOOD_MAX_MATERIALS];
    int64_t memory_bytes;

    /* The planes, padded by a border of one cell (in 2D none along z). */
    uint64_t *levels;   /* shape [padded]: four lanes and four marks */
    uint8_t *cells;     /* shape [padded + slack]: material, source bit */
    uint32_t padded;    /* cells of a plane, < 2^31 */
    uint32_t origin;    /* number of cell (0, 0, 0) */
    uint32_t stride[3]; /* to the next x, y, z */
    dpl_flood_divider rows, slices;

    dpl_flood_move moves[DPL_FLOOD_MOVES]; /* along the axes first */
    int32_t move_count;
    uint64_t cost[3][128]; /* [axes of the step - 1][material]; multiplicative: share that is kept */
    uint64_t least;        /* a lane below this has nothing left for a neighbour */

    dpl_flood_queue queue;
    uint32_t *edits; /* shape [edit_capacity] */
    uint32_t edit_count, edit_capacity;
    dpl_flood_removal *removals; /* shape [removal_capacity] */
    uint32_t removal_count, removal_capacity;
    dpl_flood_lamps lamps;

    uint64_t sun_level;     /* lanes; 0 without a sun */
    int32_t *sunlit;        /* shape [columns]: cells of a column that the sun falls through; NULL without */
    uint32_t sun_entry;     /* the first cell of the first column */
    uint32_t sun_stride;    /* down a column; wraps round where the sun falls towards 0 */
    int32_t sun_length;     /* cells of a column */
    int32_t sun_columns[2]; /* numbers of columns along the two other axes */
    uint32_t sun_across[2]; /* from a column to the next along them */
    int32_t sun_axis;       /* 0 x, 1 y, 2 z */

    dpl_buffer depth_first_path;

    bool stale;              /* the next update solves from scratch */
    bool tracking;           /* cells that become brighter widen the box */
    int32_t low[3], high[3]; /* the box, while tracking */
    dpl_flood_stats stats;
};

static inline bool dpl_flood_is_deep(const dpl_flood *flood) {
    return flood->desc.depth > 1;
}

/* Costs are then shares of light that are kept: the greater, the better. */
static inline bool dpl_falloff_is_multiplicative(dpl_flood_falloff falloff) {
    return falloff == DPL_FLOOD_MULTIPLICATIVE || falloff == DPL_FLOOD_ROUND;
}

/* Are there diagonal steps? */
static inline bool dpl_falloff_is_round(dpl_flood_falloff falloff) {
    return falloff == DPL_FLOOD_EUCLIDEAN || falloff == DPL_FLOOD_ROUND;
}

static inline uint32_t dpl_flood_number(const dpl_flood *flood, int32_t x, int32_t y, int32_t z) {
    return flood->origin + (uint32_t)x + (uint32_t)y * flood->stride[1] + (uint32_t)z * flood->stride[2];
}

static inline uint32_t dpl_flood_divide(dpl_flood_divider divider, uint32_t n) {
    return (uint32_t)(n * divider.factor >> divider.shift);
}

/* Coordinates of a cell of the world (not of its border). */
static inline void dpl_flood_locate(const dpl_flood *flood, uint32_t cell, int32_t at[3]) {
    uint32_t n = cell - flood->origin;
    uint32_t slice = dpl_flood_divide(flood->slices, n);
    n -= slice * flood->stride[2];
    uint32_t row = dpl_flood_divide(flood->rows, n);
    at[0] = (int32_t)(n - row * flood->stride[1]);
    at[1] = (int32_t)row;
    at[2] = (int32_t)slice;
}

static inline void dpl_flood_widen_box(dpl_flood *flood, uint32_t cell) {
    int32_t at[3];
    dpl_flood_locate(flood, cell, at);
    for (int axis = 0; axis < 3; axis++) {
        flood->low[axis] = at[axis] < flood->low[axis] ? at[axis] : flood->low[axis];
        flood->high[axis] = at[axis] > flood->high[axis] ? at[axis] : flood->high[axis];
    }
}

/* ---- world.c: memory and geometry ---- */

/* The desc is good. On failure everything is given back by dpl_flood_destroy(). */
DPL_MUST_CHECK dpl_status dpl_flood_build(dpl_flood *flood);
/* Do the sizes fit, border and all, in cell numbers below 2^31? */
bool dpl_flood_size_fits(int32_t width, int32_t height, int32_t depth);
/* Packs one level per channel of the world. */
uint64_t dpl_flood_pack(const dpl_flood *flood, const uint16_t level[DPL_FLOOD_MAX_CHANNELS]);

/* ---- moves.c ---- */

void dpl_flood_make_moves(dpl_flood *flood);
/* What a step from this cell costs on its way, per lane (multiplicative: keeps). */
uint64_t dpl_flood_move_cost(const dpl_flood *flood, uint32_t cell, const dpl_flood_move *move);
/* The light that a step leaves of `light`. */
uint64_t dpl_flood_after(const dpl_flood *flood, uint64_t light, uint64_t cost);

/* ---- spread.c ---- */

/* Offers light to a cell: raises it, queues it, widens the box. */
void dpl_flood_offer(dpl_flood *flood, uint32_t cell, uint64_t light);
/* Hands the light of one cell on to its neighbours. */
void dpl_flood_visit(dpl_flood *flood, uint32_t cell);
/* Until nobody has more to hand on. */
void dpl_flood_drain(dpl_flood *flood);

/* ---- retract.c ---- */

/* Takes away the light of doomed cells and all that followed from it, then offers every edited or darkened
 * cell what its sources and neighbours have. False when the list of removals was too short: solve from
 * scratch. */
bool dpl_flood_retract(dpl_flood *flood);
/* After the light is back: which darkened cells differ from before? Widens the box, wipes the marks. */
void dpl_flood_settle_removals(dpl_flood *flood);

/* ---- edits.c ---- */

/* Notes that a cell has changed; `doomed`: its light may have lost its reason. */
void dpl_flood_edit(dpl_flood *flood, uint32_t cell, bool doomed);
/* Sets the material of a cell, and the sunlight below it. */
void dpl_flood_place(dpl_flood *flood, uint32_t cell, uint8_t material);

/* ---- lights.c ---- */

DPL_MUST_CHECK dpl_status dpl_flood_lamps_reserve(dpl_flood *flood, uint32_t count);
/* Makes a lamp in a free place; room was reserved. */
dpl_flood_light dpl_flood_lamps_add(dpl_flood *flood, uint32_t cell, uint64_t level);
/* The lamp of that name, or NULL. */
dpl_flood_lamp *dpl_flood_lamps_find(const dpl_flood *flood, dpl_flood_light light);
void dpl_flood_lamps_move(dpl_flood *flood, dpl_flood_lamp *lamp, uint32_t cell);
void dpl_flood_lamps_remove(dpl_flood *flood, dpl_flood_lamp *lamp);
/* Puts a lamp where it stands into its chain; for a list that was filled by hand. */
void dpl_flood_lamps_chain(dpl_flood *flood, uint32_t index);
/* The brightest of all lamps in a cell, per lane; 0 without. */
uint64_t dpl_flood_lamps_at(const dpl_flood *flood, uint32_t cell);
void dpl_flood_lamps_free(dpl_flood *flood);

/* ---- sun.c ---- */

/* Takes the memory for columns and lights a world of air. */
DPL_MUST_CHECK dpl_status dpl_flood_sun_build(dpl_flood *flood);
/* Finds all sunlit cells anew. */
void dpl_flood_sun_measure(dpl_flood *flood);
/* A cell's material has changed: how far does the sun fall now? */
void dpl_flood_sun_follow(dpl_flood *flood, uint32_t cell);
/* Does the sun fall through this cell? */
bool dpl_flood_is_sunlit(const dpl_flood *flood, uint32_t cell);
/* Gives sunlit cells the sun's level; the rest is left. */
void dpl_flood_sun_shine(dpl_flood *flood);
/* Calls `visit` for each sunlit cell that may have a neighbour in the shade. */
void dpl_flood_sun_each(dpl_flood *flood, void (*visit)(dpl_flood *flood, uint32_t cell));

/* ---- update.c ---- */

/* The light that stands in a cell by itself. */
uint64_t dpl_flood_source(const dpl_flood *flood, uint32_t cell);
/* Dark, but for sunlit cells; no marks, no edits. */
void dpl_flood_darken(dpl_flood *flood);
/* All light from nothing. */
void dpl_flood_start_over(dpl_flood *flood);

#endif
