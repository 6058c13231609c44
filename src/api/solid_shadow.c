/* The public face of shadows in space: argument checks, making and freeing, counters. */
#include "shadow/solid_shadow.h"

#include "base/desc.h"
#include "job/jobs.h"

#include <math.h>

static const char *const method_names[DPL_SOLID_METHOD_COUNT] = {"mrma", "moments", "march", "reference"};

/* Rays start this share of the mesh's size above surfaces. */
#define SURFACE_OFFSET 1e-4f

#define FARTHEST_LIGHT 1e6f
#define MOST_RECEIVERS ((int64_t)1 << 36)

const char *dpl_solid_method_name(dpl_solid_method method) {
    return (unsigned)method < DPL_SOLID_METHOD_COUNT ? method_names[method] : "?";
}

/* ---- making and freeing --------------------------------------------------------------------------- */

static bool is_within(float value, float least, float most) {
    return value >= least && value <= most; /* not-a-number is not */
}

static const char *fault_of_desc(const dpl_solid_shadow_desc *desc) {
    int32_t cones = desc->sub_cones;
    if ((unsigned)desc->method >= DPL_SOLID_METHOD_COUNT)
        return "there is no such method";
    if ((unsigned)desc->weight >= DPL_SOLID_WEIGHT_COUNT)
        return "there is no such weight";
    if (!(desc->tau > 0.0f && desc->tau <= 1.0f))
        return "tau must be above 0 and at most 1";
    if (!is_within(desc->constant, 0.0f, 1.0f))
        return "the constant weight must be within 0 .. 1";
    if (desc->map_resolution < 16 || desc->map_resolution > 4096 || desc->map_resolution % 4 != 0)
        return "the map resolution must be a multiple of 4 within 16 .. 4096";
    if (cones != 1 && cones != 4 && cones != 9 && cones != 16)
        return "sub-cones are 1, 4, 9 or 16";
    if (desc->samples < 1 || desc->samples > 65536)
        return "samples must be within 1 .. 65536";
    if (desc->refine_rays < 0 || desc->refine_rays > 256)
        return "rays of refinement must be within 0 .. 256";
    if (!is_within(desc->refine_threshold, 0.0f, 1.0f))
        return "the threshold of refinement must be within 0 .. 1";
    if (!(desc->refine_distance > 0.0f))
        return "the distance of refinement must be above 0";
    if (!isfinite(desc->eye[0] + desc->eye[1] + desc->eye[2]))
        return "the eye must be finite";
    return NULL;
}

dpl_status dpl_solid_shadow_create(dpl_context *context, const dpl_solid_shadow_desc *desc,
                                   dpl_solid_shadow **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC,
                        "the shadow desc was not made by dpl_solid_shadow_desc_default()");
    const char *fault = fault_of_desc(desc);
    if (fault)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s", fault);
    dpl_solid_shadow *shadow = dpl_allocate(context, 1, sizeof *shadow);
    if (!shadow)
        return DPL_ERROR_MEMORY;
    memset(shadow, 0, sizeof *shadow);
    shadow->context = context;
    shadow->desc = *desc;
    dpl_solid_points_spread(&shadow->points, desc->refine_rays);
    size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    dpl_status status = dpl_buffer_reserve(context, &shadow->counts, workers, sizeof(dpl_solid_counts));
    if (status != DPL_OK)
        dpl_solid_shadow_destroy(shadow);
    else
        *out = shadow;
    return status;
}

void dpl_solid_shadow_destroy(dpl_solid_shadow *shadow) {
    if (!shadow)
        return;
    dpl_buffer *buffers[] = {&shadow->sums, &shadow->ranges, &shadow->corners, &shadow->rows,
                             &shadow->counts};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(shadow->context, buffers[i]);
    dpl_release(shadow->context, shadow, 1, sizeof *shadow);
}

/* ---- the light ------------------------------------------------------------------------------------ */

static const char *fault_of_light(const dpl_solid_light *light) {
    bool sun = light->kind == DPL_SOLID_LIGHT_DIRECTIONAL;
    if ((unsigned)light->kind > DPL_SOLID_LIGHT_DIRECTIONAL)
        return "there is no such kind of light";
    for (int i = 0; i < 3; i++) {
        if (!is_within(fabsf(light->position[i]), 0.0f, FARTHEST_LIGHT))
            return "a light must be within 1e6";
        if (!is_within(fabsf(light->direction[i]), 0.0f, FARTHEST_LIGHT))
            return "a light's direction must be finite";
        if (!is_within(light->color[i], 0.0f, 1e9f))
            return "a light's color must be finite and not negative";
    }
    if (!(dpl_solid_dot(light->direction, light->direction) > 1e-12f))
        return "a light's direction must not be nothing";
    if (!(light->radius > 0.0f && light->radius <= (sun ? 1.0f : FARTHEST_LIGHT)))
        return sun ? "a directional light's radius must be above 0 and at most 1 radian"
                   : "a light's radius must be above 0 and at most 1e6";
    if (!is_within(light->angle, 0.01f, 1.4f))
        return "a spot light's angle must be within 0.01 .. 1.4 radians";
    if (!is_within(light->intensity, 0.0f, 1e9f))
        return "a light's intensity must be finite and not negative";
    return NULL;
}

