/* Cases of the kernels that treat every value of a row alike. */
#include "kernel/cases.h"

#include "testing.h"

#define RUN(name)                                                                                            \
    static void name(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,        \
                     void *out)

enum { ROW = DPL_CASE_ROW, TRANSPOSED = 16 };

RUN(aim_row) {
    (void)c;
    float *first = out, *const ends[4] = {first, first + ROW, first + 2 * ROW, first + 3 * ROW};
    kernels->aim_row(ROW, ends, in->planes[0], (const float[2]){0.25f, 7.5f}, in->planes[1],
                     (const float[2]){-1.75f, 3.0f});
}

/* Four parents each stand behind the rays of a row of probes, in every channel the same. */
static dpl_parents parents_of(const dpl_case_inputs *in) {
    return (dpl_parents){
        .seen = DPL_PARENTS_FOUR, .between = 0.75f, .row = in->planes[0], .next_row = in->planes[1]};
}

static dpl_probe_sums sums_in(float *out) {
    return (dpl_probe_sums){
        .count = ROW, .sum = {out, out + ROW, out + 2 * ROW}, .weight = {0.1875f, 0.0625f}};
}

RUN(merge) {
    (void)c;
    dpl_intervals intervals;
    for (int k = 0; k < 3; k++) {
        intervals.radiance[k] = (float *)(uintptr_t)in->planes[2 + k];
        intervals.transmittance[k] = (float *)(uintptr_t)in->planes[5 + k];
    }
    const dpl_parents seen = parents_of(in);
    const dpl_probe_sums all = sums_in(out);
    kernels->merge(&all, &seen, &intervals);
}

RUN(merge_hits) {
    (void)c;
    const uint64_t hits[ROW / 64] = {0, ~(uint64_t)0, 0x00ff00ff00ff00ff, 0, 0, 1, 0, 0xffff};
    const dpl_parents seen = parents_of(in);
    const dpl_probe_sums all = sums_in(out);
    kernels->merge_hits(&all, &seen, hits);
}

RUN(spread) {
    (void)c;
    kernels->spread(ROW, out, in->planes[0], in->planes[1], 0.75f);
}

RUN(distance_down) {
    (void)c;
    kernels->distance_down(ROW, out, in->kinds, in->runs);
}

RUN(distance_up) {
    (void)c;
    kernels->distance_up(ROW, out, in->runs);
}

RUN(distance_along) {
    int32_t scratch[4 * ROW];
    const dpl_case_band *band = &in->bands[c->world];
    const dpl_distance_rows rows = {
        .width = ROW,
        .height = DPL_CASE_BAND,
        .nowhere = 2 * ROW,
        .kind = band->kind[0],
        .runs = band->runs[0],
        .clearance = out,
    };
    assert_true(sizeof scratch >= dpl_distance_scratch(ROW));
    kernels->distance_along(&rows, scratch);
}

RUN(tonemap) {
    (void)c;
    kernels->tonemap(ROW, out, in->planes[0]);
}

RUN(all_within) {
    (void)c;
    *(uint8_t *)out = kernels->all_within(ROW, in->planes[0], 1.0f);
}

RUN(half_from_float) {
    (void)c;
    kernels->half_from_float(ROW, out, in->planes[0]);
}

RUN(float_from_half) {
    (void)c;
    kernels->float_from_half(ROW, out, in->halves);
}

RUN(bytes_from_linear) {
    (void)c;
    kernels->bytes_from_linear(ROW, out, in->planes[0]);
}

RUN(srgb_from_linear) {
    (void)c;
    kernels->srgb_from_linear(ROW, out, in->planes[0], &in->steps);
}

RUN(opaque_planes) {
    (void)c;
    kernels->opaque_planes(ROW, out, ROW, in->kinds, in->texels);
}

