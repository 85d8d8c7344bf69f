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

enum { ACCEL_MOST_CHANNELS = 64, ACCEL_CHANNEL_NAME = 32, ACCEL_MOST_PIXELS = 1 << 26 };

/* One channel. */
typedef struct accel_channel {
    char name[ACCEL_CHANNEL_NAME];
    bool is_float;  /* otherwise unsigned */
    uint32_t *bits; /* of each pixel, rows from the top */
} accel_channel;

/* An image. Ended by accel_image_free. */
typedef struct accel_image {
    uint32_t width, height;
    uint32_t channel_count;
    accel_channel channels[ACCEL_MOST_CHANNELS]; /* in the order of their names' bytes */
} accel_image;

/* Makes an image of zeros. `names` are in order and ended by NULL; those that begin with a capital
 * are float. Returns false when memory runs out. */
bool accel_image_make(accel_image *image, uint32_t width, uint32_t height,
                      const char *const *names);

void accel_image_free(accel_image *image);

/* Writes the image into the file under way. Returns false and fills error->text otherwise. */
bool accel_image_write_exr(const accel_image *image, accel_output *output, accel_error *error);

/* Reads an image. Otherwise fills error->text and holds nothing. */
bool accel_image_read_exr(accel_image *image, const char *path, accel_error *error);

/* Writes 8-bit red, green, blue of each pixel into the file under way. */
bool accel_write_png(const unsigned char *pixels, uint32_t width, uint32_t height,
                     accel_output *output, accel_error *error);

#endif
