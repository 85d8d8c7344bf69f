/* SPDX-License-Identifier: Apache-2.0
 *
 * The primitives of a mesh: triangles, strips and fans become triangles; points and lines are
 * counted.
 */
#include "gltf.h"

#include <stdlib.h>
#include <string.h>

/* What a primitive is made of. */
enum { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN };

/* Corners of a primitive: by a list, or each vertex once. */
typedef struct corners {
    double *indices; /* or NULL */
    uint64_t count;
    double restart; /* an index that must not be there */
} corners;

static uint32_t corner(const corners *c, uint64_t i)
{
    return c->indices == NULL ? (uint32_t)i : (uint32_t)c->indices[i];
}

static bool check_corners(gltf *g, const gltf_object *mesh, const corners *c, uint32_t vertices)
{
    for (uint64_t i = 0; i < c->count && c->indices != NULL; i++) {
        if (!(c->indices[i] < (double)vertices) || c->indices[i] == c->restart) {
            return gltf_refuse(g, mesh, "has a primitive that refers to vertex %.0f of %lu",
                               c->indices[i], (unsigned long)vertices);
        }
    }
    return true;
}

static bool load_corners(gltf *g, const gltf_object *mesh, const gltf_primitive *p, corners *c)
{
    gltf_accessor a;
    uint64_t index;
    *c = (corners){NULL, p->vertex_count, -1.0};
    if (!gltf_whole(g, mesh, p->json, "indices", GLTF_MOST, GLTF_MOST - 1, &index)) {
        return false;
    }
    if (index == GLTF_MOST) {
        return true;
    }
    if (!gltf_open_accessor(g, index, &a)) {
        return false;
    }
    if (a.components != 1 || a.normalized || (a.type != 5121 && a.type != 5123 && a.type != 5125)) {
        return gltf_refuse(g, &a.object,
                           "is used for indices, allowed is SCALAR of componentType "
                           "5121, 5123 or 5125");
    }
    c->indices = gltf_load_accessor(g, &a);
    c->count = a.count;
    c->restart = a.type == 5121 ? 255.0 : a.type == 5123 ? 65535.0 : 4294967295.0;
    return c->indices != NULL && check_corners(g, mesh, c, p->vertex_count);
}

/* Points and lines of a primitive without triangles. */
static uint64_t count_left_out(uint64_t mode, uint64_t corners)
{
    return mode == POINTS || mode == LINE_LOOP ? corners
           : mode == LINES                     ? (corners + 1) / 2
                                               : (corners == 0 ? 0 : corners - 1);
}

static void write_triangles(uint64_t mode, const corners *c, gltf_primitive *p)
{
    for (uint64_t i = 0; i < p->triangle_count; i++) {
        uint32_t *to = p->triangles + 3 * i;
        const uint64_t odd = i & 1;
        const uint64_t first = mode == TRIANGLES ? 3 * i : mode == TRIANGLE_STRIP ? i : 0;
        const uint64_t second = mode == TRIANGLES        ? first + 1
                                : mode == TRIANGLE_STRIP ? i + 1 + odd
                                                         : i + 1;
        const uint64_t third = mode == TRIANGLES        ? first + 2
                               : mode == TRIANGLE_STRIP ? i + 2 - odd
                                                        : i + 2;
        to[0] = corner(c, first);
        to[1] = corner(c, second);
        to[2] = corner(c, third);
    }
}

static bool make_triangles(gltf *g, const gltf_object *mesh, const corners *c, gltf_primitive *p,
                           uint64_t *left_out)
{
    uint64_t mode;
    if (!gltf_whole(g, mesh, p->json, "mode", TRIANGLES, TRIANGLE_FAN, &mode)) {
        return false;
    }
    if (mode < TRIANGLES) {
        *left_out += count_left_out(mode, c->count);
        return true;
    }
    if (mode == TRIANGLES ? c->count % 3 != 0 : c->count == 1 || c->count == 2) {
        return gltf_refuse(g, mesh, "has a primitive of %llu corners, which are no triangles",
                           (unsigned long long)c->count);
    }
    p->triangle_count = (uint32_t)(mode == TRIANGLES ? c->count / 3
                                   : c->count == 0   ? 0
                                                     : c->count - 2);
    p->triangles = malloc(3 * (size_t)p->triangle_count * sizeof *p->triangles + 1);
    if (p->triangles == NULL) {
        return mesh_refuse_memory(g->r);
    }
    write_triangles(mode, c, p);
    return true;
}

/* Reads a primitive. One without triangles has none, and its points and lines are counted. */
static bool read_primitive(gltf *g, const gltf_object *mesh, gltf_primitive *p, uint64_t *left_out)
{
    corners c = {0};
    gltf_accessor places;
    if (!json_is_object(p->json)) {
        return gltf_refuse(g, mesh, "has a primitive that is no object");
    }
    if (!gltf_open_places(g, mesh, p->json, &places)) {
        return false;
    }
    p->vertex_count = (uint32_t)places.count;
    const bool fine = load_corners(g, mesh, p, &c) && make_triangles(g, mesh, &c, p, left_out);
    free(c.indices);
    return fine;
}

/* What it takes where it is placed: no more vertices than it uses. */
static uint64_t placed_bytes(const gltf_primitive *p)
{
    const uint64_t corners = 3 * (uint64_t)p->triangle_count;
    return 24 * (corners < p->vertex_count ? corners : p->vertex_count) + 4 * corners;
}

/* Keeps it where it has triangles. */
static bool add_primitive(gltf *g, gltf_mesh *mesh, const gltf_primitive *p)
{
    if (p->triangle_count == 0) {
        free(p->triangles);
        return true;
    }
    mesh->primitives[mesh->count++] = *p;
    mesh->triangles += p->triangle_count;
    mesh->bytes += placed_bytes(p);
    g->bytes += 12 * (uint64_t)p->triangle_count;
    return g->bytes <= g->r->source->memory || mesh_refuse_memory(g->r);
}

static bool read_primitives(gltf *g, const gltf_object *object, json_t *list, gltf_mesh *mesh)
{
    mesh->primitives = calloc(json_array_size(list), sizeof *mesh->primitives);
    if (mesh->primitives == NULL) {
        return mesh_refuse_memory(g->r);
    }
    for (size_t i = 0; i < json_array_size(list); i++) {
        gltf_primitive p = {.json = json_array_get(list, i)};
        if (!read_primitive(g, object, &p, &mesh->left_out)) {
            free(p.triangles);
            return false;
        }
        if (!add_primitive(g, mesh, &p)) {
            return false;
        }
    }
    mesh->read = true;
    return true;
}

const gltf_mesh *gltf_read_mesh(gltf *g, size_t index)
{
    gltf_object object;
    bool fine;
    if (!gltf_find(g, "meshes", index, &object)) {
        return NULL;
    }
    gltf_mesh *mesh = &g->meshes[index];
    if (mesh->read) {
        return mesh;
    }
    json_t *list = gltf_list(g, &object, object.json, "primitives", &fine);
    if (fine && json_array_size(list) == 0) {
        fine = gltf_refuse(g, &object, "has no primitives");
    }
    return fine && read_primitives(g, &object, list, mesh) ? mesh : NULL;
}
