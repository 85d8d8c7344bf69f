/* SPDX-License-Identifier: Apache-2.0
 *
 * Where the name of an output leads, and how what is finished gets there.
 */
#ifndef ACCEL_CLI_PLACE_H
#define ACCEL_CLI_PLACE_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/stat.h>

/* PATH_MAX of Linux, which C11 alone does not show. */
enum { ACCEL_MOST_PATH = 4096 };

/* What is there. */
typedef enum accel_place_kind {
    ACCEL_PLACE_NEW,    /* nothing, or a link to nothing */
    ACCEL_PLACE_FILE,   /* a regular file that may be written */
    ACCEL_PLACE_FOLDER, /* a folder */
    ACCEL_PLACE_STREAM, /* a pipe, a character device, or a descriptor that the process was given */
} accel_place_kind;

/* Where a name leads. */
typedef struct accel_place {
    accel_place_kind kind;
    int descriptor;             /* of a stream, owned; otherwise -1 */
    char path[ACCEL_MOST_PATH]; /* links followed */
} accel_place;

/* How it went. */
typedef enum accel_placed {
    ACCEL_PLACED,
    ACCEL_NOT_PLACED,  /* nothing has changed there */
    ACCEL_HALF_PLACED, /* the former content is damaged, what was to be written is not */
} accel_placed;

/* Finds out. Links are followed; /dev/stdout, /dev/fd/N and the like become descriptor N, not the
 * file that is behind it. Returns NULL, or why nothing can be written there. */
const char *accel_place_find(accel_place *place, const char *name);

/* Makes an empty file or folder with a name of its own: beside what it will be, or in the folder
 * that is there, or, where a file is in a folder that may not be written, in $TMPDIR. Whatever
 * replaces something is for its owner alone until it is in place. Writes the name to `temporary`;
 * returns the descriptor of a file, 0 for a folder, or -1 and sets errno. */
int accel_place_make(const accel_place *place, bool folder, char temporary[ACCEL_MOST_PATH]);

/* Moves a finished file, of which `descriptor` is open, to `path`, or copies it into the file that
 * is there; output.h says when. Sets errno where that fails. */
accel_placed accel_place_file(int descriptor, const char *temporary, const char *path);

/* Gives a new file the owner, group and mode of an old one. False: it cannot be made like that one,
 * which may have attributes or an access list as well. */
bool accel_place_dress(int descriptor, const char *path, const struct stat *old);

/* Writes a finished file to a stream. Returns NULL, or what went wrong: *done is what has arrived
 * and could not be taken back. */
const char *accel_place_stream(int descriptor, int stream, uint64_t *done);

#endif
