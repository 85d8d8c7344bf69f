/* SPDX-License-Identifier: Apache-2.0
 *
 * What runs in the child: assimp's C interface over bytes in memory, and the result to the pipe.
 * Only polygons are cut into triangles; nothing is joined, sorted, welded or dropped.
 */
#include "scene_file.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* A mesh at its place in the scene. */
typedef struct placed {
    const struct aiMesh *mesh;
    double to_scene[3][4]; /* the node's matrix */
} placed;

/* All of them, in order. */
typedef struct placed_list {
    placed *items;
    size_t count, capacity;
    uint64_t bytes; /* of the result so far */
    bool failed;    /* no memory */
} placed_list;

static void product(const double a[3][4], const struct aiMatrix4x4 *node, double out[3][4])
{
    const double b[4][4] = {
        {(double)node->a1, (double)node->a2, (double)node->a3, (double)node->a4},
        {(double)node->b1, (double)node->b2, (double)node->b3, (double)node->b4},
        {(double)node->c1, (double)node->c2, (double)node->c3, (double)node->c4},
        {0.0, 0.0, 0.0, 1.0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            out[i][j] =
                a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + a[i][3] * b[3][j];
        }
    }
}

static void place(placed_list *list, const placed *item)
{
    list->bytes += 24 * (uint64_t)item->mesh->mNumVertices + 12 * (uint64_t)item->mesh->mNumFaces;
    if (list->count == list->capacity) {
        list->capacity = 2 * list->capacity + 16;
        placed *block = realloc(list->items, list->capacity * sizeof *block);
        list->failed = list->failed || block == NULL;
        list->items = block == NULL ? list->items : block;
    }
    if (!list->failed) {
        list->items[list->count++] = *item;
    }
}

/* Depth first. A hostile depth ends the child alone. */
static void place_node(placed_list *list, const struct aiScene *scene, const struct aiNode *node,
                       const double parent[3][4])
{
    placed item;
    product(parent, &node->mTransformation, item.to_scene);
    for (unsigned i = 0; i < node->mNumMeshes && !list->failed; i++) {
        item.mesh = scene->mMeshes[node->mMeshes[i]];
        place(list, &item);
    }
    for (unsigned i = 0; i < node->mNumChildren && !list->failed; i++) {
        place_node(list, scene, node->mChildren[i], item.to_scene);
    }
}

static uint32_t count_triangles(const struct aiMesh *mesh)
{
    uint32_t triangles = 0;
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        triangles += mesh->mFaces[i].mNumIndices == 3;
    }
    return triangles;
}

static bool is_identity(const double m[3][4])
{
    static const double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    return memcmp(m, identity, sizeof identity) == 0;
}

static void send_vertices(FILE *pipe, const placed *item)
{
    const bool as_it_is = is_identity(item->to_scene);
    for (unsigned i = 0; i < item->mesh->mNumVertices; i++) {
        const struct aiVector3D *v = &item->mesh->mVertices[i];
        const double p[3] = {(double)v->x, (double)v->y, (double)v->z};
        double q[3];
        for (int k = 0; k < 3; k++) {
            const double *row = item->to_scene[k];
            q[k] = as_it_is ? p[k] : row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        }
        child_write(pipe, q, sizeof q);
    }
}

static void send_geometry(FILE *pipe, const placed *item)
{
    const struct file_head head = {item->mesh->mNumVertices, count_triangles(item->mesh)};
    child_write(pipe, &head, sizeof head);
    send_vertices(pipe, item);
    for (unsigned i = 0; i < item->mesh->mNumFaces; i++) {
        const struct aiFace *face = &item->mesh->mFaces[i];
        if (face->mNumIndices == 3) {
            child_write(pipe, face->mIndices, 3 * sizeof(uint32_t));
        }
    }
}

/* Counts what is no polygon: assimp leaves points and lines as they are. */
static uint64_t count_left_out(const placed_list *list)
{
    uint64_t left_out = 0;
    for (size_t i = 0; i < list->count; i++) {
        left_out += list->items[i].mesh->mNumFaces - count_triangles(list->items[i].mesh);
    }
    return left_out;
}

static void send_trouble(FILE *pipe, const char *trouble)
{
    struct file_verdict verdict = {{0}, 0, 0};
    snprintf(verdict.trouble, sizeof verdict.trouble, "%s", trouble);
    /* assimp quotes the file */
    for (char *c = verdict.trouble; *c != '\0'; c++) {
        *c = isprint((unsigned char)*c) ? *c : '?';
    }
    child_write(pipe, &verdict, sizeof verdict);
}

static void send_scene(FILE *pipe, const struct aiScene *scene, uint64_t most)
{
    char text[200];
    static const double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    placed_list list = {0};
    if (scene->mRootNode != NULL) {
        place_node(&list, scene, scene->mRootNode, identity);
    }
    if (list.failed || list.count >= UINT32_MAX) {
        send_trouble(pipe, "does not fit into memory");
        return;
    }
    if (list.bytes > most) {
        snprintf(text, sizeof text,
                 "shows %zu meshes, which take %llu MB of memory, but %llu MB are free: free some",
                 list.count, (unsigned long long)(list.bytes >> 20),
                 (unsigned long long)(most >> 20));
        send_trouble(pipe, text);
        return;
    }
    const struct file_verdict verdict = {"", count_left_out(&list), (uint32_t)list.count};
    child_write(pipe, &verdict, sizeof verdict);
    for (size_t i = 0; i < list.count; i++) {
        send_geometry(pipe, &list.items[i]);
    }
}

void file_import(void *user, FILE *pipe)
{
    struct import_file *import = user;
    struct aiFileIO io = {
        .OpenProc = file_open, .CloseProc = file_close, .UserData = (char *)import};
    const struct aiScene *scene = aiImportFileEx(import->file.path, aiProcess_Triangulate, &io);
    if (scene == NULL) {
        send_trouble(pipe, aiGetErrorString());
    } else {
        send_scene(pipe, scene, import->memory);
    }
}
