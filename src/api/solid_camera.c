/* What a camera sees of a mesh. Public; rays through a hierarchy. */
#include "base/desc.h"
#include "job/jobs.h"
#include "mesh/mesh.h"

#include <dapple/solid_shadow.h>
#include <math.h>

#define LARGEST_PICTURE 16384
#define FARTHEST_CAMERA 1e6f

/* A camera ready to shoot: the ray through pixel (x, y) runs along corner + x right + y down. */
typedef struct look {
    const dpl_mesh *mesh;
    const dpl_solid_camera *camera;
    float corner[3];
    float right[3];
    float down[3];
    float (*positions)[3];
    float (*normals)[3];
    int32_t *triangles;
} look;

static void cross(const float a[3], const float b[3], float result[3]) {
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        result[axis] = a[next] * b[last] - a[last] * b[next];
    }
}

static bool make_unit(float v[3]) {
    float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int axis = 0; axis < 3; axis++)
        v[axis] /= length;
    return length > 1e-12f && isfinite(length);
}

/* False when the camera looks nowhere or straight up. */
static bool aim(look *l) {
    const dpl_solid_camera *c = l->camera;
    float forward[3], side[3], below[3], half = tanf(0.5f * c->angle), pixel = 2.0f * half / (float)c->height;
    for (int axis = 0; axis < 3; axis++)
        forward[axis] = c->target[axis] - c->eye[axis];
    if (!make_unit(forward))
        return false;
    cross(forward, c->up, side);
    if (!make_unit(side))
        return false;
    cross(forward, side, below);
    for (int axis = 0; axis < 3; axis++) {
        l->right[axis] = pixel * side[axis];
        l->down[axis] = pixel * below[axis];
        l->corner[axis] = forward[axis] - 0.5f * (float)c->width * l->right[axis] - half * below[axis];
    }
    return true;
}

/* Of the triangle, towards where the ray comes from. */
static void normal_of(const dpl_mesh_corners corner, const float direction[3], float normal[3]) {
    float u[3], v[3];
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = corner[1][axis] - corner[0][axis];
        v[axis] = corner[2][axis] - corner[0][axis];
    }
    cross(u, v, normal);
    if (!make_unit(normal))
        memset(normal, 0, 3 * sizeof *normal);
    bool behind = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2] > 0.0f;
    for (int axis = 0; axis < 3 && behind; axis++)
        normal[axis] = -normal[axis];
}

static void see(const look *l, int32_t x, int32_t y) {
    size_t at = (size_t)y * (size_t)l->camera->width + (size_t)x;
    dpl_ray ray = {.far = INFINITY};
    dpl_hit hit = dpl_hit_none();
    dpl_walk_counts counts = {0};
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = l->camera->eye[axis];
        ray.direction[axis] =
            l->corner[axis] + ((float)x + 0.5f) * l->right[axis] + ((float)y + 0.5f) * l->down[axis];
    }
    dpl_triangles_closest(&l->mesh->triangles, &ray, &hit, &counts);
    l->triangles[at] = hit.object;
    for (int axis = 0; axis < 3; axis++) {
        l->positions[at][axis] = hit.object < 0 ? NAN : ray.origin[axis] + hit.t * ray.direction[axis];
        l->normals[at][axis] = 0.0f;
    }
    if (hit.object >= 0)
        normal_of(dpl_mesh_corners_of(l->mesh)[hit.object], ray.direction, l->normals[at]);
}

static void see_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    const look *l = task;
    (void)worker;
    for (int32_t y = begin; y < end; y++)
        for (int32_t x = 0; x < l->camera->width; x++)
            see(l, x, y);
}

static bool is_good_place(const float point[3]) {
    return fabsf(point[0]) <= FARTHEST_CAMERA && fabsf(point[1]) <= FARTHEST_CAMERA &&
           fabsf(point[2]) <= FARTHEST_CAMERA;
}

dpl_status dpl_solid_camera_look(const dpl_mesh *mesh, const dpl_solid_camera *camera, float (*positions)[3],
                                 float (*normals)[3], int32_t *triangles) {
    if (!mesh || !camera || !positions || !normals || !triangles)
        return DPL_ERROR_ARGUMENT;
    dpl_context *context = mesh->context;
    if (!DPL_DESC_IS_GOOD(camera))
        return dpl_fail(context, DPL_ERROR_DESC, "the camera was not made by dpl_solid_camera_default()");
    if (camera->width < 1 || camera->height < 1 || camera->width > LARGEST_PICTURE ||
        camera->height > LARGEST_PICTURE)
        return dpl_fail(context, DPL_ERROR_SIZE, "a camera's picture is 1 .. %d pixels a side, not %d x %d",
                        LARGEST_PICTURE, camera->width, camera->height);
    look l = {
        .mesh = mesh, .camera = camera, .positions = positions, .normals = normals, .triangles = triangles};
    bool good = is_good_place(camera->eye) && is_good_place(camera->target) && is_good_place(camera->up) &&
                camera->angle >= 0.001f && camera->angle <= 3.0f;
    if (!good)
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "a camera's places must be within 1e6, its angle within 0.001 .. 3 radians");
    if (!aim(&l))
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "a camera's target must be away from its eye, and not straight up or down");
    if (mesh->facts.triangles == 0)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the mesh has no triangles");
    return dpl_jobs_run(context, see_rows, camera->height, 1, &l);
}
