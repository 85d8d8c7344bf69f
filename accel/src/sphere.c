/* SPDX-License-Identifier: Apache-2.0
 *
 * Rays that leave a sphere (accel_ray.skip). Such a ray starts at a crossing of its own, but for
 * what its origin was rounded by, so of the two roots t1, t2 the one nearer to 0 is left out. With
 * f the origin from the centre, a = dir . dir, b = -(f . dir) and c = f . f - r^2:
 *
 * Which one: t1 + t2 = 2 b / a and t1 t2 = c / a. Of two real roots, that with the sign of b is the
 * farther from 0, whichever side of the surface the origin was rounded to. It is (b +- sqrt(b^2 -
 * a c)) / a with the sign of b: a sum without cancellation, `second` below, of which c is no part.
 * So which one is left out takes the sign of b alone. b is off by at most 4u |f| |dir|, u = 2^-53:
 * its sign is right but for directions whose cosine to the surface is below 4u, which neither enter
 * nor leave for all that double can tell. No interval and no box has a part in it.
 *
 * What is left out: an origin that is d off the surface has |c| = |d| (2 r + d), about 2 r |d|, and
 * |t1| <= |t2|, so |t1| |dir| <= sqrt(|c|); and as |t2| |dir| >= |b| / |dir| = |f| cos, where cos
 * is that of the direction to the normal, |t1| |dir| <= |c| / (|f| cos), about 2 |d| / cos. The
 * kept crossing lies where it lies for any other ray, at |t2| |dir| >= |f| cos.
 *
 * None is met twice: where b <= 0, and tmin >= 0, the sphere has no hit. As computed, the kept root
 * is not above 0. It could become a hit only where clamping to S(P') raised it, hence where the ray
 * is still to enter P': on some axis k, where dir > 0, say, the origin lies before P', which begins
 * 2^-44 r before the sphere at least, so f[k]^2 > r^2 (1 + 2^-44). But b / a dir[k] <= 0 then takes
 * nearest[k] no closer to 0 than f[k], and the discriminant is negative: no roots.
 *
 * None is lost: where b > 0 and the line meets the sphere, the kept root is above 0, and where the
 * origin lies in P' the ray leaves P' behind it. Whether the line meets it is as exact as for any
 * ray. A direction that grazes, of a cosine below sqrt(2 |d| / r), may pass by the sphere if its
 * origin was rounded outward; there is no far side then.
 */
#include "sphere.h"

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

/* The roots of |f + t dir|^2 = r^2, where a = dir . dir; or the farther one. */
static int roots(const double f[3], const double dir[3], double a, double r, bool farther,
                 double t[2])
{
    double nearest[3];
    const double b = -dot(f, dir);
    for (int k = 0; k < 3; k++)
        nearest[k] = f[k] + b / a * dir[k];
    const double discriminant = r * r - dot(nearest, nearest);
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

int sphere_hits(const struct query *q, const double *sphere, bool leaves, double t[2])
{
    double f[3];
    for (int k = 0; k < 3; k++)
        f[k] = q->org[k] - sphere[k];
    const double a = dot(q->dir, q->dir), r = sphere[3];
    if (safe(a) && safe(dot(f, f) + r * r))
        return roots(f, q->dir, a, r, leaves, t);
    return roots_scaled(f, q->dir, r, leaves, t);
}
