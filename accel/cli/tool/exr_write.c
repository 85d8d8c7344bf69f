/* SPDX-License-Identifier: Apache-2.0
 *
 * OpenEXR files through OpenEXRCore: one part of scan lines, ZIP, written through our own stream so
 * that a full disk is noticed.
 */
#include "image.h"

#include <OpenEXR/openexr.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

static void say_nothing(exr_const_context_t context, exr_result_t code, const char *text)
{
    (void)context, (void)code, (void)text;
}

static int64_t write_bytes(exr_const_context_t context, void *user, const void *bytes,
                           uint64_t count, uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    struct output *output = user;
    const char *at = bytes;
    uint64_t done = 0;
    while (done < count) {
        const ssize_t written =
            pwrite(output->descriptor, at + done, count - done, (off_t)(offset + done));
        if (written < 0 && errno != EINTR) {
            output->trouble = errno;
            complain(context, EXR_ERR_WRITE_IO, "%s", strerror(errno));
            return -1;
        }
        done += written > 0 ? (uint64_t)written : 0;
    }
    return (int64_t)done;
}

static exr_result_t declare(exr_context_t context, const struct image *image)
{
    int part;
    exr_result_t result = exr_add_part(context, "hits", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS) {
        result = exr_initialize_required_attr_simple(context, 0, (int32_t)image->width,
                                                     (int32_t)image->height, EXR_COMPRESSION_ZIP);
    }
    for (uint32_t i = 0; i < image->channel_count && result == EXR_ERR_SUCCESS; i++) {
        result = exr_add_channel(context, 0, image->channels[i].name,
                                 image->channels[i].is_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_UINT,
                                 EXR_PERCEPTUALLY_LINEAR, 1, 1);
    }
    return result == EXR_ERR_SUCCESS ? exr_write_header(context) : result;
}

/* Points the encoder at row y of each channel; both list the channels by name. */
static void point_at_row(exr_encode_pipeline_t *encoder, const struct image *image, uint32_t y)
{
    for (int i = 0; i < encoder->channel_count; i++) {
        exr_coding_channel_info_t *channel = &encoder->channels[i];
        channel->encode_from_ptr =
            (const uint8_t *)(image->channels[i].bits + (size_t)y * image->width);
        channel->user_pixel_stride = 4;
        channel->user_line_stride = (int32_t)(4 * image->width);
        channel->user_bytes_per_element = 4;
        channel->user_data_type = channel->data_type;
    }
}

/* OpenEXRCore's own compression of a chunk. */
typedef struct compression {
    exr_result_t (*run)(exr_encode_pipeline_t *encoder);
} compression;

/* Readers take a chunk that is as long as its pixels as the pixels themselves, but OpenEXRCore
 * before 3.4.8 writes its ZIP there, if that has just this length: issue 2306 of openexr. */
static exr_result_t compress(exr_encode_pipeline_t *encoder)
{
    const compression *standard = encoder->encoding_user_data;
    const exr_result_t result = standard->run(encoder);
    if (result == EXR_ERR_SUCCESS && encoder->compressed_bytes == encoder->packed_bytes) {
        memcpy(encoder->compressed_buffer, encoder->packed_buffer, encoder->packed_bytes);
    }
    return result;
}

static exr_result_t choose_routines(exr_context_t context, exr_encode_pipeline_t *encoder,
                                    compression *standard)
{
    const exr_result_t result = exr_encoding_choose_default_routines(context, 0, encoder);
    *standard = (compression){encoder->compress_fn};
    encoder->encoding_user_data = standard;
    encoder->compress_fn = standard->run == NULL ? NULL : compress;
    return result;
}

static exr_result_t write_rows(exr_context_t context, const struct image *image)
{
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    compression standard;
    int32_t rows = 1;
    exr_result_t result = exr_get_scanlines_per_chunk(context, 0, &rows);
    for (uint32_t y = 0; y < image->height && result == EXR_ERR_SUCCESS; y += (uint32_t)rows) {
        exr_chunk_info_t chunk;
        result = exr_write_scanline_chunk_info(context, 0, (int)y, &chunk);
        if (result == EXR_ERR_SUCCESS) {
            result = y == 0 ? exr_encoding_initialize(context, 0, &chunk, &encoder)
                            : exr_encoding_update(context, 0, &chunk, &encoder);
        }
        if (result == EXR_ERR_SUCCESS) {
            point_at_row(&encoder, image, y);
            result = y == 0 ? choose_routines(context, &encoder, &standard) : result;
        }
        if (result == EXR_ERR_SUCCESS) {
            result = exr_encoding_run(context, 0, &encoder);
        }
    }
    exr_encoding_destroy(context, &encoder);
    return result;
}

bool image_write_exr(const struct image *image, struct output *output, accel_error *error)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = say_nothing;
    initializer.write_fn = write_bytes;
    initializer.user_data = output;
    exr_context_t context = NULL;
    exr_result_t result =
        exr_start_write(&context, output->path, EXR_WRITE_FILE_DIRECTLY, &initializer);
    if (result == EXR_ERR_SUCCESS) {
        result = declare(context, image);
    }
    if (result == EXR_ERR_SUCCESS) {
        result = write_rows(context, image);
    }
    const exr_result_t finished = context == NULL ? result : exr_finish(&context);
    result = result == EXR_ERR_SUCCESS ? finished : result;
    if (result == EXR_ERR_SUCCESS && output->trouble == 0) {
        return true;
    }
    return output_failed(output, exr_get_default_error_message(result), error);
}
