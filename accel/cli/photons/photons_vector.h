/* SPDX-License-Identifier: Apache-2.0
 *
 * The few vector operations of the photon code.
 */
#ifndef ACCEL_CLI_PHOTONS_VECTOR_H
#define ACCEL_CLI_PHOTONS_VECTOR_H

#include <math.h>

static inline double vector_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vector_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void vector_subtract(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

/* out = a + s * b */
static inline void vector_add_scaled(double out[3], const double a[3], double s, const double b[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] + s * b[k];
    }
}

/* Makes v of length 1; scaled by its largest part first, so that no square overflows or vanishes.
 */
static inline void vector_normalize(double v[3])
{
    const double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    for (int k = 0; k < 3; k++) {
        v[k] /= largest;
    }
    const double length = sqrt(vector_dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

#endif
