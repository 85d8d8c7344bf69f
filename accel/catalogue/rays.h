/* SPDX-License-Identifier: Apache-2.0
 *
 * Families of rays that look for mistakes, at any scene: for `accel check`, the tests and the
 * reports. Points on primitives are computed, not traced, but for the families that say so.
 */
#ifndef CATALOGUE_RAYS_H
#define CATALOGUE_RAYS_H

#include "rng.h"

#include "accel/accel.h"

/* What rays are aimed at. */
struct ray_target {
    const accel_scene *scene;
    accel_box box;        /* of the scene: see scene_box */
    uint64_t primitives;  /* of the scene */
    accel_ray *given;     /* rays that come with the scene */
    uint32_t given_count; /* of them */
};

struct ray_family {
    const char *test;    /* "special-rays", or "mix" */
    const char *name;    /* unique, one word */
    const char *meaning; /* one line */
    /* The i-th ray. `judge` is a linear structure over the scene. */
    accel_ray (*make)(const struct ray_target *t, const accel *judge, struct rng *d, uint64_t i);
    uint32_t rays;             /* at intensity 1, over all its scenes */
    const char *const *scenes; /* the names of scenes that it is made for, NULL-ended */
};

/* The families of the tests, ended by a NULL name. The first, "mix", is what every scene is shot
 * with: random, aimed at vertices and edges, axis-parallel with both zeros, grazing. */
extern const struct ray_family ray_families[];

/* NULL if there is none of that name. */
const struct ray_family *ray_family_find(const char *name);

/* The families of `accel check`: none asks a structure. They take turns: ray i belongs to family
 * i % FAMILIES. */
enum family {
    RAYS_PRIMARY = 0, /* from the camera that frames the scene */
    RAYS_LINES,       /* from the box or around it to a point in it */
    RAYS_INSIDE,      /* from a point of the box, any direction */
    RAYS_BOUNCE,      /* from a point on a primitive, which is skipped */
    RAYS_VERTEX,      /* aimed at a vertex, from anywhere or from another vertex */
    RAYS_EDGE,        /* aimed at a point of an edge, likewise */
    RAYS_AXIS,        /* components 0, -0 and 1, through vertices and planes that halve the box */
    RAYS_GRAZING,     /* 1e-2 to 1e-15 off the plane of the primitive that is aimed at */
    RAYS_FAR,         /* from 1e3 to 1e14 scenes away */
    RAYS_SCALED,      /* direction of length 2^-500 to 2^500 */
    RAYS_INTERVAL,    /* tmin and tmax at the hit, one ulp beside it, negative, infinite */
    RAYS_ODD,         /* zeros, denormals, huge, infinite and NaN components */
    FAMILIES
};

/* What makes the rays of one scene and seed: ray i is always the same one, whoever makes it and in
 * whatever order. Any number of threads may use it. */
struct rays {
    struct ray_target target;
    uint64_t seed;
};

/* Prepares; the scene must outlive it. Takes time linear in the scene's size. */
struct rays rays_start(const accel_scene *scene, uint64_t seed);

/* Ray number `index`. */
accel_ray rays_make(const struct rays *rays, uint64_t index);

/* "primary", "lines", ... */
const char *family_name(enum family family);

#endif
