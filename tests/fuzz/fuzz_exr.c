/* SPDX-License-Identifier: Apache-2.0
 *
 * The OpenEXR reader on any bytes, in this process: it ends, holds to its limits, and what it read
 * can be written and read again, bit for bit.
 */
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <OpenEXR/openexr.h>

#include "tool/exr_decode.h"
#include "fuzz.h"

/* What fresh memory holds: another byte each time, so that what was never written is seen. */
static int fresh;

static void *allocate(size_t size)
{
    void *block = malloc(size);
    if (block)
        memset(block, fresh, size);
    return block;
}

static const char *decode(struct image *image, const void *bytes, size_t size)
{
    const struct file file = {"in memory", (char *)(uintptr_t)bytes, size};
    fresh ^= 0x55;
    const char *trouble = exr_decode(image, &file);
    if (trouble)
        check_text(trouble);
    if (trouble && (image->channel_count > 0 || image->width > 0 || image->height > 0))
        broken("'%s', but an image is left", trouble);
    return trouble;
}

static void check_names(const struct image *image)
{
    for (uint32_t i = 0; i < image->channel_count; i++) {
        const char *name = image->channels[i].name;
        if (!memchr(name, '\0', CHANNEL_NAME))
            broken("a channel's name does not end");
        check_text(name);
        if (i > 0 && strcmp(image->channels[i - 1].name, name) >= 0)
            broken("channel '%s' comes after '%s'", name, image->channels[i - 1].name);
    }
}

static size_t bytes_of_channel(const struct image *image)
{
    return (size_t)image->width * image->height * sizeof(uint32_t);
}

static void check_limits(const struct image *image, size_t size)
{
    const size_t all = bytes_of_channel(image) * image->channel_count;
    if (image->channel_count < 1 || image->channel_count > MOST_CHANNELS || all == 0 ||
        all / image->channel_count / sizeof(uint32_t) > MOST_PIXELS)
        broken("an image of %u x %u and %u channels", image->width, image->height,
               image->channel_count);
    if (all / 2 / EXR_BEST_RATIO > size)
        broken("%zu bytes from a file of %zu", all, size);
    check_names(image);
}

/* The whole of a file that is only a descriptor; ended by free. */
static void *read_back(int descriptor, size_t *size)
{
    *size = (size_t)lseek(descriptor, 0, SEEK_END);
    void *bytes = malloc(*size + 1);
    if (!bytes || pread(descriptor, bytes, *size, 0) != (ssize_t)*size)
        broken("what was written cannot be read");
    return bytes;
}

static void *write_image(const struct image *image, size_t *size)
{
    accel_error error;
    struct output output = {.path = "in memory",
                            .file = fdopen(memfd_create("exr", MFD_CLOEXEC), "w+b")};
    if (!output.file)
        broken("no file in memory");
    output.descriptor = fileno(output.file);
    if (!image_write_exr(image, &output, &error))
        broken("what was read cannot be written: %s", error.text);
    fflush(output.file);
    void *bytes = read_back(fileno(output.file), size);
    fclose(output.file);
    return bytes;
}

static void check_same(const struct image *a, const struct image *b, const char *when)
{
    if (a->width != b->width || a->height != b->height || a->channel_count != b->channel_count)
        broken("%s: another size", when);
    for (uint32_t i = 0; i < a->channel_count; i++)
        if (strcmp(a->channels[i].name, b->channels[i].name) != 0 ||
            a->channels[i].is_float != b->channels[i].is_float ||
            memcmp(a->channels[i].bits, b->channels[i].bits, bytes_of_channel(a)) != 0)
            broken("%s: channel %s differs", when, a->channels[i].name);
}

static void check_again(const struct image *image, const void *bytes, size_t size, const char *when)
{
    static struct image again;
    const char *trouble = decode(&again, bytes, size);
    if (trouble)
        broken("%s: %s", when, trouble);
    check_same(image, &again, when);
    image_free(&again);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static struct image image;
    size_t written;
    exr_set_default_memory_routines(allocate, free);
    if (decode(&image, bytes, size))
        return 0;
    check_limits(&image, size);
    check_again(&image, bytes, size, "read again");
    void *copy = write_image(&image, &written);
    check_again(&image, copy, written, "written and read again");
    image_free(&image);
    free(copy);
    return 0;
}
