/* SPDX-License-Identifier: Apache-2.0
 *
 * Families of rays that look for mistakes: shared by the check, the tests and the reports.
 *
 * Ray number i of a seed is always the same ray, whoever makes it and in whatever order. Families
 * take turns: ray i belongs to family i % FAMILIES.
 */
#ifndef ACCEL_CLI_RAYS_H
#define ACCEL_CLI_RAYS_H

#include "camera.h"

#include <accel/accel.h>

enum family {
    RAYS_PRIMARY = 0, /* from the camera that frames the scene */
    RAYS_LINES,       /* lines through two points of the scene's box, from outside */
    RAYS_INSIDE,      /* from a point of the box, any direction */
    RAYS_BOUNCE,      /* from a point on a primitive, which is skipped */
    RAYS_VERTEX,      /* aimed at a vertex, from outside, inside or another vertex */
    RAYS_EDGE,        /* aimed at a point of an edge, likewise */
    RAYS_AXIS,        /* components 0, -0 and 1, through vertices and planes of a lattice */
    RAYS_GRAZING,     /* 1e-2 to 1e-15 off the plane of the primitive that is aimed at */
    RAYS_FAR,         /* from 1e3 to 1e14 scenes away */
    RAYS_SCALED,      /* direction of length 2^-500 to 2^500 */
    RAYS_INTERVAL,    /* tmin and tmax at the hit, one ulp beside it, negative, infinite */
    RAYS_ODD,         /* zeros, denormals, huge, infinite and NaN components */
    FAMILIES
};

/* What makes the rays of one scene and seed. Immutable; any number of threads may use it. */
struct rays {
    const accel_scene *scene;
    uint64_t primitives; /* of the scene */
    uint64_t seed;
    accel_box box;        /* of the scene */
    double centre[3];     /* of the box */
    double radius;        /* of the ball around the box, never 0 */
    struct camera camera; /* frames the box */
};

/* Prepares; the scene must outlive it. Takes time linear in the scene's size. */
struct rays rays_start(const accel_scene *scene, uint64_t seed);

/* Ray number `index`. */
accel_ray rays_make(const struct rays *rays, uint64_t index);

/* "primary", "lines", ... */
const char *family_name(enum family family);

#endif
