/* SPDX-License-Identifier: Apache-2.0
 *
 * Output files that appear whole or not at all: written under a temporary name in the same folder,
 * renamed when all bytes have arrived, removed on any error and on Ctrl-C. A device or a pipe is
 * written to directly; a link stays one, and the file that it leads to is replaced.
 */
#ifndef ACCEL_CLI_OUTPUT_H
#define ACCEL_CLI_OUTPUT_H

#include <accel/accel.h>
#include <stdio.h>

/* A file under way. One at a time in a process. */
typedef struct accel_output {
    const char *path; /* where it will appear */
    FILE *file;       /* to write to */
    char *temporary;  /* its name until then; NULL for a device */
    char *target;     /* where a link leads, else NULL */
} accel_output;

/* Opens it, before anything long is computed. Otherwise fills error->text. */
bool accel_output_open(accel_output *output, const char *path, accel_error *error);

/* Puts it in place, or removes it and fills error->text. */
bool accel_output_commit(accel_output *output, accel_error *error);

/* Removes it. */
void accel_output_abandon(accel_output *output);

#endif
