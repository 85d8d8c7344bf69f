/* SPDX-License-Identifier: Apache-2.0
 *
 * Growing arrays that end as geometries, and what can be asked of any scene.
 */
#include "loaded.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

/* Makes room for `more` elements behind `count`. Returns NULL if it cannot, leaving *room alone. */
static void *make_room(void *block, size_t count, size_t more, size_t size, size_t *capacity)
{
    if (count + more <= *capacity) {
        return block;
    }
    const size_t wanted = (count + more) * 2;
    void *grown = accel_memory_system(NULL, block, *capacity * size, wanted * size);
    *capacity = grown != NULL ? wanted : *capacity;
    return grown;
}

static void grow_numbers(struct growing *grown, const double *numbers, size_t count)
{
    if (grown->failed) {
        return;
    }
    double *block =
        make_room(grown->numbers, grown->number_count, count, sizeof *block, &grown->number_room);
    if (block == NULL || (grown->number_count + count) / count > UINT32_MAX - 1) {
        grown->failed = true;
        grown->numbers = block == NULL ? grown->numbers : block;
        return;
    }
    memcpy(block + grown->number_count, numbers, count * sizeof *numbers);
    grown->numbers = block;
    grown->number_count += count;
}

uint32_t grow_vertex(struct growing *mesh, double x, double y, double z)
{
    grow_numbers(mesh, (const double[3]){x, y, z}, 3);
    return (uint32_t)(mesh->number_count / 3 - 1);
}

void grow_sphere(struct growing *spheres, double x, double y, double z, double radius)
{
    grow_numbers(spheres, (const double[4]){x, y, z, radius}, 4);
}

void grow_triangle(struct growing *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    if (mesh->failed) {
        return;
    }
    uint32_t *block =
        make_room(mesh->indices, mesh->index_count, 3, sizeof *block, &mesh->index_room);
    if (block == NULL || mesh->index_count / 3 >= UINT32_MAX - 1) {
        mesh->failed = true;
        mesh->indices = block == NULL ? mesh->indices : block;
        return;
    }
    const uint32_t triangle[3] = {a, b, c};
    memcpy(block + mesh->index_count, triangle, sizeof triangle);
    mesh->indices = block;
    mesh->index_count += 3;
}

static accel_geometry as_geometry(accel_type type, const struct growing *grown)
{
    accel_geometry geometry = {.type = type};
    if (type == ACCEL_TRIANGLES) {
        geometry.triangles = (accel_triangles){.vertices = grown->numbers,
                                               .vertex_count = (uint32_t)(grown->number_count / 3),
                                               .indices = grown->indices,
                                               .count = (uint32_t)(grown->index_count / 3)};
    } else {
        geometry.spheres = (accel_spheres){.spheres = grown->numbers,
                                           .count = (uint32_t)(grown->number_count / 4)};
    }
    return geometry;
}

bool loaded_add(struct loaded *out, accel_type type, struct growing *grown)
{
    const size_t count = out->scene.count;
    accel_geometry *block =
        grown->failed ? NULL : realloc(out->geometries, (count + 1) * sizeof *block);
    if (block == NULL) {
        free(grown->numbers);
        free(grown->indices);
    } else {
        block[count] = as_geometry(type, grown);
        out->geometries = block;
        out->scene.geometries = block;
        out->scene.count++;
    }
    *grown = (struct growing){0};
    return block != NULL;
}

void unload_scene(struct loaded *loaded)
{
    for (uint32_t g = 0; g < loaded->scene.count; g++) {
        const accel_geometry *geometry = &loaded->geometries[g];
        if (geometry->type == ACCEL_TRIANGLES) {
            free((void *)geometry->triangles.vertices);
            free((void *)geometry->triangles.indices);
        } else if (geometry->type == ACCEL_SPHERES) {
            free((void *)geometry->spheres.spheres);
        } else {
            free((void *)geometry->objects.boxes);
            free(geometry->objects.user);
        }
    }
    free(loaded->geometries);
    *loaded = (struct loaded){0};
}

uint32_t geometry_primitives(const accel_geometry *geometry)
{
    return geometry->type == ACCEL_TRIANGLES ? geometry->triangles.count
           : geometry->type == ACCEL_SPHERES ? geometry->spheres.count
                                             : geometry->objects.count;
}

uint64_t scene_primitives(const accel_scene *scene)
{
    uint64_t total = 0;
    for (uint32_t g = 0; g < scene->count; g++) {
        total += geometry_primitives(&scene->geometries[g]);
    }
    return total;
}

void scene_vertex(const accel_triangles *mesh, uint32_t prim, int corner, double out[3])
{
    const size_t size = mesh->vertices_are_float ? sizeof(float) : sizeof(double);
    const size_t stride = mesh->vertex_stride == 0 ? 3 * size : mesh->vertex_stride;
    const uint32_t index = mesh->indices[3 * (size_t)prim + (size_t)corner];
    const char *at = (const char *)mesh->vertices + index * stride;
    for (int k = 0; k < 3; k++) {
        float narrow;
        if (mesh->vertices_are_float) {
            memcpy(&narrow, at + (size_t)k * size, size);
            out[k] = (double)narrow;
        } else {
            memcpy(&out[k], at + (size_t)k * size, size);
        }
    }
}

const double *scene_sphere(const accel_spheres *spheres, uint32_t prim)
{
    const size_t stride = spheres->stride == 0 ? 4 * sizeof(double) : spheres->stride;
    return (const double *)(const void *)((const char *)spheres->spheres + prim * stride);
}

/* Each coordinate for itself. */
static void box_add(accel_box *box, const double point[3], double radius)
{
    for (int k = 0; k < 3; k++) {
        if (fabs(point[k]) <= ACCEL_MAX_COORDINATE && radius <= ACCEL_MAX_COORDINATE) {
            box->lo[k] = fmin(box->lo[k], point[k] - radius);
            box->hi[k] = fmax(box->hi[k], point[k] + radius);
        }
    }
}

static void box_add_primitive(accel_box *box, const accel_geometry *geometry, uint32_t i)
{
    if (geometry->type == ACCEL_TRIANGLES) {
        for (int corner = 0; corner < 3; corner++) {
            double vertex[3];
            scene_vertex(&geometry->triangles, i, corner, vertex);
            box_add(box, vertex, 0.0);
        }
    } else if (geometry->type == ACCEL_SPHERES) {
        const double *sphere = scene_sphere(&geometry->spheres, i);
        box_add(box, sphere, fabs(sphere[3]));
    } else {
        box_add(box, geometry->objects.boxes[i].lo, 0.0);
        box_add(box, geometry->objects.boxes[i].hi, 0.0);
    }
}

bool scene_box(const accel_scene *scene, accel_box *box)
{
    const double inf = (double)INFINITY;
    *box = (accel_box){{inf, inf, inf}, {-inf, -inf, -inf}};
    for (uint32_t g = 0; g < scene->count; g++) {
        const uint32_t count = geometry_primitives(&scene->geometries[g]);
        for (uint32_t i = 0; i < count; i++) {
            box_add_primitive(box, &scene->geometries[g], i);
        }
    }
    bool whole = true;
    for (int k = 0; k < 3; k++) {
        if (!(box->lo[k] <= box->hi[k])) {
            box->lo[k] = 0.0;
            box->hi[k] = 1.0;
            whole = false;
        }
    }
    return whole;
}
