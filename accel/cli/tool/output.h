/* SPDX-License-Identifier: Apache-2.0
 *
 * Output files that appear whole or not at all, under whatever name: all is written to a temporary
 * first, and goes to its place when the last byte has arrived and is on disk.
 *
 * Nothing is there, or a link to nothing: renamed. A crash or SIGKILL leaves nothing there, and
 * perhaps the temporary file beside it, NAME.XXXXXX.
 *
 * A file: renamed over it, with its mode and owner. At any moment the name has the whole old or the
 * whole new content.
 *
 * A file that a new one could not stand for, because it has several hard links, an access list, an
 * owner whom we cannot give, or lies where we may rename nothing: copied into it. A full disk, a
 * size limit or a signal leaves the old content as it was. What ends the copy otherwise, as a
 * broken disk or SIGKILL, leaves the new content in the temporary file, which is
 * $TMPDIR/accel.XXXXXX where the folder takes none.
 *
 * A pipe, a device, a descriptor (/dev/stdout) or "-": written to from memory, as the shell set it
 * up. A file to be appended to is appended to, and cut off again where not all of it fits.
 *
 * Links are followed. Folders, block devices, and files that may not be written are refused at the
 * beginning. Signals: see unfinished.h.
 */
#ifndef ACCEL_CLI_OUTPUT_H
#define ACCEL_CLI_OUTPUT_H

#include "place.h"

#include <accel/accel.h>
#include <stdio.h>

/* For the help of every option that names an output. */
#define ACCEL_DASH "- is standard output"

/* A file under way. One at a time in a process; not to be moved in memory. */
struct output {
    const char *path;          /* as the user calls it */
    FILE *file;                /* to write to */
    int descriptor;            /* the same, for who needs to write in any order */
    int trouble;               /* errno of the first write that failed, or 0 */
    struct place place;        /* where it goes in the end */
    char temporary[MOST_PATH]; /* its name until then; none for a stream */
};

/* Opens it, before anything long is computed. Otherwise fills error->text. */
bool output_open(struct output *output, const char *path, accel_error *error);

/* Puts it in place, or removes it and fills error->text. */
bool output_commit(struct output *output, accel_error *error);

/* Removes it. */
void output_abandon(struct output *output);

/* Fills error->text with why it could not be written: output->trouble, or `otherwise`. Returns
 * false. */
bool output_failed(const struct output *output, const char *otherwise, accel_error *error);

#endif
