/* M.R.M.A.: the map term and the field term under one weight. Both are nearly upper bounds of visibility that
 * fail in different places (maps lose contact shadows, marches leak past thin blockers), so the tighter of
 * the two is the better one; the smooth minimum hides the kink. */
#include "shadow/blend.h"

#include "shadow/literal.h"
#include "shadow/map_shadow.h"
#include "shadow/march.h"
#include "shadow/moments.h"

#include <math.h>

/* Errors of the terms in penumbrae, measured over the eight scenes (`dapple shadow --compare all`): what the
 * inverse variance weighs with. Of n cones each errs as one does, on 1/n of the light. */
#define SOFT_ERROR 0.13
#define PCSS_ERROR 0.12
#define RAYS_ERROR 0.013
#define HARD_ERROR 0.35
#define GAP_ERROR 0.29
#define SIGNED_ERROR 0.13
#define TWO_SIDED_ERROR 0.12

/* ---- the weight ----------------------------------------------------------------------------------- */

double dpl_blend_weight(const dpl_shadow_desc *desc, const dpl_blend_terms *terms) {
    double k = (double)desc->blend_distance;
    switch (desc->weight) {
    case DPL_WEIGHT_SMOOTH_MIN:
        return dpl_blend_smooth_minimum(terms->map, terms->field, (double)desc->tau);
    case DPL_WEIGHT_MIN:
        return terms->map < terms->field ? 1.0 : 0.0;
    case DPL_WEIGHT_CONSTANT:
        return (double)desc->constant;
    case DPL_WEIGHT_DISTANCE:
        return terms->distance / (terms->distance + k);
    case DPL_WEIGHT_GAP:
        return terms->gap / (terms->gap + k);
    case DPL_WEIGHT_VARIANCE:
        return terms->field_variance / (terms->field_variance + terms->map_variance);
    case DPL_WEIGHT_LITERAL:
        break;
    }
    return 0.0;
}

/* ---- errors ---------------------------------------------------------------------------------------- */

static double error_of(const dpl_shadow_desc *desc, dpl_shadow_method method) {
    switch (method) {
    case DPL_SHADOW_MOMENTS_SOFT:
        return SOFT_ERROR;
    case DPL_SHADOW_PCSS:
        return PCSS_ERROR;
    case DPL_SHADOW_RAYS:
        return RAYS_ERROR;
    case DPL_SHADOW_DISTANCE_HARD:
        return HARD_ERROR;
    case DPL_SHADOW_DISTANCE_SIGNED:
        return SIGNED_ERROR;
    case DPL_SHADOW_DISTANCE_TWO_SIDED:
        return TWO_SIDED_ERROR;
    case DPL_SHADOW_DISTANCE_CONES:
        return TWO_SIDED_ERROR / desc->sub_cones;
    default:
        return GAP_ERROR;
    }
}

/* ---- guards --------------------------------------------------------------------------------------- */

typedef enum guard { BOTH, MAP_ONLY, FIELD_ONLY } guard;

/* Width of a texel of the map at the receiver, and the spacing of the field [px]. */
static double texel_at(const dpl_shadow_view *view, const dpl_receiver *r) {
    return 2.0 * 3.14159265358979323846 * r->distance / view->map->texels;
}

static double spacing_of(const dpl_shadow_view *view) {
    return 1 << view->desc->field_level;
}

/* A term that is coarser than the penumbra smears it. The finer one stays; where both are too coarse, both
 * do. */
static guard choose(const dpl_shadow_view *view, const dpl_receiver *r, const dpl_map_term *map) {
    double texel = texel_at(view, r), spacing = spacing_of(view);
    if (!view->desc->guard || !(map->penumbra > 0.0))
        return BOTH;
    bool map_is_coarse = texel > map->penumbra, field_is_coarse = spacing > map->penumbra;
    if (map_is_coarse == field_is_coarse)
        return BOTH;
    return map_is_coarse ? FIELD_ONLY : MAP_ONLY;
}

/* Neither term is a true bound. A minimum is worth having only among terms that err alike: one that errs less
 * than half as much is better left alone. */
static bool takes_minimum(const dpl_shadow_desc *desc) {
    return desc->guard && (desc->weight == DPL_WEIGHT_SMOOTH_MIN || desc->weight == DPL_WEIGHT_MIN);
}

static bool map_is_outdone(const dpl_shadow_desc *desc) {
    return takes_minimum(desc) && desc->field_level == 0 &&
           2.0 * error_of(desc, desc->field_method) < error_of(desc, desc->map_method);
}

