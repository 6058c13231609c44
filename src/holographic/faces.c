/* Bounces: what the faces of opaque pixels receive, by the sums of the last pass and from the solver's
 * lights, and reflect in the next. docs/algorithms/bounces.md has the definition. */
#include "holographic/holographic.h"

/* The half circle's cosine-weighted light is quarter turn * sum of the groups' means; a reflector of albedo
 * rho sends out rho/2 of it. */
#define REFLECTED_PER_SUM 0.785398163f

/* A side, named by the way it looks: where the pixel before it is, what it is called on each axis, and which
 * sums hold its light. */
typedef struct side {
    int8_t x;
    int8_t y;
    dpl_hrc_face face[2];
    dpl_hrc_mix mix;
} side;

enum { RIGHT, LEFT, DOWN, UP, SIDES };

#define MIX(along_x, along_y)                                                                                \
    {                                                                                                        \
        {                                                                                                    \
            {[along_x] = REFLECTED_PER_SUM}, {                                                               \
                [along_y] = REFLECTED_PER_SUM                                                                \
            }                                                                                                \
        }                                                                                                    \
    }

static const side sides[SIDES] = {
    [RIGHT] = {1, 0, {DPL_FACE_FORWARD, DPL_FACE_ABOVE}, MIX(DPL_GROUP_FORWARD, DPL_GROUP_ABOVE)},
    [LEFT] = {-1, 0, {DPL_FACE_BACKWARD, DPL_FACE_BELOW}, MIX(DPL_GROUP_BACKWARD, DPL_GROUP_BELOW)},
    [DOWN] = {0, 1, {DPL_FACE_ABOVE, DPL_FACE_FORWARD}, MIX(DPL_GROUP_ABOVE, DPL_GROUP_FORWARD)},
    [UP] = {0, -1, {DPL_FACE_BELOW, DPL_FACE_BACKWARD}, MIX(DPL_GROUP_BELOW, DPL_GROUP_BACKWARD)},
};

/* Where element `index` of column `column` stands, in the first plane of a face. */
static char *face_at(const dpl_hrc *hrc, int axis_index, dpl_hrc_face face, int32_t column, int32_t index) {
    const dpl_hrc_axis *axis = &hrc->layout.axes[axis_index];
    size_t plane = 3 * (size_t)face * (size_t)axis->shape.stride;
    return (char *)hrc->arena.data + axis->faces + (size_t)column * axis->faces_bytes +
           (plane + DPL_ROW_PAD + (size_t)index) * hrc->layout.element;
}

static void store_face(const dpl_hrc *hrc, int axis_index, char *at, const float rgb[3]) {
    size_t plane = (size_t)hrc->layout.axes[axis_index].shape.stride * hrc->layout.element;
    for (int c = 0; c < 3; c++, at += plane) {
        uint16_t half = dpl_half_from_float(rgb[c]);
        memcpy(at, hrc->layout.half ? (const void *)&half : (const void *)&rgb[c], hrc->layout.element);
    }
}

/* What a side of pixel (x, y) reflects. */
static void load_side(const dpl_hrc *hrc, int which, int32_t x, int32_t y, float rgb[3]) {
    const char *at = face_at(hrc, 1, sides[which].face[1], y, x);
    size_t plane = (size_t)hrc->layout.axes[1].shape.stride * hrc->layout.element;
    for (int c = 0; c < 3; c++, at += plane) {
        uint16_t half;
        if (!hrc->layout.half) {
            memcpy(&rgb[c], at, sizeof rgb[c]);
            continue;
        }
        memcpy(&half, at, sizeof half);
        rgb[c] = dpl_float_from_half(half);
    }
}

static bool is_exposed(const dpl_field *field, int which, int32_t x, int32_t y) {
    int32_t beside = x + sides[which].x, before = y + sides[which].y;
    return beside >= 0 && before >= 0 && beside < field->width && before < field->height &&
           !dpl_field_is_opaque(field, beside, before);
}

/* Does a side of pixel (x, y) reflect anything? */
static bool reflects(const dpl_field *field, int which, int32_t x, int32_t y) {
    const float *albedo = ((const float(*)[4])field->albedo.data)[dpl_field_cell(field, x, y)];
    return dpl_field_is_opaque(field, x, y) && (albedo[0] > 0.0f || albedo[1] > 0.0f || albedo[2] > 0.0f) &&
           is_exposed(field, which, x, y);
}

/* ---- lights --------------------------------------------------------------------------------------- */

/* Numbers the faces that reflect, in the order in which reflect_row() meets them, and lists them where there
 * is a list. Returns how many there are. */
static int32_t number_faces(const dpl_field *field, int32_t *first, dpl_face *list) {
    int32_t count = 0;
    for (int32_t y = 0; y < field->height; y++)
        for (int which = 0; which < SIDES; which++) {
            const side *s = &sides[which];
            first[SIDES * y + which] = count;
            for (int32_t x = 0; x < field->width; x++) {
                if (!reflects(field, which, x, y))
                    continue;
                if (list)
                    list[count] = (dpl_face){x + s->x, y + s->y, {s->x, s->y}};
                count++;
            }
        }
    return count;
}

