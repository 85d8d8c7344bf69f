/* SPDX-License-Identifier: Apache-2.0
 *
 * Between the parts of the loader of files that assimp reads: the importer in the child, and what
 * it sends.
 */
#ifndef ACCEL_CLI_SCENE_FILE_H
#define ACCEL_CLI_SCENE_FILE_H

#include "tool/child.h"
#include "tool/file.h"

#include <accel/accel.h>
#include <assimp/cfileio.h>

/* What the child says first. */
struct file_verdict {
    char trouble[240];   /* why nothing follows, or empty */
    uint64_t left_out;   /* points and lines */
    uint32_t geometries; /* that follow */
};

/* What goes before the vertices (three doubles) and triangles (three uint32_t) of a geometry. */
struct file_head {
    uint32_t vertices, triangles;
};

/* A file for the child. */
struct import_file {
    struct file file;
    uint64_t memory; /* bytes that the parent has for what it sends */
};

/* The child's part; `user` is the struct import_file. */
child_work file_import;

/* assimp's streams: the file in memory, and no other one. */
struct aiFile *file_open(struct aiFileIO *io, const char *path, const char *mode);
void file_close(struct aiFileIO *io, struct aiFile *file);

#endif
