/* Distances to meshes: exact near the surface, nearly so far away, with the right sign everywhere; open
 * meshes by their winding number. */
#include "solid_world.h"

typedef struct findings {
    double worst_near; /* errors in spacings */
    double worst_far;
    double worst_deep; /* far inside, where many triangles are nearly as near */
    int64_t wrong_signs;
    int64_t samples;
} findings;

static void judge(findings *f, double truth, double distance, double spacing, double tolerance) {
    double error = fabs(fabs(distance) - fabs(truth)) / spacing;
    double *worst = truth > 0.0 ? &f->worst_far : &f->worst_deep;
    if (fabs(truth) < 2.0 * spacing)
        worst = &f->worst_near;
    *worst = fmax(*worst, error);
    f->wrong_signs += (distance < 0.0) != (truth < 0.0) && fabs(truth) > tolerance;
    f->samples++;
}

/* ---- closed meshes -------------------------------------------------------------------------------- */

static const double box_half[3] = {1.0, 0.6, 0.3};

static double distance_to_box(const double p[3]) {
    double outside = 0.0, inside = -INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double beyond = fabs(p[axis]) - box_half[axis];
        outside += beyond > 0.0 ? beyond * beyond : 0.0;
        inside = fmax(inside, beyond);
    }
    return outside > 0.0 ? sqrt(outside) : inside;
}

static void judge_box(const double p[3], double distance, double spacing, void *user) {
    judge(user, distance_to_box(p), distance, spacing, 1e-6);
}

