/* From a light to a plane of visibility, and from lights to a picture: what every method shares. Called by
 * src/api/shadow.c. */
#include "shadow/shadow.h"

#include "job/jobs.h"
#include "os/machine.h"
#include "shadow/exact_lines.h"
#include "solver/solver.h"

#include <math.h>

/* Calls of the progress hook in a whole run. */
#define PROGRESS_STEPS 200
/* Of the ray map: 56 err by 0.0046 on the eight scenes, 32 by 0.0065. */
#define DEFAULT_RAYS 56
#define DEFAULT_BLEND_RAYS 32

static const dpl_shadow_ops methods[DPL_SHADOW_METHOD_COUNT] = {
    [DPL_SHADOW_EXACT] = {"exact", 0, dpl_shadow_exact},
    [DPL_SHADOW_REFERENCE] = {"reference", 0, dpl_shadow_truth},
    [DPL_SHADOW_MOMENTS_2] = {"moments-2", DPL_NEEDS_MAP, dpl_shadow_moments_2},
    [DPL_SHADOW_MOMENTS_EXPONENTIAL] = {"moments-evsm", DPL_NEEDS_MAP, dpl_shadow_moments_exponential},
    [DPL_SHADOW_MOMENTS_4] = {"moments-4", DPL_NEEDS_MAP, dpl_shadow_moments_4},
    [DPL_SHADOW_MOMENTS_SOFT] = {"moments-soft", DPL_NEEDS_MAP, dpl_shadow_moments_soft},
    [DPL_SHADOW_PCSS] = {"pcss", DPL_NEEDS_MAP, dpl_shadow_pcss},
    [DPL_SHADOW_DISTANCE_HARD] = {"distance-hard", DPL_NEEDS_INSIDE, dpl_shadow_hard},
    [DPL_SHADOW_DISTANCE_QUILEZ] = {"distance-quilez", DPL_NEEDS_INSIDE, dpl_shadow_quilez},
    [DPL_SHADOW_DISTANCE_AALTONEN] = {"distance-aaltonen", DPL_NEEDS_INSIDE, dpl_shadow_aaltonen},
    [DPL_SHADOW_DISTANCE_SIGNED] = {"distance-signed", DPL_NEEDS_INSIDE, dpl_shadow_signed},
    [DPL_SHADOW_DISTANCE_TWO_SIDED] = {"distance-two-sided", DPL_NEEDS_INSIDE, dpl_shadow_two_sided},
    [DPL_SHADOW_DISTANCE_CONES] = {"distance-cones", DPL_NEEDS_INSIDE, dpl_shadow_cones},
    [DPL_SHADOW_MRMA] = {"mrma", DPL_NEEDS_INSIDE, dpl_shadow_blend},
    [DPL_SHADOW_RAYS] = {"rays", DPL_NEEDS_RAYS, dpl_shadow_exact},
};

const dpl_shadow_ops *dpl_shadow_ops_of(dpl_shadow_method method) {
    return (uint32_t)method < DPL_SHADOW_METHOD_COUNT ? &methods[method] : NULL;
}

/* M.R.M.A. needs what its map term needs, too. */
static int needs_of(const dpl_shadow_desc *desc) {
    int needs = dpl_shadow_ops_of(desc->method)->needs;
    if (desc->method != DPL_SHADOW_MRMA)
        return needs;
    bool rays = desc->map_method == DPL_SHADOW_RAYS && desc->weight != DPL_WEIGHT_LITERAL;
    return needs | (rays ? DPL_NEEDS_RAYS : DPL_NEEDS_MAP);
}

/* Is what the ray map says the result, or only a term of it? */
static bool is_looked_up(const dpl_shadow_desc *desc, const dpl_ray_map *map) {
    return map->rays > 0 && (desc->method == DPL_SHADOW_RAYS ||
                             (desc->method == DPL_SHADOW_MRMA && dpl_shadow_map_is_enough(desc)));
}

