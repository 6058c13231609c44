/* The truth: rays evenly spread over the light's angle, through the pixels of the field one by one in double
 * precision as far as the disc's rim. Shares nothing with the other methods but the field, so that it can
 * judge them.
 *
 * Traversal: Amanatides and Woo 1987; a ray through a corner goes along y first. */
#include "shadow/shadow.h"

#include <math.h>

#define DEFAULT_RAYS 256

/* Distance along a ray to the first pixel edge in one axis, between edges, and which way pixels count. */
typedef struct axis_walk {
    double next;
    double between;
    int32_t step;
} axis_walk;

static axis_walk walk_from_centre(double direction) {
    if (direction == 0.0)
        return (axis_walk){INFINITY, INFINITY, 0};
    return (axis_walk){0.5 / fabs(direction), 1.0 / fabs(direction), direction < 0.0 ? -1 : 1};
}

/* Multiplies `passed` with what `length` in a pixel's medium lets through. */
static void cross_medium(const dpl_field *field, size_t cell, double length, double passed[3]) {
    const float *extinction = ((const float(*)[4])field->extinction.data)[cell];
    for (int c = 0; c < 3; c++)
        passed[c] *= exp(-(double)extinction[c] * length);
}

/* From a pixel's centre for `length`: false when an opaque pixel is entered before, unless they are to be
 * passed through. */
static bool trace(const dpl_field *field, int32_t x, int32_t y, double dx, double dy, double length,
                  bool through_opaque, double passed[3], int64_t *steps) {
    const uint8_t *kind = field->kind.data;
    axis_walk in_x = walk_from_centre(dx), in_y = walk_from_centre(dy);
    double travelled = 0.0;
    while (travelled < length && x >= 0 && y >= 0 && x < field->width && y < field->height) {
        size_t cell = (size_t)y * (size_t)field->width + (size_t)x;
        bool leaves_by_x = in_x.next < in_y.next;
        double leave = leaves_by_x ? in_x.next : in_y.next;
        ++*steps;
        if (kind[cell] == DPL_PIXEL_OPAQUE && !through_opaque)
            return false;
        if (kind[cell] == DPL_PIXEL_MEDIUM)
            cross_medium(field, cell, fmin(leave, length) - travelled, passed);
        travelled = leave;
        if (leaves_by_x) {
            x += in_x.step;
            in_x.next += in_x.between;
        } else {
            y += in_y.step;
            in_y.next += in_y.between;
        }
    }
    return true;
}

double dpl_shadow_truth_rgb(const dpl_shadow_view *view, const dpl_receiver *r, double rgb[3],
                            dpl_shadow_counts *counts) {
    int32_t rays = view->radius > 0.0 ? view->desc->samples ? view->desc->samples : DEFAULT_RAYS : 1,
            seen = 0;
    int64_t steps = 0;
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int32_t k = 0; k < rays; k++) {
        double turn = r->angle * ((2.0 * k + 1.0) / rays - 1.0), c = cos(turn), s = sin(turn);
        double across = r->distance * s, passed[3] = {1.0, 1.0, 1.0};
        double rim = r->distance * c - sqrt(fmax(view->radius * view->radius - across * across, 0.0));
        if (!trace(view->field, r->pixel[0], r->pixel[1], r->dx * c - r->dy * s, r->dy * c + r->dx * s, rim,
                   false, passed, &steps))
            continue;
        seen++;
        for (int i = 0; i < 3; i++)
            rgb[i] += passed[i] / rays;
    }
    counts->steps += steps;
    counts->fetches += steps;
    return (double)seen / rays;
}

double dpl_shadow_truth(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    double rgb[3];
    return dpl_shadow_truth_rgb(view, r, rgb, counts);
}

void dpl_shadow_medium(const dpl_shadow_view *view, const dpl_receiver *r, double rgb[3]) {
    int64_t steps = 0;
    rgb[0] = rgb[1] = rgb[2] = 1.0;
    (void)trace(view->field, r->pixel[0], r->pixel[1], r->dx, r->dy, r->distance - view->radius, true, rgb,
                &steps);
}
