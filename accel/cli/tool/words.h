/* SPDX-License-Identifier: Apache-2.0
 *
 * Words and numbers that a user typed: nearest legal word, strict numbers.
 */
#ifndef ACCEL_CLI_WORDS_H
#define ACCEL_CLI_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Does a name end with `ending`, and is there more of it? */
bool ends_with(const char *name, const char *ending);

/* Finds the word nearest to the first `length` bytes of `typed`, upper or lower case; one that
 * begins with them is nearest of all, and one of which more than a third is wrong is not near.
 * Start with *best NULL and *distance SIZE_MAX and offer the legal words. */
void nearest_offer(const char *typed, size_t length, const char *word, const char **best,
                   size_t *distance);

/* Reads the whole of text[0..length) as a decimal number; no nan, no inf, no hex, no blanks. */
bool read_number(const char *text, size_t length, double *out);

/* Reads the whole of `text` as a decimal whole number in min..max. */
bool read_whole(const char *text, uint64_t min, uint64_t max, uint64_t *out);

#endif
