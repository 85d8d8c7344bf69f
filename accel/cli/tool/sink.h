/* SPDX-License-Identifier: Apache-2.0
 *
 * A stream that remembers why it failed: stdio keeps only that it did, and the errno of a full disk
 * is gone by the time that the stream is closed.
 */
#ifndef ACCEL_CLI_SINK_H
#define ACCEL_CLI_SINK_H

#include <stdbool.h>
#include <stdio.h>

/* Opens a descriptor, which the stream then owns, to write to. *trouble becomes the errno of the
 * first write that fails, and must outlive the stream; a stream that failed writes no more.
 * Returns NULL and sets errno otherwise. */
FILE *sink_open(int descriptor, int *trouble);

/* Closes it. False: not all has arrived, and *trouble is not 0. */
bool sink_close(FILE *file, int *trouble);

#endif
