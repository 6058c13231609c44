/* Visibility by the distance to the mesh: a march along the middle of a cone from the receiver to a part of
 * the light keeps the least ratio of distance and the cone's radius, into solids as far as it takes, and a
 * straight edge at that distance covers the disc exactly. Called by solid_shadow.c.
 *
 * Source: the signed march of Quilez 2018, with the coverage of a disc by a half plane. */
#include "shadow/solid_shadow.h"

#include <math.h>

/* A march begins this far from the receiver, and this far above its surface [spacing]. */
#define START 0.5f
#define ABOVE 0.25f

/* Shortest step [spacing], and longest within a cone, as a share of the distance. */
#define LEAST_STEP 0.5f
#define SHARE 0.7f

/* Shortest step as a share of the way so far, which a float can still add to it. */
#define PROGRESS 1e-6f

/* Above a flat surface alone this height is also the distance to it [spacing]; where the distance is less
 * than this share of it, something else is near. */
#define HEIGHT 2.0f
#define FREE 0.75f

double dpl_solid_disc_share(double distance) {
    static const double PI = 3.14159265358979323846;
    if (distance >= 1.0)
        return 1.0;
    if (distance <= -1.0)
        return 0.0;
    return 0.5 + (distance * sqrt(1.0 - distance * distance) + asin(distance)) / PI;
}

/* A march, in spacings from the lattice's first sample; `along` is in units of the way to the light. */
typedef struct march {
    const dpl_mesh_lattice *lattice;
    float from[3];
    float step[3];
    float begin;
    float end;
    float spread;      /* tangent of half the cone's angle */
    float per_spacing; /* 1 / spacing */
} march;

/* Cuts the march to where it is within the lattice, grown by `margin`. */
static void cut(march *m, float margin) {
    for (int axis = 0; axis < 3; axis++) {
        float low = -margin - m->from[axis], high = m->lattice->last[axis] + margin - m->from[axis];
        if (fabsf(m->step[axis]) < 1e-9f) {
            if (low > 0.0f || high < 0.0f)
                m->end = m->begin - 1.0f;
            continue;
        }
        float one = low / m->step[axis], other = high / m->step[axis];
        m->begin = fmaxf(m->begin, fminf(one, other));
        m->end = fminf(m->end, fmaxf(one, other));
    }
}

/* Where the cone is wider than the way out, blockers within the lattice can still cover some of it. */
static void cut_cone(march *m) {
    march inner = *m;
    cut(&inner, 0.0f);
    cut(m, inner.end > inner.begin ? m->spread * inner.end : m->spread * m->lattice->last[0]);
}

/* The least ratio, -1 .. 1. */
static float least_ratio(const march *m, int64_t *steps) {
    float least = 1.0f, along = m->begin;
    while (along < m->end && least > -1.0f) {
        float place[3], inside[3];
        for (int axis = 0; axis < 3; axis++)
            place[axis] = m->from[axis] + along * m->step[axis];
        float away = dpl_mesh_lattice_enter(m->lattice, place, inside);
        float distance = dpl_mesh_lattice_at(m->lattice, inside) * m->per_spacing + away;
        float radius = m->spread * along;
        least = fminf(least, distance / radius);
        /* As far as the cone is surely open, else carefully. */
        float open = (distance - radius) / (1.0f + m->spread);
        float step = fmaxf(open, fmaxf(SHARE * fabsf(distance), LEAST_STEP));
        along += fmaxf(step, PROGRESS * along);
        ++*steps;
    }
    return fmaxf(least, -1.0f);
}

/* The march towards a point (a, b) of the unit disc. */
static march march_to(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, float a, float b) {
    const dpl_mesh_grid *grid = &shadow->field->grid;
    march m = {.lattice = &shadow->lattice, .begin = START, .per_spacing = 1.0f / grid->spacing};
    float light = r->spread * r->distance;
    m.end = isinf(r->distance) ? INFINITY : (r->distance - light) / grid->spacing;
    for (int axis = 0; axis < 3; axis++) {
        m.from[axis] = (r->position[axis] - grid->origin[axis]) / grid->spacing + ABOVE * r->normal[axis];
        m.step[axis] = r->toward[axis] + r->spread * (a * r->right[axis] + b * r->up[axis]);
    }
    return m;
}

bool dpl_solid_is_contact(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r) {
    const dpl_mesh_grid *grid = &shadow->field->grid;
    float place[3], inside[3];
    for (int axis = 0; axis < 3; axis++)
        place[axis] = (r->position[axis] - grid->origin[axis]) / grid->spacing + HEIGHT * r->normal[axis];
    float away = dpl_mesh_lattice_enter(&shadow->lattice, place, inside);
    float distance = dpl_mesh_lattice_at(&shadow->lattice, inside) / grid->spacing + away;
    return distance < FREE * HEIGHT;
}

/* From the square -1 .. 1 to the disc, keeping areas in proportion (Shirley and Chiu 1997). */
static void disc_of_square(float x, float y, float *a, float *b) {
    static const float QUARTER_PI = 0.785398163f;
    float longer = fabsf(x) > fabsf(y) ? x : y, shorter = fabsf(x) > fabsf(y) ? y : x;
    float angle = longer > 0.0f || longer < 0.0f ? QUARTER_PI * shorter / longer : 0.0f;
    *a = longer * (fabsf(x) > fabsf(y) ? cosf(angle) : sinf(angle));
    *b = longer * (fabsf(x) > fabsf(y) ? sinf(angle) : cosf(angle));
}

double dpl_solid_by_march(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, int64_t *steps) {
    int32_t side = 1;
    while (side * side < shadow->desc.sub_cones)
        side++;
    double sum = 0.0;
    for (int32_t i = 0; i < side * side; i++) {
        float a, b, cell = 2.0f / (float)side;
        disc_of_square(cell * ((float)(i % side) + 0.5f) - 1.0f, cell * ((float)(i / side) + 0.5f) - 1.0f, &a,
                       &b);
        march m = march_to(shadow, r, a, b);
        m.spread = r->spread / (float)side;
        cut_cone(&m);
        sum += dpl_solid_disc_share((double)least_ratio(&m, steps));
    }
    return sum / (side * side);
}
