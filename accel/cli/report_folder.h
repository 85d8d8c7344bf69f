/* SPDX-License-Identifier: Apache-2.0
 *
 * An output folder that appears whole or not at all: made under a temporary name beside its place,
 * moved there at the end, removed on any error, on exit and on Ctrl-C. Files in it only, no
 * folders.
 */
#ifndef ACCEL_CLI_REPORT_FOLDER_H
#define ACCEL_CLI_REPORT_FOLDER_H

#include <accel/accel.h>
#include <stdio.h>

/* A folder under way. One at a time in a process. */
typedef struct accel_folder {
    char path[3900];      /* where it will appear */
    char temporary[4000]; /* where it is made; empty: nowhere */
} accel_folder;

/* Makes it, before anything long is computed. A folder that is there already must be empty or hold
 * a former report and nothing else, which is replaced at the end. Otherwise fills error->text. */
bool accel_folder_open(accel_folder *folder, const char *path, accel_error *error);

/* Opens a file in it to write, or to read back; NULL where that fails, see errno. */
FILE *accel_folder_file(accel_folder *folder, const char *name, const char *mode);

/* Writes a line that names all files so far: what a later report may remove. */
void accel_folder_list(FILE *page);

/* Removes one file of it. */
void accel_folder_remove(accel_folder *folder, const char *name);

/* Moves it into place, or removes it and fills error->text. */
bool accel_folder_commit(accel_folder *folder, accel_error *error);

/* Removes it. */
void accel_folder_abandon(accel_folder *folder);

#endif