/* ---- one light, row by row ------------------------------------------------------------------------ */

/* A light being added to what is there: V alone (rgb NULL), or its radiance. */
typedef struct lighting {
    dpl_shadow_view view;
    const dpl_shadow_ops *ops;
    bool is_reference;
    bool classify;
    bool in_lines;   /* receivers are taken many at a time, by exact_lines.c */
    double color[3]; /* times intensity */
    float *plane;    /* V of the picture's pixels, or NULL */
    float (*rgb)[3]; /* sum of light of the picture's pixels, or NULL */
    struct {
        dpl_shadow_counts counts;
        char padding[64];
    } workers[DPL_MAX_THREADS];
} lighting;

bool dpl_receiver_at(const dpl_shadow_view *view, int32_t x, int32_t y, dpl_receiver *r) {
    r->pixel[0] = x;
    r->pixel[1] = y;
    r->x = x + 0.5;
    r->y = y + 0.5;
    double dx = view->position[0] - r->x, dy = view->position[1] - r->y;
    r->distance = sqrt(dx * dx + dy * dy);
    if (r->distance <= view->radius)
        return false;
    r->dx = dx / r->distance;
    r->dy = dy / r->distance;
    r->sine = view->radius / r->distance;
    r->angle = asin(r->sine);
    return true;
}

/* A stretch of a row, in world coordinates, and what is known of its pixels before a method works on them. */
enum { STRETCH = 256 };

/* What is neither lit nor dark nor open, in stretch.class. */
enum { OPAQUE = DPL_SHADOW_OPEN + 1 };

typedef struct stretch {
    int32_t x, y, count;
    int32_t open;           /* pixels that a method has to work on */
    const uint8_t *kind;    /* of the field */
    uint8_t class[STRETCH]; /* dpl_shadow_class or OPAQUE */
    float known[STRETCH];   /* V, below 0: not known */
} stretch;

/* V of one pixel that is not opaque; `through` receives what is left of the light's colour per channel, V
 * and media together, where `rgb` is wanted. */
static double see(lighting *l, const dpl_receiver *r, bool inside, float known, double through[3],
                  dpl_shadow_counts *counts) {
    double v = inside ? 1.0 : (double)known;
    if (!inside && known < 0.0f && l->is_reference && l->rgb)
        return dpl_shadow_truth_rgb(&l->view, r, through, counts);
    if (v < 0.0)
        v = l->ops->visibility(&l->view, r, counts);
    through[0] = through[1] = through[2] = 1.0;
    if (!inside && l->rgb && v > 0.0 && l->view.field->extinction.data)
        dpl_shadow_medium(&l->view, r, through);
    for (int c = 0; c < 3; c++)
        through[c] *= v;
    return v;
}

/* One pixel that is not opaque; `cell`: in the picture. */
static void light_pixel(lighting *l, stretch *s, int32_t i, size_t cell, dpl_shadow_counts *counts) {
    dpl_receiver r;
    double through[3];
    bool inside = !dpl_receiver_at(&l->view, s->x + i, s->y, &r);
    if (inside && s->class[i] == DPL_SHADOW_OPEN) {
        counts->worked--;
        counts->lit++;
    }
    double v = see(l, &r, inside, s->known[i], through, counts);
    s->known[i] = (float)v;
    static const double PI = 3.14159265358979323846;
    double share = inside ? 1.0 : r.angle / PI;
    for (int c = 0; c < 3 && l->rgb; c++)
        l->rgb[cell][c] += (float)(through[c] * l->color[c] * share);
}

