/* Cases of the holographic solver's kernels, on rows without an empty block: the most that there is to do. */
#include "kernel/cases.h"

static const dpl_row_kernels *kernels_of(const dpl_kernel_case *c, const dpl_kernels *kernels) {
    return &kernels->rows[c->storage][DPL_ROWS_GREY];
}

static void *input(const dpl_kernel_case *c, const dpl_case_inputs *in, int32_t number) {
    return dpl_case_row(in->rows[c->storage][number], c->storage);
}

/* The second of a pair of rows in `out`. */
static unsigned char *second(const dpl_kernel_case *c, void *out) {
    return (unsigned char *)out + dpl_case_row_bytes(c->storage);
}

/* A diagonal of level 2: five pixels, one of them by a corner, on two ways. Masks of results are filled anew,
 * for the reference keeps none. */
static void trace(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                  void *out) {
    const dpl_row_shape shape = dpl_case_shape();
    const dpl_tap taps[] = {
        {.kind = DPL_TAP_HALF, .row = input(c, in, 0)},
        {.kind = DPL_TAP_FULL, .row = input(c, in, 1)},
        {.kind = DPL_TAP_CORNER, .row = input(c, in, 2), .other_shift = 1, .other_row = input(c, in, 2)},
        {.kind = DPL_TAP_FULL, .shift = 1, .row = input(c, in, 3)},
        {.kind = DPL_TAP_HALF, .shift = 1, .row = input(c, in, 4)},
    };
    kernels_of(c, kernels)
        ->trace(&shape, dpl_case_row(out, c->storage), taps, sizeof taps / sizeof taps[0],
                DPL_TRACE_TWO_WAYS);
    dpl_case_fill_mask(out);
}

/* The two rows of a fork. */
static void fork_ways(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                      void *out) {
    const dpl_row_shape shape = dpl_case_shape();
    const dpl_fork from = {.start = {input(c, in, 0), NULL},
                           .ahead = {input(c, in, 1), NULL},
                           .aside = {input(c, in, 2), NULL},
                           .end = {input(c, in, 3), NULL},
                           .end_corner = input(c, in, 4),
                           .shift = 1};
    kernels_of(c, kernels)
        ->fork(&shape, dpl_case_row(out, c->storage), dpl_case_row(second(c, out), c->storage), &from);
    dpl_case_fill_mask(out);
    dpl_case_fill_mask(second(c, out));
}

static void extend(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                   void *out) {
    const dpl_row_shape shape = dpl_case_shape();
    const void *const near[2] = {input(c, in, 0), input(c, in, 1)};
    const void *const far[2] = {input(c, in, 2), input(c, in, 3)};
    kernels_of(c, kernels)
        ->extend(&shape, dpl_case_row(out, c->storage), dpl_case_row(second(c, out), c->storage), near, far,
                 5);
    dpl_case_fill_mask(out);
    dpl_case_fill_mask(second(c, out));
}

static void merge(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                  void *out) {
    const dpl_row_shape shape = dpl_case_shape();
    const float sky[3] = {0.1f, 0.2f, 0.3f};
    dpl_merge_ray rays[2];
    for (int32_t s = 0; s < 2; s++)
        rays[s] = (dpl_merge_ray){.segment = input(c, in, s),
                                  .far = input(c, in, 2 + s),
                                  .near = input(c, in, 4 + s),
                                  .shift = 6 * s - 3,
                                  .emitted = 0.25f,
                                  .passed = 0.2f};
    kernels_of(c, kernels)->merge(&shape, dpl_case_row(out, c->storage), rays, sky);
}

/* Sums are floats, whatever the storage. */
static void collect(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                    void *out) {
    const dpl_row_shape shape = dpl_case_shape();
    kernels_of(c, kernels)
        ->collect(&shape, dpl_case_row(out, DPL_ROWS_FLOAT), input(c, in, 0), 0.5f, input(c, in, 1), true);
}

static void fill(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in, void *out) {
    const dpl_row_shape shape = dpl_case_shape();
    const float light[3] = {0.1f, 0.2f, 0.3f};
    (void)in;
    kernels_of(c, kernels)->fill(&shape, dpl_case_row(out, c->storage), light);
}

/* Results are at most two rows of T. Any values are good ones where masks say that no block is empty. */
static void fill_floats(void *out) {
    dpl_case_fill_mask(out);
    dpl_case_fill_mask((unsigned char *)out + dpl_case_row_bytes(DPL_ROWS_FLOAT));
}

static void fill_halves(void *out) {
    dpl_case_fill_mask(out);
    dpl_case_fill_mask((unsigned char *)out + dpl_case_row_bytes(DPL_ROWS_HALF));
}

#define ROW_CASES(type, element, where, filler)                                                              \
    {"trace", type, ROWS, .bytes = 28 * (element), .run = trace, .storage = (where), .fill = filler},        \
        {"fork", type, ROWS, .bytes = 25 * (element), .run = fork_ways, .storage = (where), .fill = filler}, \
        {"extend", type, ROWS, .bytes = 24 * (element), .run = extend, .storage = (where), .fill = filler},  \
        {"merge (rows)",     type,          ROWS, .bytes = 23 * (element), .run = merge,                     \
         .storage = (where), .fill = filler},                                                                \
        {"collect",          type,          ROWS, .bytes = 7 * (element) + 24, .run = collect,               \
         .storage = (where), .fill = filler},                                                                \
    {                                                                                                        \
        "fill", type, ROWS, .bytes = 3 * (element), .run = fill, .storage = (where), .fill = filler          \
    }
#define ROWS .item = "pixel", .items = DPL_CASE_ROW, .out_bytes = 2 * (64 + 4 * 4 * (DPL_CASE_ROW + 32))

static const dpl_kernel_case cases[] = {
    ROW_CASES("floats", 4, DPL_ROWS_FLOAT, fill_floats),
    ROW_CASES("halves", 2, DPL_ROWS_HALF, fill_halves),
};

const dpl_kernel_case *dpl_cases_of_rows(int32_t *count) {
    *count = sizeof cases / sizeof cases[0];
    return cases;
}
