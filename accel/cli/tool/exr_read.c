/* SPDX-License-Identifier: Apache-2.0
 *
 * OpenEXR files, read in a child process with limits. The child sends a verdict with size and
 * channels, then the bits of each channel.
 */
#include "child.h"
#include "exr_decode.h"

#include <stdlib.h>
#include <string.h>

enum { SECONDS = 120 };

/* What the child says first. */
typedef struct verdict {
    char trouble[200];  /* why nothing follows, or empty */
    struct image image; /* its pointers mean nothing */
} verdict;

/* The child's part. */
static void work(void *user, FILE *pipe)
{
    struct file *file = user;
    static verdict v;
    const char *trouble = exr_decode(&v.image, file);
    snprintf(v.trouble, sizeof v.trouble, "%s", trouble == NULL ? "" : trouble);
    child_write(pipe, &v, sizeof v);
    for (uint32_t i = 0; i < v.image.channel_count && trouble == NULL; i++) {
        child_write(pipe, v.image.channels[i].bits,
                    (size_t)v.image.width * v.image.height * sizeof(uint32_t));
    }
}

/* What the child says is checked as if it came from the file itself. */
static bool is_sane(const struct image *image)
{
    return image->width > 0 && image->height > 0 && image->channel_count > 0 &&
           image->channel_count <= MOST_CHANNELS &&
           (uint64_t)image->width * image->height <= MOST_PIXELS;
}

static const char *receive(struct child *child, struct image *image)
{
    static verdict v;
    if (!child_read(child, &v, sizeof v)) {
        return "its reader ended early";
    }
    v.trouble[sizeof v.trouble - 1] = '\0';
    if (v.trouble[0] != '\0') {
        return v.trouble;
    }
    if (!is_sane(&v.image)) {
        return "its reader went wrong";
    }
    const size_t bytes = (size_t)v.image.width * v.image.height * sizeof(uint32_t);
    *image = (struct image){.width = v.image.width, .height = v.image.height};
    for (uint32_t i = 0; i < v.image.channel_count; i++) {
        struct image_channel *channel = &image->channels[image->channel_count];
        *channel = v.image.channels[i];
        channel->name[CHANNEL_NAME - 1] = '\0';
        channel->bits = malloc(bytes);
        if (channel->bits == NULL) {
            return "does not fit into memory";
        }
        image->channel_count++;
        if (!child_read(child, channel->bits, bytes)) {
            return "its reader ended early";
        }
    }
    return NULL;
}

bool image_read_exr(struct image *image, const char *path, accel_error *error)
{
    *image = (struct image){0};
    struct file file;
    if (!file_read(&file, path, error)) {
        return false;
    }
    /* what the pixels may take at the best ratio, twice for the decoder's own copies */
    const struct child_limits limits = {
        ((uint64_t)1 << 28) + 4 * EXR_BEST_RATIO * (uint64_t)file.size, SECONDS};
    struct child child;
    const char *trouble = "no process for its reader";
    if (child_start(&child, limits, work, &file)) {
        trouble = receive(&child, image);
        const char *end = child_end(&child);
        trouble = trouble != NULL && end != NULL ? end : trouble;
    }
    free(file.bytes);
    if (trouble == NULL) {
        return true;
    }
    image_free(image);
    return file_fail(path, trouble, error);
}
