/* The public face of shadows: argument checks, making and freeing. */
#include "shadow/shadow.h"
#include "api/light_fault.h"
#include "api/output_fault.h"

#include "base/desc.h"

/* ---- making and freeing --------------------------------------------------------------------------- */

static bool is_field_method(dpl_shadow_method method) {
    return method >= DPL_SHADOW_DISTANCE_HARD && method <= DPL_SHADOW_DISTANCE_CONES;
}

/* What is wrong with a desc, or NULL. */
static const char *fault_of(const dpl_shadow_desc *d) {
    if (!dpl_shadow_ops_of(d->method))
        return "there is no such method";
    if ((uint32_t)d->weight >= DPL_WEIGHT_COUNT)
        return "there is no such weight";
    if (d->map_method != DPL_SHADOW_MOMENTS_SOFT && d->map_method != DPL_SHADOW_PCSS &&
        d->map_method != DPL_SHADOW_RAYS)
        return "the map term is rays, moments-soft or pcss";
    if (!is_field_method(d->field_method))
        return "the field term is one of the distance methods";
    if (!(d->tau > 0.0f && d->tau <= 1.0f))
        return "tau must be above 0 and at most 1";
    if (!(d->constant >= 0.0f && d->constant <= 1.0f))
        return "the constant must be 0 .. 1";
    if (!(d->blend_distance > 0.0f && d->blend_distance <= 1e6f))
        return "the blend distance must be above 0 and at most 1e6 px";
    if (d->map_resolution < 16 || d->map_resolution > 65536 || d->map_resolution % 4 != 0)
        return "the map resolution must be a multiple of 4 from 16 to 65536";
    if (d->field_level < 0 || d->field_level > DPL_MIPS_MOST)
        return "the field level must be 0 .. 4";
    if (d->sub_cones < 1 || d->sub_cones > 64)
        return "there may be 1 to 64 sub-cones";
    if (d->samples < 0 || d->samples > 65536)
        return "there may be 1 to 65536 samples";
    if (d->method == DPL_SHADOW_RAYS && d->samples > 256)
        return "there may be 1 to 256 rays";
    return NULL;
}

dpl_status dpl_shadow_create(dpl_context *context, const dpl_shadow_desc *desc, dpl_shadow **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the shadow desc was not made by dpl_shadow_desc_default()");
    const char *fault = fault_of(desc);
    if (fault)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s", fault);
    dpl_shadow *shadow = dpl_allocate(context, 1, sizeof *shadow);
    if (!shadow)
        return DPL_ERROR_MEMORY;
    memset(shadow, 0, sizeof *shadow);
    shadow->context = context;
    shadow->desc = *desc;
    *out = shadow;
    return DPL_OK;
}

void dpl_shadow_destroy(dpl_shadow *shadow) {
    if (!shadow)
        return;
    dpl_context *context = shadow->context;
    dpl_solid_free(context, &shadow->solid);
    dpl_mips_free(context, &shadow->mips);
    dpl_horizon_free(context, &shadow->horizon);
    dpl_polar_map_free(context, &shadow->map);
    dpl_ray_table_free(context, &shadow->rays);
    dpl_buffer_free(context, &shadow->result);
    dpl_release(context, shadow, 1, sizeof *shadow);
}

/* ---- using ---------------------------------------------------------------------------------------- */

static dpl_status check_field(const dpl_shadow *shadow, const dpl_field *field) {
    if (field->context != shadow->context)
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT, "the field was made from another context");
    return DPL_OK;
}

/* Makes the stride of a plane of V explicit; rows must not overlap. */
static dpl_status check_stride(const dpl_shadow *shadow, int32_t width, ptrdiff_t *row_stride) {
    ptrdiff_t packed = (ptrdiff_t)((size_t)width * sizeof(float));
    if (*row_stride == 0)
        *row_stride = packed;
    if (*row_stride < packed && -*row_stride < packed)
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT, "the rows of the output overlap");
    if (*row_stride % (ptrdiff_t)sizeof(float) != 0)
        return dpl_fail(shadow->context, DPL_ERROR_ARGUMENT,
                        "the output's stride is not a multiple of a float");
    return DPL_OK;
}

dpl_status dpl_shadow_visibility(dpl_shadow *shadow, dpl_field *field, const dpl_light *light,
                                 float *visibility, ptrdiff_t row_stride) {
    if (!shadow || !field || !light || !visibility)
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(check_field(shadow, field));
    DPL_TRY(dpl_lights_check(shadow->context, light, 1));
    DPL_TRY(check_stride(shadow, dpl_field_width(field), &row_stride));
    return dpl_shadow_find_visibility(shadow, field, light, visibility, row_stride);
}

dpl_status dpl_shadow_light(dpl_shadow *shadow, dpl_field *field, const dpl_light *lights, int32_t count,
                            const dpl_output *given) {
    if (!shadow || !field || !given || count < 0 || (!lights && count > 0))
        return DPL_ERROR_ARGUMENT;
    dpl_output output = *given;
    dpl_output_rules rules = {dpl_field_width(field), dpl_field_height(field), "field", true};
    DPL_TRY(check_field(shadow, field));
    DPL_TRY(dpl_output_check(shadow->context, &rules, &output));
    DPL_TRY(dpl_lights_check(shadow->context, lights, count));
    return dpl_shadow_find_light(shadow, field, lights, count, &output);
}

void dpl_shadow_read_stats(const dpl_shadow *shadow, dpl_shadow_stats *stats) {
    *stats = shadow->stats;
}

const char *dpl_shadow_method_name(dpl_shadow_method method) {
    const dpl_shadow_ops *ops = dpl_shadow_ops_of(method);
    return ops ? ops->name : "?";
}

const char *dpl_shadow_weight_name(dpl_shadow_weight weight) {
    static const char *const names[DPL_WEIGHT_COUNT] = {
        "smooth-min", "min", "constant", "distance", "gap", "variance", "literal",
    };
    return (uint32_t)weight < DPL_WEIGHT_COUNT ? names[weight] : "?";
}
