/* Scenes with something that moves. */
#include "situation.h"

#include "../../scenes/families.h"

#include <math.h>

static const dpl_bench_situation situations[] = {
    {"nothing, not drawn again", "rooms", true, DPL_BENCH_NOTHING},
    {"nothing, drawn again", "rooms", true, DPL_BENCH_REDRAW},
    {"a lamp moves in a closed room", "rooms", true, DPL_BENCH_LAMP},
    {"a wall moves in a closed room", "rooms", true, DPL_BENCH_WALL},
    {"a lamp moves among rooms with doors", "rooms", false, DPL_BENCH_LAMP},
    {"a lamp's colour, in the open", "arc", false, DPL_BENCH_COLOUR},
    {"a lamp moves in the open", "arc", false, DPL_BENCH_LAMP},
    {"a wall moves in the open", "arc", false, DPL_BENCH_WALL},
};

const dpl_bench_situation *dpl_bench_situations(int32_t *count) {
    *count = (int32_t)(sizeof situations / sizeof situations[0]);
    return situations;
}

/* Where it all happens, in parts of the picture: a room's half width, and its walls'. */
#define CENTER 0.4
#define ROOM_HALF 0.083
#define WALL_HALF 2.0 /* [px] */

static bool add_box(dpl_scene *scene, double x, double y, double half_x, double half_y, bool empty,
                    dpl_error *error) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    shape.box = (dpl_box){{x, y}, {half_x, half_y}, 0.0};
    for (int c = 0; c < 3 && empty; c++)
        shape.material.extinction[c] = 0.0f;
    return dpl_scene_add_shape(scene, &shape, error);
}

/* Takes away what is there and puts walls around. */
static bool add_room(dpl_scene *scene, double size, dpl_error *error) {
    double at = CENTER * size, half = ROOM_HALF * size;
    bool good = add_box(scene, at, at, half, half, true, error);
    for (int side = -1; side <= 1 && good; side += 2)
        good = add_box(scene, at + side * half, at, WALL_HALF, half + WALL_HALF, false, error) &&
               add_box(scene, at, at + side * half, half + WALL_HALF, WALL_HALF, false, error);
    return good;
}

bool dpl_bench_situation_scene(const dpl_bench_situation *s, int32_t size, dpl_scene *scene,
                               dpl_error *error) {
    const dpl_scene_family *family = dpl_scene_family_find(s->family);
    return family->make(1, 0, size, scene, error) && (!s->closed || add_room(scene, size, error));
}

/* A lamp, or a wall beside one that stands still. */
bool dpl_bench_situation_draw(const dpl_bench_situation *s, const dpl_scene *scene, dpl_context *context,
                              int32_t frame, dpl_field *field, dpl_error *error) {
    double size = scene->width, at = CENTER * size, turn = 0.15 * frame, radius = 0.03 * size;
    double x = at + radius * cos(turn), y = at + radius * sin(turn);
    bool lamp_moves = s->change == DPL_BENCH_LAMP;
    dpl_shape shapes[2] = {dpl_shape_default(DPL_SHAPE_DISC), dpl_shape_default(DPL_SHAPE_BOX)};
    if (s->change == DPL_BENCH_NOTHING && frame > 0)
        return true;
    shapes[0].disc = (dpl_disc){{lamp_moves ? x : at, lamp_moves ? y : at}, 0.008 * size};
    for (int c = 0; c < 3; c++)
        shapes[0].material.emission[c] = s->change == DPL_BENCH_COLOUR ? 1.0f + (float)(frame % 5) : 2.0f;
    shapes[1].box = (dpl_box){{x, y}, {0.012 * size, 2.0}, turn};
    dpl_status status = DPL_OK;
    if (!dpl_scene_draw(scene, context, field, error))
        return false;
    status = dpl_field_draw_shapes(field, shapes, s->change == DPL_BENCH_WALL ? 2 : 1);
    return status == DPL_OK || dpl_error_set(error, "%s", dpl_status_text(status));
}
