/* Takes the times. Called by main.c. Processor time throughout: what others do on the machine does not count,
 * though what they do to its caches does. */
#include "measure.h"

#include "../common/clock.h"
#include "../common/progress.h"

#include <stdlib.h>

#define SMALLEST 64
#define LEVEL_14 (14 * 2048)
#define EDITS 2000

static uint32_t random_below(uint64_t *state, int32_t end) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 33) % (uint64_t)end);
}

static bool good(dpl_context *context, dpl_status status, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    return dpl_error_set(error, "%s: %s", dpl_status_text(status), dpl_context_message(context));
}

static dpl_bench_flood_row *add_row(dpl_bench_flood_table *table, const char *what, const char *unit,
                                    const dpl_flood_desc *desc, int32_t blocks) {
    dpl_bench_flood_row *row = &table->rows[table->count++];
    *row = (dpl_bench_flood_row){.what = what,
                                 .falloff = desc->falloff,
                                 .size = {desc->width, desc->height, desc->depth},
                                 .blocks = blocks,
                                 .unit = unit};
    dpl_bench_progress("%s, %s, %d x %d x %d", what, dpl_flood_falloff_name(desc->falloff), (int)desc->width,
                       (int)desc->height, (int)desc->depth);
    return row;
}

static void read_counters(const dpl_flood *flood, dpl_bench_flood_row *row) {
    dpl_flood_stats stats;
    dpl_flood_read_stats(flood, &stats);
    row->visits = stats.visits;
    row->pushes = stats.pushes;
}

/* ---- worlds --------------------------------------------------------------------------------------- */

/* Light of a lamp in the middle reaches every corner of every 2D world. */
static dpl_flood_desc flat_desc(int32_t size, dpl_flood_falloff falloff) {
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = desc.height = size;
    desc.falloff = falloff;
    desc.step = 4;
    desc.keep = 32760;
    return desc;
}

static dpl_status add_lamp(dpl_flood *flood, int32_t x, int32_t y, int32_t z, uint16_t level,
                           dpl_flood_light *light) {
    const uint16_t levels[DPL_FLOOD_MAX_CHANNELS] = {level, level, level, level};
    return dpl_flood_add_light(flood, x, y, z, levels, light);
}

/* Blocks by chance, the same for the same size; the middle stays free. */
static dpl_status scatter_blocks(dpl_flood *flood, const dpl_flood_desc *desc, int32_t percent) {
    uint64_t seed = 1;
    for (int32_t z = 0; z < desc->depth; z++)
        for (int32_t y = 0; y < desc->height; y++)
            for (int32_t x = 0; x < desc->width; x++) {
                bool block = (int32_t)random_below(&seed, 100) < percent;
                dpl_status status = block ? dpl_flood_set_cell(flood, x, y, z, 1) : DPL_OK;
                if (status != DPL_OK)
                    return status;
            }
    return dpl_flood_set_cell(flood, desc->width / 2, desc->height / 2, desc->depth / 2, 0);
}

static dpl_status make_world(dpl_context *context, const dpl_flood_desc *desc, int32_t percent,
                             uint16_t level, dpl_flood **flood) {
    dpl_flood_light light;
    dpl_status status = dpl_flood_create(context, desc, flood);
    if (status == DPL_OK)
        status = scatter_blocks(*flood, desc, percent);
    if (status == DPL_OK && level > 0)
        status = add_lamp(*flood, desc->width / 2, desc->height / 2, desc->depth / 2, level, &light);
    return status == DPL_OK ? dpl_flood_update(*flood, NULL) : status;
}

/* ---- solving from scratch ------------------------------------------------------------------------- */

#define SOLVES 16

/* A world that is solved again and again. */
typedef struct solve_case {
    dpl_bench_flood_row *row;
    dpl_flood *flood;
    double *ns; /* shape [frames] */
    double cells;
} solve_case;

static dpl_status begin_solve(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table, int32_t size,
                              dpl_flood_falloff falloff, int32_t blocks, solve_case *c) {
    dpl_flood_desc desc = flat_desc(size, falloff);
    c->row = add_row(table, "solve", "ns per cell", &desc, blocks);
    c->cells = (double)size * (double)size;
    c->ns = malloc((size_t)plan->frames * sizeof *c->ns);
    return c->ns ? make_world(plan->context, &desc, blocks, DPL_FLOOD_FULL, &c->flood) : DPL_ERROR_MEMORY;
}

