/* SPDX-License-Identifier: Apache-2.0
 *
 * An output folder that appears whole or not at all. Files in it only, no folders.
 *
 * Nothing is there, or a link to nothing: made beside it, renamed at the end.
 *
 * A folder: it stays the same one, whatever its mode, owner, links and mount. What a former report
 * has made is replaced and nothing else: were there anything else, the folder would be refused. All
 * is made in a folder inside; at the end, when it is on disk, file by file is renamed, with mode
 * and owner of the file that it replaces, the page last. In that moment SIGKILL or a crash leaves
 * files of both reports, each of them whole; before it, the temporary folder beside the former
 * report.
 *
 * Hard links to files of the former report keep its content. Signals: see unfinished.h.
 */
#ifndef ACCEL_CLI_REPORT_FOLDER_H
#define ACCEL_CLI_REPORT_FOLDER_H

#include "place.h"

#include <accel/accel.h>
#include <stdio.h>

/* A folder under way. One at a time in a process; not to be moved in memory. */
typedef struct accel_folder {
    const char *name;                /* as the user calls it */
    accel_place place;               /* where it goes in the end */
    char temporary[ACCEL_MOST_PATH]; /* where it is made; empty: nowhere */
    int trouble;                     /* errno of the first write that failed, or 0 */
} accel_folder;

/* Makes it, before anything long is computed. A folder that is there already must be empty or hold
 * a former report and nothing else. Otherwise fills error->text. */
bool accel_folder_open(accel_folder *folder, const char *path, accel_error *error);

/* Opens a file in it to write, or to read back; NULL where that fails, see errno. */
FILE *accel_folder_write(accel_folder *folder, const char *name);
FILE *accel_folder_read(accel_folder *folder, const char *name);

/* Closes a file that was written. Returns NULL, or why not all of it has arrived. */
const char *accel_folder_close(accel_folder *folder, FILE *file);

/* Writes a line that names all files so far: what a later report may remove. */
void accel_folder_list(const accel_folder *folder, FILE *page);

/* Removes one file of it. */
void accel_folder_remove(accel_folder *folder, const char *name);

/* Moves it into place, or removes it and fills error->text. */
bool accel_folder_commit(accel_folder *folder, accel_error *error);

/* Removes it. */
void accel_folder_abandon(accel_folder *folder);

#endif
