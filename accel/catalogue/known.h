/* SPDX-License-Identifier: Apache-2.0
 *
 * Cases on which other ray tracers failed, as their users reported them: numbers are data of those
 * reports, answers follow from the numbers.
 */
#ifndef CASES_KNOWN_H
#define CASES_KNOWN_H

#include "case_scene.h"

struct known {
    const char *name;   /* unique, one word */
    const char *origin; /* who reported it */
    double vertices[18];
    uint32_t triangles;
    double org[3], dir[3], tmax;
    bool hit;
    uint32_t prim; /* of the hit */
    double t;
};

/* Ended by a NULL name. */
extern const struct known known_cases[];

/* Makes its scene; ends with scene_free. */
void known_make(struct test_scene *s, const struct known *c);

accel_ray known_ray(const struct known *c);

#endif
