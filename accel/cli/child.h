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
typedef struct accel_child_limits {
    uint64_t memory;  /* bytes on top of what the parent holds */
    unsigned seconds; /* of processor time */
} accel_child_limits;

/* A running child and the pipe that it writes its result to. */
typedef struct accel_child {
    accel_child_limits limits;                   /* as started */
    pid_t pid;                                   /* of the child */
    int pipe;                                    /* end to read from */
    void (*tick)(void *user, const char *phase); /* about ten times a second, or NULL */
    void *user;                                  /* handed to tick */
} accel_child;

/* The child's part: writes its result to the pipe and returns. */
typedef void accel_child_work(void *user, FILE *pipe);

/* Starts a child. Call it before the process has threads. Returns false where fork fails. */
bool accel_child_start(accel_child *child, accel_child_limits limits, accel_child_work *work,
                       void *user);

/* In the child: writes all bytes, or ends the child. */
void accel_child_write(FILE *pipe, const void *bytes, size_t count);

/* In the parent: reads exactly `count` bytes. Returns false where the child ended before. */
bool accel_child_read(accel_child *child, void *bytes, size_t count);

/* Ends the child. Returns NULL where it had ended well, otherwise how it went wrong, in words. */
const char *accel_child_end(accel_child *child);

#endif
