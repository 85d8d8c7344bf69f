/* SPDX-License-Identifier: Apache-2.0
 *
 * How much memory is there, and large pages for large blocks.
 */
#ifndef ACCEL_CLI_MEMORY_H
#define ACCEL_CLI_MEMORY_H

#include <stddef.h>
#include <stdint.h>

/* Bytes that this process can get now without swapping: the machine's, its control group's and its
 * own limit, whichever is least. UINT64_MAX where none of them can be read. */
uint64_t memory_free(void);

#endif
