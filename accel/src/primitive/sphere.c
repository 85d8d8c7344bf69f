/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays that leave a sphere (accel_ray.skip). Such a ray starts at a crossing of its own, but for
 * what its origin was rounded by, so of the two roots t1, t2 the one nearer to 0 is left out. With
 * f the origin from the centre, a = dir . dir, b = -(f . dir), c = f . f - r^2 and u = 2^-53:
 *
 * Which one: t1 + t2 = 2 b / a and t1 t2 = c / a, so of two real roots the farther from 0 is that
 * with the sign of b, whichever side of the surface the origin was rounded to: (b +- sqrt(b^2 - a
 * c)) / a with the sign of b, a sum without cancellation. No interval, no box and not the size of
 * any root has a part in it. b is off by at most 4u |f| |dir|.
 *
 * What is left out: an origin that is d off the surface has |c| = |d| (2 r + d), about 2 r |d|. As
 * |t1| <= |t2|, |t1| |dir| <= sqrt(|c|); and as |t2| |dir| >= |f| cos, where cos is that of the
 * direction to the normal, |t1| |dir| <= |c| / (|f| cos), about 2 |d| / cos.
 *
 * A ray that grazes: where the square of the cosine comes down to u, double tells neither whether
 * the line meets the sphere nor, below 4u, the sign of b. So where the discriminant is below
 * SPHERE_GRAZING r^2, both are found from the ray as given in wider precision, which is right down
 * to cosines of 2^-50, and t is as exact as any.
 *
 * None is met twice: where b <= 0, and tmin >= 0, the sphere has no hit. The kept root is not above
 * 0. It could become a hit only where clamping to S(P') raised it, hence where the ray is still to
 * enter P': on some axis k, where dir > 0, say, the origin lies before P', which begins 2^-44 r
 * before the sphere at least, so f[k]^2 > r^2 (1 + 2^-44). But b / a dir[k] <= 0 then takes
 * nearest[k] no closer to 0 than f[k], and the discriminant is negative: no roots.
 *
 * None is lost: where b > 0 and the line meets the sphere, as it does wherever the origin was not
 * rounded outward, the kept root is above 0, and the ray leaves P', if its origin is there, behind
 * 0. Where it was rounded outward, by d, a ray of a cosine below sqrt(2 d / r) passes the sphere
 * by: there is no far side then.
 */
#include "sphere.h"

#include "quad.h"

/* With the squares of all lengths between these, no product below over- or underflows. */
#define SAFE_MIN 0x1p-400
#define SAFE_MAX 0x1p400

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool safe(double square)
{
    return square > SAFE_MIN && square < SAFE_MAX;
}

/* The root in double's precision of what may be beyond its range. */
static quad wide_root(quad x)
{
    quad scale = 1;
    for (; x > 0x1p1000; x *= 0x1p-1000)
        scale *= 0x1p500;
    for (; x > 0 && x < 0x1p-1000; x *= 0x1p1000)
        scale *= 0x1p-500;
    return scale * sqrt((double)x);
}

/* The farther root, for a ray that grazes the sphere that it leaves. Nothing is out of range. */
static int farther_wide(const struct query *q, const double *sphere, double *t)
{
    const quad r = sphere[3];
    quad a = 0, b = 0, c = -r * r;
    for (int k = 0; k < 3; k++) {
        const quad f = (quad)q->org[k] - sphere[k], dir = q->dir[k];
        a += dir * dir;
        b -= f * dir;
        c += f * f;
    }
    const quad square = b * b - a * c;
    if (!(square >= 0))
        return 0;
    const quad side = wide_root(square);
    *t = (double)((b > 0 ? b + side : b - side) / a);
    return 1;
}

/* The roots of |f + t dir|^2 = r^2, where a = dir . dir. Farther: only that. -1: it grazes. */
static int roots(const double f[3], const double dir[3], double a, double r, bool farther,
                 double t[2])
{
    double nearest[3];
    const double b = -dot(f, dir);
    for (int k = 0; k < 3; k++)
        nearest[k] = f[k] + b / a * dir[k];
    const double discriminant = r * r - dot(nearest, nearest);
    if (farther && fabs(discriminant) < SPHERE_GRAZING * (r * r))
        return -1;
    if (!(discriminant >= 0))
        return 0;
    if (farther) {
        const double side = sqrt(a * discriminant);
        t[0] = (b > 0 ? b + side : b - side) / a;
        return 1;
    }
    const double c = dot(f, f) - r * r;
    const double root = b + copysign(sqrt(a * discriminant), b);
    const double first = root != 0 ? c / root : 0, second = root / a;
    t[0] = first < second ? first : second;
    t[1] = first < second ? second : first;
    return 2;
}

/* The power of two above a length. */
static int exponent_of(double length)
{
    int exponent;
    frexp(length, &exponent);
    return exponent;
}

/* The same with all lengths scaled by powers of two to about 1. */
static int roots_scaled(const double f[3], const double dir[3], double r, bool farther, double t[2])
{
    const int space = exponent_of(fmax(fmax(fabs(f[0]), fabs(f[1])), fmax(fabs(f[2]), r)));
    const int speed = exponent_of(fmax(fmax(fabs(dir[0]), fabs(dir[1])), fabs(dir[2])));
    double g[3], d[3];
    for (int k = 0; k < 3; k++) {
        g[k] = ldexp(f[k], -space);
        d[k] = ldexp(dir[k], -speed);
    }
    const int count = roots(g, d, dot(d, d), ldexp(r, -space), farther, t);
    for (int i = 0; i < count; i++)
        t[i] = ldexp(t[i], space - speed);
    return count;
}

int accel_sphere_hits(const struct query *q, const double *sphere, bool leaves, double t[2])
{
    double f[3];
    for (int k = 0; k < 3; k++)
        f[k] = q->org[k] - sphere[k];
    const double a = dot(q->dir, q->dir), r = sphere[3];
    const bool plain = safe(a) && safe(dot(f, f) + r * r);
    const int count =
        plain ? roots(f, q->dir, a, r, leaves, t) : roots_scaled(f, q->dir, r, leaves, t);
    return count < 0 ? farther_wide(q, sphere, t) : count;
}