/* A band of 16 rows, wherever they come from. */
RUN(transpose) {
    const dpl_grid *grid = &in->grids[c->world];
    kernels->transpose(TRANSPOSED, ROW, out, TRANSPOSED, grid->clearance, (size_t)grid->width);
}

RUN(transpose_halves) {
    const dpl_grid *grid = &in->grids[c->world];
    kernels->transpose_halves(TRANSPOSED, ROW, out, TRANSPOSED,
                              (const uint16_t *)(const void *)grid->clearance, (size_t)grid->width);
}

RUN(interleave) {
    (void)c;
    const float *const planes[3] = {in->planes[0], in->planes[1], in->planes[2]};
    kernels->interleave(ROW, out, planes, false);
}

RUN(add_scaled) {
    (void)c;
    kernels->add_scaled(ROW, out, in->planes[0], 0.5f, true);
}

RUN(filter_cross) {
    (void)c;
    const float *values[3], *is_free[3];
    for (int r = 0; r < 3; r++) {
        values[r] = in->planes[r] + DPL_ROW_PAD;
        is_free[r] = in->planes[3 + r] + DPL_ROW_PAD;
    }
    kernels->filter_cross(ROW, out, values, is_free);
}

#define VALUES(number, most) .item = "value", .items = (number), .out_bytes = (size_t)(number) * (most)

static const dpl_kernel_case cases[] = {
    {"aim_row", "row", .item = "ray", .items = ROW, .out_bytes = 4 * ROW * sizeof(float), .bytes = 24,
     .run = aim_row},
    {"merge", "row", VALUES(3 * ROW, 4), .bytes = 20, .run = merge},
    {"merge_hits", "row", VALUES(3 * ROW, 4), .bytes = 12, .run = merge_hits},
    {"spread", "row", VALUES(ROW, 4), .bytes = 8, .run = spread},
    {"distance_down", "row", VALUES(ROW, 4), .bytes = 9, .run = distance_down},
    {"distance_up", "row", VALUES(ROW, 4), .bytes = 12, .run = distance_up},
    {"distance_along", "arc", VALUES(DPL_CASE_BAND *ROW, 4), .bytes = 9, .run = distance_along,
     .world = DPL_CASE_ARC_WALLS},
    {"distance_along", "noise", VALUES(DPL_CASE_BAND *ROW, 4), .bytes = 9, .run = distance_along,
     .world = DPL_CASE_NOISE_WALLS},
    {"tonemap", "row", VALUES(ROW, 1), .bytes = 5, .run = tonemap},
    {"all_within", "row", .item = "value", .items = ROW, .out_bytes = 1, .bytes = 4, .run = all_within},
    {"half_from_float", "row", VALUES(ROW, 2), .bytes = 6, .run = half_from_float},
    {"float_from_half", "row", VALUES(ROW, 4), .bytes = 6, .run = float_from_half},
    {"bytes_from_linear", "row", VALUES(ROW, 1), .bytes = 5, .run = bytes_from_linear},
    {"srgb_from_linear", "row", VALUES(ROW, 1), .bytes = 5, .run = srgb_from_linear},
    {"opaque_planes", "row", VALUES(ROW, 16), .bytes = 33, .run = opaque_planes},
    {"transpose", "16 rows", VALUES(TRANSPOSED *ROW, 4), .bytes = 8, .run = transpose},
    {"transpose_halves", "16 rows", VALUES(TRANSPOSED *ROW, 2), .bytes = 4, .run = transpose_halves},
    {"interleave", "row", .item = "pixel", .items = ROW, .out_bytes = (size_t)ROW * 12, .bytes = 24,
     .run = interleave},
    {"add_scaled", "row", VALUES(ROW, 4), .bytes = 12, .run = add_scaled},
    {"filter_cross", "row", VALUES(ROW, 4), .bytes = 28, .run = filter_cross},
};

const dpl_kernel_case *dpl_cases_of_pixels(int32_t *count) {
    *count = sizeof cases / sizeof cases[0];
    return cases;
}
