/* SPDX-License-Identifier: Apache-2.0
 *
 * Families of rays that look for mistakes: shared by the check, the tests and the reports.
 *
 * Ray number i of a seed is always the same ray, whoever makes it and in whatever order. Families
 * take turns: ray i belongs to family i % ACCEL_FAMILIES.
 */
#ifndef ACCEL_CLI_RAYS_H
#define ACCEL_CLI_RAYS_H

#include "camera.h"

#include <accel/accel.h>

typedef enum accel_family {
    ACCEL_RAYS_PRIMARY = 0, /* from the camera that frames the scene */
    ACCEL_RAYS_LINES,       /* lines through two points of the scene's box, from outside */
    ACCEL_RAYS_INSIDE,      /* from a point of the box, any direction */
    ACCEL_RAYS_BOUNCE,      /* from a point on a primitive, which is skipped */
    ACCEL_RAYS_VERTEX,      /* aimed at a vertex, from outside, inside or another vertex */
    ACCEL_RAYS_EDGE,        /* aimed at a point of an edge, likewise */
    ACCEL_RAYS_AXIS,        /* components 0, -0 and 1, through vertices and planes of a lattice */
    ACCEL_RAYS_GRAZING,     /* 1e-2 to 1e-15 off the plane of the primitive that is aimed at */
    ACCEL_RAYS_FAR,         /* from 1e3 to 1e14 scenes away */
    ACCEL_RAYS_SCALED,      /* direction of length 2^-500 to 2^500 */
    ACCEL_RAYS_INTERVAL,    /* tmin and tmax at the hit, one ulp beside it, negative, infinite */
    ACCEL_RAYS_ODD,         /* zeros, denormals, huge, infinite and NaN components */
    ACCEL_FAMILIES
} accel_family;

/* What makes the rays of one scene and seed. Immutable; any number of threads may use it. */
typedef struct accel_rays {
    const accel_scene *scene;
    uint64_t primitives; /* of the scene */
    uint64_t seed;
    accel_box box;       /* of the scene */
    double centre[3];    /* of the box */
    double radius;       /* of the ball around the box, never 0 */
    accel_camera camera; /* frames the box */
} accel_rays;

/* Prepares; the scene must outlive it. Takes time linear in the scene's size. */
accel_rays accel_rays_start(const accel_scene *scene, uint64_t seed);

/* Ray number `index`. */
accel_ray accel_rays_make(const accel_rays *rays, uint64_t index);

/* "primary", "lines", ... */
const char *accel_family_name(accel_family family);

#endif
