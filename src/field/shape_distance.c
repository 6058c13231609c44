/* Signed distance to the nearest shape and that shape's emission, per pixel, for the paper profile of
 * cascades. Filled by src/api/field.c as shapes are drawn, in fields that ask for it.
 *
 * As the ARC paper's benchmark has it: evaluated at a pixel's corner (x, y), a box measured by the larger of
 * its two axis distances (a lower bound outside corners), and a later shape wins only where it is nearer. */
#include "field/field.h"
#include "job/jobs.h"

#define NOTHING_NEAR 1000.0f

typedef struct surface_task {
    dpl_field *field;
    const dpl_shape *shapes;
    int32_t count;
} surface_task;

static double disc_distance(const dpl_disc *disc, double x, double y) {
    double dx = x - disc->center[0], dy = y - disc->center[1];
    return sqrt(dx * dx + dy * dy) - disc->radius;
}

static double box_distance(const dpl_box *box, double x, double y) {
    double dx = x - box->center[0], dy = y - box->center[1];
    if (box->angle != 0.0) {
        double c = cos(box->angle), s = sin(box->angle), turned = dx * c + dy * s;
        dy = dy * c - dx * s;
        dx = turned;
    }
    return fmax(fabs(dx) - box->half[0], fabs(dy) - box->half[1]);
}

static double line_distance(const double a[2], const double b[2], double x, double y) {
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    double along = length2 > 0.0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / length2 : 0.0;
    along = fmin(1.0, fmax(0.0, along));
    return hypot(x - a[0] - along * dx, y - a[1] - along * dy);
}

static double polygon_distance(const dpl_polygon *polygon, double x, double y) {
    double nearest = HUGE_VAL;
    bool inside = false;
    for (int32_t i = 0; i < polygon->count; i++) {
        const double *a = polygon->points[i], *b = polygon->points[(i + 1) % polygon->count];
        nearest = fmin(nearest, line_distance(a, b, x, y));
        if ((a[1] <= y) != (b[1] <= y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            inside = !inside;
    }
    return inside ? -nearest : nearest;
}

static double shape_distance(const dpl_shape *shape, double x, double y) {
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        return disc_distance(&shape->disc, x, y);
    case DPL_SHAPE_BOX:
        return box_distance(&shape->box, x, y);
    case DPL_SHAPE_POLYGON:
        return polygon_distance(&shape->polygon, x, y);
    case DPL_SHAPE_SEGMENT:
        return line_distance(shape->segment.from, shape->segment.to, x, y) - 0.5 * shape->segment.width;
    }
    return HUGE_VAL;
}

static void add_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const surface_task *t = task;
    float(*surface)[4] = t->field->surface.data;
    const int32_t margin = t->field->margin;
    for (int32_t i = 0; i < t->count; i++)
        for (int32_t y = begin; y < end; y++)
            for (int32_t x = 0; x < t->field->width; x++) {
                float *at = surface[dpl_field_cell(t->field, x, y)];
                float distance = (float)shape_distance(&t->shapes[i], x - margin, y - margin);
                if (!(distance < at[0]))
                    continue;
                at[0] = distance;
                memcpy(&at[1], t->shapes[i].material.emission, 3 * sizeof(float));
            }
}

void dpl_field_clear_surface(dpl_field *field) {
    float(*surface)[4] = field->surface.data;
    for (size_t i = 0; surface && i < dpl_field_pixels(field); i++) {
        surface[i][0] = NOTHING_NEAR;
        surface[i][1] = surface[i][2] = surface[i][3] = 0.0f;
    }
}

dpl_status dpl_field_add_surface(dpl_field *field, const dpl_shape *shapes, int32_t count) {
    if (!field->surface.data)
        return DPL_OK;
    surface_task task = {field, shapes, count};
    return dpl_jobs_run(field->context, add_rows, field->height, 8, &task);
}