bool dpl_shadow_map_is_enough(const dpl_shadow_desc *desc) {
    return takes_minimum(desc) && desc->map_method == DPL_SHADOW_RAYS &&
           2.0 * RAYS_ERROR < error_of(desc, desc->field_method);
}

/* ---- the method ----------------------------------------------------------------------------------- */

/* A term's own squared error, and that of a sample as wide as its share of the penumbra. */
static double variance_of(double error, double sample, double penumbra) {
    double share = penumbra > 0.0 ? fmin(sample / penumbra, 1.0) : 0.0;
    return error * error + share * share / 12.0;
}

static double blend_terms(const dpl_shadow_view *view, const dpl_receiver *r, const dpl_map_term *map,
                          const dpl_field_term *field) {
    dpl_blend_terms terms = {
        .map = map->visibility,
        .field = field->visibility,
        .distance = r->distance,
        .gap = field->gap,
        .map_variance =
            variance_of(error_of(view->desc, view->desc->map_method), texel_at(view, r), map->penumbra),
        .field_variance =
            variance_of(error_of(view->desc, view->desc->field_method), spacing_of(view), map->penumbra),
    };
    double a = dpl_blend_weight(view->desc, &terms);
    return a * map->visibility + (1.0 - a) * field->visibility;
}

/* The paper's last equation: one summand of its endless sum, no surface to turn away from the light, lengths
 * in units of the map's reach, the sum of distances gathered by a march in open space. */
static double literal(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    dpl_polar_window window = dpl_polar_window_around(view->map, -r->dx, -r->dy, 0.0);
    dpl_distances field = dpl_mips_level(view->mips, view->solid, view->desc->field_level);
    double b[4], unit = view->map->reach, occlusion = 0.0, t = 0.5, end = r->distance - view->radius;
    dpl_polar_moments(view->map, window, b);
    double mu1 = 0.5 * (b[0] + 1.0), mu2 = 0.25 * (b[1] + 2.0 * b[0] + 1.0);
    for (; t < end; counts->steps++) {
        double x = r->x + t * r->dx, y = r->y + t * r->dy;
        if (x < 0.0 || y < 0.0 || x > view->solid->width || y > view->solid->height)
            break;
        double h = (double)dpl_distances_at(&field, (float)x, (float)y);
        if (h < 0.5)
            break;
        occlusion += h;
        t += h;
    }
    double v = dpl_literal_summand(mu1, mu2, r->distance / unit, (double)view->desc->blend_distance / unit,
                                   1.0, occlusion / unit, 1.0);
    return v > 0.0 ? fmin(v, 1.0) : 0.0;
}

/* False where the ray map does not answer: it has no width of a kernel that could be too coarse. */
static bool look_up(const dpl_shadow_view *view, const dpl_receiver *r, dpl_map_term *term) {
    const dpl_ray_map *map = view->rays;
    float visible, dx = (float)(r->x - view->position[0]), dy = (float)(r->y - view->position[1]);
    if (map->rays == 0 || r->distance <= DPL_RAY_MAP_NEAR * view->radius)
        return false;
    view->field->context->kernels->see_rays(map, 1, &visible, &dx, &dy);
    *term = (dpl_map_term){.visibility = (double)visible};
    return true;
}

static bool find_map_term(const dpl_shadow_view *view, const dpl_receiver *r, dpl_map_term *term,
                          dpl_shadow_counts *counts) {
    if (view->desc->map_method == DPL_SHADOW_RAYS)
        return look_up(view, r, term);
    *term = view->desc->map_method == DPL_SHADOW_PCSS ? dpl_map_pcss_term(view, r, counts)
                                                      : dpl_map_soft_term(view, r, counts);
    return true;
}

double dpl_shadow_blend(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    const dpl_shadow_desc *desc = view->desc;
    if (desc->weight == DPL_WEIGHT_LITERAL)
        return literal(view, r, counts);
    if (!(view->radius > 0.0)) /* a hard shadow has no penumbra to be estimated */
        return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_HARD, counts).visibility;
    dpl_map_term map;
    if (map_is_outdone(desc) || !find_map_term(view, r, &map, counts)) {
        counts->field_only++;
        return dpl_field_term_of(view, r, desc->field_method, counts).visibility;
    }
    guard kept = choose(view, r, &map);
    counts->map_only += kept == MAP_ONLY;
    counts->field_only += kept == FIELD_ONLY;
    if (kept == MAP_ONLY)
        return map.visibility;
    dpl_field_term field = dpl_field_term_of(view, r, desc->field_method, counts);
    return kept == FIELD_ONLY ? field.visibility : blend_terms(view, r, &map, &field);
}
