/* SPDX-License-Identifier: Apache-2.0
 *
 * The nearest hit by a search of its own in 113 bits, for tests and reports. An answer is decided
 * where no rounding in double can change it: no undecided pair (see exact.h) and no second hit may
 * lie before the first. Costs microseconds for each primitive of the scene; host objects are not
 * seen.
 */
#ifndef CASES_ORACLE_H
#define CASES_ORACLE_H

#include "exact.h"

/* What the search says of a ray. */
struct judgement {
    enum verdict verdict;
    uint32_t geom, prim; /* of a hit */
    struct exact hit;    /* the same */
    quad undecided;      /* where the first undecided pair may begin */
    quad second;         /* where the second decided hit may begin */
};

/* Of the primitive that the ray leaves it sees what accel_ray says; a ray that the library refuses
 * hits nothing. Primitives must be valid: see accel_build. */
struct judgement oracle_judge(const struct test_scene *s, const accel_ray *ray);

/* Is this answer right: the primitive, and t within the derived bound? Undecided: true. */
bool oracle_agrees(const struct judgement *j, bool hit, const accel_hit *h);

#endif
