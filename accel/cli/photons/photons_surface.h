/* SPDX-License-Identifier: Apache-2.0
 *
 * Where a ray hit a triangle or a sphere, in the precision that a next ray needs.
 *
 * A point of a triangle comes from its vertices, not from org + t * dir, so its error does not grow
 * with the ray's length.
 */
#ifndef ACCEL_CLI_PHOTONS_SURFACE_H
#define ACCEL_CLI_PHOTONS_SURFACE_H

#include "scenes/scene.h"

/* A point on a surface. */
struct surface {
    double at[3];
    double normal[3]; /* of length 1, on the side that the ray came from */
};

struct surface surface_at(const accel_scene *scene, const accel_ray *ray, const accel_hit *hit);

/* The area of all triangles and spheres. */
double scene_area(const accel_scene *scene);

#endif
