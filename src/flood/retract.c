/* Taking light away: from doomed cells, and from all that may have had it from them. Called by update.c.
 *
 * A cell's light goes when a cell that lost its own could have handed it on: the neighbour's former light,
 * less the step, is not below it. Every chain of such steps ends, for light only falls along it; so what
 * stays has a chain to a source that stays, and is exactly right. What went is then offered again by whoever
 * stayed. */
#include "flood/flood.h"

static bool take_light(dpl_flood *flood, uint32_t cell, uint64_t lanes) {
    if (flood->removal_count == flood->removal_capacity)
        return false;
    uint64_t now = flood->levels[cell];
    bool again = now & DPL_MARK_RETRACTED;
    flood->removals[flood->removal_count++] = (dpl_flood_removal){
        .taken = now & lanes,
        .before = again ? DPL_REMOVAL_AGAIN : now & DPL_LANES_LEVELS,
        .cell = cell,
    };
    flood->levels[cell] = (now & ~lanes) | DPL_MARK_RETRACTED;
    return true;
}

/* Which lanes of a cell may have had their light from a neighbour whose light left `offered` here? */
static uint64_t dependent_lanes(uint64_t now, uint64_t offered) {
    uint64_t lit = dpl_lanes_at_least(now & DPL_LANES_LEVELS, dpl_lanes_all(1));
    return dpl_lanes_mask(dpl_lanes_at_least(offered, now & DPL_LANES_LEVELS) & lit);
}

static bool take_from_neighbours(dpl_flood *flood, const dpl_flood_removal *removal) {
    uint32_t cell = removal->cell;
    uint64_t taken = removal->taken;
    for (int i = 0; i < flood->move_count; i++) {
        const dpl_flood_move *move = &flood->moves[i];
        uint64_t *to = &flood->levels[cell + move->offset];
        if (!(*to & DPL_LANES_LEVELS))
            continue;
        uint64_t offered = dpl_flood_after(flood, taken, dpl_flood_move_cost(flood, cell, move));
        uint64_t lanes = dependent_lanes(*to, offered);
        if (lanes && !take_light(flood, cell + move->offset, lanes))
            return false;
    }
    return true;
}

/* ---- diagonal steps ------------------------------------------------------------------------------- */

/* A block beside a diagonal step may have carried it: whatever such steps could have lit is doomed too. The
 * step's cost is taken as if nothing stood beside it, the least it can have been. */
static void doom_diagonals(dpl_flood *flood, uint32_t cell) {
    for (int i = 0; i < flood->move_count; i++) {
        const dpl_flood_move *move = &flood->moves[i];
        int vias = move->axes == 1 ? 0 : move->axes == 2 ? 2 : 6;
        for (int v = 0; v < vias; v++) {
            uint32_t from = cell - move->via[v], to = from + move->offset;
            uint8_t material = flood->cells[from] & DPL_CELL_MATERIAL;
            if (material == DPL_MATERIAL_BORDER)
                continue;
            uint64_t cost = flood->cost[move->axes - 1][flood->cells[to] & DPL_CELL_MATERIAL];
            uint64_t offered = dpl_flood_after(flood, flood->levels[from] & DPL_LANES_LEVELS, cost);
            if (dependent_lanes(flood->levels[to], offered))
                dpl_flood_edit(flood, to, true);
        }
    }
}

/* Diagonal steps past an edited cell may cost less than before: their ends look again. */
static void edit_around(dpl_flood *flood, uint32_t cell) {
    for (int i = 0; i < flood->move_count; i++) {
        uint32_t to = cell + flood->moves[i].offset;
        if ((flood->cells[to] & DPL_CELL_MATERIAL) != DPL_MATERIAL_BORDER)
            dpl_flood_edit(flood, to, false);
    }
}

/* False when the list of edits became too long. */
static bool edit_diagonals(dpl_flood *flood) {
    uint32_t own = flood->edit_count;
    if (!dpl_falloff_is_round(flood->desc.falloff))
        return true;
    for (uint32_t i = 0; i < own; i++)
        if (flood->levels[flood->edits[i]] & DPL_MARK_DOOMED)
            doom_diagonals(flood, flood->edits[i]);
    for (uint32_t i = 0; i < own; i++)
        edit_around(flood, flood->edits[i]);
    return !flood->stale;
}

/* ---- the two halves ------------------------------------------------------------------------------- */

static bool take_all(dpl_flood *flood) {
    flood->removal_count = 0;
    for (uint32_t i = 0; i < flood->edit_count; i++) {
        uint64_t *levels = &flood->levels[flood->edits[i]];
        bool doomed = *levels & DPL_MARK_DOOMED;
        *levels &= ~(DPL_MARK_DOOMED | DPL_MARK_EDITED);
        if (doomed && *levels & DPL_LANES_LEVELS && !take_light(flood, flood->edits[i], DPL_LANES_LEVELS))
            return false;
    }
    for (uint32_t i = 0; i < flood->removal_count; i++) {
        dpl_flood_removal removal = flood->removals[i];
        if (!take_from_neighbours(flood, &removal))
            return false;
    }
    return true;
}

/* The most that sources and neighbours have for a cell. A step costs the same both ways but for the cell that
 * is entered, so it is looked at from the neighbour's side. */
static void look_around(dpl_flood *flood, uint32_t cell) {
    uint64_t light = dpl_flood_source(flood, cell);
    for (int i = 0; i < flood->move_count; i++) {
        const dpl_flood_move *move = &flood->moves[i];
        uint32_t from = cell - move->offset;
        uint64_t there = flood->levels[from] & DPL_LANES_LEVELS;
        if (there)
            light =
                dpl_lanes_max(light, dpl_flood_after(flood, there, dpl_flood_move_cost(flood, from, move)));
    }
    if (light)
        dpl_flood_offer(flood, cell, light);
}

bool dpl_flood_retract(dpl_flood *flood) {
    if (!edit_diagonals(flood) || !take_all(flood))
        return false;
    flood->stats.removals = flood->removal_count;
    for (uint32_t i = 0; i < flood->edit_count; i++)
        look_around(flood, flood->edits[i]);
    for (uint32_t i = 0; i < flood->removal_count; i++)
        if (flood->removals[i].before != DPL_REMOVAL_AGAIN)
            look_around(flood, flood->removals[i].cell);
    return true;
}

void dpl_flood_settle_removals(dpl_flood *flood) {
    for (uint32_t i = 0; i < flood->removal_count; i++) {
        const dpl_flood_removal *removal = &flood->removals[i];
        if (removal->before == DPL_REMOVAL_AGAIN)
            continue;
        uint64_t *levels = &flood->levels[removal->cell];
        *levels &= ~DPL_MARK_RETRACTED;
        if ((*levels & DPL_LANES_LEVELS) != removal->before)
            dpl_flood_widen_box(flood, removal->cell);
    }
}
