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
enum { MOST_PATH = 4096 };

/* What is there. */
enum place_kind {
    PLACE_NEW,    /* nothing, or a link to nothing */
    PLACE_FILE,   /* a regular file that may be written */
    PLACE_FOLDER, /* a folder */
    PLACE_STREAM, /* a pipe, a character device, or a descriptor that the process was given */
};

/* Where a name leads. */
struct place {
    enum place_kind kind;
    int descriptor;       /* of a stream, owned; otherwise -1 */
    char path[MOST_PATH]; /* links followed */
};

/* How it went. */
enum placed {
    PLACED,
    NOT_PLACED,  /* nothing has changed there */
    HALF_PLACED, /* the former content is damaged, what was to be written is not */
};

/* Finds out. Links are followed; /dev/stdout, /dev/fd/N and the like become descriptor N, not the
 * file that is behind it. Returns NULL, or why nothing can be written there. */
const char *place_find(struct place *place, const char *name);

/* Makes an empty file or folder with a name of its own: beside what it will be, or in the folder
 * that is there, or, where a file is in a folder that may not be written, in $TMPDIR. Whatever
 * replaces something is for its owner alone until it is in place. Writes the name to `temporary`;
 * returns the descriptor of a file, 0 for a folder, or -1 and sets errno. */
int place_make(const struct place *place, bool folder, char temporary[MOST_PATH]);

/* Moves a finished file, of which `descriptor` is open, to `path`, or copies it into the file that
 * is there; output.h says when. Sets errno where that fails. */
enum placed place_file(int descriptor, const char *temporary, const char *path);

/* Gives a new file the owner, group and mode of an old one. False: it cannot be made like that one,
 * which may have attributes or an access list as well. */
bool place_dress(int descriptor, const char *path, const struct stat *old);

/* Writes a finished file to a stream. Returns NULL, or what went wrong: *done is what has arrived
 * and could not be taken back. */
const char *place_stream(int descriptor, int stream, uint64_t *done);

#endif
