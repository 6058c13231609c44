/* What can be wrong with a shape or a colour that a caller hands in. Called by field.c and tracer.c. */
#include "api/shape_fault.h"

/* Coordinates beyond this are a mistake, and would make row and column numbers meaningless. */
#define HIGHEST_COORDINATE 1e9

static bool numbers_are_good(const double *numbers, int count) {
    for (int i = 0; i < count; i++)
        if (!(fabs(numbers[i]) <= HIGHEST_COORDINATE))
            return false;
    return true;
}

/* What is wrong with a shape's geometry, or NULL. */
static const char *geometry_fault(const dpl_shape *shape) {
    static const char range[] = "coordinates must be finite and within 1e9";
    switch (shape->kind) {
    case DPL_SHAPE_DISC:
        if (!numbers_are_good(shape->disc.center, 2))
            return range;
        return shape->disc.radius >= 0.0 && shape->disc.radius <= HIGHEST_COORDINATE
                   ? NULL
                   : "the radius must be finite and not negative";
    case DPL_SHAPE_BOX:
        if (!numbers_are_good(shape->box.center, 2) || !numbers_are_good(&shape->box.angle, 1) ||
            !numbers_are_good(shape->box.half, 2))
            return range;
        return shape->box.half[0] >= 0.0 && shape->box.half[1] >= 0.0 ? NULL
                                                                      : "half sizes must not be negative";
    case DPL_SHAPE_POLYGON:
        if (!shape->polygon.points || shape->polygon.count < 3)
            return "a polygon has at least 3 points";
        for (int32_t i = 0; i < shape->polygon.count; i++)
            if (!numbers_are_good(shape->polygon.points[i], 2))
                return range;
        return NULL;
    case DPL_SHAPE_SEGMENT:
        if (!numbers_are_good(shape->segment.from, 2) || !numbers_are_good(shape->segment.to, 2))
            return range;
        return shape->segment.width >= 0.0 && shape->segment.width <= HIGHEST_COORDINATE
                   ? NULL
                   : "the width must be finite and not negative";
    }
    return "there is no such kind of shape";
}

static const char *material_fault(const dpl_material *material) {
    if (!colour_is_good(material->emission, HIGHEST_RADIANCE))
        return "emission must be finite and not negative";
    if (!colour_is_good(material->extinction, INFINITY))
        return "extinction must not be negative or NaN";
    if (!colour_is_good(material->albedo, 1.0f))
        return "albedo must be 0 .. 1";
    return NULL;
}

const char *dpl_shape_fault(const dpl_shape *shape) {
    const char *fault = geometry_fault(shape);
    return fault ? fault : material_fault(&shape->material);
}
