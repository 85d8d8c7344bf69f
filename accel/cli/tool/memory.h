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

/* Asks for large pages under a block from malloc, if it is large: in a virtual machine the faults
 * of small ones take as long as reading a mesh. It may be without effect. */
void memory_large_pages(void *block, size_t bytes);

#endif
