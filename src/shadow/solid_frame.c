/* Where a light's maps look, and where a point is in them. One view for a spot light and a directional one,
 * six for a point light, which overlap so that a kernel stays within one. Called by solid_map.c and
 * solid_shadow.c. */
#include "shadow/solid_shadow.h"

#include <math.h>

/* How far beyond its sixth of the sphere, or its cone, a view reaches: tangents times this. */
#define OVERLAP 1.25f
#define BEYOND_CONE 1.05f

/* Nearest depth that a view from a point can have, as a share of the farthest. */
#define NEAREST 1e-3f

void dpl_solid_across(const float forward[3], float right[3], float down[3]) {
    int least = fabsf(forward[0]) < fabsf(forward[1]) ? 0 : 1;
    least = fabsf(forward[2]) < fabsf(forward[least]) ? 2 : least;
    float length = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        right[axis] = (axis == least ? 1.0f : 0.0f) - forward[least] * forward[axis];
        length += right[axis] * right[axis];
    }
    for (int axis = 0; axis < 3; axis++)
        right[axis] /= sqrtf(length);
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        down[axis] = forward[next] * right[last] - forward[last] * right[next];
    }
}

void dpl_solid_look(const dpl_solid_frame *frame, const float point[3], float seen[3]) {
    float away[3] = {point[0] - frame->eye[0], point[1] - frame->eye[1], point[2] - frame->eye[2]};
    for (int axis = 0; axis < 3; axis++)
        seen[axis] = dpl_solid_dot(frame->axis[axis], away);
}

static void aim(dpl_solid_frame *frame, const float forward[3]) {
    memcpy(frame->axis[2], forward, sizeof frame->axis[2]);
    dpl_solid_across(forward, frame->axis[0], frame->axis[1]);
}

/* The depths of the mesh, and for a directional light how wide it is. */
static void fit(dpl_solid_frame *frame, const dpl_mesh_facts *facts, int32_t size) {
    float low = INFINITY, high = -INFINITY, widest = 0.0f;
    for (int corner = 0; corner < 8; corner++) {
        float point[3], seen[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = corner >> axis & 1 ? facts->high[axis] : facts->low[axis];
        dpl_solid_look(frame, point, seen);
        low = fminf(low, seen[2]);
        high = fmaxf(high, seen[2]);
        widest = fmaxf(widest, fmaxf(fabsf(seen[0]), fabsf(seen[1])));
    }
    if (frame->parallel)
        frame->scale = 0.5f * (float)size / (1.02f * widest);
    float least = frame->parallel ? low : fmaxf(low, NEAREST * fmaxf(high, 1e-6f));
    float most = fmaxf(high, least + 1e-6f * fmaxf(fabsf(least), 1e-6f));
    /* A little more, so that what is farthest is not nothing. */
    frame->near = least;
    frame->far = most + 0.02f * (most - least);
}

int32_t dpl_solid_frames(const dpl_solid_light *light, const dpl_mesh_facts *facts, int32_t size,
                         dpl_solid_frame frames[DPL_SOLID_MAX_FRAMES]) {
    int32_t count = light->kind == DPL_SOLID_LIGHT_POINT ? 6 : 1;
    for (int32_t i = 0; i < count; i++) {
        dpl_solid_frame *frame = &frames[i];
        float forward[3] = {light->direction[0], light->direction[1], light->direction[2]};
        frame->parallel = light->kind == DPL_SOLID_LIGHT_DIRECTIONAL;
        for (int axis = 0; axis < 3; axis++) {
            if (light->kind == DPL_SOLID_LIGHT_POINT)
                forward[axis] = axis == i / 2 ? (i % 2 ? -1.0f : 1.0f) : 0.0f;
            frame->eye[axis] =
                frame->parallel ? 0.5f * (facts->low[axis] + facts->high[axis]) : light->position[axis];
        }
        float tangent = count == 6 ? OVERLAP : BEYOND_CONE * tanf(light->angle);
        frame->scale = 0.5f * (float)size / tangent;
        aim(frame, forward);
        fit(frame, facts, size);
    }
    return count;
}

int32_t dpl_solid_map_of(const dpl_solid_shadow *shadow, const float point[3]) {
    if (shadow->map_count == 1)
        return 0;
    int32_t longest = 0;
    float away[3];
    for (int32_t axis = 0; axis < 3; axis++) {
        away[axis] = point[axis] - shadow->light.position[axis];
        longest = fabsf(away[axis]) > fabsf(away[longest]) ? axis : longest;
    }
    return 2 * longest + (away[longest] < 0.0f);
}

float dpl_solid_disc_at(const dpl_solid_map *map, const dpl_solid_receiver *r, float receiver_depth,
                        float depth) {
    float gap = receiver_depth - depth;
    if (map->frame.parallel)
        return r->spread * gap * map->frame.scale;
    return r->spread * r->distance * gap / (receiver_depth * depth) * map->frame.scale;
}