/* What one look at the horizon says, and how many pixels there are of each class. */
static void classify(const lighting *l, stretch *s, dpl_shadow_counts *counts) {
    static const float values[] = {
        [DPL_SHADOW_LIT] = 1.0f, [DPL_SHADOW_DARK] = 0.0f, [DPL_SHADOW_OPEN] = -1.0f, [OPAQUE] = 0.0f};
    dpl_horizon_table table = dpl_horizon_table_of(l->view.horizon);
    float dx = (float)(s->x + 0.5 - l->view.position[0]), dy = (float)(s->y + 0.5 - l->view.position[1]);
    if (l->classify)
        l->view.field->context->kernels->look_round(&table, s->count, s->class, dx, dy);
    else
        memset(s->class, DPL_SHADOW_OPEN, (size_t)s->count);
    int64_t tally = 0; /* 16 bits for each class */
    for (int32_t i = 0; i < s->count; i++) {
        s->class[i] = s->kind[i] == DPL_PIXEL_OPAQUE ? OPAQUE : s->class[i];
        s->known[i] = values[s->class[i]];
        tally += (int64_t)1 << 16 * s->class[i];
    }
    s->open = (int32_t)(tally >> 16 * DPL_SHADOW_OPEN & 0xffff);
    counts->lit += tally >> 16 * DPL_SHADOW_LIT & 0xffff;
    counts->dark += tally >> 16 * DPL_SHADOW_DARK & 0xffff;
    counts->worked += s->open;
    counts->pixels += s->count - (tally >> 16 * OPAQUE);
}

/* Looks the open pixels up in the ray map, all at once. */
static void look_up(const lighting *l, stretch *s, dpl_shadow_counts *counts) {
    const dpl_ray_map *map = l->view.rays;
    float dx[STRETCH], dy[STRETCH], visible[STRETCH], row = (float)(s->y + 0.5 - l->view.position[1]);
    float near = (float)(DPL_RAY_MAP_NEAR * l->view.radius);
    int32_t pixel[STRETCH], count = 0;
    for (int32_t i = 0; i < s->count; i++) {
        float x = (float)(s->x + i + 0.5 - l->view.position[0]);
        if (s->known[i] >= 0.0f || x * x + row * row <= near * near)
            continue;
        dx[count] = x;
        dy[count] = row;
        pixel[count++] = i;
    }
    l->view.field->context->kernels->see_rays(map, count, visible, dx, dy);
    for (int32_t i = 0; i < count; i++)
        s->known[pixel[i]] = visible[i];
    counts->fetches += (int64_t)count * map->rays;
    counts->map_only += l->view.desc->method == DPL_SHADOW_MRMA ? count : 0;
}

/* Has a line of receivers looked at, and notes what they see. */
static void see_line(const lighting *l, stretch *rows, dpl_receiver_line *line, dpl_shadow_counts *counts) {
    if (line->count == 0)
        return;
    dpl_shadow_exact_line(&l->view, line, counts);
    for (int32_t i = 0; i < line->count; i++) {
        int32_t x = line->turned ? line->v[i] : line->u, y = line->turned ? line->u : line->v[i];
        rows[y - rows->y].known[x - rows->x] = line->visible[i];
    }
    line->count = 0;
}

/* Open pixels of a row that look along y more than along x, 16 at a time; the others, bit by bit, are left in
 * `flat` by their column. */
static void see_row(const lighting *l, stretch *rows, int32_t row, uint32_t *flat,
                    dpl_shadow_counts *counts) {
    const stretch *s = &rows[row];
    dpl_receiver_line line = {.turned = true, .u = s->y};
    double dy = fabs(s->y + 0.5 - l->view.position[1]), near = DPL_EXACT_LINES_NEAR * l->view.radius;
    for (int32_t i = 0; i < s->count && s->open > 0; i++) {
        if ((s->x + i) % DPL_RECEIVERS == 0)
            see_line(l, rows, &line, counts);
        double dx = fabs(s->x + i + 0.5 - l->view.position[0]);
        if (s->known[i] >= 0.0f || dx * dx + dy * dy <= near * near)
            continue;
        if (dy > dx)
            line.v[line.count++] = s->x + i;
        else
            flat[i] |= 1u << row;
    }
    see_line(l, rows, &line, counts);
}

