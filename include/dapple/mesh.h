/** @file
 * Meshes: triangles in space, and the signed distance to them on a grid. What casts the shadows of
 * solid_shadow.h.
 *
 * Coordinates are scene units, right-handed, and up to the caller. What a mesh encloses is found per
 * connected part: closed and consistently oriented parts by counting signed crossings, closed parts whose
 * triangles face anyhow by parity, and open ones by their winding number.
 */
#ifndef DAPPLE_MESH_H
#define DAPPLE_MESH_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Most triangles in a mesh. */
#define DPL_MAX_MESH_TRIANGLES (1 << 26)

/** Farthest coordinate of a corner [scene unit]. */
#define DPL_MAX_MESH_COORDINATE 1e9f

/** Finest grid of distances [sample per side]. */
#define DPL_MAX_MESH_RESOLUTION 512

/** Triangles. Start from dpl_mesh_desc_default(). */
typedef struct dpl_mesh_desc {
    uint32_t struct_size;        /**< stamped by the default function */
    uint32_t cookie;             /**< stamped by the default function */
    const float (*vertices)[3];  /**< corners, shape [vertex_count][3], finite, within 1e9 */
    int32_t vertex_count;        /**< >= 0 */
    const int32_t (*indices)[3]; /**< numbers of corners, shape [triangle_count][3] */
    int32_t triangle_count;      /**< 1 .. DPL_MAX_MESH_TRIANGLES, at least one of them with an area */
} dpl_mesh_desc;

/** Defaults of a mesh: none; vertices and indices must be set. */
static inline dpl_mesh_desc dpl_mesh_desc_default(void) {
    dpl_mesh_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    return desc;
}

/** What a mesh turned out to be. */
typedef struct dpl_mesh_facts {
    int32_t triangles;        /**< as given */
    int32_t degenerate;       /**< of them without an area: they cast no shadow */
    int32_t corners;          /**< at different places */
    int32_t parts;            /**< connected by shared corners */
    int32_t closed_parts;     /**< every edge runs as often one way as the other */
    int32_t unoriented_parts; /**< every edge an even number of times, but not closed as above */
    int32_t open_parts;       /**< the rest */
    float low[3];             /**< of all corners in use [scene unit] */
    float high[3];            /**< of all corners in use [scene unit] */
} dpl_mesh_facts;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_mesh dpl_mesh;

/**
 * Makes a mesh of copies of these triangles, sorted into a hierarchy of boxes.
 * @param context the context, must outlive the mesh
 * @param desc    from dpl_mesh_desc_default()
 * @param mesh    receives the mesh, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _MEMORY; _SIZE for counts out of range; _ARGUMENT naming the corner that is
 * not finite or the triangle that names a corner there is not, or when no triangle has an area
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_mesh_create(dpl_context *context, const dpl_mesh_desc *desc,
                                                  dpl_mesh **mesh);

/**
 * Replaces the triangles. As many triangles as before, moved, are cheap and allocate nothing.
 * On failure the mesh is without triangles, and whatever uses it fails until it is set again.
 * @return as dpl_mesh_create()
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_mesh_set(dpl_mesh *mesh, const dpl_mesh_desc *desc);

/** Frees a mesh. NULL is fine. */
DPL_API void dpl_mesh_destroy(dpl_mesh *mesh);

/** What the mesh is. */
DPL_API void dpl_mesh_read_facts(const dpl_mesh *mesh, dpl_mesh_facts *facts);

/** A grid of signed distances. Start from dpl_mesh_field_desc_default(). */
typedef struct dpl_mesh_field_desc {
    uint32_t struct_size; /**< stamped by the default function */
    uint32_t cookie;      /**< stamped by the default function */
    int32_t resolution;   /**< samples along the longest side, 8 .. DPL_MAX_MESH_RESOLUTION, default 128 */
    int32_t margin;       /**< of them beyond the mesh on each side, 1 .. resolution / 4, default 2 */
    int32_t band;         /**< spacings from a triangle within which it is surely the nearest one that is
                               measured, 1 .. 8, default 2; farther out the nearest is found by sweeping */
} dpl_mesh_field_desc;

/** Defaults of a grid: 128 samples along the longest side, margin 2, band 2. */
static inline dpl_mesh_field_desc dpl_mesh_field_desc_default(void) {
    dpl_mesh_field_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.resolution = 128;
    desc.margin = 2;
    desc.band = 2;
    return desc;
}

/** Where the samples of a grid are: sample (i, j, k) at origin + spacing * (i, j, k). */
typedef struct dpl_mesh_grid {
    int32_t size[3]; /**< samples along x, y, z */
    float origin[3]; /**< of the first sample [scene unit] */
    float spacing;   /**< [scene unit] */
} dpl_mesh_grid;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_mesh_field dpl_mesh_field;

/**
 * Makes a grid that holds nothing yet.
 * @param context the context, must outlive the field
 * @param desc    from dpl_mesh_field_desc_default()
 * @param field   receives the field, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_mesh_field_create(dpl_context *context, const dpl_mesh_field_desc *desc,
                                                        dpl_mesh_field **field);

/**
 * Measures the distances to a mesh, in parallel: positive outside, negative inside. The same bytes for every
 * number of threads. Allocates only when a grid is larger than ever before. On failure the field holds
 * nothing.
 * @return DPL_OK; DPL_ERROR_ARGUMENT when the mesh has no triangles, _MEMORY
 * Sources: closest triangles by sweeping: Zhao 2005, Danielsson 1980; inside: Jacobson et al. 2013 and, in
 * fast, Barill et al. 2018. docs/algorithms/mesh-distance.md.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_mesh_field_measure(dpl_mesh_field *field, const dpl_mesh *mesh);

/** Frees a field. NULL is fine. */
DPL_API void dpl_mesh_field_destroy(dpl_mesh_field *field);

/** Where the samples are; zeros before the first dpl_mesh_field_measure(). */
DPL_API dpl_mesh_grid dpl_mesh_field_grid(const dpl_mesh_field *field);

/**
 * The samples.
 * @return shape [size[2]][size[1]][size[0]] [scene unit], valid until the next dpl_mesh_field_measure(); NULL
 * before the first
 */
DPL_API const float *dpl_mesh_field_samples(const dpl_mesh_field *field);

/**
 * The distance at a point, interpolated between samples; outside the grid that of the nearest point of the
 * grid plus the way there. The field must have been measured.
 * @param point [scene unit]
 * @return [scene unit]. Thread-safe while nobody measures.
 */
DPL_API float dpl_mesh_field_distance(const dpl_mesh_field *field, const float point[3]);

#ifdef __cplusplus
}
#endif
#endif
