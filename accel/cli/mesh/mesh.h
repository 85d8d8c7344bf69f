/* SPDX-License-Identifier: Apache-2.0
 *
 * Mesh files that are read strictly: OBJ, PLY, STL, OFF and glTF 2.0, from bytes in memory.
 *
 * Either the mesh that the file holds comes out, or one line that says where the file is wrong,
 * what was found and what is allowed: nothing is guessed, joined, sorted, welded or dropped, but
 * for points and lines, which are counted. Numbers of text become the nearest double, whatever the
 * locale; those of binary files keep their value. Time and memory are bounded by the file's size,
 * but for glTF, whose meshes can be placed many times, and which `memory` bounds.
 */
#ifndef ACCEL_CLI_MESH_MESH_H
#define ACCEL_CLI_MESH_MESH_H

#include "tool/file.h"
#include "scenes/scene.h"

/* Reads the file `name` from the folder of the mesh file. Otherwise fills error->text. */
typedef bool mesh_beside(void *user, struct file *file, const char *name, accel_error *error);

/* A mesh file in memory. */
struct mesh_source {
    const char *name;        /* of the file; its ending decides where the bytes do not */
    const char *bytes;       /* `size` of them */
    size_t size;             /* at least one */
    uint64_t memory;         /* bytes that the vertices and triangles may take */
    mesh_beside *beside;     /* for the buffers of a glTF; NULL: there are no other files */
    load_progress *progress; /* may be NULL */
    void *user;              /* handed to beside and progress */
};

/* What a file holds, by its first bytes; by its name where they leave it open. */
enum mesh_format { MESH_OTHER, MESH_OBJ, MESH_PLY, MESH_STL, MESH_OFF, MESH_GLTF };

enum mesh_format mesh_recognise(const char *name, const char *bytes, size_t size);

/* Reads a mesh of any format but MESH_OTHER into *out, which must be zero. Otherwise fills
 * error->text with one line; *out then may hold a part, to be freed by unload_scene. */
bool mesh_load(struct loaded *out, const struct mesh_source *source, accel_error *error);

#endif
