/* Traversal: Amanatides and Woo 1987, "A fast voxel traversal algorithm for ray tracing". */
#include "reference/ray.h"

#include <math.h>

/* Distance along a ray to the first pixel edge in one axis, between edges, and which way the pixel number
 * goes. */
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

/* Goes on to the next pixel; returns whether it is entered by its left or right face. */
static bool step(axis_walk *in_x, axis_walk *in_y, int32_t *x, int32_t *y) {
    bool by_x = in_x->next < in_y->next; /* an exact corner looks at the neighbour in y first */
    axis_walk *walk = by_x ? in_x : in_y;
    *(by_x ? x : y) += walk->step;
    walk->next += walk->between;
    return by_x;
}

static void cross_medium(const dpl_field *field, size_t cell, double length, double radiance[3],
                         double passed[3]) {
    const float *extinction = ((const float(*)[4])field->extinction.data)[cell];
    const float *emission = ((const float(*)[4])field->emission.data)[cell];
    for (int c = 0; c < 3; c++) {
        double absorbed = -expm1(-(double)extinction[c] * length);
        radiance[c] += passed[c] * absorbed * (double)emission[c];
        passed[c] *= 1.0 - absorbed;
    }
}

/* What an opaque pixel shows to a ray that enters it by `face`. */
static void hit_opaque(const dpl_ray_world *world, size_t cell, int face, const double passed[3],
                       double radiance[3]) {
    const float *emission = ((const float(*)[4])world->field->emission.data)[cell];
    int32_t reflector = world->reflector ? world->reflector[cell] : -1;
    for (int c = 0; c < 3; c++) {
        double reflected = reflector < 0 ? 0.0 : world->reflected[reflector][face][c];
        radiance[c] += passed[c] * ((double)emission[c] + reflected);
    }
}

static int face_entered(const double unit[2], bool by_x) {
    if (by_x)
        return unit[0] < 0.0 ? DPL_FACE_RIGHT : DPL_FACE_LEFT;
    return unit[1] < 0.0 ? DPL_FACE_BELOW : DPL_FACE_ABOVE;
}

void dpl_ray_trace(const dpl_ray_world *world, int32_t x, int32_t y, const dpl_ray_direction *direction,
                   double radiance[3]) {
    const dpl_field *field = world->field;
    const uint8_t *kind = field->kind.data;
    axis_walk in_x = walk_from_centre(direction->unit[0]), in_y = walk_from_centre(direction->unit[1]);
    double passed[3] = {1.0, 1.0, 1.0}, travelled = 0.0;
    bool by_x = false; /* how the pixel was entered */
    for (int c = 0; c < 3; c++)
        radiance[c] = 0.0;
    while (x >= 0 && y >= 0 && x < field->width && y < field->height) {
        size_t cell = dpl_field_cell(field, x, y);
        if (kind[cell] == DPL_PIXEL_OPAQUE) {
            hit_opaque(world, cell, face_entered(direction->unit, by_x), passed, radiance);
            return;
        }
        double leave = fmin(in_x.next, in_y.next);
        if (kind[cell] == DPL_PIXEL_MEDIUM)
            cross_medium(field, cell, leave - travelled, radiance, passed);
        travelled = leave;
        by_x = step(&in_x, &in_y, &x, &y);
    }
    const float *sky = dpl_field_sky_at(field, direction->angle);
    for (int c = 0; c < 3; c++)
        radiance[c] += passed[c] * (double)sky[c];
}

bool dpl_ray_reaches(const dpl_field *field, int32_t x, int32_t y, const double unit[2], double length,
                     double passed[3]) {
    const uint8_t *kind = field->kind.data;
    axis_walk in_x = walk_from_centre(unit[0]), in_y = walk_from_centre(unit[1]);
    double travelled = 0.0, emitted[3] = {0.0, 0.0, 0.0};
    passed[0] = passed[1] = passed[2] = 1.0;
    while (travelled < length && x >= 0 && y >= 0 && x < field->width && y < field->height) {
        size_t cell = dpl_field_cell(field, x, y);
        double leave = fmin(in_x.next, in_y.next);
        if (kind[cell] == DPL_PIXEL_OPAQUE)
            return false;
        if (kind[cell] == DPL_PIXEL_MEDIUM)
            cross_medium(field, cell, fmin(leave, length) - travelled, emitted, passed);
        travelled = leave;
        (void)step(&in_x, &in_y, &x, &y);
    }
    return true;
}
