/* SPDX-License-Identifier: Apache-2.0
 *
 * Input files: opened once, must be regular, not too large; read, not mapped, so that a file that
 * shrinks meanwhile is an error and no signal.
 */
#include "file.h"

#include "core/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Enough for 10^8 triangles in text; beyond it a file is a mistake or an attack. */
#define MOST_FILE_BYTES ((uint64_t)8 << 30)

bool file_fail(const char *path, const char *trouble, accel_error *error)
{
    error->status = ACCEL_BAD_ARGUMENT;
    snprintf(error->text, sizeof error->text, "%.200s: %s; nothing was loaded", path, trouble);
    return false;
}

static const char *why_not_a_file(int descriptor, uint64_t *size)
{
    struct stat status;
    if (fstat(descriptor, &status) != 0) {
        return strerror(errno);
    }
    if (S_ISDIR(status.st_mode)) {
        return "is a directory, not a file";
    }
    if (!S_ISREG(status.st_mode)) {
        return "is not a regular file";
    }
    *size = (uint64_t)status.st_size;
    if (*size == 0) {
        return "is empty";
    }
    return *size > MOST_FILE_BYTES ? "is larger than 8 GiB" : NULL;
}

static const char *read_all(int descriptor, struct file *file)
{
    size_t done = 0;
    while (done < file->size) {
        const ssize_t got = read(descriptor, file->bytes + done, file->size - done);
        if (got == 0) {
            return "became shorter while it was read";
        }
        if (got < 0 && errno != EINTR) {
            return strerror(errno);
        }
        done += got > 0 ? (size_t)got : 0;
    }
    return NULL;
}

static const char *read_open_file(int descriptor, struct file *file)
{
    uint64_t size = 0;
    const char *trouble = why_not_a_file(descriptor, &size);
    if (trouble != NULL) {
        return trouble;
    }
    file->size = (size_t)size;
    file->bytes = accel_memory_system(NULL, NULL, 0, file->size + 1);
    if (file->bytes == NULL) {
        return "does not fit into memory";
    }
    file->bytes[file->size] = '\0';
    trouble = read_all(descriptor, file);
    if (trouble != NULL) {
        free(file->bytes);
        file->bytes = NULL;
    }
    return trouble;
}

/* Without O_NONBLOCK a pipe would wait for its writer. */
static int open_file(const char *path)
{
    return open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

bool file_there(const char *path, accel_error *error)
{
    uint64_t size;
    const int descriptor = open_file(path);
    if (descriptor < 0) {
        return file_fail(path, strerror(errno), error);
    }
    const char *trouble = why_not_a_file(descriptor, &size);
    close(descriptor);
    return trouble == NULL || file_fail(path, trouble, error);
}

bool file_read(struct file *file, const char *path, accel_error *error)
{
    *file = (struct file){.path = path};
    const int descriptor = open_file(path);
    if (descriptor < 0) {
        return file_fail(path, strerror(errno), error);
    }
    const char *trouble = read_open_file(descriptor, file);
    close(descriptor);
    return trouble == NULL || file_fail(path, trouble, error);
}
