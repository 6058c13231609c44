/** @file
 * The field: the pixel world that light travels through. Emission, extinction and albedo per pixel, a sky
 * outside, and the distance to the nearest pixel that is not empty.
 *
 * The world may be larger than the picture: a margin around it holds lamps and walls that act but are not
 * shown. All coordinates, sizes and arrays are of the picture; its top left pixel is (0, 0), and shapes and
 * layers with coordinates outside it land in the margin.
 */
#ifndef DAPPLE_FIELD_H
#define DAPPLE_FIELD_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/image.h>
#include <dapple/shape.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Largest width and height of a field [px]. */
#define DPL_MAX_SIZE 16384

/** Widest margin around a field's picture [px]. */
#define DPL_MAX_MARGIN 4096

/** Most sectors of a sky. */
#define DPL_MAX_SKY_SECTORS 4096

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_field dpl_field;

/** Size of a field. Start from dpl_field_desc_default(). */
typedef struct dpl_field_desc {
    uint32_t struct_size; /**< stamped by the default function */
    uint32_t cookie;      /**< stamped by the default function */
    int32_t width;        /**< 1 .. DPL_MAX_SIZE [px], default 512 */
    int32_t height;       /**< 1 .. DPL_MAX_SIZE [px], default 512 */
    int32_t margin;       /**< of the world on each side of the picture, 0 .. DPL_MAX_MARGIN [px]; width
                             and height plus twice the margin stay within DPL_MAX_SIZE. Default 0 */
    float sky[3];         /**< RGB radiance of rays that leave the world, >= 0, default 0 */
    int32_t keep_shape_distance; /**< 1: also keep, per pixel, the signed distance to the nearest shape and
                                    its emission, as DPL_PROFILE_PAPER wants it; costs time per shape and
                                    pixel. Such a field takes no layers. Default 0 */
} dpl_field_desc;

/** Defaults of a field: 512x512, black sky. */
static inline dpl_field_desc dpl_field_desc_default(void) {
    dpl_field_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.width = desc.height = 512;
    return desc;
}

/** Pictures to lay into a field. Any of the three may have data == NULL. All present ones have one size. */
typedef struct dpl_layer {
    uint32_t struct_size;  /**< stamped by the default function */
    uint32_t cookie;       /**< stamped by the default function */
    dpl_pixels emission;   /**< RGB(A) or grey radiance, scaled by `intensity` */
    dpl_pixels extinction; /**< see `extinction_is_opacity`: grey, RGB, or the alpha of 2 or 4 channels */
    dpl_pixels albedo;     /**< RGB(A) or grey, 0 .. 1 */
    int32_t x;             /**< where the pictures' left edge goes [px]; what falls outside is cut */
    int32_t y;             /**< where their top edge goes [px] */
    float intensity;       /**< factor on emission, >= 0, default 1 */
    /** 1 (default): extinction values are opacities 0 .. 1 and become -ln(1-v), so 1 is opaque. 0: they are
     * extinction per pixel [1/px], and INFINITY is opaque. */
    int32_t extinction_is_opacity;
} dpl_layer;

/** Defaults of a layer: nothing in it, at (0, 0), intensity 1. */
static inline dpl_layer dpl_layer_default(void) {
    dpl_layer layer;
    memset(&layer, 0, sizeof layer);
    layer.struct_size = (uint32_t)sizeof layer;
    layer.cookie = DPL_DESC_COOKIE;
    layer.intensity = 1.0f;
    layer.extinction_is_opacity = 1;
    return layer;
}

/**
 * Makes an empty field: nothing emits, nothing blocks.
 * @param context the context, must outlive the field
 * @param desc    from dpl_field_desc_default()
 * @param field   receives the field, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _SIZE (also for the margin), _ARGUMENT (sky), _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_create(dpl_context *context, const dpl_field_desc *desc,
                                                   dpl_field **field);

/** Frees a field. NULL is fine. */
DPL_API void dpl_field_destroy(dpl_field *field);

/** Width of the picture, without the margin [px]. */
DPL_API int32_t dpl_field_width(const dpl_field *field);

/** Height of the picture, without the margin [px]. */
DPL_API int32_t dpl_field_height(const dpl_field *field);

/** Margin of the world on each side of the picture [px]. */
DPL_API int32_t dpl_field_margin(const dpl_field *field);

/** Makes every pixel empty again. Keeps the sky and the memory. */
DPL_API void dpl_field_clear(dpl_field *field);

/**
 * Sets the radiance of rays that leave the world, the same in all directions.
 * @param sky RGB, linear, finite, >= 0
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_set_sky(dpl_field *field, const float sky[3]);

/**
 * Sets the radiance of rays that leave the world by their direction: a ring of equal sectors, infinitely far
 * away. Sector k is seen by rays whose angle from +x towards +y (downwards) is in [k, k+1) * 2pi/count. A
 * call with no more sectors than before allocates nothing.
 * @param rgb   shape [count][3], linear, finite, >= 0
 * @param count 1 .. DPL_MAX_SKY_SECTORS
 * @return DPL_OK; DPL_ERROR_ARGUMENT naming the sector, _MEMORY; the sky is unchanged on failure
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_set_sky_ring(dpl_field *field, const float (*rgb)[3],
                                                         int32_t count);

/**
 * Draws shapes in order, later ones over earlier ones. All are checked before the first is drawn.
 * @param shapes array of `count` shapes
 * @return DPL_OK; DPL_ERROR_ARGUMENT naming the shape and what is wrong with it; DPL_ERROR_MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_draw_shapes(dpl_field *field, const dpl_shape *shapes,
                                                        int32_t count);

/**
 * Lays pictures (or a game's raw buffers) over the field. A pixel whose extinction is zero in all channels
 * leaves what was there; any other replaces it whole.
 *
 * Without an extinction picture the emission picture decides what is there: with 2 or 4 channels its alpha is
 * the opacity; with 1 or 3 channels every pixel that is not black is opaque.
 * @return DPL_OK; DPL_ERROR_DESC, _SIZE, _ARGUMENT (also for values below zero, or not finite where they must
 * be, with the pixel named; nothing is drawn then), _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_draw_layer(dpl_field *field, const dpl_layer *layer);

/**
 * Reads the exact Euclidean distance from each pixel's centre to the centre of the nearest pixel that is not
 * empty, in the margin too [px]: 0 on such pixels, at least width+height in an empty field.
 * @param distance   shape [height][width]
 * @param row_stride from a row to the next [byte]; 0: tightly packed
 * @return DPL_OK; DPL_ERROR_ARGUMENT, _MEMORY
 * Source: Meijster, Roerdink, Hesselink 2000, "A general algorithm for computing distance transforms in
 * linear time".
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_read_distance(dpl_field *field, float *distance,
                                                          ptrdiff_t row_stride);

/**
 * Reads which pixels are opaque: 1, else 0. Such pixels are left out of comparisons.
 * @param opaque     shape [height][width]
 * @param row_stride from a row to the next [byte]; 0: tightly packed
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_read_opaque(const dpl_field *field, uint8_t *opaque,
                                                        ptrdiff_t row_stride);

/**
 * Reads the material of one pixel.
 * @param x,y      pixel, 0 .. width-1, 0 .. height-1
 * @param material receives it; extinction is 0 for an empty pixel
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_field_read_pixel(const dpl_field *field, int32_t x, int32_t y,
                                                       dpl_material *material);

#ifdef __cplusplus
}
#endif
#endif
