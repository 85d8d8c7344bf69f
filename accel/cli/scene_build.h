/* SPDX-License-Identifier: Apache-2.0
 *
 * What the loaders and generators of scenes share: growing arrays that end as geometries.
 *
 * Running out of memory is remembered in the array, so that generators need no check of their own
 * until accel_loaded_add hands the array over.
 */
#ifndef ACCEL_CLI_SCENE_BUILD_H
#define ACCEL_CLI_SCENE_BUILD_H

#include "scene.h"

/* A mesh or a set of spheres under construction. Starts as zero. */
typedef struct accel_growing {
    double *numbers;     /* x, y, z of vertices, or x, y, z, radius of spheres */
    size_t number_count; /* numbers in use */
    size_t number_room;  /* numbers allocated */
    uint32_t *indices;   /* three for each triangle */
    size_t index_count;  /* indices in use */
    size_t index_room;   /* indices allocated */
    bool failed;         /* no memory, or more than 2^32 - 2 vertices or primitives */
} accel_growing;

/* Adds a vertex and returns its index. */
uint32_t accel_grow_vertex(accel_growing *mesh, double x, double y, double z);

/* Adds a triangle over three vertices. */
void accel_grow_triangle(accel_growing *mesh, uint32_t a, uint32_t b, uint32_t c);

/* Adds a sphere. */
void accel_grow_sphere(accel_growing *spheres, double x, double y, double z, double radius);

/* Hands the arrays of *grown to *out as one more geometry and leaves *grown at zero. Returns false
 * and frees them where memory ran out. */
bool accel_loaded_add(accel_loaded *out, accel_type type, accel_growing *grown);

/* Generates a scene from the values of its options, in the order of its table. Returns false when
 * memory runs out. */
typedef bool accel_generate(accel_loaded *out, const double *values);

/* One built-in scene. */
typedef struct accel_generator {
    accel_kind_info info;     /* what accel_scene_kinds shows */
    accel_generate *generate; /* makes it */
} accel_generator;

extern const accel_generator accel_generator_cubes, accel_generator_teapots,
    accel_generator_stadium, accel_generator_soup, accel_generator_spheres, accel_generator_nested,
    accel_generator_same, accel_generator_one, accel_generator_empty;

/* Loads a mesh file: see scene.h. */
bool accel_load_file(accel_loaded *out, const char *path, accel_load_progress *progress, void *user,
                     accel_error *error);

#endif