/* About a million cells per sample, so that the clock's grain does not show. */
static dpl_status sample_solve(solve_case *c, int32_t frame) {
    int32_t times = c->cells < 1e6 ? (int32_t)(1e6 / c->cells) + 1 : 1;
    dpl_status status = DPL_OK;
    dpl_bench_time start = dpl_bench_now();
    for (int32_t i = 0; i < times && status == DPL_OK; i++)
        status = dpl_flood_solve(c->flood);
    c->ns[frame] = dpl_bench_since(start).cpu_ms * 1e6 / (c->cells * times);
    return status;
}

static dpl_status begin_solves(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table,
                               solve_case *cases, int32_t *count) {
    dpl_status status = DPL_OK;
    for (int32_t size = SMALLEST; size <= plan->largest && status == DPL_OK; size *= 2)
        status = begin_solve(plan, table, size, DPL_FLOOD_SUBTRACTIVE, 0, &cases[(*count)++]);
    int32_t middle = plan->largest < 1024 ? plan->largest : 1024;
    for (int falloff = DPL_FLOOD_SUBTRACTIVE; falloff <= DPL_FLOOD_ROUND; falloff++)
        for (int32_t blocks = falloff == DPL_FLOOD_SUBTRACTIVE ? 20 : 0; blocks <= 20; blocks += 20)
            if (status == DPL_OK)
                status =
                    begin_solve(plan, table, middle, (dpl_flood_falloff)falloff, blocks, &cases[(*count)++]);
    return status;
}

/* The worlds take turns: when the machine is slower for a while, it is so for all, and ratios stay fair. */
static bool measure_solves(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table, dpl_error *error) {
    solve_case cases[SOLVES] = {{0}};
    int32_t count = 0;
    dpl_status status = begin_solves(plan, table, cases, &count);
    for (int32_t frame = 0; frame < plan->frames && status == DPL_OK; frame++) {
        dpl_bench_progress("solve, frame %d of %d", (int)frame + 1, (int)plan->frames);
        for (int32_t i = 0; i < count && status == DPL_OK; i++)
            status = sample_solve(&cases[i], frame);
    }
    for (int32_t i = 0; i < count; i++) {
        if (status == DPL_OK) {
            cases[i].row->value = dpl_bench_summarise(cases[i].ns, plan->frames);
            read_counters(cases[i].flood, cases[i].row);
        }
        free(cases[i].ns);
        dpl_flood_destroy(cases[i].flood);
    }
    return good(plan->context, status, error);
}

/* ---- torches -------------------------------------------------------------------------------------- */

static dpl_status torch(dpl_flood *flood, uint64_t *seed, int32_t side, double us[2]) {
    int32_t at[3];
    dpl_flood_light light;
    for (int k = 0; k < 3; k++) /* far enough from the edge to shine freely */
        at[k] = 14 + (int32_t)random_below(seed, side - 28);
    dpl_bench_time start = dpl_bench_now();
    dpl_status status = add_lamp(flood, at[0], at[1], at[2], LEVEL_14, &light);
    if (status == DPL_OK)
        status = dpl_flood_update(flood, NULL);
    us[0] = dpl_bench_since(start).cpu_ms * 1e3;
    start = dpl_bench_now();
    if (status == DPL_OK)
        status = dpl_flood_remove_light(flood, light);
    if (status == DPL_OK)
        status = dpl_flood_update(flood, NULL);
    us[1] = dpl_bench_since(start).cpu_ms * 1e3;
    return status;
}

static dpl_flood_desc deep_desc(const dpl_bench_flood_plan *plan) {
    dpl_flood_desc desc = dpl_flood_desc_default();
    desc.width = desc.height = desc.depth = plan->side;
    return desc;
}

static bool measure_torch(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table, dpl_error *error) {
    dpl_flood_desc desc = deep_desc(plan);
    dpl_bench_flood_row *place = add_row(table, "place", "us", &desc, 0);
    dpl_bench_flood_row *removal = add_row(table, "remove", "us", &desc, 0);
    int32_t torches = plan->frames * 20;
    dpl_flood *flood = NULL;
    uint64_t seed = 1;
    double *us = malloc((size_t)torches * 2 * sizeof *us);
    dpl_status status = us ? make_world(plan->context, &desc, 0, 0, &flood) : DPL_ERROR_MEMORY;
    for (int32_t i = 0; i < torches && status == DPL_OK; i++) {
        double both[2];
        status = torch(flood, &seed, plan->side, both);
        us[i] = both[0];
        us[torches + i] = both[1];
    }
    if (status == DPL_OK) {
        place->value = dpl_bench_summarise(us, torches);
        removal->value = dpl_bench_summarise(us + torches, torches);
        read_counters(flood, removal);
    }
    free(us);
    dpl_flood_destroy(flood);
    return good(plan->context, status, error);
}

