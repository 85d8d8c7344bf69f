/* SPDX-License-Identifier: Apache-2.0
 *
 * Foreign parsers run in a child process with limits on memory and time: whatever a hostile file
 * does to them ends there, and the parent reports one line.
 */
#ifndef ACCEL_CLI_CHILD_H
#define ACCEL_CLI_CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

/* What a child may use. */
struct child_limits {
    uint64_t memory;  /* bytes on top of what the parent holds */
    unsigned seconds; /* of processor time */
};

/* A running child and the pipe that it writes its result to. */
struct child {
    struct child_limits limits;                  /* as started */
    pid_t pid;                                   /* of the child */
    int pipe;                                    /* end to read from */
    void (*tick)(void *user, const char *phase); /* about ten times a second, or NULL */
    void *user;                                  /* handed to tick */
};

/* The child's part: writes its result to the pipe and returns. */
typedef void child_work(void *user, FILE *pipe);

/* Starts a child. Call it before the process has threads. Returns false where fork fails. */
bool child_start(struct child *child, struct child_limits limits, child_work *work, void *user);

/* In the child: writes all bytes, or ends the child. */
void child_write(FILE *pipe, const void *bytes, size_t count);

/* In the parent: reads exactly `count` bytes. Returns false where the child ended before. */
bool child_read(struct child *child, void *bytes, size_t count);

/* Ends the child. Returns NULL where it had ended well, otherwise how it went wrong, in words. */
const char *child_end(struct child *child);

#endif
