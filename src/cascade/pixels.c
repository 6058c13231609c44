/* Bilinear interpolation that does not mix in probes which stand inside walls or outside the picture: those
 * see another place than the pixel does. */
#include "cascade/pixels.h"

#include "cascade/level.h"
#include "job/jobs.h"

/* How many probes further a pixel looks when none of the four around it is usable. */
#define FURTHEST_RING 3

typedef struct output_task {
    const dpl_probe_plane *probes;
    const dpl_field *field;
    const dpl_output *output;
    float *rows;
    void (*pixel)(const struct output_task *task, int32_t x, int32_t y, float rgb[3]);
} output_task;

/* Mean over the slots of level 0 at one probe, one channel. */
static float probe_mean(const dpl_probe_plane *probes, int channel, int32_t probe_x, int32_t probe_y) {
    float sum = 0.0f;
    for (int32_t slot = 0; slot < probes->plan->slots; slot++)
        sum += probes->radiance[dpl_level_row(probes->plan, slot, channel, probe_y) + (size_t)probe_x];
    return sum / (float)probes->plan->slots;
}

/* Does the probe exist and stand in the picture, and in a pixel that is not opaque unless walls will do? */
static bool probe_is_usable(const output_task *task, int32_t probe_x, int32_t probe_y, bool walls_will_do) {
    const dpl_schedule_level *plan = task->probes->plan;
    const dpl_field *field = task->field;
    if (probe_x < 0 || probe_y < 0 || probe_x >= plan->probes_x || probe_y >= plan->probes_y)
        return false;
    int32_t x = (int32_t)((probe_x + 0.5) * plan->spacing), y = (int32_t)((probe_y + 0.5) * plan->spacing);
    if (x >= field->width || y >= field->height)
        return walls_will_do;
    return walls_will_do || !dpl_field_is_opaque(field, x, y);
}

/* Sums light and weights of usable probes. */
typedef struct probe_sum {
    const output_task *task;
    bool walls_will_do;
    float weight;
    float rgb[3];
} probe_sum;

static void add_probe(probe_sum *sum, int32_t probe_x, int32_t probe_y, float weight) {
    if (weight == 0.0f || !probe_is_usable(sum->task, probe_x, probe_y, sum->walls_will_do))
        return;
    sum->weight += weight;
    for (int c = 0; c < 3; c++)
        sum->rgb[c] += weight * probe_mean(sum->task->probes, c, probe_x, probe_y);
}

/* The lower of the two probes around a pixel in one axis, and the share of the upper one. */
static int32_t lower_probe(int32_t pixel, double spacing, float *upper_share) {
    double u = (pixel + 0.5) / spacing - 0.5, low = floor(u);
    *upper_share = (float)(u - low);
    return (int32_t)low;
}

/* Adds the four probes around a pixel by distance (ring 0), or all in a square around them alike. */
static void add_around(probe_sum *sum, int32_t x, int32_t y, int32_t ring) {
    float share_x, share_y;
    int32_t left = lower_probe(x, sum->task->probes->plan->spacing, &share_x);
    int32_t above = lower_probe(y, sum->task->probes->plan->spacing, &share_y);
    if (ring == 0) {
        add_probe(sum, left, above, (1.0f - share_x) * (1.0f - share_y));
        add_probe(sum, left + 1, above, share_x * (1.0f - share_y));
        add_probe(sum, left, above + 1, (1.0f - share_x) * share_y);
        add_probe(sum, left + 1, above + 1, share_x * share_y);
        return;
    }
    for (int32_t v = above - ring; v <= above + 1 + ring; v++)
        for (int32_t u = left - ring; u <= left + 1 + ring; u++)
            add_probe(sum, u, v, 1.0f);
}

/* The four probes around a pixel; in a corridor narrower than the spacing the mean of the nearest ring that
 * has a usable one; in a hole that no probe reaches, the walls around it. */
static void interpolate_pixel(const output_task *task, int32_t x, int32_t y, float rgb[3]) {
    probe_sum sum = {.task = task};
    for (int32_t ring = 0; ring <= FURTHEST_RING && sum.weight == 0.0f; ring++)
        add_around(&sum, x, y, ring);
    if (sum.weight == 0.0f) {
        sum.walls_will_do = true;
        add_around(&sum, x, y, 0);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = sum.rgb[c] / sum.weight;
}

/* Distance from a shape at which its own colour begins to show, and over which it takes over [px]. */
#define BLEND_FROM 3.0f

static void blend_pixel(const output_task *task, int32_t x, int32_t y, float rgb[3]) {
    const dpl_field *field = task->field;
    const float *surface = ((const float(*)[4])field->surface.data)[dpl_field_cell(field, x, y)];
    probe_sum sum = {.task = task, .walls_will_do = true};
    float near = fminf(fmaxf(BLEND_FROM - surface[0], 0.0f), 1.0f);
    add_around(&sum, x, y, 0);
    for (int c = 0; c < 3; c++) {
        float light = sum.rgb[c] / sum.weight;
        rgb[c] = light + (surface[1 + c] - light) * near;
    }
}

/* With a probe in every pixel a free pixel's own probe has weight 1 and its neighbours 0: the same bits
 * without looking around. Walls show their emission whatever this gives. */
static void copy_probes(const dpl_probe_plane *probes, int32_t y, float *const planes[3]) {
    int32_t width = probes->plan->probes_x, slots = probes->plan->slots;
    for (int c = 0; c < 3; c++) {
        for (int32_t x = 0; x < width; x++)
            planes[c][x] = 0.0f;
        for (int32_t slot = 0; slot < slots; slot++) {
            const float *row = probes->radiance + dpl_level_row(probes->plan, slot, c, y);
            for (int32_t x = 0; x < width; x++)
                planes[c][x] += row[x];
        }
        for (int32_t x = 0; x < width; x++)
            planes[c][x] /= (float)slots;
    }
}

/* Items are rows of the picture. */
static void write_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    const output_task *t = task;
    size_t width = (size_t)t->field->width;
    float *planes[3];
    for (int c = 0; c < 3; c++)
        planes[c] = t->rows + ((size_t)worker * 3 + (size_t)c) * width;
    const int32_t margin = t->field->margin;
    bool copies = t->pixel == interpolate_pixel && t->probes->plan->spacing == 1.0;
    for (int32_t y = begin + margin; y < end + margin; y++) {
        if (copies)
            copy_probes(t->probes, y, planes);
        for (int32_t x = margin; x < t->field->width - margin && !copies; x++) {
            float rgb[3];
            t->pixel(t, x, y, rgb);
            for (int c = 0; c < 3; c++)
                planes[c][x] = rgb[c];
        }
        dpl_solver_write_row(t->field, t->output, y, (const float *const *)planes,
                             t->pixel == interpolate_pixel);
    }
}

dpl_status dpl_probes_to_pixels(dpl_context *context, const dpl_probe_plane *probes, const dpl_field *field,
                                const dpl_output *output, float *rows) {
    output_task task = {probes, field, output, rows, interpolate_pixel};
    return dpl_jobs_run(context, write_rows, dpl_field_picture_height(field), 8, &task);
}

dpl_status dpl_probes_to_blended_pixels(dpl_context *context, const dpl_probe_plane *probes,
                                        const dpl_field *field, const dpl_output *output, float *rows) {
    output_task task = {probes, field, output, rows, blend_pixel};
    return dpl_jobs_run(context, write_rows, dpl_field_picture_height(field), 8, &task);
}
