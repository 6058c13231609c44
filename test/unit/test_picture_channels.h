/* Pictures of every number of channels, written in linear floats: PFM and EXR make three of them alike. */
#ifndef DPL_TEST_PICTURE_CHANNELS_H
#define DPL_TEST_PICTURE_CHANNELS_H

#include "testing.h"

#include "../../image/picture.h"

static void assert_every_number_of_channels_becomes_three(const char *path) {
    static const float expected[4][3] = {{1, 1, 1}, {1, 1, 1}, {1, 2, 3}, {1, 2, 3}};
    for (int32_t channels = 1; channels <= 4; channels++) {
        dpl_picture picture, back;
        assert_true(dpl_picture_create(&picture, 1, 1, channels, NULL));
        for (int32_t k = 0; k < channels; k++)
            picture.data[k] = (float)(k + 1);
        assert_true(dpl_picture_write(path, &picture, NULL));
        assert_true(dpl_picture_read(path, DPL_PICTURE_LINEAR, &back, NULL));
        assert_int_equal(back.channels, 3);
        assert_memory_equal(back.data, expected[channels - 1], sizeof expected[0]);
        dpl_picture_free(&picture);
        dpl_picture_free(&back);
    }
}

#endif
