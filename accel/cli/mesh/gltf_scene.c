/* SPDX-License-Identifier: Apache-2.0
 *
 * The nodes of the scene, depth first, and their matrices to it, which are multiplied in double.
 * Rotations are brought to unit length. The walk keeps its own stack: nodes may lie deep.
 */
#include "gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const gltf_matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

gltf_matrix gltf_product(const gltf_matrix *a, const gltf_matrix *b)
{
    gltf_matrix out;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            out.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                          a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0.0);
        }
    }
    return out;
}

void gltf_apply(const gltf_matrix *a, const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a->m[i][0] * p[0] + a->m[i][1] * p[1] + a->m[i][2] * p[2] + a->m[i][3];
    }
}

gltf_matrix gltf_from_columns(const double columns[16])
{
    gltf_matrix out;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            out.m[i][j] = columns[4 * j + i];
        }
    }
    return out;
}

/* Translation, rotation by a unit quaternion and scale, the last one first. */
static gltf_matrix from_parts(const double t[3], const double q[4], const double s[3])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return (gltf_matrix){{{s[0] * (1 - 2 * (y * y + z * z)), s[1] * 2 * (x * y - z * w),
                           s[2] * 2 * (x * z + y * w), t[0]},
                          {s[0] * 2 * (x * y + z * w), s[1] * (1 - 2 * (x * x + z * z)),
                           s[2] * 2 * (y * z - x * w), t[1]},
                          {s[0] * 2 * (x * z - y * w), s[1] * 2 * (y * z + x * w),
                           s[2] * (1 - 2 * (x * x + y * y)), t[2]}}};
}

/* The matrix from the node to its parent. */
static bool own_matrix(gltf *g, const gltf_object *node, gltf_matrix *own)
{
    double columns[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    bool whole, moved, turned, scaled;
    if (!gltf_numbers(g, node, "matrix", 16, columns, &whole) ||
        !gltf_numbers(g, node, "translation", 3, t, &moved) ||
        !gltf_numbers(g, node, "rotation", 4, q, &turned) ||
        !gltf_numbers(g, node, "scale", 3, s, &scaled)) {
        return false;
    }
    if (whole) {
        *own = gltf_from_columns(columns);
        const bool affine =
            columns[3] == 0.0 && columns[7] == 0.0 && columns[11] == 0.0 && columns[15] == 1.0;
        return affine || gltf_refuse(g, node, "has a matrix whose last row is not 0 0 0 1");
    }
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0.0 && isfinite(length))) {
        return gltf_refuse(g, node, "has a rotation of length %g", length);
    }
    for (int k = 0; k < 4; k++) {
        q[k] /= length;
    }
    *own = moved || turned || scaled ? from_parts(t, q, s) : identity;
    return true;
}

static bool place(gltf *g, size_t node, size_t mesh)
{
    if (g->placed_count == g->placed_room) {
        const size_t capacity = 2 * g->placed_room + 16;
        gltf_placed *placed = realloc(g->placed, capacity * sizeof *placed);
        if (placed == NULL) {
            return mesh_refuse_memory(g->r);
        }
        g->placed = placed;
        g->placed_room = capacity;
    }
    g->placed[g->placed_count++] = (gltf_placed){node, mesh};
    return true;
}

/* Nodes that are still to be visited, the next one last. */
typedef struct stack {
    struct {
        size_t node, parent;
    } * items;
    size_t count;
} stack;

/* Puts children on the stack in reverse order. All together they are not more than the nodes, or
 * one is met twice. */
static bool push(gltf *g, const gltf_object *object, const char *key, size_t parent, stack *s)
{
    bool fine;
    const json_t *list = gltf_list(g, object, object->json, key, &fine);
    for (size_t i = json_array_size(list); i > 0 && fine; i--) {
        const json_t *item = json_array_get(list, i - 1);
        const json_int_t node = json_is_integer(item) ? json_integer_value(item) : -1;
        if (node < 0 || (uint64_t)node >= g->node_count) {
            return gltf_refuse(g, object, "has a node in %s that is not there", key);
        }
        if (g->reached[node]) {
            return mesh_refuse(g->r, "nodes[%lld] is there twice in the scene, allowed is a tree",
                               (long long)node);
        }
        g->reached[node] = true;
        s->items[s->count].node = (size_t)node;
        s->items[s->count++].parent = parent;
    }
    return fine;
}

static bool visit(gltf *g, size_t index, size_t parent, stack *s)
{
    gltf_object node;
    gltf_matrix own;
    uint64_t mesh;
    if (!gltf_find(g, "nodes", index, &node) || !own_matrix(g, &node, &own) ||
        !gltf_whole(g, &node, node.json, "mesh", GLTF_MOST, GLTF_MOST - 1, &mesh)) {
        return false;
    }
    g->matrices[index] = parent == SIZE_MAX ? own : gltf_product(&g->matrices[parent], &own);
    return (mesh == GLTF_MOST || place(g, index, (size_t)mesh)) &&
           push(g, &node, "children", index, s);
}

static bool walk_from(gltf *g, const gltf_object *scene, stack *s)
{
    bool fine = push(g, scene, "nodes", SIZE_MAX, s);
    while (fine && s->count > 0) {
        s->count--;
        fine = visit(g, s->items[s->count].node, s->items[s->count].parent, s);
    }
    return fine;
}

bool gltf_walk(gltf *g)
{
    gltf_object scene;
    const gltf_object root = {g->root, "glTF", 0};
    uint64_t index;
    if (gltf_count(g, "scenes") == 0) {
        return mesh_refuse(g->r, "has no scene, so that nothing of it is shown");
    }
    if (!gltf_whole(g, &root, g->root, "scene", 0, GLTF_MOST, &index) ||
        !gltf_find(g, "scenes", index, &scene)) {
        return false;
    }
    g->node_count = gltf_count(g, "nodes");
    g->matrices = malloc(g->node_count * sizeof *g->matrices + 1);
    g->reached = calloc(g->node_count + 1, sizeof *g->reached);
    stack s = {malloc(g->node_count * sizeof *s.items + 1), 0};
    const bool fine = (g->matrices != NULL && g->reached != NULL && s.items != NULL)
                          ? walk_from(g, &scene, &s)
                          : mesh_refuse_memory(g->r);
    free(s.items);
    return fine;
}
