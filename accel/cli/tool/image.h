/* SPDX-License-Identifier: Apache-2.0
 *
 * Images of named 32-bit channels, as OpenEXR files by OpenEXRCore, the C interface of libopenexr;
 * and pictures to look at as PNG.
 *
 * Reading accepts single-part scan line files without compression or with RLE, ZIPS or ZIP, at most
 * 2^26 pixels and 64 channels, and runs in a child process with limits.
 */
#ifndef ACCEL_CLI_IMAGE_H
#define ACCEL_CLI_IMAGE_H

#include "output.h"

enum { MOST_CHANNELS = 64, CHANNEL_NAME = 32, MOST_PIXELS = 1 << 26 };

/* One channel. */
struct image_channel {
    char name[CHANNEL_NAME];
    bool is_float;  /* otherwise unsigned */
    uint32_t *bits; /* of each pixel, rows from the top */
};

/* An image. Ended by image_free. */
struct image {
    uint32_t width, height;
    uint32_t channel_count;
    struct image_channel channels[MOST_CHANNELS]; /* in the order of their names' bytes */
};

/* Makes an image of zeros. `names` are in order and ended by NULL; those that begin with a capital
 * are float. Returns false when memory runs out. */
bool image_make(struct image *image, uint32_t width, uint32_t height, const char *const *names);

void image_free(struct image *image);

/* Writes the image into the file under way. Returns false and fills error->text otherwise. */
bool image_write_exr(const struct image *image, struct output *output, accel_error *error);

/* Reads an image. Otherwise fills error->text and holds nothing. */
bool image_read_exr(struct image *image, const char *path, accel_error *error);

/* Writes 8-bit red, green, blue of each pixel into the file under way. */
bool png_write(const unsigned char *pixels, uint32_t width, uint32_t height, struct output *output,
               accel_error *error);

#endif
