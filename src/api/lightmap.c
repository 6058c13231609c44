/* dpl_lightmap_apply(): checks, then rows in parallel, each in runs that stay in the innermost cache. Called
 * by the user. */
#include <dapple/lightmap.h>

#include "base/desc.h"
#include "base/layout.h"
#include "field/reader.h"
#include "job/jobs.h"
#include "metric/view.h"

#include <dapple/field.h>
#include <math.h>

typedef struct lightmap_work {
    const dpl_kernels *kernels;
    dpl_pixels light, albedo, output; /* strides explicit */
    float exposure;
    dpl_lightmap_curve curve;
    dpl_byte_values bytes; /* of the albedo */
    dpl_srgb_steps steps;  /* filled in where the result is encoded again */
} lightmap_work;

/* ---- checking ------------------------------------------------------------------------------------- */

static ptrdiff_t row_bytes(const dpl_pixels *p) {
    return (ptrdiff_t)((size_t)p->width * (size_t)p->channels * dpl_format_bytes(p->format));
}

/* Checks what is the same for all three, except the format, and makes the stride explicit. */
static dpl_status check_layout(dpl_context *context, const char *name, dpl_pixels *p) {
    if (!p->data)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: data is NULL", name);
    if (p->channels != 3 && p->channels != 4)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: %d channels, not 3 or 4", name, p->channels);
    if (p->width < 1 || p->width > DPL_MAX_SIZE || p->height < 1 || p->height > DPL_MAX_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE, "%s: size %d x %d is not within 1 .. %d", name, p->width,
                        p->height, DPL_MAX_SIZE);
    p->row_stride = dpl_stride_or_tight(p->row_stride, row_bytes(p));
    if (!dpl_stride_holds(p->row_stride, row_bytes(p)))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: row_stride %td is shorter than a row of %td bytes",
                        name, p->row_stride, row_bytes(p));
    if (!dpl_layout_is_aligned(p->data, p->row_stride, p->format))
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "%s: data or row_stride is not a multiple of a channel's %d bytes", name,
                        (int)dpl_format_bytes(p->format));
    return DPL_OK;
}

static dpl_status check_formats(dpl_context *context, const lightmap_work *w) {
    if (w->light.format != DPL_FORMAT_F32 && w->light.format != DPL_FORMAT_F16)
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "light: format is %d, not DPL_FORMAT_F32 or DPL_FORMAT_F16", (int)w->light.format);
    if (w->albedo.format != DPL_FORMAT_UNORM8 && w->albedo.format != DPL_FORMAT_SRGB8)
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "albedo: format is %d, not DPL_FORMAT_UNORM8 or DPL_FORMAT_SRGB8",
                        (int)w->albedo.format);
    if (w->output.format != w->albedo.format)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "output: format is %d, the albedo's is %d",
                        (int)w->output.format, (int)w->albedo.format);
    return DPL_OK;
}

static dpl_status check_size(dpl_context *context, const char *name, const dpl_pixels *p,
                             const dpl_pixels *albedo) {
    if (p->width == albedo->width && p->height == albedo->height)
        return DPL_OK;
    return dpl_fail(context, DPL_ERROR_SIZE, "%s: size is %d x %d, the albedo's is %d x %d", name, p->width,
                    p->height, albedo->width, albedo->height);
}

/* Address of the lowest byte, and one behind the highest. */
static void extent(const dpl_pixels *p, uintptr_t *low, uintptr_t *high) {
    ptrdiff_t rows = p->row_stride * (p->height - 1);
    *low = (uintptr_t)p->data + (uintptr_t)(rows < 0 ? rows : 0);
    *high = (uintptr_t)p->data + (uintptr_t)(rows > 0 ? rows : 0) + (uintptr_t)row_bytes(p);
}

/* Do two pictures share bytes? Two parts of one larger picture, side by side, do not. */
static bool overlap(const dpl_pixels *a, const dpl_pixels *b) {
    uintptr_t a_low, a_high, b_low, b_high;
    extent(a, &a_low, &a_high);
    extent(b, &b_low, &b_high);
    if (a_high <= b_low || b_high <= a_low)
        return false;
    ptrdiff_t pitch = a->row_stride < 0 ? -a->row_stride : a->row_stride;
    if (b->row_stride != pitch && b->row_stride != -pitch)
        return true;
    /* how far b's rows begin behind a's within the larger picture */
    ptrdiff_t behind = (ptrdiff_t)((b_low - a_low) % (uintptr_t)pitch);
    if (b_low < a_low)
        behind = (pitch - (ptrdiff_t)((a_low - b_low) % (uintptr_t)pitch)) % pitch;
    return behind < row_bytes(a) || behind + row_bytes(b) > pitch;
}

