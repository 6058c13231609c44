/* Are two scenes the same to the last bit? Used by the tests of the writer and of the families. */
#ifndef DPL_TEST_SCENE_SAME_H
#define DPL_TEST_SCENE_SAME_H

#include "testing.h"

#include "../../scenes/scene.h"

#include <math.h>

static inline void assert_same_shape(const dpl_shape *a, const dpl_shape *b) {
    assert_int_equal(a->kind, b->kind);
    assert_memory_equal(&a->material, &b->material, sizeof a->material);
    if (a->kind == DPL_SHAPE_DISC) {
        assert_memory_equal(&a->disc, &b->disc, sizeof a->disc);
    } else if (a->kind == DPL_SHAPE_BOX) {
        assert_memory_equal(&a->box, &b->box, sizeof a->box);
    } else if (a->kind == DPL_SHAPE_SEGMENT) {
        assert_memory_equal(&a->segment, &b->segment, sizeof a->segment);
    } else {
        assert_int_equal(a->polygon.count, b->polygon.count);
        assert_memory_equal(a->polygon.points, b->polygon.points,
                            (size_t)a->polygon.count * sizeof *a->polygon.points);
    }
}

/* Pictures go through 8 bits; decoded colours may differ in their last bits between two decoders. */
static inline void assert_same_picture(const dpl_picture *a, const dpl_picture *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channels, b->channels);
    assert_int_equal(a->display, b->display);
    assert_int_equal(a->data != NULL, b->data != NULL);
    for (int64_t i = 0; i < (int64_t)a->width * a->height * a->channels; i++)
        if (fabsf(a->data[i] - b->data[i]) > 1e-6f)
            fail_msg("value %d is %.9g and %.9g", (int)i, (double)a->data[i], (double)b->data[i]);
}

static inline void assert_same_name(const char *a, const char *b) {
    assert_int_equal(a != NULL, b != NULL);
    if (a)
        assert_string_equal(a, b);
}

static inline void assert_same_image(const dpl_scene_image *a, const dpl_scene_image *b) {
    assert_same_name(a->emission, b->emission);
    assert_same_name(a->extinction, b->extinction);
    assert_same_name(a->albedo, b->albedo);
    assert_same_picture(&a->emission_picture, &b->emission_picture);
    assert_same_picture(&a->extinction_picture, &b->extinction_picture);
    assert_same_picture(&a->albedo_picture, &b->albedo_picture);
    assert_memory_equal(a->at, b->at, sizeof a->at);
    assert_memory_equal(&a->intensity, &b->intensity, sizeof a->intensity);
}

static inline void assert_same_scene(const dpl_scene *a, const dpl_scene *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->margin, b->margin);
    assert_memory_equal(a->sky, b->sky, sizeof a->sky);
    assert_int_equal(a->sky_sectors, b->sky_sectors);
    if (a->sky_sectors > 0)
        assert_memory_equal(a->sky_ring, b->sky_ring, (size_t)a->sky_sectors * sizeof *a->sky_ring);
    assert_int_equal(a->image_count, b->image_count);
    assert_int_equal(a->shape_count, b->shape_count);
    assert_int_equal(a->light_count, b->light_count);
    for (int32_t i = 0; i < a->image_count; i++)
        assert_same_image(&a->images[i], &b->images[i]);
    for (int32_t i = 0; i < a->shape_count; i++)
        assert_same_shape(&a->shapes[i], &b->shapes[i]);
    if (a->light_count > 0)
        assert_memory_equal(a->lights, b->lights, (size_t)a->light_count * sizeof *a->lights);
}

#endif
