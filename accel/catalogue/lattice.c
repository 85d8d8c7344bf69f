/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice.h"

#include "catalogue.h"

#include <stdlib.h>

static int64_t cross_dot(const int64_t d[3], const int64_t a[3], const int64_t b[3])
{
    return d[0] * (a[1] * b[2] - a[2] * b[1]) + d[1] * (a[2] * b[0] - a[0] * b[2]) +
           d[2] * (a[0] * b[1] - a[1] * b[0]);
}

/* Coordinates are below 2^11 and directions below 2^4, so that every product below stays far inside
 * 63 bits. */
static bool crosses(const struct line *l, const double *vertices, struct crossing *c)
{
    int64_t p[3][3], e[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = (int64_t)(2 * vertices[3 * i + k]) - l->org[k];
    bool positive = false, negative = false;
    for (int i = 0; i < 3; i++) {
        e[i] = cross_dot(l->dir, p[(i + 1) % 3], p[(i + 2) % 3]);
        positive |= e[i] > 0;
        negative |= e[i] < 0;
    }
    const int64_t sum = e[0] + e[1] + e[2];
    if ((positive && negative) || sum == 0)
        return false;
    /* t d = sum of e_i p_i / sum, along any axis where d is not 0. */
    const int k = l->dir[0] ? 0 : l->dir[1] ? 1 : 2;
    const int64_t over = e[0] * p[0][k] + e[1] * p[1][k] + e[2] * p[2][k];
    const int64_t under = sum * l->dir[k];
    c->over = under < 0 ? -over : over;
    c->under = under < 0 ? -under : under;
    return true;
}

static int compare_crossings(const void *x, const void *y)
{
    const struct crossing *a = x, *b = y;
    const __int128 left = (__int128)a->over * b->under, right = (__int128)b->over * a->under;
    if (left != right)
        return left < right ? -1 : 1;
    if (a->geom != b->geom)
        return a->geom < b->geom ? -1 : 1;
    return a->prim < b->prim ? -1 : a->prim > b->prim;
}

uint32_t lattice_crossings(const struct test_scene *s, const struct line *l, bool backwards,
                           struct crossing *out, uint32_t most)
{
    uint32_t count = 0;
    for (uint32_t g = 0; g < s->count; g++) {
        for (uint32_t i = 0; i < s->part[g].count && count < most; i++) {
            struct crossing *c = &out[count];
            if (!crosses(l, s->part[g].data + 9 * (size_t)i, c) || (!backwards && c->over <= 0))
                continue;
            c->geom = g;
            c->prim = i;
            count++;
        }
    }
    qsort(out, count, sizeof *out, compare_crossings);
    return count;
}

accel_ray lattice_line(const struct test_scene *s, struct rng *d, struct line *l)
{
    double org[3], dir[3];
    bool zero = true;
    for (int k = 0; k < 3; k++) {
        const uint32_t cells = 2 * ((uint32_t)(s->target.box.hi[k] - s->target.box.lo[k]) + 4);
        l->org[k] = 2 * (int64_t)(s->target.box.lo[k] - 2) + (int64_t)rng_below(d, cells);
        l->dir[k] = rng_chance(d, 0.35) ? 0 : 1 << rng_below(d, 4);
        if (rng_chance(d, 0.5))
            l->dir[k] = -l->dir[k];
        zero = zero && l->dir[k] == 0;
        org[k] = (double)l->org[k] / 2;
        dir[k] = l->dir[k] ? (double)l->dir[k] : rng_chance(d, 0.5) ? 0.0 : -0.0;
    }
    if (zero) {
        l->dir[1] = 1;
        dir[1] = 1;
    }
    return accel_ray_from(org, dir);
}

accel_ray lattice_line_on(const struct test_scene *s, struct rng *d, struct line *l)
{
    accel_ray ray = lattice_line(s, d, l);
    const struct part *p = &s->part[rng_below(d, s->count)];
    const double *t = p->data + 9 * (size_t)rng_below(d, p->count);
    const uint32_t i = rng_below(d, 3), j = rng_chance(d, 0.5) ? i : (i + 1) % 3;
    for (uint32_t k = 0; k < 3; k++) {
        l->org[k] = (int64_t)(t[3 * i + k] + t[3 * j + k]);
        ray.org[k] = (double)l->org[k] / 2;
    }
    return ray;
}

struct line lattice_line_of(const accel_ray *ray)
{
    struct line l;
    for (int k = 0; k < 3; k++) {
        l.org[k] = (int64_t)(2 * ray->org[k]);
        l.dir[k] = (int64_t)ray->dir[k];
    }
    return l;
}

bool crossing_is(const struct crossing *c, const accel_hit *h)
{
    return c->geom == h->geom && c->prim == h->prim &&
           h->t == (double)c->over / (2 * (double)c->under);
}
