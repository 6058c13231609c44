/* Worlds of chance for rays in the plane: shapes that cover a tenth of a square, however many they are, and
 * rays from anywhere in it to anywhere. Used by the tracers' benchmark and by `dapple complexity`. */
#ifndef DPL_BENCH_SCATTER_H
#define DPL_BENCH_SCATTER_H

#include <dapple/ray.h>
#include <dapple/shape.h>
#include <stdint.h>

/* `count` discs or boxes: malloc'ed, NULL when out of memory. The same arguments give the same shapes. */
dpl_shape *dpl_bench_scatter_shapes(dpl_shape_kind kind, int32_t count, uint64_t seed);

/* Fills `count` rays without an end. The first ones are the same for every count. */
void dpl_bench_scatter_rays(uint64_t seed, int32_t count, dpl_ray *rays);

/* Sizes to measure at: 1, 2, 5, 10, 20, 50 ... */
int32_t dpl_bench_next_size(int32_t size);

#endif
