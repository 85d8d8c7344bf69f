/* SPDX-License-Identifier: Apache-2.0
 *
 * A direction around a unit normal by the cosine: a point of the disc, lifted to the sphere.
 */
#ifndef ACCEL_CLI_SCATTER_H
#define ACCEL_CLI_SCATTER_H

#include "photons/photons_vector.h"
#include "random.h"

static inline void scatter(const double normal[3], struct random *random, double out[3])
{
    double x[3], y[3];
    const double axis[3] = {fabs(normal[0]) < 0.5, fabs(normal[0]) >= 0.5, 0.0};
    const double square = random_unit(random);
    const double angle = 6.283185307179586 * random_unit(random), r = sqrt(square);
    vector_cross(x, normal, axis);
    vector_normalize(x);
    vector_cross(y, normal, x);
    for (int k = 0; k < 3; k++) {
        out[k] = r * cos(angle) * x[k] + r * sin(angle) * y[k] + sqrt(1.0 - square) * normal[k];
    }
}

#endif
