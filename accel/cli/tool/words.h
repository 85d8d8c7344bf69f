/* SPDX-License-Identifier: Apache-2.0
 *
 * Numbers that a user typed, by the library's parser, and endings of names. Nearest words and
 * settings are the library's too: core/words.h.
 */
#ifndef ACCEL_CLI_WORDS_H
#define ACCEL_CLI_WORDS_H

#include "core/words.h"

/* Does a name end with `ending`, and is there more of it? */
bool ends_with(const char *name, const char *ending);

/* Reads the whole of text[0..length) as a decimal number; no nan, no inf, no hex, no blanks. */
bool read_number(const char *text, size_t length, double *out);

/* Reads `count` of them with commas between. */
bool read_numbers(const char *text, size_t length, double *out, size_t count);

/* Reads the whole of `text` as a decimal whole number in min..max. */
bool read_whole(const char *text, uint64_t min, uint64_t max, uint64_t *out);

#endif
