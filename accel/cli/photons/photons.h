/* SPDX-License-Identifier: Apache-2.0
 *
 * Photon illumination: what the hierarchy-of-octrees paper times.
 *
 * Rectangular lights shoot photons; every surface reflects diffusely on both sides and keeps each
 * photon with the chance `reflectance` (Russian roulette), so a photon's power never changes. Every
 * hit is stored, with the straight path that led to it.
 *
 * The random numbers of a step are named by (seed, light, photon, bounce): see random.h. So every
 * structure and every number of threads traces the same paths, and stores the same bits in the same
 * order: by light, photon, bounce. The next path starts on the primitive that was hit, which is
 * excluded by its id; there is no epsilon.
 */
#ifndef ACCEL_CLI_PHOTONS_H
#define ACCEL_CLI_PHOTONS_H

#include "scenes/scene.h"

/* A rectangle: corner + a edge[0] + b edge[1] for a, b in 0..1. It emits by the cosine from the
 * side that edge[0] x edge[1] points to. It is not an object: photons pass through it. */
struct light {
    double corner[3];
    double edge[2][3];
    double power; /* flux of the whole rectangle */
};

/* The lights of one run. */
struct lights {
    const struct light *at;
    uint32_t count;
};

/* Where a photon hit, and the end of the path that led there. 72 bytes, none of them padding. */
struct photon {
    double at[3];        /* the hit */
    double dir[3];       /* of the path, of length 1 up to rounding */
    double length;       /* of the path: it began at at - length * dir */
    uint32_t geom, prim; /* what was hit */
    uint32_t number;     /* of the photon among its light's */
    uint16_t light;      /* that shot it */
    uint16_t bounce;     /* reflections before this hit */
};

/* What to trace. */
struct photon_run {
    struct lights lights;
    uint32_t photons;   /* for each light */
    double reflectance; /* of every surface, 0 .. ACCEL_MOST_REFLECTANCE */
    uint64_t seed;
    unsigned threads;
    /* Called now and then from the calling thread; may be NULL. */
    void (*progress)(void *user, double done);
    void *user; /* handed to progress */
};

/* A photon survives n reflections with the chance 0.99^n: 65,535, the limit of `bounce`, are out of
 * reach (10^-286). */
#define ACCEL_MOST_REFLECTANCE 0.99

/* What was traced. Ended by photons_free. */
struct photons {
    struct photon *at; /* by light, photon, bounce */
    size_t count;
    uint64_t emitted;  /* photons; each is absorbed or escapes */
    uint64_t absorbed; /* by a surface */
    uint64_t escaped;  /* left the scene */
    uint64_t rays;     /* traced */
    accel_query query; /* counts of all rays */
    double seconds;    /* of emission, tracing and storing, by the clock on the wall */
    double processor;  /* the same in seconds of processor time, of all threads together */
};

/* Traces run->photons photons of each light through `a`, which was built over `scene`. Returns
 * false, and holds nothing, if memory runs out. */
bool trace_photons(struct photons *out, const accel *a, const accel_scene *scene,
                   const struct photon_run *run);

void photons_free(struct photons *photons);

/* FNV-1a, 64 bits, of all stored bytes in order. */
uint64_t photons_hash(const struct photons *photons);

/* The power of one photon of light `light`. */
double photon_power(const struct photon_run *run, uint32_t light);

enum { MOST_LIGHTS = 16 };

/* The lights of a scene: a square above each cluster for cubes, as large as the cluster and half
 * its side away; one rectangle above the box for all others, as wide as the box and a quarter of
 * its diagonal away. Up is y. They shine down with power 1 each. Returns their number. */
uint32_t scene_lights(const char *name, const accel_scene *scene, struct light lights[MOST_LIGHTS]);

/* Reads "x,y,z:x,y,z:x,y,z[:power]", corner and the two edges; power 1 if it is not given. Returns
 * NULL, or what is wrong with it. */
const char *light_read(const char *text, struct light *light);

/* ------------------------------------------------------------- irradiance ---- */

/* A point of a surface whose irradiance is wanted, and the unit normal of the lit side. */
struct receiver {
    double at[3], normal[3];
};

/* The receivers of one estimate. */
struct receivers {
    const struct receiver *at;
    size_t count;
};

/* Irradiance by the nearest photons (Jensen, "Realistic Image Synthesis Using Photon Mapping",
 * 2001): the power of the nearest - 1 photons within the distance r of number `nearest`, over
 * pi r^2, which is the unbiased form for even light on a plane; where fewer lie within `radius`,
 * all of them over pi radius^2. Only photons that come from the front count. Fills irradiance[i]
 * for each receiver. Returns false if memory runs out. Bad at: edges and corners, where part of the
 * disc holds no surface, and small objects. */
bool irradiance_nearest(const struct photons *photons, const struct photon_run *run,
                        struct receivers receivers, double radius, uint32_t nearest,
                        double *irradiance);

/* Irradiance by density estimation on paths (Lastra, Urena, Revelles, Montes, "A Particle-Path
 * based Method for Monte Carlo Density Estimation", EG Workshop on Rendering 2002): a disc of
 * `radius` on the tangent plane of each receiver; the power of all paths that cross it from the
 * front, over pi radius^2. No cosine: a tilted disc catches fewer paths by itself.
 *
 * What counts as crossing: the path meets the plane from the front, 0 < t < length + radius, at a
 * distance < radius from the receiver. The extension by one radius is what the paper leaves open. A
 * path that ends on the disc's own surface must not stop short of the plane by rounding, or where
 * the surface bends up from it; and in a corner some of the paths that the wall stops cross the
 * part of the disc behind the wall: in even light an edge between floor and wall gets 5/8 of what
 * it should, without the extension 1/2. The price: through a surface h < radius above the disc 1 -
 * (h / radius)^2 of even light leaks.
 *
 * The paths are sent through a structure of the library over the discs, which `config` names:
 * accel_all visits every disc that a path crosses once. Powers are counted for each light, so the
 * result does not depend on order or threads. Returns false with the reason in *error. */
bool irradiance_paths(const struct photons *photons, const struct photon_run *run,
                      struct receivers receivers, double radius, const char *config,
                      double *irradiance, accel_query *query, accel_error *error);

/* A radius whose disc is crossed by about `paths` paths, as if all of them hit the scene's surface
 * evenly; at most a twentieth of the diagonal of the scene's box. */
double irradiance_radius(const struct photons *photons, const accel_scene *scene, double paths);

#endif
