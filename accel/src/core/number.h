/* SPDX-License-Identifier: Apache-2.0
 *
 * Numbers as text, the same in every locale: no radix character is given to libc or taken from it.
 * Exact, as libc's conversions are, in the default floating-point environment.
 */
#ifndef ACCEL_NUMBER_H
#define ACCEL_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

struct number_text {
    char at[32];
};

/* As %g of so many digits, 17 at most, prints it in the C locale. */
struct number_text accel_number_text(double x, int digits);

/* With the fewest digits, 15 or more, that accel_number_parse reads as x again. */
struct number_text accel_number_text_exact(double x);

/* [sign]digits[.digits][e[sign]digits]: no blanks, hexadecimal, inf or nan. Rounded once, to
 * nearest; infinite beyond double's range. False if it is not that. */
bool accel_number_parse(const char *at, size_t size, double *out);

enum { NUMBER_REWRITTEN = 832 };

/* The same number without radix character, which libc's strtod and strtof read in every locale and
 * round as they would the original. False if it is no number. */
bool accel_number_rewrite(const char *at, size_t size, char out[NUMBER_REWRITTEN]);

#endif
