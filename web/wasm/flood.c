/* Keeps a tile world from call to call, so that light follows what has changed and no more. */
#include "flood.h"

#include "host.h"

#include <dapple/flood.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RANGE_MAX 4096

/* A light as it stands in the world; a generation of 0: none. */
typedef struct lamp {
    dpl_flood_light light;
    uint16_t level[DPL_FLOOD_MAX_CHANNELS];
} lamp;

struct dpl_web_flood {
    dpl_flood *flood;
    int32_t width, height, falloff, range;
    uint8_t *walls;
    float *lights;
    lamp *lamps; /* of each cell */
};

static void close_world(dpl_web_session *session) {
    dpl_web_flood *world = session->flood;
    session->flood = NULL;
    if (!world)
        return;
    dpl_flood_destroy(world->flood);
    free(world->walls);
    free(world->lights);
    free(world->lamps);
    free(world);
}

static dpl_status create_flood(dpl_web_session *session, dpl_web_flood *world) {
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = world->width;
    desc.height = world->height;
    desc.falloff = (dpl_flood_falloff)world->falloff;
    /* As `dapple flood` has it: all is lost at the range, or a hundredth is left. */
    desc.step = (DPL_FLOOD_FULL + world->range / 2) / world->range;
    desc.keep = (int32_t)(32768 * pow(0.01, 1.0 / world->range));
    return dpl_flood_create(session->context, &desc, &world->flood);
}

static dpl_status make_world(dpl_web_session *session, dpl_web_flood *world) {
    dpl_status status = create_flood(session, world); /* checks the size, too */
    if (status != DPL_OK)
        return status;
    size_t cells = (size_t)world->width * (size_t)world->height;
    world->walls = calloc(cells, sizeof *world->walls);
    world->lights = calloc(3 * cells, sizeof *world->lights);
    world->lamps = calloc(cells, sizeof *world->lamps);
    return world->walls && world->lights && world->lamps ? DPL_OK : DPL_ERROR_MEMORY;
}

int32_t dpl_web_flood_open(dpl_web_session *session, int32_t width, int32_t height, int32_t falloff,
                           int32_t range) {
    const dpl_web_flood *kept = session->flood;
    if (kept && kept->width == width && kept->height == height && kept->falloff == falloff &&
        kept->range == range)
        return DPL_OK;
    close_world(session);
    if (range < 1 || range > RANGE_MAX)
        return DPL_ERROR_ARGUMENT;
    session->flood = calloc(1, sizeof *session->flood);
    if (!session->flood)
        return DPL_ERROR_MEMORY;
    session->flood->width = width;
    session->flood->height = height;
    session->flood->falloff = falloff;
    session->flood->range = range;
    dpl_status status = make_world(session, session->flood);
    if (status != DPL_OK)
        close_world(session);
    return (int32_t)status;
}

uint8_t *dpl_web_flood_walls(dpl_web_session *session) {
    return session->flood ? session->flood->walls : NULL;
}

float *dpl_web_flood_lights(dpl_web_session *session) {
    return session->flood ? session->flood->lights : NULL;
}

static float brightest_of(const dpl_web_flood *world) {
    size_t values = 3 * (size_t)world->width * (size_t)world->height;
    float brightest = 0;
    for (size_t i = 0; i < values; i++)
        brightest = world->lights[i] > brightest ? world->lights[i] : brightest;
    return brightest > 0 ? brightest : 1;
}

/* Replaces a cell's lamp if it shines otherwise now. */
static dpl_status set_lamp(dpl_web_flood *world, int32_t x, int32_t y, float brightest) {
    size_t cell = (size_t)y * (size_t)world->width + (size_t)x;
    lamp *there = &world->lamps[cell];
    lamp next = {.light = {0}};
    for (int c = 0; c < 3; c++)
        next.level[c] =
            (uint16_t)((double)world->lights[3 * cell + (size_t)c] / (double)brightest * DPL_FLOOD_FULL +
                       0.5);
    if (memcmp(there->level, next.level, sizeof next.level) == 0)
        return DPL_OK;
    dpl_status status = DPL_OK;
    if (there->light.generation)
        status = dpl_flood_remove_light(world->flood, there->light);
    if (status != DPL_OK)
        return status;
    *there = (lamp){.light = {0}};
    if (next.level[0] || next.level[1] || next.level[2])
        status = dpl_flood_add_light(world->flood, x, y, 0, next.level, &next.light);
    if (status == DPL_OK)
        *there = next;
    return status;
}

static dpl_status edit(dpl_web_flood *world, float brightest) {
    const dpl_flood_box all = {.width = world->width, .height = world->height, .depth = 1};
    dpl_status status = dpl_flood_set_cells(world->flood, &all, world->walls, 0, 0);
    for (int32_t y = 0; y < world->height; y++)
        for (int32_t x = 0; x < world->width && status == DPL_OK; x++)
            status = set_lamp(world, x, y, brightest);
    return status;
}

static dpl_status read_light(dpl_web_flood *world, float brightest) {
    const dpl_output output = {.data = world->lights,
                               .format = DPL_FORMAT_F32,
                               .width = world->width,
                               .height = world->height,
                               .channels = 3};
    const float weights[DPL_FLOOD_MAX_CHANNELS][3] = {
        {brightest, 0, 0}, {0, brightest, 0}, {0, 0, brightest}};
    return dpl_flood_read_light(world->flood, 0, weights, &output);
}

int32_t dpl_web_flood_update(dpl_web_session *session, double numbers[DPL_WEB_FLOOD_NUMBERS]) {
    dpl_web_flood *world = session->flood;
    if (!world)
        return DPL_ERROR_SIZE;
    const double begin = dpl_web_now();
    const float brightest = brightest_of(world);
    dpl_status status = edit(world, brightest);
    if (status == DPL_OK)
        status = dpl_flood_update(world->flood, NULL);
    if (status == DPL_OK)
        status = read_light(world, brightest);
    if (status != DPL_OK)
        return (int32_t)status;
    dpl_flood_stats stats;
    dpl_flood_read_stats(world->flood, &stats);
    const double found[DPL_WEB_FLOOD_NUMBERS] = {(double)stats.visits, (double)stats.pushes,
                                                 (double)stats.removals, stats.from_scratch,
                                                 dpl_web_now() - begin};
    memcpy(numbers, found, sizeof found);
    return DPL_OK;
}
