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

#include "file.h"
#include "scene.h"

/* Reads the file `name` from the folder of the mesh file. Otherwise fills error->text. */
typedef bool accel_mesh_beside(void *user, accel_file *file, const char *name, accel_error *error);

/* A mesh file in memory. */
typedef struct accel_mesh_source {
    const char *name;              /* of the file; its ending decides where the bytes do not */
    const char *bytes;             /* `size` of them */
    size_t size;                   /* at least one */
    uint64_t memory;               /* bytes that the vertices and triangles may take */
    accel_mesh_beside *beside;     /* for the buffers of a glTF; NULL: there are no other files */
    accel_load_progress *progress; /* may be NULL */
    void *user;                    /* handed to beside and progress */
} accel_mesh_source;

/* What a file holds, by its first bytes; by its name where they leave it open. */
typedef enum accel_mesh_format {
    ACCEL_MESH_OTHER,
    ACCEL_MESH_OBJ,
    ACCEL_MESH_PLY,
    ACCEL_MESH_STL,
    ACCEL_MESH_OFF,
    ACCEL_MESH_GLTF
} accel_mesh_format;

accel_mesh_format accel_mesh_recognise(const char *name, const char *bytes, size_t size);

/* Reads a mesh of any format but ACCEL_MESH_OTHER into *out, which must be zero. Otherwise fills
 * error->text with one line; *out then may hold a part, to be freed by accel_unload_scene. */
bool accel_mesh_read(accel_loaded *out, const accel_mesh_source *source, accel_error *error);

#endif
