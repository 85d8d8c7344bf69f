/* SPDX-License-Identifier: Apache-2.0
 *
 * Where the vertices of a placed primitive are: moved by morph targets, then by the joints of a
 * skin or by the node's matrix, all in double. A skin replaces the matrix of its node. Weights of
 * joints are divided by their sum.
 */
#include "gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* May coordinates be of this type? Whole numbers are an extension's. */
static bool is_place(const gltf *g, const gltf_accessor *a)
{
    return a->components == 3 &&
           (a->type == 5126 ? !a->normalized : g->is_quantized && a->type <= 5123);
}

bool gltf_open_places(gltf *g, const gltf_object *mesh, json_t *primitive, gltf_accessor *a)
{
    uint64_t index;
    if (!gltf_whole(g, mesh, json_object_get(primitive, "attributes"), "POSITION", GLTF_REQUIRED,
                    GLTF_MOST, &index) ||
        !gltf_open_accessor(g, index, a)) {
        return false;
    }
    if (24 * a->count > g->r->source->memory) {
        return gltf_refuse(g, &a->object, "has %llu elements, which do not fit into memory",
                           (unsigned long long)a->count);
    }
    return is_place(g, a) ||
           gltf_refuse(g, &a->object,
                       "is used for POSITION, allowed is VEC3 of componentType 5126, "
                       "or with KHR_mesh_quantization 5120 to 5123");
}

/* Is it a list of numbers? */
static bool are_weights(const json_t *weights)
{
    for (size_t i = 0; i < json_array_size(weights); i++) {
        if (!json_is_number(json_array_get(weights, i))) {
            return false;
        }
    }
    return json_is_array(weights);
}

static bool add_target(gltf *g, const gltf_object *mesh, json_t *target, double weight,
                       const gltf_primitive *p, double *places)
{
    gltf_accessor a;
    uint64_t index;
    if (!gltf_whole(g, mesh, target, "POSITION", GLTF_MOST, GLTF_MOST - 1, &index)) {
        return false;
    }
    if (index == GLTF_MOST || weight == 0.0) {
        return true;
    }
    if (!gltf_open_accessor(g, index, &a)) {
        return false;
    }
    if (a.components != 3 || a.count != p->vertex_count) {
        return gltf_refuse(g, &a.object,
                           "is used for a morph target, allowed is VEC3 and as many "
                           "as there are vertices");
    }
    double *moves = gltf_load_accessor(g, &a);
    for (size_t i = 0; moves != NULL && i < 3 * (size_t)p->vertex_count; i++) {
        places[i] += weight * moves[i];
    }
    free(moves);
    return moves != NULL;
}

static bool morph(gltf *g, const gltf_object *node, const gltf_object *mesh,
                  const gltf_primitive *p, double *places)
{
    bool fine;
    const json_t *targets = gltf_list(g, mesh, p->json, "targets", &fine);
    json_t *weights = json_object_get(node->json, "weights");
    weights = weights == NULL ? json_object_get(mesh->json, "weights") : weights;
    const size_t count = json_array_size(targets);
    if (!fine || count == 0 || weights == NULL) {
        return fine;
    }
    if (!are_weights(weights) || json_array_size(weights) != count) {
        return gltf_refuse(g, mesh, "has %zu morph targets, but not as many weights", count);
    }
    for (size_t i = 0; i < count && fine; i++) {
        fine = add_target(g, mesh, json_array_get(targets, i),
                          json_number_value(json_array_get(weights, i)), p, places);
    }
    return fine;
}

static bool multiply_joints(gltf *g, gltf_skin *s, const json_t *list, const double *inverse)
{
    for (size_t i = 0; i < s->count; i++) {
        const json_t *item = json_array_get(list, i);
        const json_int_t node = json_is_integer(item) ? json_integer_value(item) : -1;
        if (node < 0 || (uint64_t)node >= g->node_count || !g->reached[node]) {
            return gltf_refuse(g, &s->object, "has a joint that is not in the scene");
        }
        s->joints[i] = g->matrices[node];
        if (inverse != NULL) {
            const gltf_matrix bind = gltf_from_columns(inverse + 16 * i);
            s->joints[i] = gltf_product(&g->matrices[node], &bind);
        }
    }
    return true;
}

/* Fills the joints of a skin, once. */
static bool open_skin(gltf *g, uint64_t index)
{
    gltf_object object;
    gltf_accessor a;
    uint64_t inverse;
    bool fine;
    if (!gltf_find(g, "skins", index, &object)) {
        return false;
    }
    gltf_skin *s = &g->skins[index];
    if (s->joints != NULL) {
        return true;
    }
    s->object = object;
    if (!gltf_whole(g, &s->object, s->object.json, "inverseBindMatrices", GLTF_MOST, GLTF_MOST - 1,
                    &inverse)) {
        return false;
    }
    const json_t *list = gltf_list(g, &s->object, s->object.json, "joints", &fine);
    s->count = json_array_size(list);
    double *numbers = NULL;
    if (fine && inverse != GLTF_MOST) {
        fine = gltf_open_accessor(g, inverse, &a) &&
               ((a.components == 16 && a.type == 5126 && a.count >= s->count) ||
                gltf_refuse(g, &a.object,
                            "is used for a skin, allowed is MAT4 of componentType "
                            "5126, one for each joint")) &&
               (numbers = gltf_load_accessor(g, &a)) != NULL;
    }
    s->joints = fine ? malloc(s->count * sizeof *s->joints + 1) : NULL;
    fine = fine && (s->joints != NULL || mesh_refuse_memory(g->r)) &&
           multiply_joints(g, s, list, numbers);
    free(numbers);
    return fine;
}

