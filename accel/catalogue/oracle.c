/* SPDX-License-Identifier: Apache-2.0 */
#include "oracle.h"

static quad infinity(void)
{
    return (quad)(double)INFINITY;
}

/* Enters one pair. Hits that may or may not lie in the open interval are undecided. */
static void enter(struct judgement *j, const accel_ray *ray, const struct exact *e, uint32_t geom,
                  uint32_t prim)
{
    const quad first = e->verdict == HIT ? e->t - e->off : e->first;
    const quad last = e->verdict == HIT ? e->t + e->off : e->last;
    if (e->verdict == NO_HIT || last <= (quad)ray->tmin || first >= (quad)ray->tmax)
        return;
    if (e->verdict == UNDECIDED || first <= (quad)ray->tmin || last >= (quad)ray->tmax) {
        j->undecided = first < j->undecided ? first : j->undecided;
        return;
    }
    if (j->verdict == HIT && j->hit.t <= e->t) {
        j->second = first < j->second ? first : j->second;
        return;
    }
    if (j->verdict == HIT)
        j->second = j->hit.t - j->hit.off < j->second ? j->hit.t - j->hit.off : j->second;
    j->verdict = HIT;
    j->hit = *e;
    j->geom = geom;
    j->prim = prim;
}

/* A ray that is none hits nothing: see accel_ray. */
static bool is_ray(const accel_ray *r)
{
    bool any = false;
    for (int k = 0; k < 3; k++) {
        if (!isfinite(r->org[k]) || !isfinite(r->dir[k]))
            return false;
        any = any || r->dir[k] != 0;
    }
    return any && !isnan(r->tmin) && !isnan(r->tmax);
}

struct judgement oracle_judge(const struct test_scene *s, const accel_ray *ray)
{
    struct judgement j = {.verdict = NO_HIT, .undecided = infinity(), .second = infinity()};
    for (uint32_t g = 0; g < s->count && is_ray(ray); g++) {
        const struct part *p = &s->part[g];
        for (uint32_t i = 0; i < p->count; i++) {
            const bool leaves = g == ray->skip.geom && i == ray->skip.prim;
            if (p->type == ACCEL_TRIANGLES) {
                if (leaves || exact_misses(ray, p->data + 9 * (size_t)i))
                    continue;
                const struct exact e = exact_triangle(ray, p->data + 9 * (size_t)i);
                enter(&j, ray, &e, g, i);
            } else if (leaves) {
                const struct exact e = exact_sphere_left(ray, p->data + 4 * (size_t)i, true);
                enter(&j, ray, &e, g, i);
            } else {
                struct exact e[2];
                exact_sphere(ray, p->data + 4 * (size_t)i, e);
                enter(&j, ray, &e[0], g, i);
                enter(&j, ray, &e[1], g, i);
            }
        }
    }
    const quad last = j.verdict == HIT ? j.hit.t + j.hit.off : infinity();
    if (j.undecided < infinity() && j.undecided <= last)
        j.verdict = UNDECIDED;
    if (j.verdict == HIT && j.second <= last)
        j.verdict = UNDECIDED;
    return j;
}

bool oracle_agrees(const struct judgement *j, bool hit, const accel_hit *h)
{
    if (j->verdict == UNDECIDED)
        return true;
    if (j->verdict == NO_HIT)
        return !hit;
    const quad off = (quad)h->t - j->hit.t;
    return hit && h->geom == j->geom && h->prim == j->prim && off <= j->hit.off &&
           -off <= j->hit.off;
}
