/* SPDX-License-Identifier: Apache-2.0
 *
 * A scene in memory that owns its arrays, what can be asked of any accel_scene, and growing arrays
 * that end as geometries.
 *
 * Running out of memory is remembered in the growing array, so that generators need no check of
 * their own until loaded_add hands the array over.
 */
#ifndef CATALOGUE_LOADED_H
#define CATALOGUE_LOADED_H

#include "accel/accel.h"

/* A scene in memory. Starts as zero, ended by unload_scene. */
struct loaded {
    accel_scene scene;          /* for accel_build; borrows from `geometries` */
    accel_geometry *geometries; /* scene.count of them; their arrays, and of objects what `user`
                                   points to, are owned as well */
    uint64_t left_out;          /* points and lines of a mesh file */
    char note[300];             /* what else a mesh file holds that is not in the scene, or empty */
};

/* Frees its arrays. */
void unload_scene(struct loaded *loaded);

/* How many primitives a geometry has. */
uint32_t geometry_primitives(const accel_geometry *geometry);

/* All primitives of all geometries. */
uint64_t scene_primitives(const accel_scene *scene);

/* The box of all coordinates that are in the library's range. Returns false where an axis has none,
 * and 0..1 for it. */
bool scene_box(const accel_scene *scene, accel_box *box);

/* Vertex `corner` of triangle `prim`. */
void scene_vertex(const accel_triangles *mesh, uint32_t prim, int corner, double out[3]);

/* Centre and radius of sphere `prim`. */
const double *scene_sphere(const accel_spheres *spheres, uint32_t prim);

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

#endif