/* Open pixels of some rows. */
static void see_lines(const lighting *l, stretch *rows, int32_t count, dpl_shadow_counts *counts) {
    uint32_t flat[STRETCH] = {0};
    for (int32_t row = 0; row < count; row++)
        see_row(l, rows, row, flat, counts);
    for (int32_t i = 0; i < rows->count; i++) {
        dpl_receiver_line line = {.u = rows->x + i};
        for (int32_t row = 0; row < count && flat[i]; row++)
            if (flat[i] >> row & 1)
                line.v[line.count++] = rows->y + row;
        see_line(l, rows, &line, counts);
    }
}

/* `cell`: of the first pixel, in the picture. */
static void light_stretch(lighting *l, stretch *s, size_t cell, dpl_shadow_counts *counts) {
    for (int32_t i = 0; i < s->count && (l->rgb || s->open > 0); i++)
        if (s->known[i] < 0.0f || (l->rgb && s->class[i] != OPAQUE))
            light_pixel(l, s, i, cell + (size_t)i, counts);
    if (l->plane)
        memcpy(l->plane + cell, s->known, (size_t)s->count * sizeof *l->plane);
}

/* Rows of a band in the world: a band is as high as a line of receivers is long. */
enum { BAND = DPL_RECEIVERS };

/* The part of a band's rows from column x on. */
static void light_block(lighting *l, int32_t x, int32_t y, int32_t rows, dpl_shadow_counts *counts) {
    const dpl_field *field = l->view.field;
    int32_t width = dpl_field_picture_width(field), left = field->margin + width - x;
    stretch s[BAND];
    s[0].count = 0;
    for (int32_t row = 0; row < rows; row++) {
        s[row].x = x;
        s[row].y = y + row;
        s[row].count = left < STRETCH ? left : STRETCH;
        s[row].kind = (const uint8_t *)field->kind.data + dpl_field_cell(field, x, y + row);
        classify(l, &s[row], counts);
        if (s[row].open > 0 && is_looked_up(l->view.desc, l->view.rays))
            look_up(l, &s[row], counts);
    }
    if (l->in_lines)
        see_lines(l, s, rows, counts);
    for (int32_t row = 0; row < rows; row++)
        light_stretch(l, &s[row],
                      (size_t)(y + row - field->margin) * (size_t)width + (size_t)(x - field->margin),
                      counts);
}

/* Rows of the world that are one item of work: a line of receivers, where they are taken in lines. */
static int32_t rows_per_item(const lighting *l) {
    return l->in_lines ? BAND : 1;
}

/* Work from an item on: so it is cut for the progress hook. Items count from the world's first row, so that
 * it does not show how it was cut. */
typedef struct rows_task {
    lighting *l;
    int32_t first;
} rows_task;

static void light_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    const rows_task *t = task;
    lighting *l = t->l;
    dpl_shadow_counts counts = l->workers[worker].counts;
    int32_t margin = l->view.field->margin, behind = l->view.field->height - margin, rows = rows_per_item(l);
    for (int32_t item = begin + t->first; item < end + t->first; item++) {
        int32_t top = item * rows > margin ? item * rows : margin,
                bottom = (item + 1) * rows < behind ? (item + 1) * rows : behind;
        for (int32_t x = margin; x < l->view.field->width - margin; x += STRETCH)
            light_block(l, x, top, bottom - top, &counts);
    }
    l->workers[worker].counts = counts;
}

