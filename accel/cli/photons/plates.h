/* SPDX-License-Identifier: Apache-2.0
 *
 * Closed forms between parallel rectangles, for tests and reports.
 */
#ifndef ACCEL_CLI_PLATES_H
#define ACCEL_CLI_PLATES_H

#include <math.h>

/* From a point to the parallel rectangle a x b at distance 1 with a corner above it; for negative
 * sides the value changes its sign, so that corners add up to any rectangle. Howell, B-3. */
static inline double corner_form_factor(double a, double b)
{
    const double a1 = sqrt(1.0 + a * a), b1 = sqrt(1.0 + b * b);
    return (a / a1 * atan(b / a1) + b / b1 * atan(a / b1)) / (2.0 * 3.141592653589793);
}

/* From the point (x, z) of the unit square y = 0 to the whole unit square y = 1. */
static inline double ceiling_form_factor(double x, double z)
{
    return corner_form_factor(1.0 - x, 1.0 - z) + corner_form_factor(x, 1.0 - z) +
           corner_form_factor(1.0 - x, z) + corner_form_factor(x, z);
}

#endif
