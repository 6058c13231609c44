/* `dapple shadow --compare all`: every method against the reference on one light. Prints a table, and makes
 * a sheet of pictures: for each row of the table, from left to right and from top to bottom, V and below it
 * four times its error (red: too bright, blue: too dark); the reference comes first. */
#include "json.h"
#include "report.h"
#include "shadow.h"

#include "image/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COLUMNS 7
#define TILE_MOST 256 /* [px] */
#define GAP 4         /* between pictures [px] */
#define RUNS 3        /* of which the quickest counts */
#define CONTACT 6.0f  /* receivers nearer to an occluder than this [px] */

/* One row of the table. */
typedef struct entry {
    char name[40];
    double rmse, penumbra, contact, leak, over;
    double ms, ns_per_pixel, fetches_per_pixel;
} entry;

typedef struct comparison {
    dpl_shadow_job *job;
    size_t pixels;
    float *truth, *visibility, *distance; /* malloc'ed planes */
    uint8_t *opaque;
    int32_t shrink;                  /* every so many pixels is shown */
    int32_t width, height;           /* of one picture of the sheet */
    int32_t tile_width, tile_height; /* with the gap */
    json_t *rows;
} comparison;

/* ---- what is compared ----------------------------------------------------------------------------- */

/* The index-th way of finding V; false when there are no more. M.R.M.A. comes as it is by default, then with
 * each weight over the soft map and one signed cone, the paper's two terms. */
static bool choose(const dpl_shadow_desc *base, int index, dpl_shadow_desc *desc, char name[40]) {
    int methods = DPL_SHADOW_METHOD_COUNT - 1; /* all but the reference */
    *desc = *base;
    if (index < methods) {
        desc->method = (dpl_shadow_method)(index < DPL_SHADOW_REFERENCE ? index : index + 1);
        snprintf(name, 40, "%s", dpl_shadow_method_name(desc->method));
        return true;
    }
    desc->method = DPL_SHADOW_MRMA;
    desc->weight = (dpl_shadow_weight)(index - methods);
    desc->map_method = DPL_SHADOW_MOMENTS_SOFT;
    desc->field_method = DPL_SHADOW_DISTANCE_SIGNED;
    snprintf(name, 40, "mrma, %s of one cone", dpl_shadow_weight_name(desc->weight));
    return index - methods < DPL_WEIGHT_COUNT;
}

/* ---- errors --------------------------------------------------------------------------------------- */

typedef struct mean {
    double sum;
    double count;
} mean;

static void add(mean *m, double value, bool counts) {
    m->sum += counts ? value : 0.0;
    m->count += counts;
}

static double mean_of(const mean *m) {
    return m->count > 0.0 ? m->sum / m->count : 0.0;
}

static void measure(const comparison *c, entry *e) {
    mean all = {0}, penumbra = {0}, contact = {0}, leak = {0}, over = {0};
    for (size_t i = 0; i < c->pixels; i++) {
        if (c->opaque[i])
            continue;
        double truth = (double)c->truth[i], error = (double)c->visibility[i] - truth;
        add(&all, error * error, true);
        add(&penumbra, error * error, truth > 0.02 && truth < 0.98);
        add(&contact, error * error, c->distance[i] < CONTACT);
        add(&leak, (double)c->visibility[i], truth == 0.0);
        add(&over, fmax(-error - 0.02, 0.0), true);
    }
    e->rmse = sqrt(mean_of(&all));
    e->penumbra = sqrt(mean_of(&penumbra));
    e->contact = sqrt(mean_of(&contact));
    e->leak = mean_of(&leak);
    e->over = mean_of(&over);
}

/* ---- the sheet ------------------------------------------------------------------------------------ */

static void paint(const comparison *c, size_t cell, uint8_t value[3], uint8_t error[3]) {
    static const uint8_t WALL[3] = {40, 60, 90};
    double v = (double)c->visibility[cell], wrong = 4.0 * (v - (double)c->truth[cell]);
    uint8_t grey = (uint8_t)(v * 255.0 + 0.5), much = (uint8_t)(fmin(fabs(wrong), 1.0) * 255.0 + 0.5);
    for (int k = 0; k < 3; k++) {
        value[k] = c->opaque[cell] ? WALL[k] : grey;
        error[k] = c->opaque[cell] ? WALL[k] : 0;
    }
    if (!c->opaque[cell])
        error[wrong > 0.0 ? 0 : 2] = much;
}

static void paint_tile(const comparison *c, int index, uint8_t *sheet) {
    int32_t sheet_width = COLUMNS * c->tile_width, left = index % COLUMNS * c->tile_width;
    int32_t top = index / COLUMNS * 2 * c->tile_height, width = c->job->scene.width;
    for (int32_t y = 0; y < c->height; y++)
        for (int32_t x = 0; x < c->width; x++) {
            size_t cell = (size_t)(y * c->shrink) * (size_t)width + (size_t)(x * c->shrink);
            size_t at = (size_t)(top + y) * (size_t)sheet_width + (size_t)(left + x);
            size_t below = at + (size_t)c->tile_height * (size_t)sheet_width;
            paint(c, cell, sheet + 3 * at, sheet + 3 * below);
        }
}

/* ---- rows ----------------------------------------------------------------------------------------- */

static json_t *entry_json(const entry *e) {
    return json_pack("{s:s, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "method", e->name, "rmse", e->rmse,
                     "penumbra", e->penumbra, "contact", e->contact, "leak", e->leak, "over_shadow", e->over,
                     "ms", e->ms, "ns_per_pixel", e->ns_per_pixel, "fetches_per_pixel", e->fetches_per_pixel);
}

