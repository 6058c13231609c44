/* Irradiance of lights on faces, see face_light.h. */
#include "shadow/face_light.h"

#include "job/jobs.h"
#include "shadow/shadow.h"

#include <math.h>

typedef struct lighting {
    const dpl_solver *solver;
    const dpl_face_order *order;
    const dpl_solid *solid;
} lighting;

/* Adds what one light gives to one face. */
static void add_light(const lighting *l, const dpl_light *light, const dpl_face *face, double sum[3]) {
    const dpl_face_order *order = l->order;
    double scale = order->scale, margin = order->margin;
    dpl_shadow_view view = {
        .field = order->field,
        .solid = l->solid,
        .position = {scale * (light->position[0] + margin), scale * (light->position[1] + margin)},
        .radius = scale * light->radius,
    };
    dpl_receiver r;
    dpl_shadow_counts unused = {0};
    double share = 1.0, through[3] = {1.0, 1.0, 1.0};
    if (!(view.radius > 0.0))
        return;
    if (dpl_receiver_at(&view, face->x, face->y, &r)) {
        share = dpl_shadow_exact_facing(&view, &r, face->normal, &unused);
        if (share > 0.0 && order->field->extinction.data)
            dpl_shadow_medium(&view, &r, through);
    }
    for (int c = 0; c < 3; c++)
        sum[c] += (double)light->color[c] * (double)light->intensity * share * through[c];
}

static void light_faces(int32_t begin, int32_t end, int32_t worker, void *task) {
    const lighting *l = task;
    const dpl_light *lights = l->solver->lights.data;
    (void)worker;
    for (int32_t i = begin; i < end; i++) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (int32_t k = 0; k < l->solver->light_count; k++)
            add_light(l, &lights[k], &l->order->faces[i], sum);
        for (int c = 0; c < 3; c++)
            l->order->rgb[i][c] = (float)fmin(sum[c], (double)DPL_RADIANCE_MAX);
    }
}

dpl_status dpl_face_light_fill(dpl_solver *solver, const dpl_face_order *order) {
    if (!solver->face_state) {
        solver->face_state = dpl_allocate(solver->context, 1, sizeof(dpl_solid));
        if (!solver->face_state)
            return DPL_ERROR_MEMORY;
        memset(solver->face_state, 0, sizeof(dpl_solid));
    }
    lighting l = {solver, order, solver->face_state};
    DPL_TRY(dpl_solid_fill_bits(solver->face_state, order->field));
    return dpl_jobs_run(solver->context, light_faces, order->count, 64, &l);
}

void dpl_face_light_free(dpl_solver *solver) {
    if (!solver->face_state)
        return;
    dpl_solid_free(solver->context, solver->face_state);
    dpl_release(solver->context, solver->face_state, 1, sizeof(dpl_solid));
}