dpl_status dpl_hrc_light_faces(dpl_hrc *hrc, const dpl_field *field, int32_t margin) {
    static const double scales[] = {[DPL_RESOLUTION_FULL] = 1.0,
                                    [DPL_RESOLUTION_HALF] = 0.5,
                                    [DPL_RESOLUTION_QUARTER] = 0.25,
                                    [DPL_RESOLUTION_DOUBLE] = 2.0};
    dpl_solver *solver = &hrc->solver;
    dpl_hrc_lit *lit = &hrc->lit;
    lit->count = 0;
    if (!hrc->layout.faces || solver->light_count == 0)
        return DPL_OK;
    DPL_TRY(dpl_buffer_reserve(solver->context, &lit->first, (size_t)field->height, SIDES * sizeof(int32_t)));
    int32_t count = number_faces(field, lit->first.data, NULL), room = 256;
    if (count == 0)
        return DPL_OK;
    while (room < count && room < INT32_MAX / 2) /* so that a few more in the next frame allocate nothing */
        room *= 2;
    room = room > count ? room : count;
    DPL_TRY(dpl_buffer_reserve(solver->context, &lit->faces, (size_t)room, sizeof(dpl_face)));
    DPL_TRY(dpl_buffer_reserve(solver->context, &lit->rgb, (size_t)room, sizeof(float[3])));
    lit->count = number_faces(field, lit->first.data, lit->faces.data);
    dpl_face_order order = {
        .field = field,
        .margin = margin,
        .scale = scales[hrc->resolution.kind],
        .faces = lit->faces.data,
        .count = count,
        .rgb = lit->rgb.data,
    };
    return solver->light_faces(solver, &order);
}

/* What lights give to the faces of a side of row y that reflect, from the left; NULL where there are none. */
static const float (*lit_row(const dpl_hrc *hrc, int which, int32_t y))[3] {
    if (hrc->lit.count == 0)
        return NULL;
    return (const float(*)[3])hrc->lit.rgb.data + ((const int32_t *)hrc->lit.first.data)[SIDES * y + which];
}

/* ---- reflection ----------------------------------------------------------------------------------- */

/* The mean of what the exposed sides of a pixel reflect, 0 where none is. */
static void mean_of_sides(const dpl_hrc_frame *f, int32_t x, int32_t y, float rgb[3]) {
    float exposed = 0.0f;
    rgb[0] = rgb[1] = rgb[2] = 0.0f;
    for (int which = 0; which < SIDES; which++) {
        float reflected[3];
        if (!is_exposed(f->field, which, x, y))
            continue;
        load_side(f->hrc, which, x, y, reflected);
        exposed += 1.0f;
        for (int c = 0; c < 3; c++)
            rgb[c] += reflected[c];
    }
    for (int c = 0; c < 3 && exposed > 0.0f; c++)
        rgb[c] /= exposed;
}

/* One side of row y's opaque pixels, from the light of the row that it looks at. */
static void reflect_row(const dpl_hrc_frame *f, int which, int32_t y, float *const light[3]) {
    const float(*albedo)[4] = (const float(*)[4])f->field->albedo.data;
    const float(*direct)[3] = lit_row(f->hrc, which, y);
    const side *s = &sides[which];
    for (int32_t x = 0; x < f->field->width; x++) {
        if (!reflects(f->field, which, x, y))
            continue;
        float rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = albedo[dpl_field_cell(f->field, x, y)][c] *
                     (light[c][x + s->x] + (direct ? (*direct)[c] : 0.0f));
        direct += direct != NULL;
        store_face(f->hrc, 0, face_at(f->hrc, 0, s->face[0], x, y), rgb);
        store_face(f->hrc, 1, face_at(f->hrc, 1, s->face[1], y, x), rgb);
    }
}

void dpl_hrc_faces_task(int32_t begin, int32_t end, int32_t worker, void *frame) {
    const dpl_hrc_frame *f = frame;
    int32_t height = f->field->height;
    for (int32_t item = begin; item < end; item++) {
        int32_t y = item * DPL_HRC_BAND, left = height - y, count = left < DPL_HRC_BAND ? left : DPL_HRC_BAND;
        for (int which = 0; which < SIDES; which++) {
            dpl_hrc_band band = dpl_hrc_mix_rows(f, worker, &sides[which].mix, y + sides[which].y, count);
            for (int32_t at = y; at < y + count; at++) {
                int32_t seen = at + sides[which].y;
                float *light[3];
                if (seen < 0 || seen >= height)
                    continue;
                dpl_hrc_filter_row(f, &band, seen, light);
                reflect_row(f, which, at, light);
            }
        }
    }
}

void dpl_hrc_show_opaque(const dpl_hrc_frame *frame, int32_t x, int32_t y, float rgb[3]) {
    const float(*emission)[4] = (const float(*)[4])frame->field->emission.data;
    float reflected[3] = {0.0f, 0.0f, 0.0f};
    if (frame->hrc->faces_lit)
        mean_of_sides(frame, x, y, reflected);
    for (int c = 0; c < 3; c++)
        rgb[c] = emission[dpl_field_cell(frame->field, x, y)][c] + reflected[c];
}
