/* Shadows in space: each way against the penumbra of paper, and the blend against both its terms on the
 * reference scene. */
#include "solid_world.h"

#include <stdlib.h>

/* ---- closed forms --------------------------------------------------------------------------------- */

static const double PI = 3.14159265358979323846;

/* The share of a disc on one side of a line, from the distance of its middle in radii. */
static double share(double x) {
    x = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
    return 0.5 + (x * sqrt(1.0 - x * x) + asin(x)) / PI;
}

enum { LINE = 200 };

static float positions[LINE][3], normals[LINE][3], visibility[LINE];

/* Receivers along x at y = 0, looking up. */
static void place_line(double low, double high) {
    for (int i = 0; i < LINE; i++) {
        positions[i][0] = (float)(low + (high - low) * i / (LINE - 1));
        positions[i][1] = 0.0f;
        positions[i][2] = 0.02f;
        normals[i][1] = 1.0f;
    }
}

static dpl_solid_light lamp(dpl_solid_light_kind kind) {
    dpl_solid_light light = dpl_solid_light_default();
    light.kind = kind;
    light.position[1] = 4.0f;
    light.direction[1] = -1.0f;
    light.direction[2] = 0.0f;
    light.radius = kind == DPL_SOLID_LIGHT_DIRECTIONAL ? 0.05f : 0.2f;
    return light;
}

static void cast(const dpl_solid_shadow_desc *desc, const dpl_mesh *mesh, const dpl_mesh_field *field,
                 const dpl_solid_light *light) {
    dpl_solid_shadow *shadow;
    assert_ok(dpl_solid_shadow_create(context, desc, &shadow));
    assert_ok(dpl_solid_shadow_set_light(shadow, mesh, field, light));
    assert_ok(dpl_solid_shadow_visibility(shadow, (const float(*)[3])positions, (const float(*)[3])normals,
                                          LINE, visibility));
    dpl_solid_shadow_destroy(shadow);
}

static double rms_against(const double *truth) {
    double sum = 0.0;
    for (int i = 0; i < LINE; i++)
        sum += ((double)visibility[i] - truth[i]) * ((double)visibility[i] - truth[i]);
    return sqrt(sum / LINE);
}

/* Every method, and the error that each may have. */
static void every_method_is_near(const dpl_mesh *mesh, const dpl_solid_light *light, const double *truth,
                                 const double limits[DPL_SOLID_METHOD_COUNT]) {
    dpl_mesh_field *field = solid_field(context, mesh, 96);
    for (int method = 0; method < DPL_SOLID_METHOD_COUNT; method++)
        for (int classify = 0; classify < 2; classify++) {
            dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
            desc.method = (dpl_solid_method)method;
            desc.classify = classify;
            desc.refine_rays = 0;
            desc.samples = 1024;
            cast(&desc, mesh, field, light);
            double error = rms_against(truth);
            if (error > limits[method])
                print_message("%s %d: %g\n", dpl_solid_method_name(desc.method), classify, error);
            assert_true(error <= limits[method]);
        }
    dpl_mesh_field_destroy(field);
}

/* A half space of blocker at x < 0, its edge 1 above the receivers, 3 below the light. */
static void the_penumbra_of_a_straight_edge_is_a_disc_cut_by_a_line(void **state) {
    (void)state;
    static const double limits[] = {0.02, 0.045, 0.02, 0.003};
    dpl_mesh *mesh = solid_box(context, -1.0, 1.0, 0.0, 1.0, 0.15, 1.5, 0.0);
    double truth[LINE];
    place_line(-0.25, 0.25);
    for (int kind = 0; kind < 3; kind++) {
        dpl_solid_light light = lamp((dpl_solid_light_kind)kind);
        for (int i = 0; i < LINE; i++) {
            double x = (double)positions[i][0], radius = (double)light.radius;
            /* The lower or the upper edge, whichever cuts more. */
            double low = kind == 2 ? x / (0.85 * radius) : x * (4.0 / 0.85 - 1.0) / radius;
            double high = kind == 2 ? x / (1.15 * radius) : x * (4.0 / 1.15 - 1.0) / radius;
            truth[i] = share(fmin(low, high));
        }
        every_method_is_near(mesh, &light, truth, limits);
    }
    dpl_mesh_destroy(mesh);
}

/* A ball much wider than the light: its rim is nearly straight, and seen at the angle asin(r / distance). */
static void the_penumbra_of_a_ball_begins_at_its_rim(void **state) {
    (void)state;
    static const double limits[] = {0.03, 0.04, 0.03, 0.02};
    dpl_mesh *mesh = solid_sphere(context, 0.0, 1.2, 0.0, 0.8, 96);
    dpl_solid_light light = lamp(DPL_SOLID_LIGHT_SPOT);
    double truth[LINE];
    place_line(0.7, 1.6);
    for (int i = 0; i < LINE; i++) {
        double x = (double)positions[i][0], to_light = sqrt(x * x + 16.0), to_ball = sqrt(x * x + 1.44);
        double between = acos((x * x + 4.0 * 1.2) / (to_light * to_ball));
        truth[i] = share((between - asin(0.8 / to_ball)) / atan(0.2 / to_light));
    }
    every_method_is_near(mesh, &light, truth, limits);
    dpl_mesh_destroy(mesh);
}

