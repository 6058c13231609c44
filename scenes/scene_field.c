/* From a scene to the field that light travels through. */
#include "scene.h"

static bool failed(dpl_context *context, dpl_status status, dpl_error *error) {
    const char *message = dpl_context_message(context);
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

/* Extinction pictures hold opacities: 1 is opaque. Without one, the library lets the emission decide. */
static dpl_status draw_image(dpl_field *field, const dpl_scene_image *image) {
    dpl_layer layer = dpl_layer_default();
    if (image->emission_picture.data)
        layer.emission = dpl_picture_pixels(&image->emission_picture);
    if (image->extinction_picture.data)
        layer.extinction = dpl_picture_pixels(&image->extinction_picture);
    if (image->albedo_picture.data)
        layer.albedo = dpl_picture_pixels(&image->albedo_picture);
    layer.x = image->at[0];
    layer.y = image->at[1];
    layer.intensity = (float)image->intensity;
    layer.extinction_is_opacity = 1;
    return dpl_field_draw_layer(field, &layer);
}

static dpl_status set_sky(const dpl_scene *scene, dpl_field *field) {
    float ring[DPL_MAX_SKY_SECTORS][3] = {{(float)scene->sky[0], (float)scene->sky[1], (float)scene->sky[2]}};
    for (int32_t k = 0; k < scene->sky_sectors && k < DPL_MAX_SKY_SECTORS; k++)
        for (int c = 0; c < 3; c++)
            ring[k][c] = (float)scene->sky_ring[k][c];
    int32_t count = scene->sky_ring ? scene->sky_sectors : 1;
    return dpl_field_set_sky_ring(field, (const float(*)[3])ring, count);
}

static dpl_status draw_all(const dpl_scene *scene, dpl_field *field) {
    dpl_field_clear(field);
    dpl_status status = set_sky(scene, field);
    for (int32_t i = 0; status == DPL_OK && i < scene->image_count; i++)
        status = draw_image(field, &scene->images[i]);
    if (status == DPL_OK && scene->shape_count > 0)
        status = dpl_field_draw_shapes(field, scene->shapes, scene->shape_count);
    return status;
}

bool dpl_scene_draw(const dpl_scene *scene, dpl_context *context, dpl_field *field, dpl_error *error) {
    if (dpl_field_width(field) != scene->width || dpl_field_height(field) != scene->height)
        return dpl_error_set(error, "the scene is %dx%d px, but the field is %dx%d px", scene->width,
                             scene->height, dpl_field_width(field), dpl_field_height(field));
    if (dpl_field_margin(field) != scene->margin)
        return dpl_error_set(error, "the scene has a margin of %d px, but the field one of %d px",
                             scene->margin, dpl_field_margin(field));
    dpl_status status = draw_all(scene, field);
    return status == DPL_OK || failed(context, status, error);
}

bool dpl_scene_build_field(const dpl_scene *scene, dpl_context *context, bool keep_shape_distance,
                           dpl_field **field, dpl_error *error) {
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = scene->width;
    desc.height = scene->height;
    desc.margin = scene->margin;
    desc.keep_shape_distance = keep_shape_distance;
    *field = NULL;
    dpl_status status = dpl_field_create(context, &desc, field);
    if (status != DPL_OK)
        return failed(context, status, error);
    if (dpl_scene_draw(scene, context, *field, error))
        return true;
    dpl_field_destroy(*field);
    *field = NULL;
    return false;
}
