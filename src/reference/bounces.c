/* B_0 = 0, B_n = albedo * (cosine-weighted mean, over the half circle before a face, of what is seen there
 * when walls send out emission + B_(n-1), and of lights). Every face is written by one item, so threads
 * cannot show. */
#include "reference/bounces.h"

#include "reference/light.h"

#include <math.h>

/* Directions less than this above a face's plane are in it, up to rounding. */
#define LOWEST_COSINE 1e-9

/* What lies before face f: a step in x and y. */
static const int32_t outward[DPL_FACE_COUNT][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/* ---- which faces reflect -------------------------------------------------------------------------- */

static uint8_t exposed_faces(const dpl_field *field, int32_t x, int32_t y) {
    uint8_t exposed = 0;
    for (int f = 0; f < DPL_FACE_COUNT; f++) {
        int32_t u = x + outward[f][0], v = y + outward[f][1];
        bool inside = u >= 0 && v >= 0 && u < field->width && v < field->height;
        if (inside && !dpl_field_is_opaque(field, u, v))
            exposed |= (uint8_t)(1u << f);
    }
    return exposed;
}

static bool has_albedo(const dpl_field *field, size_t cell) {
    const float(*albedo)[4] = (const float(*)[4])field->albedo.data;
    return albedo && (albedo[cell][0] > 0.0f || albedo[cell][1] > 0.0f || albedo[cell][2] > 0.0f);
}

/* Numbers the reflectors row by row and lists them where there is a list; returns how many there are. */
static int32_t number_reflectors(const dpl_field *field, int32_t *number, dpl_reflector *list) {
    int32_t count = 0;
    for (int32_t y = 0; y < field->height; y++)
        for (int32_t x = 0; x < field->width; x++) {
            size_t cell = dpl_field_cell(field, x, y);
            bool reflects = dpl_field_is_opaque(field, x, y) && has_albedo(field, cell);
            dpl_reflector reflector = {x, y, reflects ? exposed_faces(field, x, y) : 0};
            number[cell] = reflector.exposed ? count : -1;
            if (reflector.exposed && list)
                list[count] = reflector;
            count += reflector.exposed != 0;
        }
    return count;
}

static int64_t count_faces(const dpl_reflector *list, int32_t count) {
    int64_t faces = 0;
    for (int32_t i = 0; i < count; i++)
        for (int f = 0; f < DPL_FACE_COUNT; f++)
            faces += list[i].exposed >> f & 1;
    return faces;
}

dpl_status dpl_bounces_prepare(dpl_solver *solver, dpl_bounces *bounces, const dpl_field *field) {
    dpl_context *context = solver->context;
    DPL_TRY(dpl_buffer_reserve(context, &bounces->number, dpl_field_pixels(field), sizeof(int32_t)));
    size_t count = (size_t)number_reflectors(field, bounces->number.data, NULL);
    DPL_TRY(dpl_buffer_reserve(context, &bounces->reflectors, count, sizeof(dpl_reflector)));
    for (int i = 0; i < 2; i++)
        DPL_TRY(dpl_buffer_reserve(context, &bounces->reflected[i], count, sizeof(dpl_faces)));
    if (solver->light_count > 0)
        DPL_TRY(dpl_buffer_reserve(context, &bounces->direct, count, sizeof(dpl_faces)));
    bounces->count = number_reflectors(field, bounces->number.data, bounces->reflectors.data);
    bounces->faces = count_faces(bounces->reflectors.data, bounces->count);
    return DPL_OK;
}

/* ---- one bounce ----------------------------------------------------------------------------------- */

typedef struct bounce {
    const dpl_solver *solver;
    const dpl_ray_world *world; /* as the bounce before left it */
    const dpl_reflector *reflectors;
    dpl_faces *direct; /* NULL where there are no lights */
    dpl_faces *reflected;
    dpl_ray_counter counters[DPL_MAX_THREADS];
} bounce;

/* What lights give; it is the same for every bounce. */
static void light_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    bounce *b = task;
    int64_t rays = 0;
    memset(b->direct + begin, 0, (size_t)(end - begin) * sizeof *b->direct);
    for (int32_t i = begin; i < end; i++) {
        const dpl_reflector *r = &b->reflectors[i];
        for (int f = 0; f < DPL_FACE_COUNT; f++) {
            const int32_t *normal = outward[f];
            dpl_face face = {r->x + normal[0], r->y + normal[1], {normal[0], normal[1]}};
            if (r->exposed >> f & 1)
                rays += dpl_lights_on_face(b->solver, b->world->field, &face, b->direct[i][f]);
        }
    }
    b->counters[worker].rays += rays;
}

