/* Scatters shapes and rays. Called by whatever measures tracers. */
#include "scatter.h"

#include "random.h"

#include <math.h>
#include <stdlib.h>

#define SIDE 1024.0
#define COVERED 0.1
#define PI 3.14159265358979323846

static dpl_shape random_shape(dpl_shape_kind kind, double size, uint64_t *state) {
    double x = dpl_bench_random(state, 0, SIDE), y = dpl_bench_random(state, 0, SIDE);
    double ratio = dpl_bench_random(state, 0.5, 1.5);
    dpl_shape shape = dpl_shape_default(kind);
    if (kind == DPL_SHAPE_DISC)
        shape.disc = (dpl_disc){{x, y}, size * ratio};
    else
        shape.box = (dpl_box){{x, y}, {size * ratio, size * (2 - ratio)}, dpl_bench_random(state, 0, PI)};
    return shape;
}

/* Where a sequence begins: never at 0, where it would stay. */
static uint64_t start(uint64_t base, uint64_t seed) {
    return base + seed ? base + seed : 1;
}

dpl_shape *dpl_bench_scatter_shapes(dpl_shape_kind kind, int32_t count, uint64_t seed) {
    dpl_shape *shapes = malloc((size_t)count * sizeof *shapes);
    uint64_t state = start(0x9e3779b97f4a7c15u, seed);
    double size = sqrt(COVERED * SIDE * SIDE / (count * (kind == DPL_SHAPE_DISC ? PI : 4.0)));
    for (int32_t i = 0; shapes && i < count; i++)
        shapes[i] = random_shape(kind, size, &state);
    return shapes;
}

void dpl_bench_scatter_rays(uint64_t seed, int32_t count, dpl_ray *rays) {
    uint64_t state = start(0, seed);
    for (int32_t i = 0; i < count; i++) {
        double angle = dpl_bench_random(&state, 0, 2 * PI);
        rays[i] = (dpl_ray){.far = INFINITY};
        rays[i].origin[0] = (float)dpl_bench_random(&state, 0, SIDE);
        rays[i].origin[1] = (float)dpl_bench_random(&state, 0, SIDE);
        rays[i].direction[0] = (float)cos(angle);
        rays[i].direction[1] = (float)sin(angle);
    }
}

int32_t dpl_bench_next_size(int32_t size) {
    int32_t digit = size;
    while (digit >= 10)
        digit /= 10;
    return digit == 2 ? size / 2 * 5 : 2 * size;
}
