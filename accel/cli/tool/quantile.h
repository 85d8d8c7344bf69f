/* SPDX-License-Identifier: Apache-2.0
 *
 * Medians and quartiles of a few measured values.
 */
#ifndef ACCEL_CLI_QUANTILE_H
#define ACCEL_CLI_QUANTILE_H

#include <stddef.h>

/* Sorts by rising value. */
void sort_values(double *values, size_t count);

/* The value at `part` (0..1) of count > 0 sorted ones, between two of them in proportion. */
double quantile(const double *sorted, size_t count, double part);

#endif