static int run_entry(comparison *c, const dpl_shadow_desc *desc, entry *e) {
    e->ms = INFINITY;
    for (int run = 0; run < RUNS; run++) {
        dpl_shadow_stats stats;
        int status = dpl_shadow_solve(c->job, desc, c->visibility, &stats);
        if (status != DPL_EXIT_DONE)
            return status;
        double pixels = stats.pixels > 0 ? (double)stats.pixels : 1.0;
        e->ms = fmin(e->ms, stats.map_ms + stats.solve_ms);
        e->ns_per_pixel = e->ms * 1e6 / pixels;
        e->fetches_per_pixel = (double)stats.fetches / pixels;
    }
    measure(c, e);
    printf("%-32s %7.4f %8.4f %7.4f %7.4f %7.4f %8.1f %7.0f %7.1f\n", e->name, e->rmse, e->penumbra,
           e->contact, e->leak, e->over, e->ms, e->ns_per_pixel, e->fetches_per_pixel);
    c->rows = dpl_json_append(c->rows, entry_json(e));
    return DPL_EXIT_DONE;
}

static int run_all(comparison *c, uint8_t *sheet) {
    dpl_shadow_desc desc = c->job->order->shadow;
    entry e;
    desc.method = DPL_SHADOW_REFERENCE;
    int status = dpl_shadow_solve(c->job, &desc, c->truth, &c->job->stats);
    if (status != DPL_EXIT_DONE)
        return status;
    memcpy(c->visibility, c->truth, c->pixels * sizeof *c->truth);
    paint_tile(c, 0, sheet);
    desc = c->job->order->shadow;
    desc.samples = 0; /* those were for the reference */
    const dpl_shadow_desc base = desc;
    printf("%-32s %7s %8s %7s %7s %7s %8s %7s %7s\n", "method", "rmse", "penumbra", "contact", "leak", "over",
           "ms", "ns/px", "fetch/px");
    for (int i = 0; choose(&base, i, &desc, e.name); i++) {
        status = run_entry(c, &desc, &e);
        if (status != DPL_EXIT_DONE)
            return status;
        paint_tile(c, i + 1, sheet);
    }
    return DPL_EXIT_DONE;
}

/* ---- all ------------------------------------------------------------------------------------------ */

static int count_entries(const dpl_shadow_desc *base) {
    dpl_shadow_desc desc;
    char name[40];
    int count = 0;
    while (choose(base, count, &desc, name))
        count++;
    return count;
}

static bool open_comparison(comparison *c) {
    const dpl_scene *scene = &c->job->scene;
    int32_t larger = scene->width > scene->height ? scene->width : scene->height;
    c->pixels = (size_t)scene->width * (size_t)scene->height;
    c->truth = malloc(c->pixels * sizeof(float));
    c->visibility = malloc(c->pixels * sizeof(float));
    c->distance = malloc(c->pixels * sizeof(float));
    c->opaque = malloc(c->pixels);
    c->shrink = (larger + TILE_MOST - 1) / TILE_MOST;
    c->width = scene->width / c->shrink;
    c->height = scene->height / c->shrink;
    c->tile_width = c->width + GAP;
    c->tile_height = c->height + GAP;
    c->rows = json_array();
    return c->truth && c->visibility && c->distance && c->opaque;
}

static void close_comparison(comparison *c) {
    free(c->truth);
    free(c->visibility);
    free(c->distance);
    free(c->opaque);
    json_decref(c->rows);
}

static int write_rows(comparison *c) {
    dpl_error error;
    const char *path = c->job->order->stats;
    if (!path)
        return DPL_EXIT_DONE;
    char *text =
        dpl_json_text(json_pack("{s:s, s:O}", "scene", c->job->order->scene, "methods", c->rows), &error);
    bool good = text && dpl_file_write(path, text, strlen(text), &error);
    free(text);
    return good ? DPL_EXIT_DONE : dpl_report_failure("%s", error.text);
}

static int compare_into(comparison *c, uint8_t *sheet, int rows) {
    dpl_error error;
    if (dpl_field_read_distance(c->job->field, c->distance, 0) != DPL_OK ||
        dpl_field_read_opaque(c->job->field, c->opaque, 0) != DPL_OK)
        return dpl_report_status(c->job->context, DPL_ERROR_MEMORY);
    int status = run_all(c, sheet);
    if (status == DPL_EXIT_DONE && !dpl_picture_write_png(c->job->order->output, COLUMNS * c->tile_width,
                                                          rows * 2 * c->tile_height, 3, sheet, &error))
        status = dpl_report_failure("%s", error.text);
    return status == DPL_EXIT_DONE ? write_rows(c) : status;
}

int dpl_shadow_compare(dpl_shadow_job *job) {
    comparison c = {.job = job};
    int rows = count_entries(&job->order->shadow) / COLUMNS + 1, status = DPL_EXIT_FAILED;
    bool good = open_comparison(&c);
    uint8_t *sheet =
        good ? calloc((size_t)(COLUMNS * c.tile_width) * (size_t)(rows * 2 * c.tile_height), 3) : NULL;
    if (sheet)
        status = compare_into(&c, sheet, rows);
    else
        status = dpl_report_status(NULL, DPL_ERROR_MEMORY);
    free(sheet);
    close_comparison(&c);
    return status;
}
