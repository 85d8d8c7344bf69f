/* SPDX-License-Identifier: Apache-2.0
 *
 * Mesh files, hardened: the file is opened once and must be regular, and its size is capped. OBJ,
 * PLY, STL, OFF and glTF have strict readers of their own; for other formats assimp runs in a child
 * process whose every number is checked again before it is used.
 */
#include "scene_file.h"

#include "tool/memory.h"
#include "mesh/mesh.h"
#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Bytes that importing a file may take: text formats hold a number in two bytes, and the importers
 * keep about a hundred bytes for each. */
static uint64_t memory_for(size_t file_bytes)
{
    return ((uint64_t)1 << 30) + 100 * (uint64_t)file_bytes;
}

/* Processor seconds: a fixed minute, and a pace that the slowest importer keeps tenfold. */
static unsigned seconds_for(size_t file_bytes)
{
    return 60 + (unsigned)(file_bytes / 200000);
}

static bool indices_are_fine(const struct growing *mesh)
{
    for (size_t i = 0; i < mesh->index_count; i++) {
        if (mesh->indices[i] >= mesh->number_count / 3) {
            return false;
        }
    }
    return true;
}

/* Takes one geometry from the child. Returns NULL, or what is wrong. */
static const char *receive_geometry(struct child *child, struct loaded *out)
{
    struct file_head head;
    if (!child_read(child, &head, sizeof head)) {
        return "its reader ended early";
    }
    struct growing mesh = {.number_count = 3 * (size_t)head.vertices,
                           .index_count = 3 * (size_t)head.triangles};
    mesh.numbers = malloc(mesh.number_count * sizeof *mesh.numbers + 1);
    mesh.indices = malloc(mesh.index_count * sizeof *mesh.indices + 1);
    const char *trouble = NULL;
    if (mesh.numbers == NULL || mesh.indices == NULL) {
        trouble = "does not fit into memory";
    } else if (!child_read(child, mesh.numbers, mesh.number_count * sizeof *mesh.numbers) ||
               !child_read(child, mesh.indices, mesh.index_count * sizeof *mesh.indices)) {
        trouble = "its reader ended early";
    } else if (!indices_are_fine(&mesh)) {
        trouble = "a face refers to a vertex that is not there";
    }
    if (trouble == NULL && mesh.index_count == 0) {
        free(mesh.numbers);
        free(mesh.indices);
        return NULL;
    }
    mesh.failed = trouble != NULL;
    if (!loaded_add(out, ACCEL_TRIANGLES, &mesh) && trouble == NULL) {
        trouble = "does not fit into memory";
    }
    return trouble;
}

static const char *receive(struct child *child, struct loaded *out, struct file_verdict *verdict)
{
    if (!child_read(child, verdict, sizeof *verdict)) {
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
    return trouble == NULL && scene_primitives(&out->scene) == 0 ? "holds no triangle" : trouble;
}

static bool import(struct loaded *out, const struct file *file, load_progress *progress, void *user,
                   accel_error *error)
{
    struct child child;
    struct import_file import = {*file, memory_free()};
    const struct child_limits limits = {memory_for(file->size), seconds_for(file->size)};
    if (!child_start(&child, limits, file_import, &import)) {
        return file_fail(file->path, "no process for its reader", error);
    }
    child.tick = progress;
    child.user = user;
    struct file_verdict verdict;
    const char *trouble = receive(&child, out, &verdict);
    const char *end = child_end(&child);
    /* a child that died explains more than the bytes that are missing */
    trouble = trouble != NULL && end != NULL ? end : trouble;
    snprintf(out->note, sizeof out->note,
             "is read by assimp, unchecked, with coordinates as float");
    return trouble == NULL || file_fail(file->path, trouble, error);
}

/* What the readers of this command are given beside the bytes. */
typedef struct reading {
    const char *path; /* of the mesh file */
    load_progress *progress;
    void *user;
} reading;

static void show_reading(void *user, const char *phase)
{
    const reading *r = user;
    if (r->progress != NULL) {
        r->progress(r->user, phase);
    }
}

/* Reads a file in the folder of the mesh file. */
static bool read_beside(void *user, struct file *file, const char *name, accel_error *error)
{
    const char *path = ((const reading *)user)->path;
    const char *slash = strrchr(path, '/');
    const size_t folder = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    const size_t capacity = folder + strlen(name) + 1;
    char *other = malloc(capacity);
    if (other == NULL) {
        return file_fail(path, "does not fit into memory", error);
    }
    snprintf(other, capacity, "%.*s%s", (int)folder, path, name);
    const bool fine = file_read(file, other, error);
    free(other);
    return fine;
}

static bool read_mesh(struct loaded *out, const struct file *file, load_progress *progress,
                      void *user, accel_error *error)
{
    reading reading = {file->path, progress, user};
    const struct mesh_source source = {.name = file->path,
                                       .bytes = file->bytes,
                                       .size = file->size,
                                       .memory = memory_free(),
                                       .beside = read_beside,
                                       .progress = show_reading,
                                       .user = &reading};
    return mesh_load(out, &source, error);
}

bool load_file(struct loaded *out, const char *path, load_progress *progress, void *user,
               accel_error *error)
{
    struct file file;
    if (!file_read(&file, path, error)) {
        return false;
    }
    const bool own = mesh_recognise(path, file.bytes, file.size) != MESH_OTHER;
    const bool fine = (own ? read_mesh : import)(out, &file, progress, user, error);
    if (!fine) {
        unload_scene(out);
    }
    free(file.bytes);
    return fine;
}
