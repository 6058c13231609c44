/* The scene that shadows in space are judged by, see solid_reference.h. */
#include "solid_reference.h"

#include "random.h"

/* Where things stand. */
#define REACH 1.6

typedef struct builder {
    dpl_mesh_data *data;
    dpl_error *error;
    dpl_random random;
    int32_t rings;
    bool good;
} builder;

static double pick(builder *b, double low, double high) {
    return dpl_random_between(&b->random, low, high);
}

/* At some place, with its middle at a height. */
static dpl_mesh_transform somewhere(builder *b, double height, double hx, double hy, double hz, bool turned) {
    const double scale[3] = {hx, hy, hz};
    const double angles[3] = {0.0, turned ? pick(b, 0.0, 3.0) : 0.0, 0.0};
    const double move[3] = {pick(b, -REACH, REACH), height, pick(b, -REACH, REACH)};
    return dpl_mesh_transform_of(scale, angles, move);
}

static void add_ball(builder *b, double radius, double height) {
    dpl_mesh_transform t = somewhere(b, height, radius, radius, radius, false);
    b->good = b->good && dpl_mesh_data_add_sphere(b->data, &t, b->rings, b->error);
}

static void add_box(builder *b, double height, double hx, double hy, double hz, bool turned) {
    dpl_mesh_transform t = somewhere(b, height, hx, hy, hz, turned);
    b->good = b->good && dpl_mesh_data_add_box(b->data, &t, b->error);
}

/* Every second ball and box stands on the ground. */
static void add_solid_things(builder *b) {
    for (int i = 0; i < 8; i++) {
        double radius = pick(b, 0.06, 0.3), height = pick(b, radius, 1.2);
        add_ball(b, radius, i % 2 ? radius : height);
    }
    for (int i = 0; i < 5; i++) {
        double half = pick(b, 0.1, 0.3), height = pick(b, 0.3, 1.0), width = pick(b, 0.08, 0.3);
        add_box(b, i % 2 ? half : height, width, half, pick(b, 0.08, 0.3), true);
    }
}

static void add_thin_things(builder *b) {
    for (int i = 0; i < 4; i++) { /* lying slabs */
        double height = pick(b, 0.3, 1.0), width = pick(b, 0.2, 0.4);
        add_box(b, height, width, 0.01, pick(b, 0.2, 0.4), true);
    }
    for (int i = 0; i < 2; i++) /* walls */
        add_box(b, 0.35, pick(b, 0.2, 0.4), 0.35, 0.01, true);
    for (int i = 0; i < 6; i++) /* poles */
        add_box(b, 0.5, 0.015, 0.5, 0.015, false);
}

bool dpl_solid_reference_mesh(int32_t seed, int32_t rings, dpl_mesh_data *data, dpl_error *error) {
    builder b = {.data = data, .error = error, .rings = rings, .good = true};
    b.random = dpl_random_start((uint64_t)seed, 0);
    add_solid_things(&b);
    add_thin_things(&b);
    return b.good;
}

dpl_solid_light dpl_solid_reference_light(float radius) {
    static const float position[3] = {0.7f, 4.0f, 0.5f};
    dpl_solid_light light = dpl_solid_light_default();
    for (int axis = 0; axis < 3; axis++) {
        light.position[axis] = position[axis];
        light.direction[axis] = -position[axis];
    }
    light.radius = radius;
    light.angle = 0.68f;
    return light;
}

void dpl_solid_reference_receivers(int32_t side, float (*positions)[3], float (*normals)[3]) {
    const float half = (float)DPL_SOLID_REFERENCE_HALF;
    for (int32_t i = 0; i < side * side; i++) {
        positions[i][0] = half * (2.0f * ((float)(i % side) + 0.5f) / (float)side - 1.0f);
        positions[i][1] = 0.0f;
        positions[i][2] = half * (2.0f * ((float)(i / side) + 0.5f) / (float)side - 1.0f);
        normals[i][0] = normals[i][2] = 0.0f;
        normals[i][1] = 1.0f;
    }
}
