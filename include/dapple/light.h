/** @file
 * Lights with a size: discs that shine and block nothing. What they give with their shadows: shadow.h. What
 * walls reflect of them: dpl_solver_set_lights() in solver.h.
 */
#ifndef DAPPLE_LIGHT_H
#define DAPPLE_LIGHT_H

#ifdef __cplusplus
extern "C" {
#endif

/** Largest coordinate and radius of a light, from the picture's origin [px]. */
#define DPL_MAX_LIGHT_COORDINATE 1e6

/** A disc that shines evenly: radiance color * intensity. */
typedef struct dpl_light {
    double position[2]; /**< centre in the picture [px], within DPL_MAX_LIGHT_COORDINATE */
    double radius;      /**< [px], 0 .. DPL_MAX_LIGHT_COORDINATE */
    float color[3];     /**< RGB, linear, >= 0, finite */
    float intensity;    /**< >= 0, finite */
} dpl_light;

#ifdef __cplusplus
}
#endif
#endif
