/* The same light, depth first: the way not to do it. Called by users who want to see why, tests and bench.
 *
 * A cell that becomes brighter hands its light on at once, before the neighbour beside it has had a look: the
 * first ray of work runs in a long winding line to where the light ends, and most of what it wrote is raised
 * again later, over and over. */
#include "flood/flood.h"

#include <string.h>

/* Frames of the path; a longer path (it ends where light does) goes on breadth first. */
#define PATH_LENGTH 65536

typedef struct frame {
    uint32_t cell;
    int32_t move; /* next to try */
} frame;

static void brighten(uint64_t *now, uint64_t light) {
    *now = dpl_lanes_max(*now & DPL_LANES_LEVELS, light) | (*now & DPL_LANES_GUARDS);
}

/* Raises the neighbour that the frame's next move leads to. False when it has as much already. */
static bool step(dpl_flood *flood, frame *f, uint32_t *to) {
    const dpl_flood_move *move = &flood->moves[f->move++];
    uint64_t light = flood->levels[f->cell] & DPL_LANES_LEVELS;
    uint64_t offered = dpl_flood_after(flood, light, dpl_flood_move_cost(flood, f->cell, move));
    *to = f->cell + move->offset;
    uint64_t *now = &flood->levels[*to];
    if (dpl_lanes_at_least(*now, offered) == DPL_LANES_GUARDS)
        return false;
    brighten(now, offered);
    return true;
}

static void visit_depth_first(dpl_flood *flood, uint32_t cell) {
    frame *path = flood->depth_first_path.data;
    int32_t length = 1;
    path[0] = (frame){cell, 0};
    flood->stats.visits++;
    while (length > 0) {
        uint32_t to;
        if (path[length - 1].move == flood->move_count) {
            length--;
        } else if (step(flood, &path[length - 1], &to)) {
            flood->stats.visits++;
            if (length < PATH_LENGTH)
                path[length++] = (frame){to, 0};
            else
                dpl_flood_visit(flood, to);
        }
    }
}

dpl_status dpl_flood_solve_depth_first(dpl_flood *flood) {
    if (!flood)
        return DPL_ERROR_ARGUMENT;
    bool fresh = !flood->depth_first_path.data;
    DPL_TRY(dpl_buffer_reserve(flood->context, &flood->depth_first_path, PATH_LENGTH, sizeof(frame)));
    if (fresh)
        flood->memory_bytes += (int64_t)flood->depth_first_path.bytes;
    dpl_flood_darken(flood);
    dpl_flood_sun_each(flood, visit_depth_first);
    for (uint32_t i = 0; i < flood->lamps.count; i++) {
        const dpl_flood_lamp *lamp = &flood->lamps.lamps[i];
        if (lamp->cell == DPL_NO_CELL)
            continue;
        brighten(&flood->levels[lamp->cell], lamp->level);
        visit_depth_first(flood, lamp->cell);
    }
    dpl_flood_drain(flood);
    return DPL_OK;
}