/* Cosine-weighted mean of what is seen from the centre of the free pixel before a face. Dividing by the sum
 * of the cosines themselves, not by the 2 that it tends to, keeps a furnace exact. Returns the rays. */
static int64_t see_from_face(const dpl_ray_world *world, const dpl_reflector *r, int face, double mean[3]) {
    const int32_t *normal = outward[face];
    double sum[3] = {0.0, 0.0, 0.0}, weight = 0.0;
    int64_t rays = 0;
    for (int32_t k = 0; k < world->direction_count; k++) {
        const dpl_ray_direction *d = &world->directions[k];
        double cosine = d->unit[0] * normal[0] + d->unit[1] * normal[1], radiance[3];
        if (cosine < LOWEST_COSINE)
            continue;
        dpl_ray_trace(world, r->x + normal[0], r->y + normal[1], d, radiance);
        for (int c = 0; c < 3; c++)
            sum[c] += cosine * radiance[c];
        weight += cosine;
        rays++;
    }
    for (int c = 0; c < 3; c++)
        mean[c] = rays ? sum[c] / weight : 0.0;
    return rays;
}

static void bounce_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    bounce *b = task;
    const dpl_field *field = b->world->field;
    const float(*albedo)[4] = (const float(*)[4])field->albedo.data;
    int64_t rays = 0;
    for (int32_t i = begin; i < end; i++) {
        const dpl_reflector *r = &b->reflectors[i];
        size_t cell = dpl_field_cell(field, r->x, r->y);
        for (int f = 0; f < DPL_FACE_COUNT; f++) {
            double mean[3] = {0.0, 0.0, 0.0};
            if (r->exposed >> f & 1)
                rays += see_from_face(b->world, r, f, mean);
            for (int c = 0; c < 3; c++) {
                double direct = b->direct ? b->direct[i][f][c] : 0.0;
                b->reflected[i][f][c] = (double)albedo[cell][c] * (mean[c] + direct);
            }
        }
    }
    b->counters[worker].rays += rays;
}

/* One pass over all reflectors, between two shares of the solve; adds the rays it traced. */
static dpl_status run_pass(dpl_solver *solver, dpl_task_function function, int32_t count, bounce *b,
                           double from, double to, int64_t *rays) {
    memset(b->counters, 0, sizeof b->counters);
    DPL_TRY(dpl_solver_run(solver, function, count, 4, b, from, to));
    *rays += dpl_ray_counter_sum(b->counters);
    return DPL_OK;
}

dpl_status dpl_bounces_run(dpl_solver *solver, dpl_bounces *bounces, dpl_ray_world *world, int32_t times,
                           double share, dpl_bounces_rays *rays) {
    bool lit = solver->light_count > 0;
    double pass = share / (times + lit);
    bounce b = {.solver = solver, .world = world, .reflectors = bounces->reflectors.data};
    memset(bounces->reflected[0].data, 0, (size_t)bounces->count * sizeof(dpl_faces));
    world->reflector = bounces->number.data;
    world->reflected = bounces->reflected[0].data;
    if (lit) {
        b.direct = bounces->direct.data;
        DPL_TRY(run_pass(solver, light_items, bounces->count, &b, 0.0, pass, &rays->to_lights));
    }
    for (int32_t n = 1; n <= times; n++) {
        double from = pass * (n - 1 + lit);
        b.reflected = bounces->reflected[n % 2].data;
        DPL_TRY(run_pass(solver, bounce_items, bounces->count, &b, from, from + pass, &rays->to_world));
        world->reflected = bounces->reflected[n % 2].data;
    }
    return DPL_OK;
}

/* ---- the rest ------------------------------------------------------------------------------------- */

void dpl_bounces_show(const dpl_bounces *bounces, const dpl_ray_world *world, size_t cell, double rgb[3]) {
    int32_t number = world->reflector ? world->reflector[cell] : -1;
    if (number < 0)
        return;
    const dpl_reflector *reflectors = bounces->reflectors.data;
    double faces = (double)count_faces(&reflectors[number], 1);
    for (int f = 0; f < DPL_FACE_COUNT; f++) /* faces that are not exposed hold zero */
        for (int c = 0; c < 3; c++)
            rgb[c] += world->reflected[number][f][c] / faces;
}

int64_t dpl_bounces_bytes(const dpl_bounces *bounces) {
    return (int64_t)(bounces->number.bytes + bounces->reflectors.bytes + bounces->reflected[0].bytes +
                     bounces->reflected[1].bytes + bounces->direct.bytes);
}

void dpl_bounces_free(dpl_context *context, dpl_bounces *bounces) {
    dpl_buffer *buffers[] = {&bounces->number, &bounces->reflectors, &bounces->reflected[0],
                             &bounces->reflected[1], &bounces->direct};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(context, buffers[i]);
}
