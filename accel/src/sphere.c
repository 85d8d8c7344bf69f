/* SPDX-License-Identifier: Apache-2.0 */
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

/* The roots of |f + t dir|^2 = r^2, where a = dir . dir. */
static int roots(const double f[3], const double dir[3], double a, double r, double t[2])
{
    double nearest[3];
    const double b = -dot(f, dir);
    for (int k = 0; k < 3; k++)
        nearest[k] = f[k] + b / a * dir[k];
    const double discriminant = r * r - dot(nearest, nearest);
    if (!(discriminant >= 0))
        return 0;
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
static int roots_scaled(const double f[3], const double dir[3], double r, double t[2])
{
    const int space = exponent_of(fmax(fmax(fabs(f[0]), fabs(f[1])), fmax(fabs(f[2]), r)));
    const int speed = exponent_of(fmax(fmax(fabs(dir[0]), fabs(dir[1])), fabs(dir[2])));
    double g[3], d[3];
    for (int k = 0; k < 3; k++) {
        g[k] = ldexp(f[k], -space);
        d[k] = ldexp(dir[k], -speed);
    }
    const int count = roots(g, d, dot(d, d), ldexp(r, -space), t);
    for (int i = 0; i < count; i++)
        t[i] = ldexp(t[i], space - speed);
    return count;
}

int sphere_hits(const struct query *q, const double *sphere, double t[2])
{
    double f[3];
    for (int k = 0; k < 3; k++)
        f[k] = q->org[k] - sphere[k];
    const double a = dot(q->dir, q->dir), r = sphere[3];
    if (safe(a) && safe(dot(f, f) + r * r))
        return roots(f, q->dir, a, r, t);
    return roots_scaled(f, q->dir, r, t);
}
