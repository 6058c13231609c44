/* A game's frame: clear, lay buffers in, solve, apply the light. From the second frame on nothing is
 * allocated, whatever the buffers hold of what was there before. */
#include "testing.h"

#include "kernel/half.h"

#include <dapple/dapple.h>

#include <stdlib.h>

enum { W = 150, H = 90, FRAMES = 4 };

static uint16_t emission[H][W][3];
static uint8_t opacity[H][W], albedo[H][W][4], screen[H][W][4];
static uint16_t light[H][W][4];

static void *count_allocation(size_t bytes, size_t alignment, void *user) {
    ++*(int *)user;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void release(void *memory, size_t bytes, void *user) {
    (void)bytes, (void)user;
    free(memory);
}

/* A lamp that moves, walls, and a patch of fog. */
static void draw_buffers(int frame) {
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            int dx = x - 20 - 10 * frame, dy = y - 40, lamp = dx * dx + dy * dy < 36;
            int wall = (x / 12 + y / 9) % 7 == 0, fog = x > 100 && y > 50;
            opacity[y][x] = lamp || wall ? 255 : fog ? 8 : 0;
            for (int c = 0; c < 3; c++) {
                emission[y][x][c] = dpl_half_from_float(lamp ? 4.0f - (float)c : 0.0f);
                albedo[y][x][c] = (uint8_t)(x + 40 * c);
            }
            albedo[y][x][3] = (uint8_t)y;
        }
}

static dpl_layer frame_layer(void) {
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){emission, DPL_FORMAT_F16, W, H, 3, 0};
    layer.extinction = (dpl_pixels){opacity, DPL_FORMAT_UNORM8, W, H, 1, 0};
    layer.albedo = (dpl_pixels){albedo, DPL_FORMAT_SRGB8, W, H, 4, 0};
    return layer;
}

static void run_frame(dpl_context *context, dpl_field *field, dpl_solver *solver) {
    const dpl_layer layer = frame_layer();
    const dpl_output mean = {.data = light, .format = DPL_FORMAT_F16, .width = W, .height = H, .channels = 4};
    const dpl_pixels lamps = {light, DPL_FORMAT_F16, W, H, 4, 0};
    const dpl_output out = {
        .data = screen, .format = DPL_FORMAT_SRGB8, .width = W, .height = H, .channels = 4};
    dpl_field_clear(field);
    assert_ok(dpl_field_draw_layer(field, &layer));
    assert_ok(dpl_solver_solve(solver, field, &mean));
    assert_ok(dpl_lightmap_apply(context, &lamps, &layer.albedo, NULL, &out));
}

static void assert_frames_allocate_once(dpl_solver_kind kind, dpl_storage storage) {
    int allocations = 0;
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 2;
    desc.allocator = (dpl_allocator){.allocate = count_allocation, .release = release, .user = &allocations};
    dpl_context *context;
    assert_ok(dpl_context_create(&desc, &context));
    dpl_field_desc size = dpl_field_desc_default();
    size.width = W;
    size.height = H;
    dpl_field *field;
    assert_ok(dpl_field_create(context, &size, &field));
    dpl_solver_desc method = dpl_solver_desc_default();
    method.kind = kind;
    method.holographic.storage = storage;
    dpl_solver *solver;
    assert_ok(dpl_solver_create(context, &method, &solver));
    int first = 0, bright = 0;
    for (int frame = 1; frame <= FRAMES; frame++) {
        int before = allocations;
        draw_buffers(frame);
        run_frame(context, field, solver);
        if (frame == 1)
            first = allocations - before;
        else
            assert_int_equal(allocations, before);
        for (int i = 0; i < H * W * 4; i++)
            bright += i % 4 < 3 && (&screen[0][0][0])[i] > 20;
    }
    assert_true(first > 0);     /* the books are kept */
    assert_true(bright > 1000); /* and there was light */
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(context);
}

static void after_the_first_frame_nothing_is_allocated(void **state) {
    (void)state;
    assert_frames_allocate_once(DPL_SOLVER_CASCADES, DPL_STORAGE_FLOAT);
    assert_frames_allocate_once(DPL_SOLVER_HOLOGRAPHIC, DPL_STORAGE_FLOAT);
    assert_frames_allocate_once(DPL_SOLVER_HOLOGRAPHIC, DPL_STORAGE_HALF);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(after_the_first_frame_nothing_is_allocated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
