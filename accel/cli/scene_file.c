/* SPDX-License-Identifier: Apache-2.0
 *
 * Mesh files, hardened: the file is opened once and must be regular, its size is capped, what its
 * header promises is compared with the bytes that are there, and the importer runs in a child
 * process whose every number is checked again before it is used.
 */
#include "scene_file.h"
#include "scene_build.h"

#include <stdlib.h>

/* Bytes that importing a file may take: text formats hold a number in two bytes, and the importers
 * keep about a hundred bytes for each. */
uint64_t accel_file_memory(size_t file_bytes)
{
    return ((uint64_t)1 << 30) + 100 * (uint64_t)file_bytes;
}

/* Processor seconds: a fixed minute, and a pace that the slowest importer keeps tenfold. */
static unsigned seconds_for(size_t file_bytes)
{
    return 60 + (unsigned)(file_bytes / 200000);
}

static bool indices_are_fine(const accel_growing *mesh)
{
    for (size_t i = 0; i < mesh->index_count; i++) {
        if (mesh->indices[i] >= mesh->number_count / 3) {
            return false;
        }
    }
    return true;
}

/* Takes one geometry from the child. Returns NULL, or what is wrong. */
static const char *receive_geometry(accel_child *child, accel_loaded *out)
{
    accel_file_head head;
    if (!accel_child_read(child, &head, sizeof head)) {
        return "its reader ended early";
    }
    accel_growing mesh = {.number_count = 3 * (size_t)head.vertices,
                          .index_count = 3 * (size_t)head.triangles};
    mesh.numbers = malloc(mesh.number_count * sizeof *mesh.numbers + 1);
    mesh.indices = malloc(mesh.index_count * sizeof *mesh.indices + 1);
    const char *trouble = NULL;
    if (mesh.numbers == NULL || mesh.indices == NULL) {
        trouble = "does not fit into memory";
    } else if (!accel_child_read(child, mesh.numbers, mesh.number_count * sizeof *mesh.numbers) ||
               !accel_child_read(child, mesh.indices, mesh.index_count * sizeof *mesh.indices)) {
        trouble = "its reader ended early";
    } else if (!indices_are_fine(&mesh)) {
        trouble = "a face refers to a vertex that is not there";
    }
    mesh.failed = trouble != NULL;
    if (!accel_loaded_add(out, ACCEL_TRIANGLES, &mesh) && trouble == NULL) {
        trouble = "does not fit into memory";
    }
    return trouble;
}

static const char *receive(accel_child *child, accel_loaded *out, accel_file_verdict *verdict)
{
    if (!accel_child_read(child, verdict, sizeof *verdict)) {
        return "its reader ended early";
    }
    verdict->trouble[sizeof verdict->trouble - 1] = '\0';
    if (verdict->trouble[0] != '\0') {
        return verdict->trouble;
    }
    const char *trouble = NULL;
    for (uint32_t g = 0; g < verdict->geometries && trouble == NULL; g++) {
        trouble = receive_geometry(child, out);
    }
    out->left_out = verdict->left_out;
    return trouble == NULL && accel_scene_primitives(&out->scene) == 0 ? "holds no triangle"
                                                                       : trouble;
}

static bool import(accel_loaded *out, accel_mesh_file *mesh, accel_load_progress *progress,
                   void *user, accel_error *error)
{
    accel_child child;
    const accel_child_limits limits = {accel_file_memory(mesh->file.size),
                                       seconds_for(mesh->file.size)};
    if (!accel_child_start(&child, limits, accel_file_import, mesh)) {
        return accel_file_fail(mesh->file.path, "no process for its reader", error);
    }
    child.tick = progress;
    child.user = user;
    accel_file_verdict verdict;
    const char *trouble = receive(&child, out, &verdict);
    const char *end = accel_child_end(&child);
    /* a child that died explains more than the bytes that are missing */
    trouble = trouble != NULL && end != NULL ? end : trouble;
    return trouble == NULL || accel_file_fail(mesh->file.path, trouble, error);
}

bool accel_load_file(accel_loaded *out, const char *path, accel_load_progress *progress, void *user,
                     accel_error *error)
{
    accel_mesh_file mesh = {0};
    if (!accel_file_read(&mesh.file, path, error)) {
        return false;
    }
    char text[200];
    const char *trouble = accel_file_counts(&mesh, text);
    const bool fine = trouble == NULL ? import(out, &mesh, progress, user, error)
                                      : accel_file_fail(path, trouble, error);
    if (!fine) {
        accel_unload_scene(out);
    }
    free(mesh.file.bytes);
    return fine;
}