/* Adds what a set of four joints and weights makes of the vertices. Where a primitive has no set of
 * this number, *there becomes false. */
static bool add_set(gltf *g, const gltf_object *mesh, const gltf_skin *s, const gltf_primitive *p,
                    int number, const double *places, double (*sums)[4], bool *there)
{
    json_t *attributes = json_object_get(p->json, "attributes");
    char joints_key[24], weights_key[24];
    snprintf(joints_key, sizeof joints_key, "JOINTS_%d", number);
    snprintf(weights_key, sizeof weights_key, "WEIGHTS_%d", number);
    *there = json_object_get(attributes, joints_key) != NULL;
    gltf_accessor of_joints, of_weights;
    uint64_t joints_index, weights_index;
    if (!*there) {
        return true;
    }
    if (!gltf_whole(g, mesh, attributes, joints_key, GLTF_REQUIRED, GLTF_MOST, &joints_index) ||
        !gltf_whole(g, mesh, attributes, weights_key, GLTF_REQUIRED, GLTF_MOST, &weights_index) ||
        !gltf_open_accessor(g, joints_index, &of_joints) ||
        !gltf_open_accessor(g, weights_index, &of_weights)) {
        return false;
    }
    if (of_joints.components != 4 || of_weights.components != 4 || of_joints.type == 5126 ||
        of_joints.count != p->vertex_count || of_weights.count != p->vertex_count) {
        return gltf_refuse(g, mesh, "has joints or weights that are not VEC4, one for each vertex");
    }
    double *joints = gltf_load_accessor(g, &of_joints);
    double *weights = joints == NULL ? NULL : gltf_load_accessor(g, &of_weights);
    bool fine = weights != NULL;
    for (size_t i = 0; i < 4 * (size_t)p->vertex_count && fine; i++) {
        double at[3];
        double *sum = sums[i / 4];
        if (weights[i] == 0.0) {
            continue;
        }
        if (!(joints[i] >= 0.0 && joints[i] < (double)s->count)) {
            fine = gltf_refuse(g, mesh, "refers to joint %.0f of %zu", joints[i], s->count);
            break;
        }
        gltf_apply(&s->joints[(size_t)joints[i]], &places[3 * (i / 4)], at);
        for (int k = 0; k < 3; k++) {
            sum[k] += weights[i] * at[k];
        }
        sum[3] += weights[i];
    }
    free(joints);
    free(weights);
    return fine;
}

static bool move_by_skin(gltf *g, const gltf_object *mesh, const gltf_skin *s,
                         const gltf_primitive *p, double *places)
{
    double(*sums)[4] = calloc((size_t)p->vertex_count + 1, sizeof *sums);
    bool there = true, fine = sums != NULL || mesh_refuse_memory(g->r);
    for (int number = 0; there && fine; number++) {
        fine = add_set(g, mesh, s, p, number, places, sums, &there);
    }
    for (size_t i = 0; i < p->vertex_count && fine; i++) {
        fine = sums[i][3] != 0.0 ||
               gltf_refuse(g, mesh, "has a skin, but vertex %zu has no weight", i);
        for (int k = 0; k < 3 && fine; k++) {
            places[3 * i + (size_t)k] = sums[i][k] / sums[i][3];
        }
    }
    free(sums);
    return fine;
}

static bool is_identity(const gltf_matrix *a)
{
    static const gltf_matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    return memcmp(a, &identity, sizeof identity) == 0;
}

bool gltf_place(gltf *g, const gltf_placed *placed, const gltf_primitive *p, double *places)
{
    gltf_object node, mesh;
    gltf_accessor a;
    uint64_t index;
    if (!gltf_find(g, "nodes", placed->node, &node) ||
        !gltf_find(g, "meshes", placed->mesh, &mesh) ||
        !gltf_whole(g, &node, node.json, "skin", GLTF_MOST, GLTF_MOST - 1, &index) ||
        !gltf_open_places(g, &mesh, p->json, &a) || !gltf_read_accessor(g, &a, places) ||
        !morph(g, &node, &mesh, p, places)) {
        return false;
    }
    if (index != GLTF_MOST) {
        return open_skin(g, index) && move_by_skin(g, &mesh, &g->skins[index], p, places);
    }
    const gltf_matrix *matrix = &g->matrices[placed->node];
    for (size_t i = 0; i < p->vertex_count && !is_identity(matrix); i++) {
        double at[3];
        gltf_apply(matrix, &places[3 * i], at);
        memcpy(&places[3 * i], at, sizeof at);
    }
    return true;
}
