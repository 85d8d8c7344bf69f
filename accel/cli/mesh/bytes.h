/* SPDX-License-Identifier: Apache-2.0
 *
 * Numbers of binary formats, of any alignment and byte order. Signed ones are cast from these.
 */
#ifndef ACCEL_CLI_MESH_BYTES_H
#define ACCEL_CLI_MESH_BYTES_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static inline uint16_t mesh_bytes16(const char *at, bool big)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint16_t)(big ? b[0] << 8 | b[1] : b[1] << 8 | b[0]);
}

static inline uint32_t mesh_bytes32(const char *at, bool big)
{
    const uint32_t first = mesh_bytes16(at, big), second = mesh_bytes16(at + 2, big);
    return big ? first << 16 | second : second << 16 | first;
}

static inline uint64_t mesh_bytes64(const char *at, bool big)
{
    const uint64_t first = mesh_bytes32(at, big), second = mesh_bytes32(at + 4, big);
    return big ? first << 32 | second : second << 32 | first;
}

static inline double mesh_float(const char *at, bool big)
{
    const uint32_t bits = mesh_bytes32(at, big);
    float number;
    memcpy(&number, &bits, sizeof number);
    return (double)number;
}

static inline double mesh_double(const char *at, bool big)
{
    const uint64_t bits = mesh_bytes64(at, big);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

#endif
