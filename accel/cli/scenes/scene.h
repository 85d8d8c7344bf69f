/* SPDX-License-Identifier: Apache-2.0
 *
 * The scenes of the command: those of the catalogue, and mesh files.
 *
 * A SCENE is "name[:key=value[,key=value]...]" for a built-in one, which is one of `generators`, or
 * of `scene_makers` with a seed, or else the path of a mesh file.
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

#include "loaded.h"

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

/* Loads a mesh file. */
bool load_file(struct loaded *out, const char *path, load_progress *progress, void *user,
               accel_error *error);

#endif
