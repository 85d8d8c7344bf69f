/* SPDX-License-Identifier: Apache-2.0
 *
 * What the loaders and generators of scenes share: growing arrays that end as geometries.
 *
 * Running out of memory is remembered in the array, so that generators need no check of their own
 * until loaded_add hands the array over.
 */
#ifndef ACCEL_CLI_SCENE_BUILD_H
#define ACCEL_CLI_SCENE_BUILD_H

#include "scene.h"

/* A mesh or a set of spheres under construction. Starts as zero. */
struct growing {
    double *numbers;     /* x, y, z of vertices, or x, y, z, radius of spheres */
    size_t number_count; /* numbers in use */
    size_t number_room;  /* numbers allocated */
    uint32_t *indices;   /* three for each triangle */
    size_t index_count;  /* indices in use */
    size_t index_room;   /* indices allocated */
    bool failed;         /* no memory, or more than 2^32 - 2 vertices or primitives */
};

/* Adds a vertex and returns its index. */
uint32_t grow_vertex(struct growing *mesh, double x, double y, double z);

/* Adds a triangle over three vertices. */
void grow_triangle(struct growing *mesh, uint32_t a, uint32_t b, uint32_t c);

/* Adds a sphere. */
void grow_sphere(struct growing *spheres, double x, double y, double z, double radius);

/* Hands the arrays of *grown to *out as one more geometry and leaves *grown at zero. Returns false
 * and frees them where memory ran out. */
bool loaded_add(struct loaded *out, accel_type type, struct growing *grown);

/* Generates a scene from the values of its options, in the order of its table. Returns false when
 * memory runs out. */
typedef bool generate_scene(struct loaded *out, const double *values);

/* One built-in scene. */
struct generator {
    accel_kind_info info;     /* what scene_kinds shows */
    generate_scene *generate; /* makes it */
};

extern const struct generator generator_cubes, generator_teapots, generator_stadium, generator_soup,
    generator_spheres, generator_nested, generator_same, generator_one, generator_empty;

/* Loads a mesh file: see scene.h. */
bool load_file(struct loaded *out, const char *path, load_progress *progress, void *user,
               accel_error *error);

#endif
