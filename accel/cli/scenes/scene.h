/* SPDX-License-Identifier: Apache-2.0
 *
 * The scenes of the command, the tests and the reports: mesh files and built-in generators.
 *
 * A SCENE is "name[:key=value[,key=value]...]" for a built-in one, where the name is one of
 * scene_kinds, or else the path of a mesh file.
 *
 * Mesh files: OBJ, PLY, STL, OFF and glTF are read strictly (see mesh/mesh.h), the other formats by
 * assimp, unchecked. A geometry is what PLY and OFF hold, a solid of STL, an object or group of
 * OBJ, and of formats with nodes a mesh that a node refers to, nodes depth first. Triangles and
 * vertices keep the file's order; polygons are cut into triangles in place; points and lines are
 * left out and counted. Coordinates of text are the nearest doubles, those of binary files keep
 * their value; assimp reads them as float. The matrices of nodes are applied in double. A file
 * needs no more memory than is free; of what a glTF shows many times that is told before.
 */
#ifndef ACCEL_CLI_SCENE_H
#define ACCEL_CLI_SCENE_H

#include <accel/accel.h>

/* A scene in memory. Ended by unload_scene. */
struct loaded {
    accel_scene scene;          /* for accel_build; borrows from `geometries` */
    accel_geometry *geometries; /* scene.count of them; their arrays are owned as well */
    uint64_t left_out;          /* points and lines of a mesh file */
    char note[300];             /* what else a mesh file holds that is not in the scene, or empty */
};

/* Called about ten times a second while a file is read; may be NULL. */
typedef void load_progress(void *user, const char *phase);

/* Loads or generates `name`. Returns true and fills *out; otherwise returns false, fills
 * error->text with one line and holds nothing. The same name gives the same scene, bit for bit. */
bool load_scene(struct loaded *out, const char *name, load_progress *progress, void *user,
                accel_error *error);

/* Says whether `name` means a built-in scene, all of its options in range, or a file that can be
 * read: for commands that take many scenes, before the first is measured. Loading may still fail.
 * Otherwise fills error->text with one line. */
bool scene_understood(const char *name, accel_error *error);

/* Frees what load_scene made. */
void unload_scene(struct loaded *loaded);

/* The built-in scenes, `*count` of them: the table that the parser uses. */
const accel_kind_info *const *scene_kinds(size_t *count);

/* All primitives of all geometries. */
uint64_t scene_primitives(const accel_scene *scene);

/* The box of all finite triangles and spheres. Returns false, and the box of the unit cube, where
 * there is none. */
bool scene_box(const accel_scene *scene, accel_box *box);

/* Vertex `corner` of triangle `prim`. */
void scene_vertex(const accel_triangles *mesh, uint32_t prim, int corner, double out[3]);

/* Centre and radius of sphere `prim`. */
const double *scene_sphere(const accel_spheres *spheres, uint32_t prim);

#endif
