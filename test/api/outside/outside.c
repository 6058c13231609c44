/* A program that a stranger might write in C: one lamp, one wall, and is it darker behind the wall? Built by
 * with_cmake.sh and with_pkg_config.sh against an installed Dapple. */
#include <dapple/dapple.h>

#include <stdio.h>

enum { SIZE = 64 };

static float picture[SIZE][SIZE][3];

static dpl_status draw(dpl_field *field) {
    dpl_shape shapes[2] = {dpl_shape_default(DPL_SHAPE_DISC), dpl_shape_default(DPL_SHAPE_BOX)};
    shapes[0].disc.center[0] = 12.0;
    shapes[0].disc.center[1] = 32.0;
    shapes[0].disc.radius = 5.0;
    shapes[0].material.emission[0] = 2.0f;
    shapes[1].box.center[0] = 32.0;
    shapes[1].box.center[1] = 32.0;
    shapes[1].box.half[0] = 2.0;
    shapes[1].box.half[1] = 12.0;
    return dpl_field_draw_shapes(field, shapes, 2);
}

static dpl_status solve(dpl_context *context, dpl_field *field) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    dpl_status status = dpl_solver_create(context, &desc, &solver);
    if (status != DPL_OK)
        return status;
    dpl_output output = {.data = &picture[0][0][0], .width = SIZE, .height = SIZE, .channels = 3};
    status = dpl_solver_solve(solver, field, &output);
    dpl_solver_destroy(solver);
    return status;
}

static dpl_status light(dpl_context *context) {
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = SIZE;
    dpl_field *field;
    dpl_status status = dpl_field_create(context, &desc, &field);
    if (status == DPL_OK)
        status = draw(field);
    if (status == DPL_OK)
        status = solve(context, field);
    dpl_field_destroy(field);
    return status;
}

int main(void) {
    dpl_context *context;
    dpl_status status = dpl_context_create(NULL, &context);
    if (status == DPL_OK)
        status = light(context);
    if (status != DPL_OK)
        fprintf(stderr, "%s: %s\n", dpl_status_text(status), context ? dpl_context_message(context) : "");
    dpl_context_destroy(context);
    float before = picture[32][24][0], behind = picture[32][40][0];
    printf("dapple %s: %.4f before the wall, %.4f behind it\n", dpl_version(), (double)before,
           (double)behind);
    return status == DPL_OK && before > 2.0f * behind && behind >= 0.0f ? 0 : 1;
}
