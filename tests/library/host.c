/* SPDX-License-Identifier: Apache-2.0
 *
 * A host with vectors of its own type, and the header's examples: C and C++ alike, which compilers
 * are to take without a warning: see host.sh.
 */
#include "accel/accel.h"

#include "header_ball.inc"
#include "header_follow.inc"

struct vector {
    double x, y, z;
};

struct path {
    struct vector at, towards;
};

int host(const accel *a, const struct ball *balls, const struct path *p, accel_visit_id *visit)
{
    struct vector o, d;
    o.x = p->at.x;
    o.y = p->at.y;
    o.z = p->at.z;
    d.x = p->towards.x - o.x;
    d.y = p->towards.y - o.y;
    d.z = p->towards.z - o.z;
    accel_ray ray = accel_ray_from(&o.x, &d.x);
    const accel_ray back = accel_ray_from(&p->towards.x, &p->at.x);
    accel_point(a, &o.x, visit, NULL, NULL);
    accel_point(a, &p->at.x, visit, NULL, NULL);
    return accel_any(a, &back, NULL) + follow(a, balls, &ray);
}

accel_intersect *callback = intersect_ball;
