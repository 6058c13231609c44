/* Makes the four tables of row kernels from functions that take storage and colour as constants at their end.
 * Included by rows_ref.c and rows_vector.c, which define those functions and then say DPL_ROW_TABLES(name).
 */
#ifndef DPL_KERNEL_ROWS_TABLE_H
#define DPL_KERNEL_ROWS_TABLE_H

#include "kernel/rows.h"

#define DPL_ROW_FUNCTIONS(suffix, is_half, t_planes)                                                         \
    static void trace_##suffix(const dpl_row_shape *shape, void *out, const dpl_tap *taps, int32_t count,    \
                               dpl_trace_into into) {                                                        \
        trace(shape, out, taps, count, into, (layout){is_half, t_planes});                                   \
    }                                                                                                        \
    static void fork_##suffix(const dpl_row_shape *shape, void *out, void *straight, const dpl_fork *from) { \
        fork_ways(shape, out, straight, from, (layout){is_half, t_planes});                                  \
    }                                                                                                        \
    static void extend_##suffix(const dpl_row_shape *shape, void *even, void *odd,                           \
                                const void *const near[2], const void *const far[2], int32_t shift) {        \
        extend(shape, even, odd, near, far, shift, (layout){is_half, t_planes});                             \
    }                                                                                                        \
    static void merge_##suffix(const dpl_row_shape *shape, void *out, const dpl_merge_ray rays[2],           \
                               const float sky[3]) {                                                         \
        merge(shape, out, rays, sky, (layout){is_half, t_planes});                                           \
    }                                                                                                        \
    static void fill_##suffix(const dpl_row_shape *shape, void *out, const float light[3]) {                 \
        fill(shape, out, light, (layout){is_half, t_planes});                                                \
    }                                                                                                        \
    static void fill_pads_##suffix(const dpl_row_shape *shape, void *out, const float light[3]) {            \
        fill_pads(shape, out, light, (layout){is_half, t_planes});                                           \
    }                                                                                                        \
    static void collect_##suffix(const dpl_row_shape *shape, float *sum, const void *segment, float emitted, \
                                 const void *radiance, bool add) {                                           \
        collect(shape, sum, segment, emitted, radiance, add, (layout){is_half, t_planes});                   \
    }

#define DPL_ROW_ENTRY(suffix)                                                                                \
    {                                                                                                        \
        .trace = trace_##suffix, .fork = fork_##suffix, .extend = extend_##suffix, .merge = merge_##suffix,  \
        .fill = fill_##suffix, .fill_pads = fill_pads_##suffix, .collect = collect_##suffix                  \
    }

/* Half precision takes more code than all else here: a build whose size counts leaves it out, and its tables
 * are empty. */
#if defined(DPL_WITHOUT_HALF_ROWS)
#define DPL_HALF_ROW_FUNCTIONS
#define DPL_HALF_ROW_ENTRIES                                                                                 \
    {                                                                                                        \
        { 0 }                                                                                                \
    }
#else
#define DPL_HALF_ROW_FUNCTIONS DPL_ROW_FUNCTIONS(half_grey, true, 1) DPL_ROW_FUNCTIONS(half_rgb, true, 3)
#define DPL_HALF_ROW_ENTRIES                                                                                 \
    { [DPL_ROWS_GREY] = DPL_ROW_ENTRY(half_grey), [DPL_ROWS_RGB] = DPL_ROW_ENTRY(half_rgb) }
#endif

#define DPL_ROW_TABLES(name)                                                                                 \
    DPL_ROW_FUNCTIONS(float_grey, false, 1)                                                                  \
    DPL_ROW_FUNCTIONS(float_rgb, false, 3)                                                                   \
    DPL_HALF_ROW_FUNCTIONS                                                                                   \
    extern const dpl_row_kernels name[DPL_ROWS_STORAGES][DPL_ROWS_COLOURS];                                  \
    const dpl_row_kernels name[DPL_ROWS_STORAGES][DPL_ROWS_COLOURS] = {                                      \
        [DPL_ROWS_FLOAT] =                                                                                   \
            {[DPL_ROWS_GREY] = DPL_ROW_ENTRY(float_grey), [DPL_ROWS_RGB] = DPL_ROW_ENTRY(float_rgb)},        \
        [DPL_ROWS_HALF] = DPL_HALF_ROW_ENTRIES};

#endif
