/* The parts of shadows in space. Made by src/api/solid_shadow.c; solid_shadow.c runs the parts.
 *
 *     solid_frame.c    where the light's maps look
 *     solid_raster.c   depths of the nearest triangles
 *     solid_map.c      from depths to moments and to nearest and farthest depths of regions
 *     solid_moments.c  V by the map
 *     solid_march.c    V by the distances
 *     solid_cover.c    V by a few rays at once: refinement
 *     solid_rays.c     V by rays, one by one: the truth
 */
#ifndef DPL_SHADOW_SOLID_SHADOW_H
#define DPL_SHADOW_SOLID_SHADOW_H

#include "kernel/kernel.h"
#include "mesh/field.h"
#include "mesh/sample.h"
#include "shadow/moment_table.h"

#include <dapple/solid_shadow.h>

#define DPL_SOLID_MAX_FRAMES 6

/* A view from the light. Depth is the distance along its axis. */
typedef struct dpl_solid_frame {
    float eye[3];
    float axis[3][3]; /* right, down, forward */
    bool parallel;
    float scale; /* texels per tangent, or per scene unit where `parallel` */
    float near;  /* depths of the map: less is as near as this */
    float far;   /* nothing: beyond the mesh */
} dpl_solid_frame;

/* A point as a view sees it. */
typedef struct dpl_solid_place {
    float u; /* [texel], 0 .. size within the map */
    float v;
    float depth;
    float stretch; /* distance over depth: how much wider things look away from the middle of the view */
} dpl_solid_place;

/* Nearest and farthest depth in a region of a map; INFINITY where there is nothing. */
typedef struct dpl_solid_range {
    float near;
    float far;
} dpl_solid_range;

/* One map. Level k of `ranges` covers 2^k texels a side per entry; level 0 holds the depths. */
typedef struct dpl_solid_map {
    dpl_solid_frame frame;
    int32_t size;
    int32_t levels;
    dpl_moment_table table;
    dpl_solid_range *ranges[DPL_DEPTH_LEVELS];
    dpl_depth_view view; /* of what is above, for classification */
} dpl_solid_map;

/* A receiver and the light as it sees it: the disc is at p + t_light (toward + spread (a right + b up)) for
 * points (a, b) of the unit disc. */
typedef struct dpl_solid_receiver {
    float position[3];
    float normal[3]; /* zeros: none */
    float toward[3]; /* unit */
    float right[3];
    float up[3];
    float distance; /* to the light's middle; INFINITY for a directional light */
    float spread;   /* tangent of half the angle of the disc */
} dpl_solid_receiver;

/* Counted by each worker. */
typedef struct dpl_solid_counts {
    int64_t lit;
    int64_t dark;
    int64_t refined;
    int64_t steps;
    int64_t rays;
    dpl_walk_counts walk;
    int64_t unused[1]; /* fills a cache line with what is above */
} dpl_solid_counts;

struct dpl_solid_shadow {
    dpl_context *context;
    dpl_solid_shadow_desc desc;
    dpl_solid_light light; /* direction of length 1 */
    const dpl_mesh *mesh;  /* NULL: no light has been set */
    const dpl_mesh_field *field;
    dpl_mesh_lattice lattice;
    int32_t map_count;
    dpl_solid_map maps[DPL_SOLID_MAX_FRAMES];
    dpl_disc_points points; /* where rays of refinement end */
    bool exits_only;        /* the mesh is solid and the light is outside: its triangles' backs are enough */
    float longest;          /* side of the mesh's box [scene unit] */
    float surface_offset;   /* rays start this far above surfaces [scene unit] */
    float cone_cosine;      /* of a spot light's angle */
    float sun_spread;       /* tangent of a directional light's radius */
    dpl_buffer sums;        /* of all maps */
    dpl_buffer ranges;
    dpl_buffer corners; /* of triangles as the view sees them */
    dpl_buffer rows;    /* double[4] per texel of a row, per worker */
    dpl_buffer counts;  /* dpl_solid_counts per worker */
    int64_t receivers;
};

static inline float dpl_solid_dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Two directions across a unit vector and each other. */
void dpl_solid_across(const float forward[3], float right[3], float down[3]);

/* ---- the light's maps: solid_frame.c, solid_raster.c, solid_map.c --------------------------------- */

/* Says where the views look and how deep; returns how many there are. */
int32_t dpl_solid_frames(const dpl_solid_light *light, const dpl_mesh_facts *facts, int32_t size,
                         dpl_solid_frame frames[DPL_SOLID_MAX_FRAMES]);

/* Which of a light's maps a point belongs to. */
int32_t dpl_solid_map_of(const dpl_solid_shadow *shadow, const float point[3]);

/* The point in a frame's own axes. */
void dpl_solid_look(const dpl_solid_frame *frame, const float point[3], float seen[3]);

/* Depths of the nearest triangles, into level 0 of the map's ranges. */
DPL_MUST_CHECK dpl_status dpl_solid_rasterise(dpl_solid_shadow *shadow, const dpl_solid_map *map);

/* Memory that rasterising needs for each triangle [byte]. */
size_t dpl_solid_seen_bytes(void);

/* Builds all maps of the light that has been set. */
DPL_MUST_CHECK dpl_status dpl_solid_maps_build(dpl_solid_shadow *shadow);

/* Half the width of what lies between the receiver and the disc at a depth before it, in the middle of the
 * map [texel]; elsewhere it is up to `stretch` times as much. */
float dpl_solid_disc_at(const dpl_solid_map *map, const dpl_solid_receiver *r, float receiver_depth,
                        float depth);

/* ---- visibility ----------------------------------------------------------------------------------- */

/* A receiver that a map sees, and what classification knows of the depths around it. */
typedef struct dpl_solid_site {
    const dpl_solid_map *map;
    dpl_solid_place place;
    float slope; /* of the receiver's surface [depth/texel] */
    float near;  /* nearest depth of all that can be between receiver and disc */
} dpl_solid_site;

double dpl_solid_by_moments(const dpl_solid_receiver *r, const dpl_solid_site *site);

double dpl_solid_by_march(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, int64_t *steps);

/* Is something beside the receiver's own surface so near that samples of distance cannot tell? */
bool dpl_solid_is_contact(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r);

/* Rays end just before the light, at this share of the way. */
#define DPL_SOLID_BEFORE_LIGHT 0.9999f

/* Points of a disc, each turned by the golden angle from the one before (Vogel 1979): even for any number of
 * points, and no two alike. */
void dpl_solid_point_of_disc(int32_t i, int32_t count, float *a, float *b);
void dpl_solid_points_spread(dpl_disc_points *points, int32_t rays);

double dpl_solid_by_rays(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, int32_t rays,
                         dpl_walk_counts *counts);

/* Most receivers whose rays are asked for together. */
#define DPL_SOLID_GROUP 8

/* The same with the rays of refinement, all at once, for some receivers that should be near each other. */
void dpl_solid_by_cover(const dpl_solid_shadow *shadow, const dpl_solid_receiver *receivers, int32_t count,
                        double *visibility, dpl_walk_counts *counts);

/* The share of the disc that lies above the receiver's horizon. */
double dpl_solid_above_horizon(const dpl_solid_receiver *r);

/* The share of a disc on the positive side of a line, from the signed distance of the disc's middle from it
 * in radii. */
double dpl_solid_disc_share(double distance);

/* All of them: solid_shadow.c. */
DPL_MUST_CHECK dpl_status dpl_solid_shadow_solve(dpl_solid_shadow *shadow, const float (*positions)[3],
                                                 const float (*normals)[3], int64_t count, float *visibility);

#endif
