/* SPDX-License-Identifier: Apache-2.0
 *
 * Sums over what must not change once it is built, made by the build, so that accel_validate sees
 * what no rule could: a vertex, a box, a pointer that was overwritten.
 *
 * Whatever changes in one word changes the sum of its block, and whatever changes in one block the
 * sum of all: turning, adding and multiplying by an odd number lose nothing. Of changes to several
 * words one in 2^64 is missed.
 */
#ifndef ACCEL_SEAL_H
#define ACCEL_SEAL_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The sum of a block of whole words. */
static inline uint64_t seal_words(const void *at, size_t words)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < words; i++) {
        uint64_t word;
        memcpy(&word, (const char *)at + i * sizeof word, sizeof word);
        sum = (sum << 7 | sum >> 57) + word;
    }
    return sum;
}

#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
/* Padding has no value in the language, but bytes in memory all the same. */
#define SEAL_PADDING __attribute__((no_sanitize("memory")))
#endif
#endif
#if !defined(SEAL_PADDING)
#define SEAL_PADDING
#endif

/* The sum of any block. */
SEAL_PADDING static inline uint64_t seal_bytes(const void *at, size_t bytes)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < bytes; i += sizeof sum) {
        uint64_t word = 0;
        if (bytes - i >= sizeof word)
            memcpy(&word, (const char *)at + i, sizeof word);
        else
            memcpy(&word, (const char *)at + i, bytes - i);
        sum = (sum << 7 | sum >> 57) + word;
    }
    return sum;
}

/* A primitive's part of the sum over all, which may be added in any order: of `words` words of its
 * data. */
static inline uint64_t seal_primitive(uint32_t id, const void *at, size_t words)
{
    return (2 * (uint64_t)id + 1) * seal_words(at, words);
}

#endif
