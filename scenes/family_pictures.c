/* The scene "pictures": lamps, walls and paint as PNGs drawn by program, the way a game or a painting program
 * hands them over. Called through the table in families.c. */
#include "family_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A rectangle of one colour in a picture; corners in 64ths of the side, the colour as PNG bytes. */
typedef struct patch {
    int32_t left, top, right, bottom;
    uint8_t bytes[4];
} patch;

static const patch lamps[] = {
    {6, 8, 9, 11, {255, 196, 128, 255}},
    {40, 20, 42, 30, {96, 160, 255, 255}},
    {54, 50, 58, 52, {255, 96, 144, 255}},
    {20, 44, 22, 46, {144, 255, 176, 255}},
};

/* Alpha is what blocks: 255 is a wall, less is tinted air. */
static const patch walls[] = {
    {0, 0, 64, 1, {200, 190, 170, 255}},    {0, 63, 64, 64, {200, 190, 170, 255}},
    {0, 0, 1, 64, {200, 190, 170, 255}},    {63, 0, 64, 64, {200, 190, 170, 255}},
    {18, 1, 19, 24, {180, 90, 80, 255}},    {18, 32, 19, 63, {180, 90, 80, 255}},
    {19, 36, 34, 37, {90, 120, 180, 255}},  {42, 36, 63, 37, {90, 120, 180, 255}},
    {28, 10, 32, 14, {120, 120, 120, 255}}, {46, 12, 48, 28, {120, 120, 120, 255}},
    {26, 48, 36, 58, {0, 0, 0, 4}},         {19, 24, 20, 32, {0, 0, 0, 24}},
    {6, 8, 9, 11, {0, 0, 0, 255}},          {40, 20, 42, 30, {0, 0, 0, 255}},
    {54, 50, 58, 52, {0, 0, 0, 255}},       {20, 44, 22, 46, {0, 0, 0, 255}},
};

/* IEC 61966-2-1, as PNGs of colour are decoded. */
static float linear_from_byte(uint8_t byte) {
    double value = byte / 255.0;
    return (float)(value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4));
}

static void paint(dpl_picture *picture, const patch *p) {
    int64_t side = picture->width;
    for (int64_t y = p->top * side / 64; y < p->bottom * side / 64; y++) {
        for (int64_t x = p->left * side / 64; x < p->right * side / 64; x++) {
            float *pixel = picture->data + (y * side + x) * picture->channels;
            for (int32_t k = 0; k < picture->channels; k++)
                pixel[k] = picture->display ? (float)p->bytes[k] / 255.0f : linear_from_byte(p->bytes[k]);
        }
    }
}

/* `display`: values as stored, for opacity; otherwise decoded to linear light. */
static bool draw(dpl_picture *picture, int32_t size, int32_t channels, bool display, const patch *patches,
                 size_t count, dpl_error *error) {
    if (!dpl_picture_create(picture, size, size, channels, error))
        return false;
    picture->display = display;
    for (size_t i = 0; i < count; i++)
        paint(picture, &patches[i]);
    return true;
}

static bool name(char **to, const char *text, dpl_error *error) {
    *to = malloc(strlen(text) + 1);
    if (!*to)
        return dpl_error_set(error, "out of memory");
    memcpy(*to, text, strlen(text) + 1);
    return true;
}

static bool fill(dpl_scene_image *image, int32_t size, dpl_error *error) {
    const size_t lamp_count = sizeof lamps / sizeof lamps[0], wall_count = sizeof walls / sizeof walls[0];
    image->intensity = 6;
    return name(&image->emission, "pictures-lamps.png", error) &&
           name(&image->extinction, "pictures-walls.png", error) &&
           name(&image->albedo, "pictures-paint.png", error) &&
           draw(&image->emission_picture, size, 3, false, lamps, lamp_count, error) &&
           draw(&image->extinction_picture, size, 4, true, walls, wall_count, error) &&
           draw(&image->albedo_picture, size, 3, false, walls, wall_count, error);
}

DPL_FAMILY(pictures) {
    (void)seed;
    (void)index;
    memset(scene, 0, sizeof *scene);
    scene->width = scene->height = size;
    scene->images = calloc(1, sizeof *scene->images);
    scene->image_count = scene->images ? 1 : 0;
    bool good = scene->images ? fill(scene->images, size, error) : dpl_error_set(error, "out of memory");
    if (!good)
        dpl_scene_free(scene);
    return good;
}
