/* Makes a session and holds its world. Called by web/module/core.js. */
#include "session.h"

#include "host.h"

#include <stdlib.h>
#include <string.h>

dpl_web_session *dpl_web_open(int32_t helpers) {
    dpl_web_session *session = calloc(1, sizeof *session);
    if (!session)
        return NULL;
    session->crew.helpers = helpers;
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = helpers + 1;
    desc.tasks = dpl_web_crew_hooks(&session->crew);
    if (dpl_context_create(&desc, &session->context) == DPL_OK)
        return session;
    free(session);
    return NULL;
}

dpl_web_crew *dpl_web_crew_of(dpl_web_session *session) {
    return &session->crew;
}

const char *dpl_web_isa(const dpl_web_session *session) {
    return dpl_isa_name(dpl_context_isa(session->context));
}

const char *dpl_web_message(const dpl_web_session *session, int32_t status) {
    const char *message = dpl_context_message(session->context);
    return message[0] ? message : dpl_status_text((dpl_status)status);
}

static void forget_world(dpl_web_session *session) {
    dpl_field_destroy(session->field);
    session->field = NULL;
    free(session->planes[0]);
    memset(session->planes, 0, sizeof session->planes);
    session->width = session->height = 0;
}

int32_t dpl_web_resize(dpl_web_session *session, int32_t width, int32_t height) {
    if (session->field && session->width == width && session->height == height)
        return DPL_OK;
    forget_world(session);
    /* The solver's and the shadow's buffers belong to the old size. */
    dpl_solver_destroy(session->solver);
    session->solver = NULL;
    dpl_shadow_destroy(session->shadow);
    session->shadow = NULL;
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = width;
    desc.height = height;
    dpl_status status = dpl_field_create(session->context, &desc, &session->field);
    if (status != DPL_OK)
        return (int32_t)status;
    size_t values = 3 * (size_t)width * (size_t)height; /* at most 3 * 2^28: planes may not fit, one does */
    float *planes = values <= SIZE_MAX / sizeof *planes / DPL_WEB_PLANES
                        ? calloc(DPL_WEB_PLANES * values, sizeof *planes)
                        : NULL;
    if (!planes) {
        forget_world(session);
        return DPL_ERROR_MEMORY;
    }
    for (int i = 0; i < DPL_WEB_PLANES; i++)
        session->planes[i] = planes + (size_t)i * values;
    session->width = width;
    session->height = height;
    return DPL_OK;
}

float *dpl_web_plane(dpl_web_session *session, int32_t plane) {
    return plane >= 0 && plane < DPL_WEB_PLANES ? session->planes[plane] : NULL;
}

static dpl_pixels pixels_of(const dpl_web_session *session, dpl_web_plane_name plane) {
    return (dpl_pixels){.data = session->planes[plane],
                        .format = DPL_FORMAT_F32,
                        .width = session->width,
                        .height = session->height,
                        .channels = 3};
}

int32_t dpl_web_draw(dpl_web_session *session, int32_t has_albedo, float red, float green, float blue) {
    const float sky[3] = {red, green, blue};
    if (!session->field)
        return DPL_ERROR_SIZE;
    dpl_layer layer = dpl_layer_default();
    layer.emission = pixels_of(session, DPL_WEB_EMISSION);
    layer.extinction = pixels_of(session, DPL_WEB_EXTINCTION);
    layer.extinction_is_opacity = 0;
    if (has_albedo)
        layer.albedo = pixels_of(session, DPL_WEB_ALBEDO);
    dpl_field_clear(session->field);
    dpl_status status = dpl_field_set_sky(session->field, sky);
    if (status == DPL_OK)
        status = dpl_field_draw_layer(session->field, &layer);
    return (int32_t)status;
}

int32_t dpl_web_distance(dpl_web_session *session) {
    if (!session->field)
        return DPL_ERROR_SIZE;
    return (int32_t)dpl_field_read_distance(session->field, session->planes[DPL_WEB_LIGHT], 0);
}

int dpl_web_progress_hook(double done, void *user) {
    (void)user;
    return dpl_web_progress(done);
}
