/* What a module works with between calls: a context, a pixel world and its planes, a solver. Used by every
 * file of this folder. Planes are row by row from the top left, three floats per pixel. */
#ifndef DPL_WEB_SESSION_H
#define DPL_WEB_SESSION_H

#include "crew.h"

#include <dapple/field.h>
#include <dapple/shadow.h>
#include <dapple/solver.h>

typedef enum dpl_web_plane_name {
    DPL_WEB_EMISSION,
    DPL_WEB_EXTINCTION,
    DPL_WEB_ALBEDO,
    DPL_WEB_LIGHT,
    DPL_WEB_PLANES
} dpl_web_plane_name;

/* What a solver is made from; see settings in web/module/backend.d.ts. */
typedef struct dpl_web_settings {
    int32_t solver; /* dpl_solver_kind */
    int32_t bounces;
    int32_t merge; /* dpl_merge */
    int32_t skip;  /* dpl_skip_mode */
    double bound_db;
    int32_t directions;
    int32_t watched; /* 1: tells the host how far it has come, and can be cancelled */
    int32_t reuse;   /* 1: keeps the last frame, as dpl_solver_desc.reuse */
} dpl_web_settings;

struct dpl_web_study;
typedef struct dpl_web_flood dpl_web_flood;

typedef struct dpl_web_session {
    dpl_web_crew crew;
    dpl_context *context;
    dpl_field *field;
    float *planes[DPL_WEB_PLANES]; /* one piece of memory, which begins with the first */
    int32_t width;
    int32_t height;
    dpl_solver *solver;
    dpl_web_settings settings; /* of the solver */
    dpl_shadow *shadow;
    int32_t shadow_method;
    struct dpl_web_study *study;
    dpl_web_flood *flood;
} dpl_web_session;

/* Makes a session of `helpers` + 1 threads. NULL when there is no memory. */
dpl_web_session *dpl_web_open(int32_t helpers);

/* The crew that helpers serve. */
dpl_web_crew *dpl_web_crew_of(dpl_web_session *session);

/* Name of the kernels in use. */
const char *dpl_web_isa(const dpl_web_session *session);

/* Why the last call failed; never NULL. */
const char *dpl_web_message(const dpl_web_session *session, int32_t status);

/* Makes room for a world of this size; whatever was in another is gone. Returns a dpl_status, as do all
 * functions of this module that may fail. */
int32_t dpl_web_resize(dpl_web_session *session, int32_t width, int32_t height);

/* A plane of the world, shape [height][width][3]; NULL before there is one. */
float *dpl_web_plane(dpl_web_session *session, int32_t plane);

/* Planes to field. Without albedo walls are black. */
int32_t dpl_web_draw(dpl_web_session *session, int32_t has_albedo, float red, float green, float blue);

/* Distance to the nearest pixel that is not empty [px], into the light plane, shape [height][width]. */
int32_t dpl_web_distance(dpl_web_session *session);

/* A progress function for solvers and shadows: asks the host. */
int dpl_web_progress_hook(double done, void *user);

#endif
