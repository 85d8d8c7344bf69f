/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays that must hit: meshes whose triangles share the values of their vertices, shot at vertices,
 * along edges and anywhere, closed ones from inside, open ones away from their border. A miss is a
 * leak, with no need of an oracle.
 */
#ifndef CASES_LEAKS_H
#define CASES_LEAKS_H

#include "case_scene.h"
#include "rng.h"

/* Which targets count: those of an open mesh must be inside its border. */
typedef bool is_target(const double at[3]);

/* Where a ray to a target starts. */
typedef void start(struct rng *d, const struct test_scene *s, const double at[3], double org[3]);

/* A mesh and how it is shot at. */
struct leak_mesh {
    const char *scene;
    is_target *counts;
    start *from;
    double scale, shift; /* the scene is moved */
};

/* One closed ball, at scales and offsets; ended by a NULL scene. */
extern const struct leak_mesh leak_balls[];

/* The square split into 4..65,536 triangles; the same. */
extern const struct leak_mesh leak_squares[];

extern const struct leak_mesh leak_fan, leak_terrain;

/* Makes its scene; ends with scene_free. */
void leak_make(struct test_scene *s, const struct leak_mesh *m, uint64_t seed);

/* With that many rays for each triangle every corner and every edge of it is shot at. */
enum { LEAK_ROUNDS = 7 };

/* The i-th ray: at triangle i % n of n, in round i / n. False: its target does not count. */
bool leak_ray(const struct leak_mesh *m, const struct test_scene *s, struct rng *d, uint64_t i,
              accel_ray *ray);

#endif