/* ---- edits ---------------------------------------------------------------------------------------- */

/* A torch of level 14 in every 24th cell of a row, column and layer. */
static dpl_status plant_torches(dpl_flood *flood, const dpl_flood_desc *desc) {
    dpl_flood_light light;
    for (int32_t z = desc->depth > 1 ? 12 : 0; z < desc->depth; z += 24)
        for (int32_t y = 12; y < desc->height; y += 24)
            for (int32_t x = 12; x < desc->width; x += 24) {
                dpl_status status = add_lamp(flood, x, y, z, LEVEL_14, &light);
                if (status != DPL_OK)
                    return status;
            }
    return dpl_flood_solve(flood);
}

/* Breaks a block or places one, wherever chance points, an update after each. */
static dpl_status edit_blocks(dpl_flood *flood, const dpl_flood_desc *desc, uint64_t *seed, double *us) {
    dpl_status status = DPL_OK;
    dpl_bench_time start = dpl_bench_now();
    for (int32_t i = 0; i < EDITS && status == DPL_OK; i++) {
        int32_t x = (int32_t)random_below(seed, desc->width), y = (int32_t)random_below(seed, desc->height);
        int32_t z = (int32_t)random_below(seed, desc->depth);
        dpl_flood_box cell = {x, y, z, 1, 1, 1};
        uint8_t material = 0;
        status = dpl_flood_read_cells(flood, &cell, &material, 0, 0);
        if (status == DPL_OK)
            status = dpl_flood_set_cell(flood, x, y, z, 1 - material);
        if (status == DPL_OK)
            status = dpl_flood_update(flood, NULL);
    }
    *us = dpl_bench_since(start).cpu_ms * 1e3 / EDITS;
    return status;
}

static bool measure_edits(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table,
                          const dpl_flood_desc *desc, dpl_error *error) {
    dpl_bench_flood_row *row = add_row(table, "edit", "us", desc, 20);
    dpl_flood *flood = NULL;
    uint64_t seed = 1;
    double *us = malloc((size_t)plan->frames * sizeof *us);
    dpl_status status = us ? make_world(plan->context, desc, 20, 0, &flood) : DPL_ERROR_MEMORY;
    if (status == DPL_OK)
        status = plant_torches(flood, desc);
    for (int32_t i = 0; i < plan->frames && status == DPL_OK; i++)
        status = edit_blocks(flood, desc, &seed, &us[i]);
    if (status == DPL_OK) {
        row->value = dpl_bench_summarise(us, plan->frames);
        read_counters(flood, row);
    }
    free(us);
    dpl_flood_destroy(flood);
    return good(plan->context, status, error);
}

/* ---- depth first ---------------------------------------------------------------------------------- */

static bool measure_depth_first(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table, int32_t size,
                                dpl_error *error) {
    dpl_flood_desc desc = flat_desc(size, DPL_FLOOD_SUBTRACTIVE);
    desc.step = DPL_FLOOD_FULL / (2 * size); /* reaches every corner */
    dpl_bench_flood_row *row = add_row(table, "depth first", "visits over breadth first", &desc, 0);
    dpl_flood *flood = NULL;
    dpl_flood_stats breadth;
    dpl_status status = make_world(plan->context, &desc, 0, DPL_FLOOD_FULL, &flood);
    if (status == DPL_OK)
        status = dpl_flood_solve(flood);
    if (status == DPL_OK) {
        dpl_flood_read_stats(flood, &breadth);
        status = dpl_flood_solve_depth_first(flood);
    }
    if (status == DPL_OK) {
        read_counters(flood, row);
        double ratio = (double)row->visits / (double)breadth.visits;
        row->value = dpl_bench_summarise(&ratio, 1);
    }
    dpl_flood_destroy(flood);
    return good(plan->context, status, error);
}

bool dpl_bench_flood_measure(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table,
                             dpl_error *error) {
    table->count = 0;
    dpl_flood_desc flat = dpl_flood_desc_default(), deep = deep_desc(plan);
    flat.width = flat.height = plan->largest < 1024 ? plan->largest : 1024;
    flat.sun = deep.sun = DPL_FLOOD_SUN_Y_UP;
    bool done = measure_solves(plan, table, error) && measure_torch(plan, table, error) &&
                measure_edits(plan, table, &flat, error) && measure_edits(plan, table, &deep, error);
    for (int32_t size = SMALLEST; done && size <= plan->largest && size <= 256; size *= 2)
        done = measure_depth_first(plan, table, size, error);
    dpl_bench_progress_end();
    return done;
}
