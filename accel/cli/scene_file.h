/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of the loader of files that assimp reads: the importer in the child, and what
 * it sends.
 */
#ifndef ACCEL_CLI_SCENE_FILE_H
#define ACCEL_CLI_SCENE_FILE_H

#include "child.h"
#include "file.h"

#include <accel/accel.h>
#include <assimp/cfileio.h>

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

/* A file for the child. */
typedef struct accel_import_file {
    accel_file file;
    uint64_t memory; /* bytes that the parent has for what it sends */
} accel_import_file;

/* The child's part; `user` is the accel_import_file. */
accel_child_work accel_file_import;

/* assimp's doors to files: the file in memory, and no other one. */
struct aiFile *accel_file_open(struct aiFileIO *io, const char *path, const char *mode);
void accel_file_close(struct aiFileIO *io, struct aiFile *file);

#endif
