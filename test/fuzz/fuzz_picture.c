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

static uint32_t checksum(const uint8_t *bytes, size_t size) {
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

/* Makes the checksum of every PNG chunk right: else no changed file would ever get past the first. */
static void mend(uint8_t *data, size_t size) {
    for (size_t at = 8; at + 12 <= size;) {
        size_t length =
            (size_t)data[at] << 24 | (size_t)data[at + 1] << 16 | (size_t)data[at + 2] << 8 | data[at + 3];
        if (length > size - at - 12)
            return;
        uint32_t crc = checksum(data + at + 4, length + 4);
        for (size_t k = 0; k < 4; k++)
            data[at + 8 + length + k] = (uint8_t)(crc >> (24 - 8 * k));
        at += length + 12;
    }
}

static void read_mended(const uint8_t *data, size_t size) {
    uint8_t *copy = size > 8 && data[0] == 0x89 ? malloc(size) : NULL;
    if (!copy)
        return;
    memcpy(copy, data, size);
    mend(copy, size);
    read_as(copy, size, DPL_PICTURE_LINEAR);
    free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    read_mended(data, size);
    read_as(data, size, DPL_PICTURE_LINEAR);
    read_as(data, size, DPL_PICTURE_RAW);
    return 0;
}
