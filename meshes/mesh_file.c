/* Reads mesh files through Assimp's C API, see mesh_file.h. */
#include "mesh_file.h"

#include "../image/file.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest mesh file [byte]. */
#define FILE_LIMIT ((size_t)1 << 30)

/* Deepest tree of nodes in a file. */
#define MOST_DEPTH 256

/* Farthest corner. */
#define FARTHEST ((double)DPL_MAX_MESH_COORDINATE)

bool dpl_mesh_file_is_built_in(void) {
    return true;
}

/* A transform of the file put behind another: the product of both. */
static dpl_mesh_transform behind(const dpl_mesh_transform *outer, const struct aiMatrix4x4 *m) {
    const double turn[3][3] = {{(double)m->a1, (double)m->a2, (double)m->a3},
                               {(double)m->b1, (double)m->b2, (double)m->b3},
                               {(double)m->c1, (double)m->c2, (double)m->c3}};
    const double move[3] = {(double)m->a4, (double)m->b4, (double)m->c4};
    dpl_mesh_transform t = {.move = {0}};
    for (int row = 0; row < 3; row++) {
        t.move[row] = outer->move[row];
        for (int k = 0; k < 3; k++) {
            t.move[row] += outer->turn[row][k] * move[k];
            for (int column = 0; column < 3; column++)
                t.turn[row][column] += outer->turn[row][k] * turn[k][column];
        }
    }
    return t;
}

static bool is_within(const float point[3]) {
    for (int axis = 0; axis < 3; axis++)
        if (!(fabs((double)point[axis]) <= FARTHEST))
            return false;
    return true;
}

static bool add_mesh(const struct aiMesh *mesh, const dpl_mesh_transform *transform, dpl_mesh_data *data,
                     dpl_error *error) {
    if (!dpl_mesh_data_reserve(data, mesh->mNumVertices, mesh->mNumFaces, error))
        return false;
    int32_t first = data->vertex_count;
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *v = &mesh->mVertices[i];
        int32_t at = dpl_mesh_data_add_vertex(data, transform, (double)v->x, (double)v->y, (double)v->z);
        if (!is_within(data->vertices[at]))
            return dpl_error_set(error, "corner %d is not finite or beyond 1e9", (int)(at - first));
    }
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        for (unsigned k = 0; k < face->mNumIndices; k++)
            if (face->mIndices[k] >= mesh->mNumVertices)
                return dpl_error_set(error, "a triangle names a corner that is not there");
        if (face->mNumIndices == 3)
            dpl_mesh_data_add_triangle(data, first + (int32_t)face->mIndices[0],
                                       first + (int32_t)face->mIndices[1],
                                       first + (int32_t)face->mIndices[2]);
    }
    return true;
}

static bool add_node(const struct aiScene *scene, const struct aiNode *node, const dpl_mesh_transform *outer,
                     int depth, dpl_mesh_data *data, dpl_error *error) {
    if (depth > MOST_DEPTH)
        return dpl_error_set(error, "more than %d nodes inside each other", MOST_DEPTH);
    dpl_mesh_transform transform = behind(outer, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (!add_mesh(scene->mMeshes[node->mMeshes[i]], &transform, data, error))
            return false;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!add_node(scene, node->mChildren[i], &transform, depth + 1, data, error))
            return false;
    return true;
}

/* Assimp reads a great many formats; three are promised, and others stay closed. */
static bool is_known(const char *path) {
    static const char *const endings[] = {".gltf", ".glb", ".obj", ".ply"};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof endings / sizeof endings[0]; i++) {
        size_t k = 0;
        while (endings[i][k] && tolower((unsigned char)dot[k]) == endings[i][k])
            k++;
        if (endings[i][k] == dot[k])
            return true;
    }
    return false;
}

/* Files that cannot be opened are told apart from those that cannot be understood. */
static bool can_open(const char *path, dpl_error *error) {
    char *bytes;
    size_t size;
    if (!is_known(path))
        return dpl_error_set(error, "%s: is no mesh file; those end in .gltf, .glb, .obj or .ply", path);
    if (!dpl_file_read(path, FILE_LIMIT, &bytes, &size, error))
        return false;
    free(bytes);
    return true;
}

bool dpl_mesh_file_read(const char *path, const dpl_mesh_transform *transform, dpl_mesh_data *data,
                        dpl_error *error) {
    dpl_error what;
    if (!can_open(path, error))
        return false;
    const struct aiScene *scene =
        aiImportFile(path, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure);
    if (!scene)
        return dpl_error_set(error, "%s: %s", path, aiGetErrorString());
    int32_t before = data->triangle_count;
    bool good = true;
    if (scene->mRootNode)
        good = add_node(scene, scene->mRootNode, transform, 0, data, &what);
    aiReleaseImport(scene);
    if (!good)
        return dpl_error_set(error, "%s: %s", path, what.text);
    return data->triangle_count > before || dpl_error_set(error, "%s: has no triangles", path);
}
