/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of the mesh file loader: the checks of what a header promises, the importer in
 * the child, and what it sends.
 */
#ifndef ACCEL_CLI_SCENE_FILE_H
#define ACCEL_CLI_SCENE_FILE_H

#include "child.h"
#include "file.h"

#include <accel/accel.h>
#include <assimp/cfileio.h>

/* Bytes that importing a file of this size may take. */
uint64_t accel_file_memory(size_t file_bytes);

/* A mesh file and what is known of it before it is imported. */
typedef struct accel_mesh_file {
    accel_file file;
    uint64_t faces; /* that its header promises; 0 where it promises none */
} accel_mesh_file;

/* Compares what the headers of PLY, OFF and STL files promise with the bytes that are there, and
 * removes comments from OFF files. Returns NULL where nothing is wrong or the format has no counts;
 * otherwise what is wrong. `text` is room for it. */
const char *accel_file_counts(accel_mesh_file *mesh, char text[200]);

/* What the child says first. */
typedef struct accel_file_verdict {
    char trouble[240];   /* why nothing follows, or empty */
    uint64_t left_out;   /* points and lines */
    uint32_t geometries; /* that follow */
} accel_file_verdict;

/* What goes before the vertices (three doubles) and triangles (three uint32_t) of a geometry. */
typedef struct accel_file_head {
    uint32_t vertices, triangles;
} accel_file_head;

/* The child's part; `user` is the accel_mesh_file. */
accel_child_work accel_file_import;

/* assimp's doors to files: the file in memory, and the buffers of a glTF beside it. */
struct aiFile *accel_file_open(struct aiFileIO *io, const char *path, const char *mode);
void accel_file_close(struct aiFileIO *io, struct aiFile *file);

#endif
