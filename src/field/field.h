/* The pixel world in memory. It is larger than the picture by `margin` on every side; rooms below src/api/
 * count pixels of the world, callers of the library pixels of the picture. Drawn into by rasterise.c and
 * layer.c, measured by distance.c, read by every solver through dpl_field_grid(). Argument checks are in
 * src/api/field.c: this room trusts. */
#ifndef DPL_FIELD_FIELD_H
#define DPL_FIELD_FIELD_H

#include "base/context.h"
#include "kernel/kernel.h"

#include <dapple/field.h>

/* What a pixel is, as stored in dpl_field.kind. */
enum { DPL_PIXEL_EMPTY = 0, DPL_PIXEL_MEDIUM = 1, DPL_PIXEL_OPAQUE = 2 };

struct dpl_field {
    dpl_context *context;
    int32_t width; /* of the whole world: the picture and the margin around it */
    int32_t height;
    int32_t margin; /* the picture's pixel (x, y) is the world's (x + margin, y + margin) */
    int32_t sky_count;
    dpl_buffer sky; /* float[3] per sector of the ring */
    /* Planes, one entry per pixel. */
    dpl_buffer kind;       /* uint8_t */
    dpl_buffer emission;   /* float[4]: RGB, 0 */
    dpl_buffer extinction; /* float[4]; held from the first medium on, see dpl_field_hold_media() */
    dpl_buffer albedo;     /* float[4]; held from the first albedo on that is not 0 */
    dpl_buffer clearance;  /* float, as in dpl_grid; held from the first measurement on */
    dpl_buffer surface;    /* float[4], as in dpl_grid; only where the desc asks for it */
    dpl_buffer scratch;    /* of rasterising and of the distance transform */
    bool measured;         /* clearance is up to date */
    uint64_t revision;     /* of the drawing: no two drawings of a context have the same */
};

static inline size_t dpl_field_pixels(const dpl_field *field) {
    return (size_t)field->width * (size_t)field->height;
}

/* Size of the picture: what the outside sees of the world. */
static inline int32_t dpl_field_picture_width(const dpl_field *field) {
    return field->width - 2 * field->margin;
}

static inline int32_t dpl_field_picture_height(const dpl_field *field) {
    return field->height - 2 * field->margin;
}

/* Where the world's pixel (x, y), which lies inside, stands in the planes. */
static inline size_t dpl_field_cell(const dpl_field *field, int32_t x, int32_t y) {
    return (size_t)y * (size_t)field->width + (size_t)x;
}

/* The same for the picture's pixel (x, y). */
static inline size_t dpl_field_picture_cell(const dpl_field *field, int32_t x, int32_t y) {
    return dpl_field_cell(field, x + field->margin, y + field->margin);
}

/* Is the world's pixel (x, y), which lies inside, opaque? */
static inline bool dpl_field_is_opaque(const dpl_field *field, int32_t x, int32_t y) {
    const uint8_t *kind = field->kind.data;
    return kind[dpl_field_cell(field, x, y)] == DPL_PIXEL_OPAQUE;
}

/* What a pixel of this extinction is. */
static inline uint8_t dpl_extinction_kind(const float s[3]) {
    if (isinf(s[0]) && isinf(s[1]) && isinf(s[2]))
        return DPL_PIXEL_OPAQUE;
    return s[0] > 0.0f || s[1] > 0.0f || s[2] > 0.0f ? DPL_PIXEL_MEDIUM : DPL_PIXEL_EMPTY;
}

/* field.c */
/* Something was drawn: what was computed from the field is out of date. */
void dpl_field_touch(dpl_field *field);
dpl_status dpl_field_hold_media(dpl_field *field);
dpl_status dpl_field_hold_albedo(dpl_field *field);
/* Makes one pixel of this material. The planes that it needs are held already. Zero extinction empties it. */
void dpl_field_put(dpl_field *field, size_t cell, const dpl_material *material);
/* Kind of a material by its extinction. */
uint8_t dpl_material_kind(const dpl_material *material);
bool dpl_material_has_albedo(const dpl_material *material);
/* The world as kernels see it; measure first. */
dpl_grid dpl_field_grid(const dpl_field *field);

/* sky.c: 1 or more sectors, checked. Nothing changes when memory runs out. */
DPL_MUST_CHECK dpl_status dpl_field_hold_sky(dpl_field *field, const float (*rgb)[3], int32_t count);
/* The sky in one direction [rad], RGB. */
const float *dpl_field_sky_at(const dpl_field *field, double angle);
/* Its exact mean over the angles from `from` to `to` >= from [rad], wherever on the number line. */
void dpl_field_sky_mean(const dpl_field *field, double from, double to, float rgb[3]);

/* rasterise.c: draws checked shapes in order. */
DPL_MUST_CHECK dpl_status dpl_field_rasterise(dpl_field *field, const dpl_shape *shapes, int32_t count);

/* shape_distance.c: nothing anywhere; and the nearer of what is there and a checked shape. */
void dpl_field_clear_surface(dpl_field *field);
DPL_MUST_CHECK dpl_status dpl_field_add_surface(dpl_field *field, const dpl_shape *shapes, int32_t count);

/* layer.c: checks the values of a layer whose shape is checked, then draws it. */
DPL_MUST_CHECK dpl_status dpl_field_lay(dpl_field *field, const dpl_layer *layer);

/* distance.c: brings the clearance up to date if it is not. */
DPL_MUST_CHECK dpl_status dpl_field_measure(dpl_field *field);

#endif