static dpl_status check_casters(const dpl_solid_shadow *shadow, const dpl_mesh *mesh,
                                const dpl_mesh_field *field) {
    bool marches = shadow->desc.method == DPL_SOLID_MRMA || shadow->desc.method == DPL_SOLID_MARCH;
    if (mesh->facts.triangles == 0)
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT, "the mesh has no triangles");
    if (marches && !(field && field->measured))
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT,
                        "method %s marches through distances: measure a field first",
                        dpl_solid_method_name(shadow->desc.method));
    return DPL_OK;
}

/* Whether all points of the light are outside of a mesh that has an inside everywhere or nowhere. */
static bool shines_from_outside(const dpl_solid_shadow *shadow) {
    const dpl_solid_light *light = &shadow->light;
    if (!shadow->mesh->is_solid || !(shadow->field && shadow->field->measured))
        return false;
    return light->kind == DPL_SOLID_LIGHT_DIRECTIONAL ||
           dpl_mesh_field_distance(shadow->field, light->position) >
               light->radius + shadow->field->grid.spacing;
}

static void keep(dpl_solid_shadow *shadow, const dpl_mesh *mesh, const dpl_mesh_field *field,
                 const dpl_solid_light *light) {
    float longest = 0.0f, length = sqrtf(dpl_solid_dot(light->direction, light->direction));
    shadow->mesh = mesh;
    shadow->field = field;
    shadow->light = *light;
    if (field && field->measured)
        shadow->lattice = dpl_mesh_lattice_of(&field->grid, field->distance.data);
    for (int axis = 0; axis < 3; axis++) {
        shadow->light.direction[axis] /= length;
        longest = fmaxf(longest, mesh->facts.high[axis] - mesh->facts.low[axis]);
    }
    shadow->longest = longest;
    shadow->surface_offset = SURFACE_OFFSET * longest;
    shadow->cone_cosine = cosf(light->angle);
    shadow->sun_spread = tanf(light->radius);
    shadow->exits_only = shines_from_outside(shadow);
    shadow->receivers = 0;
    memset(shadow->counts.data, 0, shadow->counts.bytes);
}

dpl_status dpl_solid_shadow_set_light(dpl_solid_shadow *shadow, const dpl_mesh *mesh,
                                      const dpl_mesh_field *field, const dpl_solid_light *light) {
    if (!shadow || !mesh || !light)
        return DPL_ERROR_ARGUMENT;
    shadow->mesh = NULL;
    if (!DPL_DESC_IS_GOOD(light))
        return dpl_fail(shadow->context, DPL_ERROR_DESC,
                        "the light was not made by dpl_solid_light_default()");
    const char *fault = fault_of_light(light);
    if (fault)
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT, "%s", fault);
    DPL_TRY(check_casters(shadow, mesh, field));
    keep(shadow, mesh, field, light);
    dpl_status status = dpl_solid_maps_build(shadow);
    if (status != DPL_OK)
        shadow->mesh = NULL;
    return status;
}

void dpl_solid_light_shine(const dpl_solid_light *light, const float position[3], const float normal[3],
                           float rgb[3]) {
    float away[3], reach = light->intensity, towards = 0.0f, square = 0.0f, axis_length = 0.0f, along = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        bool sun = light->kind == DPL_SOLID_LIGHT_DIRECTIONAL;
        away[axis] = sun ? light->direction[axis] : position[axis] - light->position[axis];
        towards -= away[axis] * normal[axis];
        square += away[axis] * away[axis];
        axis_length += light->direction[axis] * light->direction[axis];
        along += away[axis] * light->direction[axis];
    }
    float distance = sqrtf(square);
    if (light->kind == DPL_SOLID_LIGHT_SPOT && !(along >= distance * sqrtf(axis_length) * cosf(light->angle)))
        reach = 0.0f;
    if (light->kind != DPL_SOLID_LIGHT_DIRECTIONAL)
        reach /= fmaxf(square, light->radius * light->radius);
    reach *= fmaxf(distance > 0.0f ? towards / distance : 0.0f, 0.0f);
    for (int c = 0; c < 3; c++)
        rgb[c] = light->color[c] * reach;
}

/* ---- visibility ----------------------------------------------------------------------------------- */

dpl_status dpl_solid_shadow_visibility(dpl_solid_shadow *shadow, const float (*positions)[3],
                                       const float (*normals)[3], int64_t count, float *visibility) {
    if (!shadow || count < 0 || count > MOST_RECEIVERS || (count > 0 && (!positions || !visibility)))
        return DPL_ERROR_ARGUMENT;
    if (!shadow->mesh)
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT, "the shadow has no light");
    return dpl_solid_shadow_solve(shadow, positions, normals, count, visibility);
}

void dpl_solid_shadow_read_stats(const dpl_solid_shadow *shadow, dpl_solid_shadow_stats *stats) {
    const dpl_buffer *buffers[] = {&shadow->sums, &shadow->ranges, &shadow->corners, &shadow->rows,
                                   &shadow->counts};
    const dpl_solid_counts *counts = shadow->counts.data;
    *stats = (dpl_solid_shadow_stats){.receivers = shadow->receivers};
    for (size_t i = 0; i < shadow->counts.bytes / sizeof *counts; i++) {
        stats->lit += counts[i].lit;
        stats->dark += counts[i].dark;
        stats->refined += counts[i].refined;
        stats->steps += counts[i].steps;
        stats->rays += counts[i].rays;
    }
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        stats->memory_bytes += (int64_t)buffers[i]->bytes;
}
