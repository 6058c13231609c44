/* Reading the distances between samples. Inlined into marches. */
#ifndef DPL_MESH_SAMPLE_H
#define DPL_MESH_SAMPLE_H

#include <dapple/mesh.h>
#include <math.h>
#include <stddef.h>

/* A grid as marches read it: places are counted in spacings from its first sample. */
typedef struct dpl_mesh_lattice {
    const float *samples;
    int32_t size[3];
    float last[3]; /* size - 1 */
} dpl_mesh_lattice;

static inline dpl_mesh_lattice dpl_mesh_lattice_of(const dpl_mesh_grid *grid, const float *samples) {
    dpl_mesh_lattice lattice = {.samples = samples};
    for (int axis = 0; axis < 3; axis++) {
        lattice.size[axis] = grid->size[axis];
        lattice.last[axis] = (float)(grid->size[axis] - 1);
    }
    return lattice;
}

static inline float dpl_mesh_between(float from, float to, float share) {
    return from + (to - from) * share;
}

/* The distance [scene unit] at a place within the lattice, 0 .. last along each axis. Every axis has two
 * samples or more. */
static inline float dpl_mesh_lattice_at(const dpl_mesh_lattice *lattice, const float place[3]) {
    int32_t cell[3];
    float share[3];
    for (int axis = 0; axis < 3; axis++) {
        int32_t i = (int32_t)place[axis];
        cell[axis] = i < lattice->size[axis] - 2 ? i : lattice->size[axis] - 2;
        share[axis] = place[axis] - (float)cell[axis];
    }
    ptrdiff_t row = lattice->size[0], layer = row * lattice->size[1];
    const float *s = lattice->samples + (cell[2] * layer + cell[1] * row + cell[0]);
    float near_low = dpl_mesh_between(s[0], s[1], share[0]);
    float near_high = dpl_mesh_between(s[row], s[row + 1], share[0]);
    float far_low = dpl_mesh_between(s[layer], s[layer + 1], share[0]);
    float far_high = dpl_mesh_between(s[layer + row], s[layer + row + 1], share[0]);
    return dpl_mesh_between(dpl_mesh_between(near_low, near_high, share[1]),
                            dpl_mesh_between(far_low, far_high, share[1]), share[2]);
}

/* The point of the lattice nearest to a place; returns how far it is from there [spacing]. */
static inline float dpl_mesh_lattice_enter(const dpl_mesh_lattice *lattice, const float place[3],
                                           float inside[3]) {
    float square = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        float least = place[axis] > 0.0f ? place[axis] : 0.0f;
        inside[axis] = least < lattice->last[axis] ? least : lattice->last[axis];
        square += (place[axis] - inside[axis]) * (place[axis] - inside[axis]);
    }
    return square > 0.0f ? sqrtf(square) : 0.0f;
}

#endif
