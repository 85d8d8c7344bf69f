/* SPDX-License-Identifier: Apache-2.0
 *
 * One line of error text in the caller's struct. The first error is kept. The text is printable
 * UTF-8, whatever of the caller's words is in it: what is not becomes '?'.
 */
#ifndef ACCEL_ERROR_H
#define ACCEL_ERROR_H

#include "accel/accel.h"

/* Notes status and text unless `error` already holds one. Returns the status that it holds. */
__attribute__((format(printf, 3, 4))) accel_status
accel_error_set(accel_error *error, accel_status status, const char *format, ...);

/* Bytes of a word of which at most so many are to be shown: no character is cut in two. */
size_t accel_error_cut(const char *word, size_t size, size_t most);

#endif
