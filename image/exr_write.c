/* Writes EXR with OpenEXRCore: one part, float channels R, G and B, scanlines, zip. Called through the table
 * in picture_file.c; exr_none.c stands in where OpenEXRCore is missing. */
#include "buffer.h"
#include "file.h"
#include "formats.h"

#include <OpenEXR/openexr.h>
#include <stdlib.h>
#include <string.h>

#define CHANNELS 3

typedef struct exr_writer {
    const dpl_picture *picture;
    dpl_byte_buffer buffer; /* the file as it comes to be */
    exr_context_t context;
    exr_encode_pipeline_t encode;
    bool encoding;  /* the pipeline is set up */
    float *rows;    /* one chunk of RGB */
    char text[160]; /* what the library said first */
} exr_writer;

bool dpl_picture_has_exr(void) {
    return true;
}

static void on_error(exr_const_context_t context, exr_result_t code, const char *text) {
    (void)code;
    void *user = NULL;
    if (!context || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || !user)
        return;
    exr_writer *writer = user;
    if (!writer->text[0])
        strncpy(writer->text, text, sizeof writer->text - 1);
}

static int64_t on_write(exr_const_context_t context, void *user, const void *bytes, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t fail) {
    exr_writer *writer = user;
    if (size <= SIZE_MAX && offset <= SIZE_MAX &&
        dpl_byte_buffer_put(&writer->buffer, (size_t)offset, bytes, (size_t)size))
        return (int64_t)size;
    fail(context, EXR_ERR_OUT_OF_MEMORY, "out of memory");
    return -1;
}

static exr_result_t write_header(exr_writer *writer) {
    static const char *const names[CHANNELS] = {"R", "G", "B"};
    int part;
    exr_result_t result = exr_add_part(writer->context, "dapple", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(writer->context, part, writer->picture->width,
                                                     writer->picture->height, EXR_COMPRESSION_ZIP);
    for (int i = 0; i < CHANNELS && result == EXR_ERR_SUCCESS; i++)
        result =
            exr_add_channel(writer->context, part, names[i], EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    if (result == EXR_ERR_SUCCESS)
        result = exr_write_header(writer->context);
    return result;
}

/* Points the pipeline's channels, which are sorted by name, at the chunk's rows. */
static void aim_channels(exr_writer *writer) {
    for (int i = 0; i < writer->encode.channel_count; i++) {
        exr_coding_channel_info_t *channel = &writer->encode.channels[i];
        int place = channel->channel_name[0] == 'R' ? 0 : channel->channel_name[0] == 'G' ? 1 : 2;
        channel->encode_from_ptr = (const uint8_t *)(writer->rows + place);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = CHANNELS * sizeof(float);
        channel->user_line_stride = writer->picture->width * (int32_t)(CHANNELS * sizeof(float));
    }
}

static exr_result_t write_chunk(exr_writer *writer, int32_t y) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_write_scanline_chunk_info(writer->context, 0, y, &chunk);
    if (result != EXR_ERR_SUCCESS)
        return result;
    for (int32_t i = 0; i < chunk.height; i++)
        dpl_picture_rgb_row(writer->picture, y + i,
                            writer->rows + (size_t)i * (size_t)writer->picture->width * CHANNELS);
    bool first = !writer->encoding;
    if (first)
        result = exr_encoding_initialize(writer->context, 0, &chunk, &writer->encode);
    else
        result = exr_encoding_update(writer->context, 0, &chunk, &writer->encode);
    if (result != EXR_ERR_SUCCESS)
        return result;
    writer->encoding = true;
    aim_channels(writer);
    if (first)
        result = exr_encoding_choose_default_routines(writer->context, 0, &writer->encode);
    if (result == EXR_ERR_SUCCESS)
        result = exr_encoding_run(writer->context, 0, &writer->encode);
    return result;
}

static exr_result_t write_chunks(exr_writer *writer) {
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(writer->context, 0, &lines);
    if (result != EXR_ERR_SUCCESS)
        return result;
    if (lines < 1)
        return EXR_ERR_UNKNOWN;
    writer->rows = malloc((size_t)lines * (size_t)writer->picture->width * CHANNELS * sizeof *writer->rows);
    if (!writer->rows)
        return EXR_ERR_OUT_OF_MEMORY;
    for (int32_t y = 0; y < writer->picture->height && result == EXR_ERR_SUCCESS; y += lines)
        result = write_chunk(writer, y);
    return result;
}

static exr_result_t encode(exr_writer *writer, const char *path) {
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = on_error;
    start.user_data = writer;
    start.write_fn = on_write;
    exr_result_t result = exr_start_write(&writer->context, path, EXR_WRITE_FILE_DIRECTLY, &start);
    if (result == EXR_ERR_SUCCESS)
        result = write_header(writer);
    if (result == EXR_ERR_SUCCESS)
        result = write_chunks(writer);
    if (writer->encoding)
        exr_encoding_destroy(writer->context, &writer->encode);
    if (writer->context) {
        exr_result_t finished = exr_finish(&writer->context); /* writes the table of chunks */
        if (result == EXR_ERR_SUCCESS)
            result = finished;
    }
    return result;
}

bool dpl_exr_write(const char *path, const dpl_picture *picture, dpl_error *error) {
    exr_writer writer = {.picture = picture};
    exr_result_t result = encode(&writer, path);
    bool good = result == EXR_ERR_SUCCESS;
    if (good)
        good = dpl_file_write(path, writer.buffer.bytes, writer.buffer.size, error);
    else
        dpl_error_set(error, "%s: %s", path,
                      writer.text[0] ? writer.text : exr_get_default_error_message(result));
    free(writer.rows);
    dpl_byte_buffer_free(&writer.buffer);
    return good;
}
