/* Any bytes as a picture file, with both meanings of PNG colours: an error or a whole picture, never worse.
 * Run by libFuzzer and, over the corpus, by replay.c. */
#include "../../image/picture.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Every float can be touched, and an error has a text of one line. */
static void read_as(const uint8_t *data, size_t size, dpl_picture_colour colour) {
    dpl_picture picture;
    dpl_error error = {{0}};
    if (dpl_picture_read_memory(data, size, "input", colour, &picture, &error)) {
        size_t count = (size_t)picture.width * (size_t)picture.height * (size_t)picture.channels;
        if (count == 0 || !picture.data)
            abort();
        uint32_t sum = 0, bits;
        for (size_t i = 0; i < count; i++) {
            memcpy(&bits, picture.data + i, sizeof bits);
            sum ^= bits;
        }
        volatile uint32_t kept = sum;
        (void)kept;
    } else if (picture.data || !error.text[0] || strchr(error.text, '\n')) {
        abort();
    }
    dpl_picture_free(&picture);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    read_as(data, size, DPL_PICTURE_LINEAR);
    read_as(data, size, DPL_PICTURE_RAW);
    return 0;
}