static void distances_to_a_box_are_exact(void **state) {
    (void)state;
    dpl_mesh *mesh = solid_box(context, 0, 0, 0, box_half[0], box_half[1], box_half[2], 0.0);
    dpl_mesh_field *field = solid_field(context, mesh, 64);
    findings f = {0};
    solid_each_sample(field, judge_box, &f);
    assert_true(f.samples > 64 * 40 * 20);
    assert_true(f.worst_near < 1e-4);
    assert_true(f.worst_far < 0.05 && f.worst_deep < 0.05);
    assert_int_equal(f.wrong_signs, 0);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

/* A sphere of many triangles lies this far inside the true one at most. */
#define RINGS 64
#define SAGITTA 0.0013

static void judge_sphere(const double p[3], double distance, double spacing, void *user) {
    double truth = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0;
    judge(user, truth, distance, spacing, SAGITTA);
}

static void distances_to_a_sphere_are_right_everywhere(void **state) {
    (void)state;
    dpl_mesh *mesh = solid_sphere(context, 0, 0, 0, 1, RINGS);
    dpl_mesh_field *field = solid_field(context, mesh, 64);
    findings f = {0};
    double spacing = (double)dpl_mesh_field_grid(field).spacing;
    solid_each_sample(field, judge_sphere, &f);
    assert_true(f.worst_near < SAGITTA / spacing + 1e-3);
    assert_true(f.worst_far < SAGITTA / spacing + 0.2);
    assert_true(f.worst_deep < 0.4);
    assert_int_equal(f.wrong_signs, 0);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

/* Inside where either is, also where they overlap. */
static void overlapping_closed_parts_are_one_solid(void **state) {
    (void)state;
    dpl_mesh_data data = {0};
    dpl_mesh_transform left = solid_at(-0.5, 0, 0, 1, 1, 1, 0.0),
                       right = solid_at(0.5, 0.1, 0.2, 1, 1, 1, 0.7);
    assert_true(dpl_mesh_data_add_sphere(&data, &left, 24, NULL));
    assert_true(dpl_mesh_data_add_box(&data, &right, NULL));
    dpl_mesh *mesh = solid_mesh(context, &data);
    dpl_mesh_field *field = solid_field(context, mesh, 48);
    static const float inside[][3] = {{0, 0, 0}, {-1.2f, 0, 0}, {0.6f, 0.1f, 0.2f}, {-0.2f, 0.3f, 0.1f}};
    for (size_t i = 0; i < sizeof inside / sizeof inside[0]; i++)
        assert_true(dpl_mesh_field_distance(field, inside[i]) < -0.05f);
    assert_true(dpl_mesh_field_distance(field, (const float[3]){-1.4f, 0.9f, 0.0f}) > 0.0f);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

/* Triangles that face anyhow enclose the same by parity. */
static void unoriented_meshes_are_signed_by_parity(void **state) {
    (void)state;
    dpl_mesh_data data = {0};
    dpl_mesh_transform none = dpl_mesh_transform_none();
    dpl_mesh_facts facts;
    assert_true(dpl_mesh_data_add_sphere(&data, &none, RINGS, NULL));
    for (int32_t i = 0; i < data.triangle_count; i += 3) {
        int32_t kept = data.indices[i][1];
        data.indices[i][1] = data.indices[i][2];
        data.indices[i][2] = kept;
    }
    dpl_mesh *mesh = solid_mesh(context, &data);
    dpl_mesh_read_facts(mesh, &facts);
    assert_int_equal(facts.unoriented_parts, 1);
    dpl_mesh_field *field = solid_field(context, mesh, 40);
    findings f = {0};
    solid_each_sample(field, judge_sphere, &f);
    assert_int_equal(f.wrong_signs, 0);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

/* ---- open meshes ---------------------------------------------------------------------------------- */

/* A soup: the triangles of a sphere, some left out, none sharing a corner with another. */
static dpl_mesh *soup(int32_t every) {
    dpl_mesh_data ball = {0}, data = {0};
    dpl_mesh_transform none = dpl_mesh_transform_none();
    assert_true(dpl_mesh_data_add_sphere(&ball, &none, RINGS, NULL));
    assert_true(dpl_mesh_data_reserve(&data, 3 * ball.triangle_count, ball.triangle_count, NULL));
    for (int32_t i = 0; i < ball.triangle_count; i++) {
        if (i % every == 0)
            continue;
        double shrink = 1.0 - 1e-5 * (i % 7);
        for (int k = 0; k < 3; k++) {
            const float *v = ball.vertices[ball.indices[i][k]];
            dpl_mesh_data_add_vertex(&data, &none, shrink * (double)v[0], shrink * (double)v[1],
                                     shrink * (double)v[2]);
        }
        int32_t last = data.vertex_count;
        dpl_mesh_data_add_triangle(&data, last - 3, last - 2, last - 1);
    }
    dpl_mesh_data_free(&ball);
    return solid_mesh(context, &data);
}

static void soups_are_signed_by_winding_number(void **state) {
    (void)state;
    dpl_mesh *mesh = soup(200);
    dpl_mesh_facts facts;
    dpl_mesh_read_facts(mesh, &facts);
    assert_true(facts.open_parts > 5 && facts.closed_parts == 0);
    dpl_mesh_field *field = solid_field(context, mesh, 32);
    findings f = {0};
    solid_each_sample(field, judge_sphere, &f);
    assert_true(f.wrong_signs <= f.samples / 1000);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

static void one_square_encloses_nothing(void **state) {
    (void)state;
    dpl_mesh_data data = {0};
    dpl_mesh_transform none = dpl_mesh_transform_none();
    assert_true(dpl_mesh_data_add_plane(&data, &none, NULL));
    dpl_mesh *mesh = solid_mesh(context, &data);
    dpl_mesh_field *field = solid_field(context, mesh, 32);
    dpl_mesh_grid grid = dpl_mesh_field_grid(field);
    const float *samples = dpl_mesh_field_samples(field);
    assert_int_equal(grid.size[1], 5);
    for (int32_t i = 0; i < grid.size[0] * grid.size[1] * grid.size[2]; i++)
        assert_true(samples[i] >= -1e-6f);
    assert_true(fabsf(dpl_mesh_field_distance(field, (const float[3]){0.1f, 5.0f, 0.2f}) - 5.0f) < 0.01f);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_to_a_box_are_exact),
        cmocka_unit_test(distances_to_a_sphere_are_right_everywhere),
        cmocka_unit_test(overlapping_closed_parts_are_one_solid),
        cmocka_unit_test(unoriented_meshes_are_signed_by_parity),
        cmocka_unit_test(soups_are_signed_by_winding_number),
        cmocka_unit_test(one_square_encloses_nothing),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
