/* Lights a picture of shapes: mean radiance over directions from each pixel's centre. Keeps what rays hit of
 * the static layer, so that the next picture traces only what moves. Called by src/api/tracer.c.
 *
 * A row of pixels is an item; each value is written by one item and summed in the order of directions. */
#include "job/jobs.h"
#include "tracer/tracer.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

typedef struct lighting {
    const dpl_tracer *tracer;
    const dpl_output *output;
    const float (*directions)[2];
    int32_t direction_count;
    float sky[3];
    dpl_kept_hit *kept; /* NULL: nothing is kept */
    bool kept_is_good;  /* else this picture fills it */
    dpl_tracer_worker workers[DPL_MAX_THREADS];
} lighting;

static const float *radiance_of(const lighting *l, int32_t object) {
    if (object < 0)
        return l->sky;
    int32_t statics = l->tracer->shapes[DPL_TRACER_STATIC].count;
    int layer = object < statics ? DPL_TRACER_STATIC : DPL_TRACER_DYNAMIC;
    const float(*emission)[3] = l->tracer->emission[layer].data;
    return emission[layer == DPL_TRACER_STATIC ? object : object - statics];
}

/* The nearest hit of a ray of the picture. `kept` is the ray's own place, or NULL. */
static dpl_hit trace_ray(const lighting *l, const dpl_ray *ray, dpl_kept_hit *kept,
                         dpl_tracer_counts *counts) {
    const dpl_shapes *layers = l->tracer->shapes;
    dpl_hit hit = dpl_hit_none();
    if (kept && l->kept_is_good) {
        hit.t = kept->t;
        hit.object = kept->object;
    } else {
        counts->static_rays++;
        if (layers[DPL_TRACER_STATIC].count > 0)
            dpl_shapes_closest(&layers[DPL_TRACER_STATIC], ray, &hit, &counts->walks);
        if (kept)
            *kept = (dpl_kept_hit){hit.t, hit.object};
    }
    if (layers[DPL_TRACER_DYNAMIC].count > 0)
        dpl_shapes_closest(&layers[DPL_TRACER_DYNAMIC], ray, &hit, &counts->walks);
    return hit;
}

static void light_pixel(const lighting *l, int32_t x, int32_t y, dpl_tracer_counts *counts, float *rgb) {
    size_t pixel = (size_t)y * (size_t)l->output->width + (size_t)x;
    dpl_kept_hit *kept = l->kept ? l->kept + pixel * (size_t)l->direction_count : NULL;
    dpl_ray ray = {.origin = {(float)x + 0.5f, (float)y + 0.5f, 0.0f}, .far = INFINITY};
    double sum[3] = {0.0, 0.0, 0.0};
    for (int32_t k = 0; k < l->direction_count; k++) {
        ray.direction[0] = l->directions[k][0];
        ray.direction[1] = l->directions[k][1];
        dpl_hit hit = trace_ray(l, &ray, kept ? kept + k : NULL, counts);
        const float *radiance = radiance_of(l, hit.object);
        for (int c = 0; c < 3; c++)
            sum[c] += (double)radiance[c];
    }
    counts->rays += l->direction_count;
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(sum[c] / l->direction_count);
}

static void light_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    lighting *l = task;
    const dpl_output *output = l->output;
    for (int32_t y = begin; y < end; y++) {
        float *out = (float *)(void *)((char *)output->data + output->row_stride * y);
        for (int32_t x = 0; x < output->width; x++, out += output->channels) {
            light_pixel(l, x, y, &l->workers[worker].counts, out);
            if (output->channels == 4)
                out[3] = 1.0f;
        }
    }
}

static dpl_status aim(dpl_tracer *tracer, int32_t count) {
    if (tracer->direction_count == count)
        return DPL_OK;
    tracer->direction_count = 0;
    DPL_TRY(dpl_buffer_reserve(tracer->context, &tracer->directions, (size_t)count, 2 * sizeof(float)));
    float(*directions)[2] = tracer->directions.data;
    for (int32_t k = 0; k < count; k++) {
        double angle = 2.0 * PI * (k + 0.5) / count;
        directions[k][0] = (float)cos(angle);
        directions[k][1] = (float)sin(angle);
    }
    tracer->direction_count = count;
    return DPL_OK;
}

/* Makes room for static hits, and says whether those of an earlier picture are still there. */
static dpl_status prepare_kept(dpl_tracer *tracer, const dpl_kept_picture *picture, bool *good) {
    const dpl_kept_picture *old = &tracer->kept_picture;
    *good = old->width == picture->width && old->height == picture->height &&
            old->directions == picture->directions;
    if (*good)
        return DPL_OK;
    tracer->kept_picture = (dpl_kept_picture){0};
    size_t rays = (size_t)picture->width * (size_t)picture->height * (size_t)picture->directions;
    return dpl_buffer_reserve(tracer->context, &tracer->kept, rays, sizeof(dpl_kept_hit));
}

dpl_status dpl_tracer_light_picture(dpl_tracer *tracer, const dpl_tracer_light_desc *desc,
                                    const dpl_output *output) {
    dpl_kept_picture picture = {output->width, output->height, desc->directions};
    lighting l = {.tracer = tracer, .output = output, .direction_count = desc->directions};
    memcpy(l.sky, desc->sky, sizeof l.sky);
    DPL_TRY(aim(tracer, desc->directions));
    l.directions = (const float(*)[2])tracer->directions.data;
    if (desc->keep_static) {
        DPL_TRY(prepare_kept(tracer, &picture, &l.kept_is_good));
        l.kept = tracer->kept.data;
    }
    DPL_TRY(dpl_jobs_run(tracer->context, light_rows, output->height, 1, &l));
    if (desc->keep_static)
        tracer->kept_picture = picture;
    dpl_tracer_add_counts(tracer, l.workers);
    return DPL_OK;
}
