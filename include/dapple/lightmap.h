/** @file
 * The last step of a 2D game's frame: the game's own colours, lit by what a solver found, as the 8-bit pixels
 * that go to the screen.
 *
 * A frame: draw the sprites unlit into an RGBA8 buffer (the albedo), light the field with dpl_solver_solve(),
 * apply the light here, upload the result. The result may overwrite the albedo in place.
 */
#ifndef DAPPLE_LIGHTMAP_H
#define DAPPLE_LIGHTMAP_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/image.h>
#include <dapple/status.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How lit colours, 0 .. infinity, become the 0 .. 1 of a display. */
typedef enum dpl_lightmap_curve {
    DPL_LIGHTMAP_CLAMP = 0, /**< as they are, cut at 1: light 1 leaves the albedo's bytes as they are */
    DPL_LIGHTMAP_DISPLAY =
        1 /**< the curve of dpl_tonemap(), which never cuts; its result is display-referred */
} dpl_lightmap_curve;

/** How to apply light. Start from dpl_lightmap_desc_default(). */
typedef struct dpl_lightmap_desc {
    uint32_t struct_size;     /**< stamped by the default function */
    uint32_t cookie;          /**< stamped by the default function */
    float exposure;           /**< factor on light, finite, >= 0, default 1 */
    dpl_lightmap_curve curve; /**< default DPL_LIGHTMAP_CLAMP */
} dpl_lightmap_desc;

/** Defaults of applying light: exposure 1, clamped. */
static inline dpl_lightmap_desc dpl_lightmap_desc_default(void) {
    dpl_lightmap_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.exposure = 1.0f;
    return desc;
}

/**
 * Lights a picture: per pixel and colour channel, output = curve(albedo * light * exposure), rounded to the
 * nearest byte. Allocates nothing. The same bytes for every thread count and instruction set.
 * @param context for its kernels and threads
 * @param light   mean radiance, linear, shape [height][width][3 or 4] (a fourth channel is left out):
 *                DPL_FORMAT_F32 or DPL_FORMAT_F16; below 0 or not a number counts as 0
 * @param albedo  the unlit picture, shape [height][width][3 or 4]. DPL_FORMAT_SRGB8: colours are decoded, lit
 *                in linear light and, unless the curve is display-referred, encoded again. DPL_FORMAT_UNORM8:
 *                a plain multiply of the stored bytes, what blending a texture over another does
 * @param desc    from dpl_lightmap_desc_default(); NULL means all defaults
 * @param output  receives the lit picture: the albedo's size and format, 3 or 4 channels. Alpha is the
 *                albedo's, or 255 where that has none. May be the albedo's own buffer with the same layout;
 * may not overlap albedo or light otherwise
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT, _SIZE; nothing is written then
 * Source: sRGB as in IEC 61966-2-1; the display curve as in tonemap.h.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_lightmap_apply(dpl_context *context, const dpl_pixels *light,
                                                     const dpl_pixels *albedo, const dpl_lightmap_desc *desc,
                                                     const dpl_output *output);

#ifdef __cplusplus
}
#endif
#endif
