/* SPDX-License-Identifier: Apache-2.0
 *
 * assimp's doors to files. The mesh file itself is served from memory. Of other files only what a
 * glTF keeps beside itself is served: a regular file in the same folder, so that a hostile scene
 * cannot have other files read. Materials and pictures are not needed.
 */
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

/* An open file: bytes and a place in them. */
typedef struct door {
    struct aiFile file; /* what assimp sees; its UserData is this door */
    accel_file bytes;   /* owned if it is not the mesh file */
    size_t at;          /* of the next byte */
    bool owned;         /* bytes.bytes is freed on close */
} door;

static door *door_of(struct aiFile *file)
{
    return (door *)(void *)file->UserData;
}

static size_t door_read(struct aiFile *file, char *to, size_t size, size_t count)
{
    door *d = door_of(file);
    const size_t whole = size == 0 ? 0 : (d->bytes.size - d->at) / size;
    const size_t items = count < whole ? count : whole;
    memcpy(to, d->bytes.bytes + d->at, items * size);
    d->at += items * size;
    return items;
}

static size_t door_write(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t door_tell(struct aiFile *file)
{
    return door_of(file)->at;
}

static size_t door_size(struct aiFile *file)
{
    return door_of(file)->bytes.size;
}

static enum aiReturn door_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    door *d = door_of(file);
    const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? d->at : d->bytes.size;
    /* offsets back arrive as huge numbers: the sum wraps as it should */
    const size_t to = from + offset;
    if (to > d->bytes.size) {
        return aiReturn_FAILURE;
    }
    d->at = to;
    return aiReturn_SUCCESS;
}

static void door_flush(struct aiFile *file)
{
    (void)file;
}

static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

static bool is_gltf(const char *path)
{
    const size_t length = strlen(path);
    return length > 5 && strcmp(path + length - 5, ".gltf") == 0;
}

/* Is `path` a file in the folder of the glTF file `main`? */
static bool may_open(const char *main, const char *path)
{
    const size_t length = folder_length(main);
    return is_gltf(main) && strncmp(main, path, length) == 0 && strchr(path + length, '/') == NULL;
}

static bool open_bytes(door *d, const accel_file *main, const char *path)
{
    if (strcmp(path, main->path) == 0) {
        d->bytes = *main;
        return true;
    }
    accel_error error;
    d->owned = may_open(main->path, path) && accel_file_read(&d->bytes, path, &error);
    return d->owned;
}

struct aiFile *accel_file_open(struct aiFileIO *io, const char *path, const char *mode)
{
    door *d = strchr(mode, 'r') == NULL ? NULL : calloc(1, sizeof *d);
    const accel_mesh_file *mesh = (const accel_mesh_file *)(void *)io->UserData;
    if (d == NULL || !open_bytes(d, &mesh->file, path)) {
        free(d);
        return NULL;
    }
    d->file = (struct aiFile){.ReadProc = door_read,
                              .WriteProc = door_write,
                              .TellProc = door_tell,
                              .FileSizeProc = door_size,
                              .SeekProc = door_seek,
                              .FlushProc = door_flush,
                              .UserData = (char *)d};
    return &d->file;
}

void accel_file_close(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    door *d = door_of(file);
    if (d->owned) {
        free(d->bytes.bytes);
    }
    free(d);
}
