/* SPDX-License-Identifier: Apache-2.0
 *
 * The host objects of the test scenes. Where the ray leaves the object, its crossing nearest to
 * t = 0 is left out.
 */
#include "case_scene.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void ball(accel_probe *probe, const double *p, double limit)
{
    const accel_ray *ray = probe->ray;
    const double f[3] = {ray->org[0] - p[0], ray->org[1] - p[1], ray->org[2] - p[2]};
    const double a = dot(ray->dir, ray->dir), b = dot(f, ray->dir), c = dot(f, f) - p[3] * p[3];
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0.0))
        return;
    /* The far root first: the library may not rely on an order. */
    for (int side = 1; side >= -1; side -= 2) {
        if (probe->skip && side == (b < 0.0 ? -1 : 1))
            continue; /* the nearer to 0 */
        const double t = (-b + side * sqrt(discriminant)) / a;
        if (!(t > limit))
            accel_report(probe, t, side, t);
    }
}

static void crate(accel_probe *probe, const double *p)
{
    const accel_ray *ray = probe->ray;
    double in = -(double)INFINITY, out = (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        if (ray->dir[k] == 0.0) {
            if (!(p[k] <= ray->org[k] && ray->org[k] <= p[3 + k]))
                return;
            continue;
        }
        const double t0 = (p[k] - ray->org[k]) / ray->dir[k];
        const double t1 = (p[3 + k] - ray->org[k]) / ray->dir[k];
        in = fmax(in, fmin(t0, t1));
        out = fmin(out, fmax(t0, t1));
    }
    if (!(in <= out))
        return;
    const bool forward = in + out > 0.0; /* `in` is the nearer to 0 */
    if (!(probe->skip && forward))
        accel_report(probe, in, 0.0, 0.0);
    if (!(probe->skip && !forward))
        accel_report(probe, out, 1.0, 0.0);
}

static void plane(accel_probe *probe, const double *p)
{
    const accel_ray *ray = probe->ray;
    if (probe->skip)
        return;
    const double to[3] = {p[0] - ray->org[0], p[1] - ray->org[1], p[2] - ray->org[2]};
    accel_report(probe, dot(to, p + 3) / dot(ray->dir, p + 3), 0.0, 0.0);
}

static double tooth(const double *p, int i)
{
    return p[1] + (p[2] - p[1]) * i / p[0];
}

static void comb(accel_probe *probe, const double *p)
{
    const int count = (int)p[0];
    int left_out = count;
    for (int i = 0; probe->skip && i < count; i++)
        if (left_out == count || fabs(tooth(p, i)) < fabs(tooth(p, left_out)))
            left_out = i;
    for (int i = count - 1; i >= 0; i--)
        if (i != left_out)
            accel_report(probe, tooth(p, i), i, 0.0);
}

static void nothing(accel_probe *probe)
{
    accel_report(probe, (double)NAN, 0.0, 0.0);
    accel_report(probe, (double)-NAN, 0.0, 0.0);
}

void test_object_intersect(accel_probe *probe)
{
    const struct test_object *o = (const struct test_object *)probe->user + probe->prim;
    switch (o->behaviour) {
    case BALL:
        ball(probe, o->p, (double)INFINITY);
        break;
    case FILTER:
        ball(probe, o->p, probe->limit);
        break;
    case CRATE:
        crate(probe, o->p);
        break;
    case PLANE:
        plane(probe, o->p);
        break;
    case COMB:
        comb(probe, o->p);
        break;
    case STRAY:
        if (!probe->skip)
            accel_report(probe, o->p[0], 0.0, 0.0);
        break;
    case NOTHING:
    case BEHAVIOURS:
        nothing(probe);
        break;
    }
}
