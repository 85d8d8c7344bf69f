/* SPDX-License-Identifier: Apache-2.0 */
#include "triangle.h"

#include "quad.h"

/* Above SAFE_MIN the edge functions' sum and t's numerator have lost less than 2^-170 of themselves
 * to products that underflow; overflow makes them infinite or NaN. */
#define SAFE_MIN 0x1p-900
#define SAFE_MAX 0x1p900

/* Lengths below TINY times UP are finite, and no products of them underflow that did not have to.
 */
#define TINY 0x1p-400
#define UP   0x1p600

/* The vertices in the ray's frame. */
struct sheared {
    double x[3], y[3], z[3];
};

static struct sheared shear(const struct query *q, const double *vertices)
{
    const int kx = q->axis[0], ky = q->axis[1], kz = q->axis[2];
    struct sheared s;
    for (int i = 0; i < 3; i++) {
        const double *p = vertices + 3 * i;
        const double z = p[kz] - q->org[kz];
        s.x[i] = p[kx] - q->org[kx] - q->shear[0] * z;
        s.y[i] = p[ky] - q->org[ky] - q->shear[1] * z;
        s.z[i] = q->shear[2] * z;
    }
    return s;
}

/* Have two corners come to one place of the plane? Then the edge functions add up to 0: no hit. So
 * do all triangles whose size is below the last bit of their distance, and they come in crowds. */
static bool collapsed(const struct sheared *s)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        if (s->x[i] == s->x[j] && s->y[i] == s->y[j])
            return true;
    }
    return false;
}

/* Do the signs alone say that a triangle so small that its products underflow is missed? Scaling up
 * by a power of two is exact. */
static bool tiny_missed(const struct sheared *s)
{
    double x[3], y[3], e[3];
    for (int i = 0; i < 3; i++) {
        if (!(fabs(s->x[i]) < TINY && fabs(s->y[i]) < TINY))
            return false;
        x[i] = s->x[i] * UP;
        y[i] = s->y[i] * UP;
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        e[i] = x[k] * y[j] - y[k] * x[j];
    }
    return (e[0] < 0 || e[1] < 0 || e[2] < 0) && (e[0] > 0 || e[1] > 0 || e[2] > 0);
}

/* A corner's distance along the ray in units of its direction: beyond double's range where the
 * direction is tiny, also of triangles that the ray hits within it. */
static quad along(const struct query *q, const double *corner, double z)
{
    const int kz = q->axis[2];
    return isfinite(z) ? (quad)z : (quad)(corner[kz] - q->org[kz]) / (quad)q->dir[kz];
}

/* The same with exact products. */
static bool hit_quad(const struct query *q, const double *vertices, const struct sheared *s,
                     double *t, double *u, double *v)
{
    quad e[3], z[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        e[i] = (quad)s->x[k] * s->y[j] - (quad)s->y[k] * s->x[j];
    }
    if ((e[0] < 0 || e[1] < 0 || e[2] < 0) && (e[0] > 0 || e[1] > 0 || e[2] > 0))
        return false;
    const quad det = e[0] + e[1] + e[2];
    if (!(det < 0 || det > 0))
        return false;
    for (int i = 0; i < 3; i++)
        z[i] = along(q, vertices + 3 * i, s->z[i]);
    *t = (double)((e[0] * z[0] + e[1] * z[1] + e[2] * z[2]) / det);
    *u = (double)(e[1] / det);
    *v = (double)(e[2] / det);
    return true;
}

static bool safe(double x)
{
    return fabs(x) > SAFE_MIN && fabs(x) < SAFE_MAX;
}

bool accel_triangle_hit(const struct query *q, const double *vertices, double *t, double *u,
                        double *v)
{
    const struct sheared s = shear(q, vertices);
    const double e0 = s.x[2] * s.y[1] - s.y[2] * s.x[1];
    const double e1 = s.x[0] * s.y[2] - s.y[0] * s.x[2];
    const double e2 = s.x[1] * s.y[0] - s.y[1] * s.x[0];
    if ((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0))
        return false;
    const double det = e0 + e1 + e2;
    const double scaled = e0 * s.z[0] + e1 * s.z[1] + e2 * s.z[2];
    if (e0 == 0 || e1 == 0 || e2 == 0 || !safe(det) || !safe(scaled))
        return !collapsed(&s) && !tiny_missed(&s) && hit_quad(q, vertices, &s, t, u, v);
    *t = scaled / det;
    *u = e1 / det;
    *v = e2 / det;
    return true;
}
