/* SPDX-License-Identifier: Apache-2.0
 *
 * Small integers, where double is exact: triangles with integer corners, rays through half integers
 * along directions whose ratios are powers of two. Integers alone say which triangles are hit, in
 * which order and at which t; no answer is ambiguous, at edges, at corners and on planes neither.
 */
#ifndef CASES_LATTICE_H
#define CASES_LATTICE_H

#include "case_scene.h"
#include "rng.h"

/* Twice the coordinates, so that half integers are integers. */
struct line {
    int64_t org[3], dir[3];
};

/* A hit at t = over / under, under > 0, in units of the doubled origin. */
struct crossing {
    int64_t over, under;
    uint32_t geom, prim;
};

/* A random line through the box of a scene or past it, as integers and as a ray. */
accel_ray lattice_line(const struct test_scene *s, struct rng *d, struct line *l);

/* The same from a corner of a triangle or from the middle of one of its edges. */
accel_ray lattice_line_on(const struct test_scene *s, struct rng *d, struct line *l);

/* A ray from half integers along integers, as integers. */
struct line lattice_line_of(const accel_ray *ray);

/* What the line hits in front of its origin, with `backwards` behind it as well, in the library's
 * order. At most `most` of a scene of triangles with integer corners; returns how many. */
uint32_t lattice_crossings(const struct test_scene *s, const struct line *l, bool backwards,
                           struct crossing *out, uint32_t most);

/* Is this the crossing, and t rounded once? over / under is doubled by the origin's units; the
 * division rounds once, as the library's does. */
bool crossing_is(const struct crossing *c, const accel_hit *h);

#endif