/* `done` and `share`: of the whole run, what is done before this light and what it makes up. */
static dpl_status run_items(dpl_shadow *shadow, lighting *l, double done, double share) {
    int32_t margin = l->view.field->margin, rows = rows_per_item(l), begin = margin / rows;
    int32_t items = (l->view.field->height - margin - 1) / rows + 1 - begin, step = items;
    if (shadow->desc.progress)
        step = (int32_t)(items / (share * PROGRESS_STEPS)) + 1;
    for (int32_t first = 0; first < items; first += step) {
        rows_task task = {l, begin + first};
        int32_t count = items - first < step ? items - first : step;
        DPL_TRY(dpl_jobs_run(shadow->context, light_items, count, rows > 1 ? 1 : 2, &task));
        double now = done + share * (first + count) / items;
        if (shadow->desc.progress && !shadow->desc.progress(now, shadow->desc.progress_user))
            return dpl_fail(shadow->context, DPL_ERROR_CANCELLED, "cancelled at %.0f %%", 100.0 * now);
    }
    return DPL_OK;
}

/* ---- what a light needs --------------------------------------------------------------------------- */

static dpl_status prepare_world(dpl_shadow *shadow, const dpl_field *field, const dpl_shadow_ops *ops) {
    bool inside = ops->needs & DPL_NEEDS_INSIDE;
    if (ops->visibility == dpl_shadow_truth)
        return DPL_OK;
    DPL_TRY(dpl_solid_update(&shadow->solid, field, inside));
    return dpl_mips_update(&shadow->mips, shadow->context, &shadow->solid, shadow->desc.field_level);
}

static dpl_status prepare_light(dpl_shadow *shadow, lighting *l) {
    const double *position = l->view.position;
    if (l->classify)
        DPL_TRY(
            dpl_horizon_make(&shadow->horizon, shadow->context, &shadow->solid, position, l->view.radius));
    const dpl_shadow_desc *desc = &shadow->desc;
    int needs = needs_of(desc);
    int32_t rays =
        desc->method == DPL_SHADOW_RAYS ? desc->samples ? desc->samples : DEFAULT_RAYS : DEFAULT_BLEND_RAYS;
    shadow->rays.map.rays = 0;
    if (needs & DPL_NEEDS_RAYS)
        DPL_TRY(dpl_ray_table_make(&shadow->rays, shadow->context, &shadow->solid, position, l->view.radius,
                                   rays));
    if (!(needs & DPL_NEEDS_MAP))
        return DPL_OK;
    return dpl_polar_map_make(&shadow->map, shadow->context, &shadow->solid, position,
                              shadow->desc.map_resolution,
                              shadow->desc.method == DPL_SHADOW_MOMENTS_EXPONENTIAL);
}

static void add_counts(dpl_shadow_stats *stats, const lighting *l) {
    for (int i = 0; i < DPL_MAX_THREADS; i++) {
        const dpl_shadow_counts *c = &l->workers[i].counts;
        stats->pixels += c->pixels;
        stats->lit += c->lit;
        stats->dark += c->dark;
        stats->worked += c->worked;
        stats->steps += c->steps;
        stats->fetches += c->fetches;
        stats->map_only += c->map_only;
        stats->field_only += c->field_only;
    }
}

/* One light, into a plane of V or added to a sum of light. */
static dpl_status add_light(dpl_shadow *shadow, const dpl_field *field, const dpl_light *light, float *plane,
                            float (*rgb)[3], double done, double share, dpl_shadow_stats *stats) {
    lighting l = {
        .view = {.desc = &shadow->desc,
                 .field = field,
                 .solid = &shadow->solid,
                 .mips = &shadow->mips,
                 .horizon = &shadow->horizon,
                 .map = &shadow->map,
                 .rays = &shadow->rays.map,
                 .position = {light->position[0] + field->margin, light->position[1] + field->margin},
                 .radius = light->radius},
        .ops = dpl_shadow_ops_of(shadow->desc.method),
        .is_reference = shadow->desc.method == DPL_SHADOW_REFERENCE,
        .plane = plane,
        .rgb = rgb,
    };
    l.classify = shadow->desc.classify && !l.is_reference;
    l.in_lines = shadow->desc.method == DPL_SHADOW_EXACT && light->radius >= DPL_EXACT_LINES_RADIUS;
    for (int c = 0; c < 3; c++)
        l.color[c] = (double)light->color[c] * (double)light->intensity;
    double start = dpl_clock_ms();
    DPL_TRY(prepare_light(shadow, &l));
    double prepared = dpl_clock_ms();
    DPL_TRY(run_items(shadow, &l, done, share));
    stats->map_ms += prepared - start;
    stats->solve_ms += dpl_clock_ms() - prepared;
    stats->lights++;
    add_counts(stats, &l);
    return DPL_OK;
}

