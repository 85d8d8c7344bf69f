/* SPDX-License-Identifier: Apache-2.0
 *
 * The ray/sphere test: the roots of |org + t dir - centre|^2 = radius^2. The discriminant comes
 * from the distance of the centre to the line, the roots from Hearn and Baker's form, so neither a
 * far nor a large sphere cancels: Haines, Guenther and Akenine-Moeller, "Precision Improvements for
 * Ray/Sphere Intersection", Ray Tracing Gems, 2019.
 */
#ifndef ACCEL_SPHERE_H
#define ACCEL_SPHERE_H

#include "query.h"

/* A ray that leaves a sphere grazes it where the discriminant is nearer to 0 than this part of the
 * square of the radius. */
#define SPHERE_GRAZING 0x1p-20

/* Tests the sphere (centre, radius). Returns the number of roots, 0 or 2, the lower first; a line
 * that touches has two equal ones. Of a ray that leaves this sphere, 0 or 1: the one farther from
 * 0; see sphere.c. */
int accel_sphere_hits(const struct query *q, const double *sphere, bool leaves, double t[2]);

#endif
