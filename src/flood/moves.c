/* How light steps: the neighbours of a cell, and what each material costs. Called by world.c at creation;
 * the costs of single steps are asked for by retract.c, depth_first.c and, near blocks, spread.c. */
#include "flood/flood.h"

#include <math.h>

#define AXES 3

/* ---- neighbours ----------------------------------------------------------------------------------- */

static uint32_t offset_of(const dpl_flood *flood, const int32_t d[AXES]) {
    uint32_t offset = 0;
    for (int axis = 0; axis < AXES; axis++)
        offset += (uint32_t)d[axis] * flood->stride[axis];
    return offset;
}

/* The part of a step along some of its axes only (bits of `axes`). */
static uint32_t part_of(const dpl_flood *flood, const int32_t d[AXES], int axes) {
    const int32_t part[AXES] = {axes & 1 ? d[0] : 0, axes & 2 ? d[1] : 0, axes & 4 ? d[2] : 0};
    return offset_of(flood, part);
}

static dpl_flood_move move_of(const dpl_flood *flood, const int32_t d[AXES]) {
    dpl_flood_move move = {.offset = offset_of(flood, d)};
    int used = (d[0] != 0) | (d[1] != 0) << 1 | (d[2] != 0) << 2;
    /* Single axes before pairs: see dpl_flood_move. */
    static const int parts[6] = {1, 2, 4, 3, 5, 6};
    int count = 0;
    for (int i = 0; i < 6; i++)
        if ((parts[i] & used) == parts[i] && parts[i] != used)
            move.via[count++] = part_of(flood, d, parts[i]);
    for (int axis = 0; axis < AXES; axis++)
        move.axes += d[axis] != 0;
    return move;
}

static void add_moves(dpl_flood *flood, int axes) {
    int deep = dpl_flood_is_deep(flood) ? 1 : 0;
    for (int32_t z = -deep; z <= deep; z++)
        for (int32_t y = -1; y <= 1; y++)
            for (int32_t x = -1; x <= 1; x++) {
                const int32_t d[AXES] = {x, y, z};
                if ((x != 0) + (y != 0) + (z != 0) == axes)
                    flood->moves[flood->move_count++] = move_of(flood, d);
            }
}

/* ---- costs ---------------------------------------------------------------------------------------- */

static uint32_t attenuation_of(const dpl_flood *flood, int material, int channel) {
    if (material < flood->desc.material_count)
        return flood->materials[material].attenuation[channel];
    return DPL_FLOOD_OPAQUE; /* the border, and numbers that no cell has */
}

/* w * (step + attenuation), rounded; sqrt is exact enough to round the same everywhere. */
static uint32_t loss(const dpl_flood *flood, uint32_t attenuation, int axes) {
    if (attenuation == DPL_FLOOD_OPAQUE)
        return DPL_FLOOD_OPAQUE;
    double cost = sqrt((double)axes) * ((double)flood->desc.step + attenuation);
    return cost < DPL_FLOOD_OPAQUE ? (uint32_t)(cost + 0.5) : DPL_FLOOD_OPAQUE;
}

/* base^exponent for 0 < base < 1 <= exponent < 2, by square roots for the exponent's binary digits: unlike
 * pow() the same to the bit everywhere. */
static double power(double base, double exponent) {
    double result = base, root = base;
    for (exponent -= 1; exponent > 0;) {
        root = sqrt(root);
        exponent *= 2;
        if (exponent >= 1) {
            result *= root;
            exponent -= 1;
        }
    }
    return result;
}

static uint32_t share(const dpl_flood *flood, uint32_t attenuation, int axes) {
    if (attenuation == DPL_FLOOD_OPAQUE)
        return 0;
    uint32_t straight = (uint32_t)flood->desc.keep * (32768 - attenuation);
    return axes == 1 ? straight >> 15 : (uint32_t)(32768 * power(straight * 0x1p-30, sqrt((double)axes)));
}

static void make_costs(dpl_flood *flood) {
    bool multiplicative = dpl_falloff_is_multiplicative(flood->desc.falloff);
    for (int axes = 1; axes <= AXES; axes++)
        for (int material = 0; material < 128; material++) {
            uint64_t cost = 0;
            for (int c = 0; c < DPL_FLOOD_MAX_CHANNELS; c++) {
                uint32_t attenuation = attenuation_of(flood, material, c);
                uint32_t lane =
                    multiplicative ? share(flood, attenuation, axes) : loss(flood, attenuation, axes);
                cost |= (uint64_t)lane << (16 * c);
            }
            flood->cost[axes - 1][material] = cost;
        }
    /* The least level that leaves 1 for a neighbour of air. */
    uint32_t least = multiplicative ? (32768 + (uint32_t)flood->desc.keep - 1) / (uint32_t)flood->desc.keep
                                    : (uint32_t)flood->desc.step + 1;
    flood->least = dpl_lanes_all(least < DPL_FLOOD_FULL ? least : DPL_FLOOD_FULL);
}

void dpl_flood_make_moves(dpl_flood *flood) {
    int axes = dpl_falloff_is_round(flood->desc.falloff) ? (dpl_flood_is_deep(flood) ? 3 : 2) : 1;
    for (int i = 1; i <= axes; i++)
        add_moves(flood, i);
    make_costs(flood);
}

/* ---- single steps --------------------------------------------------------------------------------- */

static uint64_t dearer(const dpl_flood *flood, uint64_t a, uint64_t b) {
    return dpl_falloff_is_multiplicative(flood->desc.falloff) ? dpl_lanes_min(a, b) : dpl_lanes_max(a, b);
}

static uint64_t cheaper(const dpl_flood *flood, uint64_t a, uint64_t b) {
    return dpl_falloff_is_multiplicative(flood->desc.falloff) ? dpl_lanes_max(a, b) : dpl_lanes_min(a, b);
}

/* The least cost of squeezing past the cells beside a diagonal step: along the axes one after the other, in
 * the order that costs least. */
static uint64_t cost_of_passing(const dpl_flood *flood, uint32_t cell, const dpl_flood_move *move) {
    uint64_t via[6];
    const uint64_t *cost = flood->cost[move->axes - 1];
    int count = move->axes == 2 ? 2 : 6;
    for (int i = 0; i < count; i++)
        via[i] = cost[flood->cells[cell + move->via[i]] & DPL_CELL_MATERIAL];
    if (move->axes == 2)
        return cheaper(flood, via[0], via[1]);
    uint64_t xy = dearer(flood, via[3], cheaper(flood, via[0], via[1]));
    uint64_t xz = dearer(flood, via[4], cheaper(flood, via[0], via[2]));
    uint64_t yz = dearer(flood, via[5], cheaper(flood, via[1], via[2]));
    return cheaper(flood, xy, cheaper(flood, xz, yz));
}

uint64_t dpl_flood_move_cost(const dpl_flood *flood, uint32_t cell, const dpl_flood_move *move) {
    uint64_t own = flood->cost[move->axes - 1][flood->cells[cell + move->offset] & DPL_CELL_MATERIAL];
    return move->axes == 1 ? own : dearer(flood, own, cost_of_passing(flood, cell, move));
}

uint64_t dpl_flood_after(const dpl_flood *flood, uint64_t light, uint64_t cost) {
    return dpl_falloff_is_multiplicative(flood->desc.falloff) ? dpl_lanes_times(light, cost)
                                                              : dpl_lanes_minus(light, cost);
}
