/* SPDX-License-Identifier: Apache-2.0
 *
 * OpenEXR files through OpenEXRCore, in a child process with limits. What a header promises is
 * compared with the bytes that are there before anything is allocated: ZIP packs at most 1032 to 1.
 *
 * The child sends a verdict with size and channels, then the bits of each channel.
 */
#include "child.h"
#include "file.h"
#include "image.h"

#include <OpenEXR/openexr.h>
#include <stdlib.h>
#include <string.h>

enum { BEST_RATIO = 1032, SECONDS = 120 };

/* What the child says first. */
typedef struct verdict {
    char trouble[200]; /* why nothing follows, or empty */
    accel_image image; /* its pointers mean nothing */
} verdict;

static void say_nothing(exr_const_context_t context, exr_result_t code, const char *text)
{
    (void)context, (void)code, (void)text;
}

static int64_t size_of_stream(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((const accel_file *)user)->size;
}

static int64_t read_bytes(exr_const_context_t context, void *user, void *to, uint64_t count,
                          uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    const accel_file *file = user;
    if (offset > file->size) {
        complain(context, EXR_ERR_READ_IO, "the file ends before");
        return -1;
    }
    const uint64_t left = file->size - offset;
    const uint64_t taken = count < left ? count : left;
    memcpy(to, file->bytes + offset, taken);
    return (int64_t)taken;
}

static const char *check_kind(exr_context_t context)
{
    int parts = 0;
    exr_storage_t storage;
    exr_compression_t compression;
    if (exr_get_count(context, &parts) != EXR_ERR_SUCCESS || parts != 1) {
        return "has several parts; allowed is one";
    }
    if (exr_get_storage(context, 0, &storage) != EXR_ERR_SUCCESS ||
        storage != EXR_STORAGE_SCANLINE) {
        return "has tiles or deep pixels; allowed are scan lines";
    }
    if (exr_get_compression(context, 0, &compression) != EXR_ERR_SUCCESS ||
        compression > EXR_COMPRESSION_ZIP) {
        return "has an unknown or lossy compression; allowed are none, RLE, ZIPS and ZIP";
    }
    return NULL;
}

static const char *read_channels(exr_context_t context, accel_image *image)
{
    const exr_attr_chlist_t *list;
    if (exr_get_channels(context, 0, &list) != EXR_ERR_SUCCESS || list->num_channels < 1 ||
        list->num_channels > ACCEL_MOST_CHANNELS) {
        return "has no channel or more than 64";
    }
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        if (entry->x_sampling != 1 || entry->y_sampling != 1 ||
            entry->name.length >= ACCEL_CHANNEL_NAME) {
            return "has a subsampled channel or a channel with a name of more than 31 bytes";
        }
        accel_channel *channel = &image->channels[image->channel_count++];
        memcpy(channel->name, entry->name.str, (size_t)entry->name.length);
        channel->is_float = entry->pixel_type != EXR_PIXEL_UINT;
    }
    return NULL;
}

static const char *read_size(exr_context_t context, accel_image *image, size_t file_bytes)
{
    exr_attr_box2i_t window;
    if (exr_get_data_window(context, 0, &window) != EXR_ERR_SUCCESS) {
        return "has no data window";
    }
    const int64_t width = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > ACCEL_MOST_PIXELS || height > ACCEL_MOST_PIXELS ||
        width * height > ACCEL_MOST_PIXELS) {
        return "has no pixel or more than 2^26";
    }
    image->width = (uint32_t)width;
    image->height = (uint32_t)height;
    /* a half takes two bytes; nothing takes less */
    const uint64_t least = (uint64_t)width * (uint64_t)height * image->channel_count * 2;
    return least / BEST_RATIO > file_bytes ? "promises more pixels than its bytes can hold: is it "
                                             "truncated"
                                           : NULL;
}

/* Points the decoder at row y of each channel; both list the channels by name. */
static void point_at_row(exr_decode_pipeline_t *decoder, const accel_image *image, uint32_t y)
{
    for (int i = 0; i < decoder->channel_count; i++) {
        exr_coding_channel_info_t *channel = &decoder->channels[i];
        channel->decode_to_ptr = (uint8_t *)(image->channels[i].bits + (size_t)y * image->width);
        channel->user_pixel_stride = 4;
        channel->user_line_stride = (int32_t)(4 * image->width);
        channel->user_bytes_per_element = 4;
        channel->user_data_type =
            image->channels[i].is_float ? (uint16_t)EXR_PIXEL_FLOAT : (uint16_t)EXR_PIXEL_UINT;
    }
}

