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

#include "tool/place.h"

#include <accel/accel.h>
#include <stdio.h>

/* A folder under way. One at a time in a process; not to be moved in memory. */
struct folder {
    const char *name;          /* as the user calls it */
    struct place place;        /* where it goes in the end */
    char temporary[MOST_PATH]; /* where it is made; empty: nowhere */
    int trouble;               /* errno of the first write that failed, or 0 */
};

/* Makes it, before anything long is computed. A folder that is there already must be empty or hold
 * a former report and nothing else. Otherwise fills error->text. */
bool folder_open(struct folder *folder, const char *path, accel_error *error);

/* Opens a file in it to write, or to read back; NULL where that fails, see errno. */
FILE *folder_write(struct folder *folder, const char *name);
FILE *folder_read(struct folder *folder, const char *name);

/* Closes a file that was written. Returns NULL, or why not all of it has arrived. */
const char *folder_close(struct folder *folder, FILE *file);

/* Writes a line that names all files so far: what a later report may remove. */
void folder_list(const struct folder *folder, FILE *page);

/* Removes one file of it. */
void folder_remove(struct folder *folder, const char *name);

/* Moves it into place, or removes it and fills error->text. */
bool folder_commit(struct folder *folder, accel_error *error);

/* Removes it. */
void folder_abandon(struct folder *folder);

#endif