/* ---- whole runs ----------------------------------------------------------------------------------- */

static int64_t memory_of(const dpl_shadow *shadow) {
    const dpl_buffer *buffers[] = {
        &shadow->solid.block_rows, &shadow->solid.block_columns, &shadow->solid.rows,
        &shadow->solid.columns,    &shadow->solid.distance,      &shadow->solid.scratch,
        &shadow->horizon.bins,     &shadow->horizon.angles,      &shadow->horizon.work,
        &shadow->map.distances,    &shadow->map.nearest,         &shadow->map.warped_sums,
        &shadow->map.table_sums,   &shadow->mips.levels[0],      &shadow->mips.levels[1],
        &shadow->mips.levels[2],   &shadow->mips.levels[3],      &shadow->result,
        &shadow->rays.reach,       &shadow->rays.offsets,
    };
    int64_t sum = 0;
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        sum += (int64_t)buffers[i]->bytes;
    return sum;
}

static size_t picture_pixels(const dpl_field *field) {
    return (size_t)dpl_field_picture_width(field) * (size_t)dpl_field_picture_height(field);
}

static dpl_status begin(dpl_shadow *shadow, const dpl_field *field, size_t floats, dpl_shadow_stats *stats) {
    double start = dpl_clock_ms();
    DPL_TRY(
        dpl_buffer_reserve(shadow->context, &shadow->result, picture_pixels(field), floats * sizeof(float)));
    DPL_TRY(prepare_world(shadow, field, dpl_shadow_ops_of(shadow->desc.method)));
    memset(stats, 0, sizeof *stats);
    stats->field_ms = dpl_clock_ms() - start;
    return DPL_OK;
}

static void finish(dpl_shadow *shadow, const dpl_shadow_stats *stats) {
    shadow->stats = *stats;
    shadow->stats.memory_bytes = memory_of(shadow);
}

dpl_status dpl_shadow_find_visibility(dpl_shadow *shadow, const dpl_field *field, const dpl_light *light,
                                      float *visibility, ptrdiff_t row_stride) {
    dpl_shadow_stats stats;
    DPL_TRY(begin(shadow, field, 1, &stats));
    DPL_TRY(add_light(shadow, field, light, shadow->result.data, NULL, 0.0, 1.0, &stats));
    const float *plane = shadow->result.data;
    size_t width = (size_t)dpl_field_picture_width(field);
    for (int32_t y = 0; y < dpl_field_picture_height(field); y++)
        memcpy((char *)visibility + row_stride * y, plane + (size_t)y * width, width * sizeof *plane);
    finish(shadow, &stats);
    return DPL_OK;
}

dpl_status dpl_shadow_find_light(dpl_shadow *shadow, const dpl_field *field, const dpl_light *lights,
                                 int32_t count, const dpl_output *output) {
    dpl_shadow_stats stats;
    DPL_TRY(begin(shadow, field, 3, &stats));
    float(*rgb)[3] = shadow->result.data;
    memset(rgb, 0, picture_pixels(field) * sizeof *rgb);
    for (int32_t i = 0; i < count; i++)
        DPL_TRY(add_light(shadow, field, &lights[i], NULL, rgb, (double)i / count, 1.0 / count, &stats));
    for (int32_t y = 0; y < output->height; y++)
        dpl_solver_write_pixels(field, output, 0, y, output->width,
                                (const float(*)[3])rgb + (size_t)y * (size_t)output->width);
    finish(shadow, &stats);
    return DPL_OK;
}