static void receivers_that_cannot_be_lit_are_dark(void **state) {
    (void)state;
    dpl_mesh *mesh = solid_box(context, 0.0, -2.0, 0.0, 0.1, 0.1, 0.1, 0.0);
    dpl_mesh_field *field = solid_field(context, mesh, 16);
    dpl_solid_light light = lamp(DPL_SOLID_LIGHT_SPOT);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    place_line(-1.0, 1.0);
    normals[0][1] = -1.0f;                       /* turned away */
    positions[1][0] = 40.0f;                     /* outside the cone */
    positions[2][2] = NAN;                       /* nowhere */
    positions[3][1] = 4.0f;                      /* beside the light, beyond its cone */
    normals[4][1] = 0.0f, normals[4][0] = -1.0f; /* sees half the light */
    positions[4][0] = 0.0f;
    cast(&desc, mesh, field, &light);
    for (int i = 0; i < 4; i++)
        assert_true(visibility[i] == 0.0f);
    assert_true(fabsf(visibility[4] - 0.5f) < 1e-3f);
    for (int i = 5; i < LINE; i++)
        assert_true(visibility[i] == 1.0f);
    memset(normals, 0, sizeof normals);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

/* A march from there would stand still if it added half a voxel to its way. */
static void receivers_however_far_away_come_to_an_end(void **state) {
    (void)state;
    dpl_mesh *mesh = solid_box(context, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0);
    dpl_mesh_field *field = solid_field(context, mesh, 32);
    dpl_solid_light light = lamp(DPL_SOLID_LIGHT_DIRECTIONAL);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    desc.method = DPL_SOLID_MARCH;
    desc.classify = 0;
    light.radius = 1e-4f;
    place_line(-1.0, 1.0);
    for (int i = 0; i < LINE; i++) {
        positions[i][0] = 0.0f;
        positions[i][1] = -powf(10.0f, 0.1f * (float)(i + 4));
    }
    cast(&desc, mesh, field, &light);
    for (int i = 0; i < LINE; i++)
        assert_true(visibility[i] >= 0.0f && visibility[i] <= 1.0f);
    assert_true(visibility[0] == 0.0f && visibility[20] == 0.0f); /* in the box's umbra */
    memset(normals, 0, sizeof normals);
    dpl_mesh_field_destroy(field);
    dpl_mesh_destroy(mesh);
}

/* ---- the reference scene -------------------------------------------------------------------------- */

enum { SIDE = 96, RECEIVERS = SIDE * SIDE };

typedef struct world {
    dpl_mesh *mesh;
    dpl_mesh_field *field;
    dpl_solid_light light;
    float (*positions)[3];
    float (*normals)[3];
    float *truth;
    float *visibility;
} world;

static dpl_solid_shadow_stats solve(const world *w, const dpl_solid_shadow_desc *desc, float *result) {
    dpl_solid_shadow_stats stats;
    dpl_solid_shadow *shadow;
    assert_ok(dpl_solid_shadow_create(context, desc, &shadow));
    assert_ok(dpl_solid_shadow_set_light(shadow, w->mesh, w->field, &w->light));
    assert_ok(dpl_solid_shadow_visibility(shadow, (const float(*)[3])w->positions,
                                          (const float(*)[3])w->normals, RECEIVERS, result));
    dpl_solid_shadow_read_stats(shadow, &stats);
    dpl_solid_shadow_destroy(shadow);
    return stats;
}

static world make_world(float radius) {
    world w = {.light = dpl_solid_reference_light(radius)};
    dpl_mesh_data data = {0};
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    assert_true(dpl_solid_reference_mesh(DPL_SOLID_REFERENCE_SEED, 12, &data, NULL));
    w.mesh = solid_mesh(context, &data);
    w.field = solid_field(context, w.mesh, 96);
    w.positions = calloc(RECEIVERS, sizeof *w.positions);
    w.normals = calloc(RECEIVERS, sizeof *w.normals);
    w.truth = calloc(RECEIVERS, sizeof *w.truth);
    w.visibility = calloc(RECEIVERS, sizeof *w.visibility);
    assert_true(w.positions && w.normals && w.truth && w.visibility);
    dpl_solid_reference_receivers(SIDE, w.positions, w.normals);
    desc.method = DPL_SOLID_REFERENCE;
    solve(&w, &desc, w.truth);
    return w;
}

static void free_world(world *w) {
    dpl_mesh_destroy(w->mesh);
    dpl_mesh_field_destroy(w->field);
    free(w->positions);
    free(w->normals);
    free(w->truth);
    free(w->visibility);
}

static double error_of(const world *w, const dpl_solid_shadow_desc *desc) {
    double sum = 0.0;
    solve(w, desc, w->visibility);
    for (int i = 0; i < RECEIVERS; i++) {
        double error = (double)w->visibility[i] - (double)w->truth[i];
        sum += error * error;
    }
    return sqrt(sum / RECEIVERS);
}

static void the_blend_beats_both_its_terms_and_rays_beat_the_blend(void **state) {
    (void)state;
    static const float radii[] = {0.1f, 0.3f};
    for (int i = 0; i < 2; i++) {
        world w = make_world(radii[i]);
        dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
        double refined = error_of(&w, &desc);
        desc.refine_rays = 0;
        double smooth = error_of(&w, &desc);
        desc.weight = DPL_SOLID_WEIGHT_MIN;
        double least = error_of(&w, &desc);
        desc.weight = DPL_SOLID_WEIGHT_CONSTANT;
        double mean = error_of(&w, &desc);
        desc.method = DPL_SOLID_MOMENTS;
        double moments = error_of(&w, &desc);
        desc.method = DPL_SOLID_MARCH;
        double march = error_of(&w, &desc);
        print_message(
            "R = %.1f: refined %.4f, smooth min %.4f, min %.4f, mean %.4f, moments %.4f, march %.4f\n",
            (double)radii[i], refined, smooth, least, mean, moments, march);
        assert_true(smooth < moments && smooth < march);
        assert_true(least < moments && least < march);
        assert_true(smooth < mean);
        assert_true(refined < 0.6 * smooth);
        assert_true(refined < 0.018);
        free_world(&w);
    }
}

/* Where classification answers, it is right: but for things thinner than a texel it is a proof. */
static void classification_agrees_with_the_truth(void **state) {
    (void)state;
    world w = make_world(0.2f);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    float *all = calloc(RECEIVERS, sizeof *all);
    assert_non_null(all);
    desc.refine_rays = 0;
    desc.method = DPL_SOLID_MOMENTS;
    dpl_solid_shadow_stats stats = solve(&w, &desc, w.visibility);
    desc.classify = 0;
    solve(&w, &desc, all);
    int64_t decided = 0, wrong = 0;
    for (int i = 0; i < RECEIVERS; i++) {
        bool sure = w.visibility[i] != all[i] || w.visibility[i] == 0.0f || w.visibility[i] == 1.0f;
        decided += sure;
        wrong += sure && w.visibility[i] != all[i] && fabsf(w.visibility[i] - w.truth[i]) > 0.05f;
    }
    assert_int_equal(stats.receivers, RECEIVERS);
    assert_true(stats.lit + stats.dark > RECEIVERS / 2);
    assert_true(decided >= stats.lit + stats.dark);
    assert_true(wrong <= RECEIVERS / 1000);
    free(all);
    free_world(&w);
}

/* It is what everything else is judged by: nothing is settled for it, whatever `classify` says. */
static void the_reference_is_not_classified(void **state) {
    (void)state;
    world w = make_world(0.2f);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    desc.method = DPL_SOLID_REFERENCE;
    desc.samples = 16;
    dpl_solid_shadow_stats stats = solve(&w, &desc, w.visibility);
    assert_int_equal(stats.lit, 0);
    assert_int_equal(stats.rays, 16 * (stats.receivers - stats.dark)); /* dark: outside the cone */
    free_world(&w);
}

static void rays_are_asked_only_near_the_eye(void **state) {
    (void)state;
    world w = make_world(0.2f);
    dpl_solid_shadow_desc desc = dpl_solid_shadow_desc_default();
    dpl_solid_shadow_stats everywhere = solve(&w, &desc, w.visibility);
    desc.refine_distance = 1.0f;
    dpl_solid_shadow_stats near = solve(&w, &desc, w.visibility);
    desc.refine_rays = 0;
    dpl_solid_shadow_stats nowhere = solve(&w, &desc, w.visibility);
    assert_true(everywhere.refined > near.refined && near.refined > 0);
    assert_int_equal(near.rays, near.refined * 32);
    assert_true(nowhere.refined == 0 && nowhere.rays == 0 && nowhere.steps > 0);
    free_world(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_penumbra_of_a_straight_edge_is_a_disc_cut_by_a_line),
        cmocka_unit_test(the_penumbra_of_a_ball_begins_at_its_rim),
        cmocka_unit_test(receivers_that_cannot_be_lit_are_dark),
        cmocka_unit_test(receivers_however_far_away_come_to_an_end),
        cmocka_unit_test(the_blend_beats_both_its_terms_and_rays_beat_the_blend),
        cmocka_unit_test(classification_agrees_with_the_truth),
        cmocka_unit_test(the_reference_is_not_classified),
        cmocka_unit_test(rays_are_asked_only_near_the_eye),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
