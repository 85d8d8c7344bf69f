/* SPDX-License-Identifier: Apache-2.0
 *
 * assimp's streams. The mesh file itself is served from memory, and no other one, so that a
 * hostile scene cannot have other files read. Materials and pictures are not needed.
 */
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

/* An open file: bytes and a place in them. */
typedef struct stream {
    struct aiFile file; /* what assimp sees; its UserData is this stream */
    struct file bytes;  /* of the mesh file */
    size_t at;          /* of the next byte */
} stream;

static stream *stream_of(struct aiFile *file)
{
    return (stream *)(void *)file->UserData;
}

static size_t stream_read(struct aiFile *file, char *to, size_t size, size_t count)
{
    stream *d = stream_of(file);
    const size_t whole = size == 0 ? 0 : (d->bytes.size - d->at) / size;
    const size_t items = count < whole ? count : whole;
    memcpy(to, d->bytes.bytes + d->at, items * size);
    d->at += items * size;
    return items;
}

static size_t stream_write(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t stream_tell(struct aiFile *file)
{
    return stream_of(file)->at;
}

static size_t stream_size(struct aiFile *file)
{
    return stream_of(file)->bytes.size;
}

static enum aiReturn stream_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    stream *d = stream_of(file);
    const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? d->at : d->bytes.size;
    /* offsets back arrive as huge numbers: the sum wraps as it should */
    const size_t to = from + offset;
    if (to > d->bytes.size) {
        return aiReturn_FAILURE;
    }
    d->at = to;
    return aiReturn_SUCCESS;
}

static void stream_flush(struct aiFile *file)
{
    (void)file;
}

struct aiFile *file_open(struct aiFileIO *io, const char *path, const char *mode)
{
    const struct import_file *import = (const struct import_file *)(void *)io->UserData;
    const bool own = strchr(mode, 'r') != NULL && strcmp(path, import->file.path) == 0;
    stream *d = own ? calloc(1, sizeof *d) : NULL;
    if (d == NULL) {
        return NULL;
    }
    d->bytes = import->file;
    d->file = (struct aiFile){.ReadProc = stream_read,
                              .WriteProc = stream_write,
                              .TellProc = stream_tell,
                              .FileSizeProc = stream_size,
                              .SeekProc = stream_seek,
                              .FlushProc = stream_flush,
                              .UserData = (char *)d};
    return &d->file;
}

void file_close(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    free(stream_of(file));
}
