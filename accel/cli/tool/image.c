/* SPDX-License-Identifier: Apache-2.0
 *
 * Images in memory, and pictures as PNG.
 */
#include "image.h"

#include <ctype.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

bool image_make(struct image *image, uint32_t width, uint32_t height, const char *const *names)
{
    *image = (struct image){.width = width, .height = height};
    for (; names[image->channel_count] != NULL; image->channel_count++) {
        const char *name = names[image->channel_count];
        struct image_channel *channel = &image->channels[image->channel_count];
        snprintf(channel->name, sizeof channel->name, "%s", name);
        channel->is_float = isupper((unsigned char)name[0]);
        channel->bits = calloc((size_t)width * height, sizeof *channel->bits);
        if (channel->bits == NULL) {
            image_free(image);
            return false;
        }
    }
    return true;
}

void image_free(struct image *image)
{
    for (uint32_t i = 0; i < image->channel_count; i++) {
        free(image->channels[i].bits);
    }
    *image = (struct image){0};
}

bool png_write(const unsigned char *pixels, uint32_t width, uint32_t height, struct output *output,
               accel_error *error)
{
    png_image png = {
        .version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = PNG_FORMAT_RGB};
    if (png_image_write_to_stdio(&png, output->file, 0, pixels, 0, NULL) != 0) {
        return true;
    }
    return output_failed(output, png.message, error);
}
