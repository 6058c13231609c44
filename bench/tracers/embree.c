/* Embree 3 through its C API. Called by solid.c. */
#include "embree.h"

#include <embree3/rtcore.h>
#include <stdlib.h>
#include <string.h>

struct dpl_bench_embree {
    RTCDevice device;
    RTCScene scene;
};

#define TEXT_OF(number) #number
#define VERSION(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

const char *dpl_bench_embree_version(void) {
    return VERSION(RTC_VERSION_MAJOR, RTC_VERSION_MINOR, RTC_VERSION_PATCH);
}

/* Copies the mesh into a geometry and that into the scene. */
static bool fill(dpl_bench_embree *e, const dpl_bench_mesh *mesh) {
    RTCGeometry geometry = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!geometry)
        return false;
    size_t vertices = (size_t)mesh->vertex_count, triangles = (size_t)mesh->count;
    void *to_vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                sizeof *mesh->vertices, vertices);
    void *to_indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                               sizeof *mesh->indices, triangles);
    bool good = to_vertices && to_indices;
    if (good) {
        memcpy(to_vertices, mesh->vertices, vertices * sizeof *mesh->vertices);
        memcpy(to_indices, mesh->indices, triangles * sizeof *mesh->indices);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(e->scene, geometry);
        rtcCommitScene(e->scene);
        good = rtcGetDeviceError(e->device) == RTC_ERROR_NONE;
    }
    rtcReleaseGeometry(geometry);
    return good;
}

dpl_bench_embree *dpl_bench_embree_build(const dpl_bench_mesh *mesh, dpl_error *error) {
    dpl_bench_embree *e = calloc(1, sizeof *e);
    if (e)
        e->device = rtcNewDevice("threads=1");
    if (e && e->device)
        e->scene = rtcNewScene(e->device);
    if (e && e->scene && fill(e, mesh))
        return e;
    dpl_bench_embree_free(e);
    dpl_error_set(error, "Embree could not build");
    return NULL;
}

void dpl_bench_embree_free(dpl_bench_embree *e) {
    if (!e)
        return;
    if (e->scene)
        rtcReleaseScene(e->scene);
    if (e->device)
        rtcReleaseDevice(e->device);
    free(e);
}

static struct RTCRay ray_of(const dpl_ray *ray) {
    return (struct RTCRay){
        .org_x = ray->origin[0],
        .org_y = ray->origin[1],
        .org_z = ray->origin[2],
        .tnear = ray->near,
        .dir_x = ray->direction[0],
        .dir_y = ray->direction[1],
        .dir_z = ray->direction[2],
        .tfar = ray->far,
        .mask = ~0u,
    };
}

void dpl_bench_embree_closest(dpl_bench_embree *e, const dpl_ray *rays, int64_t count, dpl_hit *hits) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int64_t i = 0; i < count; i++) {
        struct RTCRayHit found = {.ray = ray_of(&rays[i]), .hit.geomID = RTC_INVALID_GEOMETRY_ID};
        rtcIntersect1(e->scene, &context, &found);
        bool hit = found.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        hits[i] = hit ? (dpl_hit){found.ray.tfar, (int32_t)found.hit.primID, found.hit.u, found.hit.v}
                      : dpl_hit_none();
    }
}

void dpl_bench_embree_occluded(dpl_bench_embree *e, const dpl_ray *rays, int64_t count, uint8_t *occluded) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int64_t i = 0; i < count; i++) {
        struct RTCRay ray = ray_of(&rays[i]);
        rtcOccluded1(e->scene, &context, &ray);
        occluded[i] = ray.tfar < 0.0f;
    }
}

void dpl_bench_embree_occluded_16(dpl_bench_embree *e, const dpl_ray rays[16], uint8_t occluded[16]) {
    struct RTCIntersectContext context;
    struct RTCRay16 packet;
    _Alignas(64) int valid[16];
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int i = 0; i < 16; i++) {
        const dpl_ray *ray = &rays[i];
        valid[i] = -1;
        packet.org_x[i] = ray->origin[0];
        packet.org_y[i] = ray->origin[1];
        packet.org_z[i] = ray->origin[2];
        packet.tnear[i] = ray->near;
        packet.dir_x[i] = ray->direction[0];
        packet.dir_y[i] = ray->direction[1];
        packet.dir_z[i] = ray->direction[2];
        packet.time[i] = 0.0f;
        packet.tfar[i] = ray->far;
        packet.mask[i] = ~0u;
        packet.id[i] = packet.flags[i] = 0;
    }
    rtcOccluded16(valid, e->scene, &context, &packet);
    for (int i = 0; i < 16; i++)
        occluded[i] = packet.tfar[i] < 0.0f;
}