static bool same_layout(const dpl_pixels *a, const dpl_pixels *b) {
    return a->data == b->data && a->row_stride == b->row_stride && a->channels == b->channels;
}

static dpl_status check_pictures(dpl_context *context, lightmap_work *w) {
    DPL_TRY(check_formats(context, w));
    DPL_TRY(check_layout(context, "albedo", &w->albedo));
    DPL_TRY(check_layout(context, "light", &w->light));
    DPL_TRY(check_layout(context, "output", &w->output));
    DPL_TRY(check_size(context, "light", &w->light, &w->albedo));
    DPL_TRY(check_size(context, "output", &w->output, &w->albedo));
    if (overlap(&w->output, &w->light))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the output overlaps the light");
    if (!same_layout(&w->output, &w->albedo) && overlap(&w->output, &w->albedo))
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "the output overlaps the albedo without being the same buffer in the same layout");
    return DPL_OK;
}

static dpl_status check_desc(dpl_context *context, const dpl_lightmap_desc *desc) {
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC,
                        "the lightmap desc was not made by dpl_lightmap_desc_default()");
    if (!(desc->exposure >= 0.0f && isfinite(desc->exposure)))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the exposure must be finite and not negative");
    if (desc->curve != DPL_LIGHTMAP_CLAMP && desc->curve != DPL_LIGHTMAP_DISPLAY)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "there is no curve %d", (int)desc->curve);
    return DPL_OK;
}

/* ---- applying ------------------------------------------------------------------------------------- */

/* Lit colours as display bytes. */
static void apply_curve(const lightmap_work *w, int32_t count, uint8_t *rgb, const float *lit) {
    if (w->curve == DPL_LIGHTMAP_DISPLAY)
        w->kernels->tonemap(count, rgb, lit);
    else if (w->albedo.format == DPL_FORMAT_SRGB8)
        w->kernels->srgb_from_linear(count, rgb, lit, &w->steps);
    else
        w->kernels->bytes_from_linear(count, rgb, lit);
}

static void apply_run(const lightmap_work *w, int32_t x, int32_t y, int32_t count) {
    float albedo[4 * DPL_RUN], light[4 * DPL_RUN], lit[3 * DPL_RUN];
    uint8_t rgb[3 * DPL_RUN];
    int32_t in = w->albedo.channels, out = w->output.channels, lights = w->light.channels;
    dpl_read_run(w->kernels, &w->albedo, &w->bytes, x, y, count, albedo);
    dpl_read_run(w->kernels, &w->light, NULL, x, y, count, light);
    for (int32_t i = 0; i < count; i++)
        for (int32_t c = 0; c < 3; c++)
            lit[3 * i + c] = albedo[i * in + c] * light[i * lights + c] * w->exposure;
    apply_curve(w, 3 * count, rgb, lit);
    const uint8_t *from = (const uint8_t *)w->albedo.data + w->albedo.row_stride * y + x * in;
    uint8_t *to = (uint8_t *)w->output.data + w->output.row_stride * y + x * out;
    for (int32_t i = 0; i < count; i++, from += in, to += out) {
        uint8_t alpha = in == 4 ? from[3] : 255;
        memcpy(to, rgb + 3 * i, 3);
        if (out == 4)
            to[3] = alpha;
    }
}

static void apply_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const lightmap_work *w = task;
    int32_t width = w->albedo.width;
    for (int32_t y = begin; y < end; y++)
        for (int32_t x = 0; x < width; x += DPL_RUN)
            apply_run(w, x, y, width - x < DPL_RUN ? width - x : DPL_RUN);
}

dpl_status dpl_lightmap_apply(dpl_context *context, const dpl_pixels *light, const dpl_pixels *albedo,
                              const dpl_lightmap_desc *desc, const dpl_output *output) {
    if (!context)
        return DPL_ERROR_ARGUMENT;
    if (!light || !albedo || !output)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "light, albedo or output is NULL");
    dpl_lightmap_desc defaults = dpl_lightmap_desc_default();
    if (!desc)
        desc = &defaults;
    DPL_TRY(check_desc(context, desc));
    lightmap_work w;
    w.kernels = context->kernels;
    w.light = *light;
    w.albedo = *albedo;
    w.output = (dpl_pixels){output->data,   output->format,   output->width,
                            output->height, output->channels, output->row_stride};
    w.exposure = desc->exposure;
    w.curve = desc->curve;
    DPL_TRY(check_pictures(context, &w));
    dpl_byte_values_fill(&w.bytes, w.albedo.format);
    if (w.albedo.format == DPL_FORMAT_SRGB8 && w.curve == DPL_LIGHTMAP_CLAMP)
        dpl_srgb_steps_fill(&w.steps);
    return dpl_jobs_run(context, apply_rows, w.albedo.height, 8, &w);
}
