/* SPDX-License-Identifier: Apache-2.0 */
#include "sphere.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int sphere_hits(const struct query *q, const double *sphere, double t[2])
{
    double f[3], nearest[3];
    for (int k = 0; k < 3; k++)
        f[k] = q->org[k] - sphere[k];
    const double a = dot(q->dir, q->dir), b = -dot(f, q->dir), r = sphere[3];
    for (int k = 0; k < 3; k++)
        nearest[k] = f[k] + b / a * q->dir[k];
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
