/** @file
 * Shapes: discs, boxes, polygons and segments with a material, to be drawn into a field.
 *
 * A shape owns a pixel iff the pixel's centre (x+.5, y+.5) lies inside it, its boundary included.
 * Coordinates are pixels, origin top left, y down; angles are radians from +x towards +y.
 */
#ifndef DAPPLE_SHAPE_H
#define DAPPLE_SHAPE_H

#include <dapple/export.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a pixel is made of. */
typedef struct dpl_material {
    float emission[3];   /**< RGB radiance, linear, >= 0, finite */
    float extinction[3]; /**< RGB, per pixel crossed [1/px], >= 0; INFINITY in all three = opaque */
    float albedo[3];     /**< RGB share of light reflected diffusely, 0 .. 1 */
} dpl_material;

/** Which member of dpl_shape is in use. */
typedef enum dpl_shape_kind {
    DPL_SHAPE_DISC = 0,    /**< dpl_shape::disc */
    DPL_SHAPE_BOX = 1,     /**< dpl_shape::box */
    DPL_SHAPE_POLYGON = 2, /**< dpl_shape::polygon */
    DPL_SHAPE_SEGMENT = 3  /**< dpl_shape::segment */
} dpl_shape_kind;

/** All points within `radius` of `center`. */
typedef struct dpl_disc {
    double center[2]; /**< [px] */
    double radius;    /**< [px], >= 0 */
} dpl_disc;

/** A rectangle, turned about its centre. */
typedef struct dpl_box {
    double center[2]; /**< [px] */
    double half[2];   /**< half width and half height [px], >= 0 */
    double angle;     /**< [rad] */
} dpl_box;

/** A closed polygon, even-odd rule where it crosses itself. */
typedef struct dpl_polygon {
    const double (*points)[2]; /**< corners [px]; the caller's, only read during the call */
    int32_t count;             /**< at least 3 */
} dpl_polygon;

/** All points within width/2 of the line from `from` to `to` (round ends). */
typedef struct dpl_segment {
    double from[2]; /**< [px] */
    double to[2];   /**< [px] */
    double width;   /**< [px], >= 0 */
} dpl_segment;

/** One shape and what it is made of. */
typedef struct dpl_shape {
    dpl_shape_kind kind;   /**< which of the four */
    dpl_material material; /**< of every pixel that it owns */
    union {
        dpl_disc disc;       /**< for DPL_SHAPE_DISC */
        dpl_box box;         /**< for DPL_SHAPE_BOX */
        dpl_polygon polygon; /**< for DPL_SHAPE_POLYGON */
        dpl_segment segment; /**< for DPL_SHAPE_SEGMENT */
    };
} dpl_shape;

/** Opaque, black, no albedo: a wall. */
static inline dpl_material dpl_material_default(void) {
    dpl_material material;
    memset(&material, 0, sizeof material);
    material.extinction[0] = material.extinction[1] = material.extinction[2] = INFINITY;
    return material;
}

/** A zero-sized shape of the given kind with the default material. */
static inline dpl_shape dpl_shape_default(dpl_shape_kind kind) {
    dpl_shape shape;
    memset(&shape, 0, sizeof shape);
    shape.kind = kind;
    shape.material = dpl_material_default();
    return shape;
}

#ifdef __cplusplus
}
#endif
#endif
