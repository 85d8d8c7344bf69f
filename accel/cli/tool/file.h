/* SPDX-License-Identifier: Apache-2.0
 *
 * Input files: regular ones, whole in memory, for readers that run in a child process.
 */
#ifndef ACCEL_CLI_FILE_H
#define ACCEL_CLI_FILE_H

#include <accel/accel.h>

/* A whole file in memory. */
struct file {
    const char *path; /* as the user gave it */
    char *bytes;      /* `size` of them and a zero behind; freed by the caller */
    size_t size;
};

/* Is it a regular file that can be read? Otherwise fills error->text. */
bool file_there(const char *path, accel_error *error);

/* Reads a regular file. Otherwise fills error->text and holds nothing. */
bool file_read(struct file *file, const char *path, accel_error *error);

/* Fills error->text with "path: trouble; nothing was loaded" and returns false. */
bool file_fail(const char *path, const char *trouble, accel_error *error);

#endif