static const char *read_rows(exr_context_t context, const accel_image *image)
{
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_attr_box2i_t window;
    int32_t rows = 1;
    exr_result_t result = exr_get_data_window(context, 0, &window);
    if (result == EXR_ERR_SUCCESS) {
        result = exr_get_scanlines_per_chunk(context, 0, &rows);
    }
    for (uint32_t y = 0; y < image->height && result == EXR_ERR_SUCCESS; y += (uint32_t)rows) {
        exr_chunk_info_t chunk;
        result = exr_read_scanline_chunk_info(context, 0, window.min.y + (int)y, &chunk);
        if (result == EXR_ERR_SUCCESS) {
            result = y == 0 ? exr_decoding_initialize(context, 0, &chunk, &decoder)
                            : exr_decoding_update(context, 0, &chunk, &decoder);
        }
        if (result == EXR_ERR_SUCCESS) {
            point_at_row(&decoder, image, y);
            result = y == 0 ? exr_decoding_choose_default_routines(context, 0, &decoder) : result;
        }
        if (result == EXR_ERR_SUCCESS) {
            result = exr_decoding_run(context, 0, &decoder);
        }
    }
    exr_decoding_destroy(context, &decoder);
    return result == EXR_ERR_SUCCESS ? NULL : exr_get_default_error_message(result);
}

static const char *read_image(exr_context_t context, accel_image *image, size_t file_bytes)
{
    const char *trouble = check_kind(context);
    trouble = trouble == NULL ? read_channels(context, image) : trouble;
    trouble = trouble == NULL ? read_size(context, image, file_bytes) : trouble;
    for (uint32_t i = 0; i < image->channel_count && trouble == NULL; i++) {
        image->channels[i].bits = calloc((size_t)image->width * image->height, sizeof(uint32_t));
        trouble = image->channels[i].bits == NULL ? "does not fit into memory" : NULL;
    }
    return trouble == NULL ? read_rows(context, image) : trouble;
}

/* The child's part. */
static void work(void *user, FILE *pipe)
{
    accel_file *file = user;
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = say_nothing;
    initializer.read_fn = read_bytes;
    initializer.size_fn = size_of_stream;
    initializer.user_data = file;
    exr_context_t context = NULL;
    static verdict v;
    const exr_result_t result = exr_start_read(&context, file->path, &initializer);
    const char *trouble = result == EXR_ERR_SUCCESS ? read_image(context, &v.image, file->size)
                                                    : exr_get_default_error_message(result);
    snprintf(v.trouble, sizeof v.trouble, "%s", trouble == NULL ? "" : trouble);
    accel_child_write(pipe, &v, sizeof v);
    for (uint32_t i = 0; i < v.image.channel_count && trouble == NULL; i++) {
        accel_child_write(pipe, v.image.channels[i].bits,
                          (size_t)v.image.width * v.image.height * sizeof(uint32_t));
    }
}

/* What the child says is checked as if it came from the file itself. */
static bool is_sane(const accel_image *image)
{
    return image->width > 0 && image->height > 0 && image->channel_count > 0 &&
           image->channel_count <= ACCEL_MOST_CHANNELS &&
           (uint64_t)image->width * image->height <= ACCEL_MOST_PIXELS;
}

static const char *receive(accel_child *child, accel_image *image)
{
    static verdict v;
    if (!accel_child_read(child, &v, sizeof v)) {
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
    *image = (accel_image){.width = v.image.width, .height = v.image.height};
    for (uint32_t i = 0; i < v.image.channel_count; i++) {
        accel_channel *channel = &image->channels[image->channel_count];
        *channel = v.image.channels[i];
        channel->name[ACCEL_CHANNEL_NAME - 1] = '\0';
        channel->bits = malloc(bytes);
        if (channel->bits == NULL) {
            return "does not fit into memory";
        }
        image->channel_count++;
        if (!accel_child_read(child, channel->bits, bytes)) {
            return "its reader ended early";
        }
    }
    return NULL;
}

bool accel_image_read_exr(accel_image *image, const char *path, accel_error *error)
{
    *image = (accel_image){0};
    accel_file file;
    if (!accel_file_read(&file, path, error)) {
        return false;
    }
    /* what the pixels may take at the best ratio, twice for the decoder's own copies */
    const accel_child_limits limits = {((uint64_t)1 << 28) + 4 * BEST_RATIO * (uint64_t)file.size,
                                       SECONDS};
    accel_child child;
    const char *trouble = "no process for its reader";
    if (accel_child_start(&child, limits, work, &file)) {
        trouble = receive(&child, image);
        const char *end = accel_child_end(&child);
        trouble = trouble != NULL && end != NULL ? end : trouble;
    }
    free(file.bytes);
    if (trouble == NULL) {
        return true;
    }
    accel_image_free(image);
    return accel_file_fail(path, trouble, error);
}
