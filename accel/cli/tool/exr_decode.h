/* SPDX-License-Identifier: Apache-2.0
 *
 * The reader of OpenEXR files that are in memory. It trusts OpenEXRCore, which hostile files may
 * crash: exr_read.c runs it in a child process.
 */
#ifndef ACCEL_CLI_EXR_DECODE_H
#define ACCEL_CLI_EXR_DECODE_H

#include "file.h"
#include "image.h"

/* The bytes that a byte of a file may become at most. */
enum { EXR_BEST_RATIO = 1032 };

/* Reads an image. Returns NULL, or what is wrong and holds nothing. */
const char *exr_decode(struct image *image, const struct file *file);

#endif
