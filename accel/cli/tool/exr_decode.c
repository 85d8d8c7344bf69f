/* SPDX-License-Identifier: Apache-2.0
 *
 * OpenEXR files through OpenEXRCore, from memory. What a header promises is compared with the bytes
 * that are there before anything is allocated: ZIP packs at most 1032 to 1.
 */
#include "exr_decode.h"

#include <OpenEXR/openexr.h>
#include <stdlib.h>
#include <string.h>

static void say_nothing(exr_const_context_t context, exr_result_t code, const char *text)
{
    (void)context, (void)code, (void)text;
}

static int64_t size_of_stream(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((const struct file *)user)->size;
}

static int64_t read_bytes(exr_const_context_t context, void *user, void *to, uint64_t count,
                          uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    const struct file *file = user;
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

/* Names are shown on terminals. */
static bool is_name(const exr_attr_string_t *name)
{
    bool fine = name->length > 0 && name->length < CHANNEL_NAME;
    for (int32_t i = 0; fine && i < name->length; i++) {
        fine = name->str[i] >= ' ' && name->str[i] <= '~';
    }
    return fine;
}

static const char *read_channels(exr_context_t context, struct image *image)
{
    const exr_attr_chlist_t *list;
    if (exr_get_channels(context, 0, &list) != EXR_ERR_SUCCESS || list->num_channels < 1 ||
        list->num_channels > MOST_CHANNELS) {
        return "has no channel or more than 64";
    }
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        if (entry->x_sampling != 1 || entry->y_sampling != 1 || !is_name(&entry->name)) {
            return "has a subsampled channel, or one whose name is not of 1 to 31 printable ASCII "
                   "characters";
        }
        struct image_channel *channel = &image->channels[image->channel_count++];
        memcpy(channel->name, entry->name.str, (size_t)entry->name.length);
        channel->is_float = entry->pixel_type != EXR_PIXEL_UINT;
    }
    return NULL;
}

static const char *read_size(exr_context_t context, struct image *image, size_t file_bytes)
{
    exr_attr_box2i_t window;
    if (exr_get_data_window(context, 0, &window) != EXR_ERR_SUCCESS) {
        return "has no data window";
    }
    const int64_t width = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > MOST_PIXELS || height > MOST_PIXELS ||
        width * height > MOST_PIXELS) {
        return "has no pixel or more than 2^26";
    }
    image->width = (uint32_t)width;
    image->height = (uint32_t)height;
    /* a half takes two bytes; nothing takes less */
    const uint64_t least = (uint64_t)width * (uint64_t)height * image->channel_count * 2;
    return least / EXR_BEST_RATIO > file_bytes
               ? "promises more pixels than its bytes can hold: is it "
                 "truncated"
               : NULL;
}

/* Points the decoder at row y of each channel; both list the channels by name. */
static void point_at_row(exr_decode_pipeline_t *decoder, const struct image *image, uint32_t y)
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

/* The bytes that a chunk of run lengths becomes: a count below zero is that of the bytes that
 * follow, any other one less than the length of the run of the next byte. */
static uint64_t run_length_bytes(const signed char *at, uint64_t left)
{
    uint64_t bytes = 0;
    while (left > 0) {
        const uint64_t count = at[0] < 0 ? (uint64_t)-at[0] : (uint64_t)at[0] + 1;
        const uint64_t taken = at[0] < 0 ? count + 1 : 2;
        if (taken > left) {
            return 0;
        }
        bytes += count;
        left -= taken;
        at += taken;
    }
    return bytes;
}

/* Are all of the chunk's pixels there? OpenEXRCore leaves those that are not as its memory was (its
 * pull requests 2156 and 2162, after Debian's version); of ZIP it checks the length itself. A chunk
 * that is as long as its pixels is not compressed. */
static bool is_whole(const exr_chunk_info_t *chunk, const struct file *file)
{
    if (chunk->data_offset > file->size || chunk->packed_size > file->size - chunk->data_offset) {
        return false;
    }
    if (chunk->packed_size == chunk->unpacked_size) {
        return true;
    }
    const signed char *bytes = (const signed char *)file->bytes + chunk->data_offset;
    switch (chunk->compression) {
    case EXR_COMPRESSION_NONE:
        return false;
    case EXR_COMPRESSION_RLE:
        return run_length_bytes(bytes, chunk->packed_size) == chunk->unpacked_size;
    default:
        return chunk->packed_size > 0;
    }
}

/* Decodes the chunk that begins with row y of the image; the first one sets up the decoder. */
static exr_result_t read_chunk(exr_context_t context, const struct image *image,
                               const struct file *file, uint32_t y, exr_decode_pipeline_t *decoder)
{
    exr_attr_box2i_t window;
    exr_chunk_info_t chunk;
    exr_result_t result = exr_get_data_window(context, 0, &window);
    if (result == EXR_ERR_SUCCESS) {
        result = exr_read_scanline_chunk_info(context, 0, window.min.y + (int)y, &chunk);
    }
    if (result == EXR_ERR_SUCCESS && !is_whole(&chunk, file)) {
        result = EXR_ERR_CORRUPT_CHUNK;
    }
    if (result == EXR_ERR_SUCCESS) {
        result = y == 0 ? exr_decoding_initialize(context, 0, &chunk, decoder)
                        : exr_decoding_update(context, 0, &chunk, decoder);
    }
    if (result == EXR_ERR_SUCCESS) {
        point_at_row(decoder, image, y);
        result = y == 0 ? exr_decoding_choose_default_routines(context, 0, decoder) : result;
    }
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(context, 0, decoder) : result;
}

static const char *read_rows(exr_context_t context, const struct image *image,
                             const struct file *file)
{
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t rows = 1;
    exr_result_t result = exr_get_scanlines_per_chunk(context, 0, &rows);
    for (uint32_t y = 0; y < image->height && result == EXR_ERR_SUCCESS; y += (uint32_t)rows) {
        result = read_chunk(context, image, file, y, &decoder);
    }
    exr_decoding_destroy(context, &decoder);
    return result == EXR_ERR_SUCCESS ? NULL : exr_get_default_error_message(result);
}

static const char *read_image(exr_context_t context, struct image *image, const struct file *file)
{
    const char *trouble = check_kind(context);
    trouble = trouble == NULL ? read_channels(context, image) : trouble;
    trouble = trouble == NULL ? read_size(context, image, file->size) : trouble;
    for (uint32_t i = 0; i < image->channel_count && trouble == NULL; i++) {
        image->channels[i].bits = calloc((size_t)image->width * image->height, sizeof(uint32_t));
        trouble = image->channels[i].bits == NULL ? "does not fit into memory" : NULL;
    }
    return trouble == NULL ? read_rows(context, image, file) : trouble;
}

const char *exr_decode(struct image *image, const struct file *file)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = say_nothing;
    initializer.read_fn = read_bytes;
    initializer.size_fn = size_of_stream;
    initializer.user_data = (void *)(uintptr_t)file;
    exr_context_t context = NULL;
    *image = (struct image){0};
    const exr_result_t result = exr_start_read(&context, file->path, &initializer);
    const char *trouble = result == EXR_ERR_SUCCESS ? read_image(context, image, file)
                                                    : exr_get_default_error_message(result);
    exr_finish(&context);
    if (trouble != NULL) {
        image_free(image);
    }
    return trouble;
}
