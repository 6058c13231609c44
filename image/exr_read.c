/* Reads EXR with OpenEXRCore: the first part, scanlines or tiles, half or float, RGB(A) or Y(A); the picture
 * is the data window. Called through the table in picture_file.c; exr_none.c stands in where OpenEXRCore is
 * missing. */
#include "formats.h"

#include <OpenEXR/openexr.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Nothing supported packs better: deflate's 1032, doubled for halves that become floats, and some room. */
#define PACKING_RATIO 4096

/* What a picture's channels are called; the first row that a file has is taken. */
typedef struct exr_layout {
    int32_t channels;
    const char *names[4];
} exr_layout;

static const exr_layout layouts[] = {
    {4, {"R", "G", "B", "A"}},
    {3, {"R", "G", "B"}},
    {2, {"Y", "A"}},
    {1, {"Y"}},
};

/* By exr_compression_t. B44 and DWA lose what comparisons are after. */
static const bool compression_is_supported[] = {
    [EXR_COMPRESSION_NONE] = true, [EXR_COMPRESSION_RLE] = true, [EXR_COMPRESSION_ZIPS] = true,
    [EXR_COMPRESSION_ZIP] = true,  [EXR_COMPRESSION_PIZ] = true, [EXR_COMPRESSION_PXR24] = true,
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

typedef struct exr_reader {
    const dpl_picture_source *source;
    dpl_picture *picture;
    dpl_error *error;
    exr_context_t context;
    exr_decode_pipeline_t decode;
    bool decoding; /* the pipeline is set up */
    exr_attr_box2i_t window;
    exr_storage_t storage;
    const exr_layout *layout;
    char text[160]; /* what the library said first */
} exr_reader;

/* ---- What the library calls ----------------------------------------------------------------------- */

static void on_error(exr_const_context_t context, exr_result_t code, const char *text) {
    (void)code;
    void *user = NULL;
    if (!context || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || !user)
        return;
    exr_reader *reader = user;
    if (!reader->text[0])
        strncpy(reader->text, text, sizeof reader->text - 1);
}

static int64_t on_size(exr_const_context_t context, void *user) {
    (void)context;
    const exr_reader *reader = user;
    return (int64_t)reader->source->size;
}

/* Memory that a broken block leaves unwritten holds zeros, not what was there before. */
static void *allocate(size_t size) {
    return calloc(1, size);
}

/* Hands out what there is: the library reads ahead, and complains itself where it must have all. */
static int64_t on_read(exr_const_context_t context, void *user, void *bytes, uint64_t size, uint64_t offset,
                       exr_stream_error_func_ptr_t fail) {
    (void)context;
    (void)fail;
    const dpl_picture_source *source = ((const exr_reader *)user)->source;
    if (offset >= source->size)
        return 0;
    uint64_t left = source->size - offset;
    size_t count = (size_t)(size < left ? size : left);
    memcpy(bytes, source->bytes + offset, count);
    return (int64_t)count;
}

/* ---- Errors --------------------------------------------------------------------------------------- */

static bool fail(exr_reader *reader, const char *text) {
    return dpl_picture_broken(reader->source, "EXR", text, reader->error);
}

/* What is sound but not for us. */
static bool refuse(exr_reader *reader, const char *text) {
    return dpl_error_set(reader->error, "%s: %s", reader->source->name, text);
}

/* True for success, else the error is set from what the library said. */
static bool check(exr_reader *reader, exr_result_t result) {
    if (result == EXR_ERR_SUCCESS)
        return true;
    return fail(reader, reader->text[0] ? reader->text : exr_get_default_error_message(result));
}

/* ---- The header ----------------------------------------------------------------------------------- */

static const exr_attr_chlist_entry_t *find_channel(const exr_attr_chlist_t *list, const char *name) {
    for (int i = 0; i < list->num_channels; i++)
        if (strcmp(list->entries[i].name.str, name) == 0)
            return &list->entries[i];
    return NULL;
}

static bool has_layout(const exr_attr_chlist_t *list, const exr_layout *layout) {
    for (int32_t i = 0; i < layout->channels; i++)
        if (!find_channel(list, layout->names[i]))
            return false;
    return true;
}

static bool choose_layout(exr_reader *reader) {
    const exr_attr_chlist_t *list = NULL;
    if (!check(reader, exr_get_channels(reader->context, 0, &list)))
        return false;
    for (size_t i = COUNT(layouts); i-- > 0;)
        if (has_layout(list, &layouts[i]))
            reader->layout = &layouts[i];
    if (!reader->layout)
        return refuse(reader, "an EXR without channels R, G, B or Y");
    for (int32_t i = 0; i < reader->layout->channels; i++) {
        const exr_attr_chlist_entry_t *channel = find_channel(list, reader->layout->names[i]);
        if (channel->pixel_type != EXR_PIXEL_HALF && channel->pixel_type != EXR_PIXEL_FLOAT)
            return refuse(reader, "an EXR with channels that are neither half nor float");
    }
    for (int i = 0; i < list->num_channels; i++)
        if (list->entries[i].x_sampling != 1 || list->entries[i].y_sampling != 1)
            return refuse(reader, "an EXR with subsampled channels");
    return true;
}

static bool check_storage(exr_reader *reader) {
    exr_compression_t compression;
    if (!check(reader, exr_get_storage(reader->context, 0, &reader->storage)) ||
        !check(reader, exr_get_compression(reader->context, 0, &compression)))
        return false;
    if (reader->storage != EXR_STORAGE_SCANLINE && reader->storage != EXR_STORAGE_TILED)
        return refuse(reader, "a deep EXR");
    if ((size_t)compression >= COUNT(compression_is_supported) || !compression_is_supported[compression])
        return refuse(reader, "an EXR with B44 or DWA compression");
    return true;
}

/* Can a file of this size hold the pixels and the table of chunks? Judged before memory is asked for. */
static bool check_plausible(exr_reader *reader, int64_t width, int64_t height) {
    if (width > DPL_PICTURE_MAX_SIZE || height > DPL_PICTURE_MAX_SIZE || width < 1 || height < 1)
        return true; /* refused with the text that all formats share */
    int32_t chunks;
    if (!check(reader, exr_get_chunk_count(reader->context, 0, &chunks)))
        return false;
    uint64_t bytes = (uint64_t)width * (uint64_t)height * (uint64_t)reader->layout->channels * sizeof(float);
    if (chunks >= 1 && (uint64_t)chunks <= reader->source->size / 8 &&
        bytes / PACKING_RATIO <= reader->source->size)
        return true;
    return dpl_error_set(reader->error,
                         "%s: broken EXR: %zu bytes cannot hold %" PRId64 " x %" PRId64 " pixels",
                         reader->source->name, reader->source->size, width, height);
}

static bool read_header(exr_reader *reader) {
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = on_error;
    start.user_data = reader;
    start.alloc_fn = allocate;
    start.free_fn = free;
    start.read_fn = on_read;
    start.size_fn = on_size;
    start.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION; /* half a picture is no picture */
    if (!check(reader, exr_start_read(&reader->context, reader->source->name, &start)) ||
        !check_storage(reader) || !choose_layout(reader) ||
        !check(reader, exr_get_data_window(reader->context, 0, &reader->window)))
        return false;
    int64_t width = (int64_t)reader->window.max.x - reader->window.min.x + 1;
    int64_t height = (int64_t)reader->window.max.y - reader->window.min.y + 1;
    return check_plausible(reader, width, height) &&
           dpl_picture_create_read(reader->source, width, height, reader->layout->channels, reader->picture,
                                   reader->error);
}

/* ---- Pixels --------------------------------------------------------------------------------------- */

static float from_half(unsigned half) {
    uint32_t sign = (half & 0x8000) << 16, exponent = half >> 10 & 31, fraction = half & 1023;
    uint32_t bits = sign | (exponent + 112) << 23 | fraction << 13;
    if (exponent == 31) /* infinity or NaN */
        bits = sign | 0x7f800000 | fraction << 13;
    float value;
    memcpy(&value, &bits, sizeof value);
    if (exponent == 0) /* zero or denormal: a float holds it exactly */
        value = (float)fraction / (sign ? -16777216.0f : 16777216.0f);
    return value;
}

/* A row of one channel, little endian as stored, to every `step`-th float. */
static void convert_row(const unsigned char *bytes, bool half, int32_t width, float *out, size_t step) {
    for (int32_t x = 0; x < width; x++, out += step) {
        if (half) {
            *out = from_half(bytes[0] | (unsigned)bytes[1] << 8);
            bytes += 2;
        } else {
            uint32_t bits =
                (uint32_t)bytes[3] << 24 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[1] << 8 | bytes[0];
            memcpy(out, &bits, sizeof bits);
            bytes += 4;
        }
    }
}

/* Which of the picture's channels this is, or -1. */
static int find_place(const exr_reader *reader, const char *name) {
    for (int32_t k = 0; k < reader->layout->channels; k++)
        if (strcmp(name, reader->layout->names[k]) == 0)
            return k;
    return -1;
}

/* The decompressed chunk, row by row and in a row channel by channel, into the picture at (x, y). Not left to
 * the library, which in several versions trips over channels that are not wanted. */
static bool unpack_chunk(exr_reader *reader, int32_t x, int32_t y) {
    const exr_decode_pipeline_t *decode = &reader->decode;
    const dpl_picture *picture = reader->picture;
    uint64_t row_size = 0;
    for (int i = 0; i < decode->channel_count; i++)
        row_size += (uint64_t)decode->chunk.width * (uint64_t)decode->channels[i].bytes_per_element;
    if (!decode->unpacked_buffer || row_size * (uint64_t)decode->chunk.height != decode->chunk.unpacked_size)
        return fail(reader, "a block of pixels has the wrong size");
    const unsigned char *bytes = decode->unpacked_buffer;
    size_t step = (size_t)picture->channels;
    for (int32_t row = 0; row < decode->chunk.height; row++) {
        float *out = picture->data + ((size_t)(y + row) * (size_t)picture->width + (size_t)x) * step;
        for (int i = 0; i < decode->channel_count; i++) {
            const exr_coding_channel_info_t *channel = &decode->channels[i];
            int place = find_place(reader, channel->channel_name);
            if (place >= 0)
                convert_row(bytes, channel->data_type == EXR_PIXEL_HALF, decode->chunk.width, out + place,
                            step);
            bytes += (size_t)decode->chunk.width * (size_t)channel->bytes_per_element;
        }
    }
    return true;
}

static bool decode_chunk(exr_reader *reader, const exr_chunk_info_t *chunk, int32_t x, int32_t y) {
    if (chunk->width < 1 || chunk->height < 1 || chunk->width > reader->picture->width - x ||
        chunk->height > reader->picture->height - y)
        return fail(reader, "a block of pixels lies outside the picture");
    if (chunk->compression == EXR_COMPRESSION_NONE && chunk->packed_size != chunk->unpacked_size)
        return fail(reader, "a block of pixels has the wrong size");
    bool first = !reader->decoding;
    exr_result_t result = first ? exr_decoding_initialize(reader->context, 0, chunk, &reader->decode)
                                : exr_decoding_update(reader->context, 0, chunk, &reader->decode);
    if (!check(reader, result))
        return false;
    reader->decoding = true;
    if (first && !check(reader, exr_decoding_choose_default_routines(reader->context, 0, &reader->decode)))
        return false;
    reader->decode.unpack_and_convert_fn = NULL; /* done here */
    return check(reader, exr_decoding_run(reader->context, 0, &reader->decode)) && unpack_chunk(reader, x, y);
}

static bool read_scanlines(exr_reader *reader) {
    int32_t lines = 0;
    if (!check(reader, exr_get_scanlines_per_chunk(reader->context, 0, &lines)))
        return false;
    if (lines < 1)
        return fail(reader, "blocks without rows");
    for (int32_t y = 0; y < reader->picture->height; y += lines) {
        exr_chunk_info_t chunk;
        int32_t line = reader->window.min.y + y;
        if (!check(reader, exr_read_scanline_chunk_info(reader->context, 0, line, &chunk)))
            return false;
        if (chunk.start_y != line)
            return fail(reader, "a block of pixels is not where it should be");
        if (!decode_chunk(reader, &chunk, 0, y))
            return false;
    }
    return true;
}

static bool read_tiles(exr_reader *reader) {
    int32_t width = 0, height = 0;
    if (!check(reader, exr_get_tile_sizes(reader->context, 0, 0, 0, &width, &height)))
        return false;
    if (width < 1 || height < 1)
        return fail(reader, "tiles without pixels");
    for (int64_t y = 0; y < reader->picture->height; y += height)
        for (int64_t x = 0; x < reader->picture->width; x += width) {
            exr_chunk_info_t chunk;
            int column = (int)(x / width), row = (int)(y / height);
            if (!check(reader, exr_read_tile_chunk_info(reader->context, 0, column, row, 0, 0, &chunk)) ||
                !decode_chunk(reader, &chunk, (int32_t)x, (int32_t)y))
                return false;
        }
    return true;
}

bool dpl_exr_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error) {
    exr_reader reader = {.source = source, .picture = picture, .error = error};
    bool good = read_header(&reader);
    if (good)
        good = reader.storage == EXR_STORAGE_TILED ? read_tiles(&reader) : read_scanlines(&reader);
    if (reader.decoding)
        exr_decoding_destroy(reader.context, &reader.decode);
    if (reader.context)
        exr_finish(&reader.context);
    if (!good)
        dpl_picture_free(picture);
    return good;
}
