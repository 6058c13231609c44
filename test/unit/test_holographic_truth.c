/* The holographic solver against the reference, on small seeded worlds of each kind: the root mean square
 * error of free pixels over their mean stays where it was measured, and 20 % above. */
#include "holographic.h"
#include "world.h"

enum { WIDTH = 96, HEIGHT = 80, DIRECTIONS = 1024 };

static float random_channel(uint32_t *seed, double low, double high) {
    return (float)dpl_test_random(seed, low, high);
}

static void add_disc(dpl_field *field, uint32_t *seed, double low, double high, dpl_material material) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    double x = dpl_test_random(seed, 0, WIDTH), y = dpl_test_random(seed, 0, HEIGHT);
    shape.disc = (dpl_disc){{x, y}, dpl_test_random(seed, low, high)};
    shape.material = material;
    assert_ok(dpl_field_draw_shapes(field, &shape, 1));
}

/* A few lamps and walls. */
static void draw_discs(dpl_field *field, uint32_t *seed) {
    for (int i = 0; i < 10; i++) {
        dpl_material material = truth_wall(0.0, 0.0);
        for (int c = 0; c < 3 && i % 3 == 0; c++)
            material.emission[c] = random_channel(seed, 0.5, 2.0);
        add_disc(field, seed, 2, 7, material);
    }
}

/* Lots of small things, a lamp among six. */
static void draw_clutter(dpl_field *field, uint32_t *seed) {
    for (int i = 0; i < 220; i++)
        add_disc(field, seed, 0.5, 1.6, truth_wall(i % 6 ? 0.0 : dpl_test_random(seed, 0.5, 2.0), 0.0));
}

static void draw_fog(dpl_field *field, uint32_t *seed) {
    truth_box(field, 0, 0, WIDTH, HEIGHT, hrc_fog(0.02, 0.01, 0.01, 0.01));
    for (int i = 0; i < 4; i++)
        add_disc(field, seed, 6, 14, hrc_fog(0.1, 0.06, 0.06, 0.06));
    draw_discs(field, seed);
}

static void draw_tinted(dpl_field *field, uint32_t *seed) {
    for (int i = 0; i < 8; i++)
        add_disc(field, seed, 6, 14, hrc_fog(0.0, i % 3 ? 0.01 : 0.3, i % 2 ? 0.02 : 0.2, 0.1));
    draw_discs(field, seed);
}

static const struct {
    void (*draw)(dpl_field *field, uint32_t *seed);
    double most; /* 1.2 * the greatest of what was measured */
} kinds[] = {{draw_discs, 0.0383}, {draw_clutter, 0.109}, {draw_fog, 0.0394}, {draw_tinted, 0.0436}};

/* Pixels that are compared: a grid of all parities. */
enum { STEP = 5, MOST_PIXELS = (WIDTH / STEP + 1) * (HEIGHT / STEP + 1) };

/* Free pixels of the grid, and what the reference says about them; how many they are. */
static int32_t free_pixels(dpl_field *field, int32_t pixels[][2], float truth[][3]) {
    static uint8_t opaque[HEIGHT][WIDTH];
    int32_t count = 0;
    assert_ok(dpl_field_read_opaque(field, opaque[0], 0));
    for (int32_t y = 2; y < HEIGHT; y += STEP)
        for (int32_t x = 2; x < WIDTH; x += STEP)
            if (!opaque[y][x]) {
                pixels[count][0] = x;
                pixels[count++][1] = y;
            }
    dpl_solver *solver = truth_solver(DIRECTIONS, 0);
    assert_ok(dpl_reference_solve_pixels(solver, field, (const int32_t(*)[2])pixels, count, truth));
    dpl_solver_destroy(solver);
    return count;
}

static double relative_error(dpl_field *field, dpl_storage storage, int32_t count, const int32_t pixels[][2],
                             const float truth[][3]) {
    float *rgb = hrc_solve(field, storage);
    double squares = 0.0, sum = 0.0;
    for (int32_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            double value = (double)rgb[3 * (pixels[i][1] * WIDTH + pixels[i][0]) + c];
            squares += pow(value - (double)truth[i][c], 2.0);
            sum += (double)truth[i][c];
        }
    free(rgb);
    return sqrt(squares / (3 * count)) / (sum / (3 * count));
}

static void every_kind_of_world_is_as_close_to_the_truth_as_measured(void **state) {
    (void)state;
    static int32_t pixels[MOST_PIXELS][2];
    static float truth[MOST_PIXELS][3];
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
        for (uint32_t world = 1; world <= 2; world++) {
            uint32_t seed = world;
            dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
            hrc_set_sky(field, 0.02);
            kinds[k].draw(field, &seed);
            int32_t count = free_pixels(field, pixels, truth);
            for (int storage = 0; storage < 2; storage++) {
                double error = relative_error(field, (dpl_storage)storage, count, (const int32_t(*)[2])pixels,
                                              (const float(*)[3])truth);
                assert_true(error > 0.0 && error <= kinds[k].most);
            }
            dpl_field_destroy(field);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_world_is_as_close_to_the_truth_as_measured),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
