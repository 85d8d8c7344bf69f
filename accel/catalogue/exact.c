/* SPDX-License-Identifier: Apache-2.0 */
#include "exact.h"

#include <float.h>

static const quad unit = (quad)0x1p-53;

/* What a rounding may add where it underflows; that many roundings are counted at each place. */
static const quad tiny = 8 * (quad)0x1p-1074;

/* The bounds are first order: doubled, they hold. */
static const quad safety = 2;

static quad absolute(quad x)
{
    return x < 0 ? -x : x;
}

static quad greater(quad a, quad b)
{
    return a > b ? a : b;
}

static quad lesser(quad a, quad b)
{
    return a < b ? a : b;
}

/* Newton's steps from double's root: each doubles the bits. What is beyond double's range, as are
 * squares of lengths, is scaled by an even power of two. */
static quad root(quad x)
{
    if (!(x > 0) || !(x < (quad)(double)INFINITY))
        return x > 0 ? x : 0;
    quad scale = 1;
    for (; x > 0x1p1000; x *= 0x1p-1000)
        scale *= 0x1p500;
    for (; x < 0x1p-1000; x *= 0x1p1000)
        scale *= 0x1p-500;
    quad y = sqrt((double)x);
    for (int i = 0; i < 3; i++)
        y = (y + x / y) / 2;
    return scale * y;
}

/* A triangle as the ray sees it: the ray is the line x = y = 0. */
struct seen {
    quad x[3], y[3], z[3]; /* z: t of the plane through the vertex */
    quad size;             /* R */
};

static int longest(const double *d)
{
    const int k = fabs(d[1]) > fabs(d[0]) ? 1 : 0;
    return fabs(d[2]) > fabs(d[k]) ? 2 : k;
}

static struct seen see(const accel_ray *ray, const double *vertices)
{
    struct seen s = {.size = 0};
    const int kz = longest(ray->dir), kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    for (int i = 0; i < 3; i++) {
        quad p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = (quad)vertices[3 * i + k] - (quad)ray->org[k];
            s.size = greater(s.size, absolute(p[k]));
        }
        s.z[i] = p[kz] / (quad)ray->dir[kz];
        s.x[i] = p[kx] - s.z[i] * (quad)ray->dir[kx];
        s.y[i] = p[ky] - s.z[i] * (quad)ray->dir[ky];
    }
    return s;
}

static quad edge_bound(const struct seen *s, int j, int k)
{
    const quad d = 6 * unit * s->size + tiny;
    const quad sum = absolute(s->x[j]) + absolute(s->y[j]) + absolute(s->x[k]) + absolute(s->y[k]);
    const quad products = absolute(s->x[k] * s->y[j]) + absolute(s->y[k] * s->x[j]);
    return safety * (d * sum + 3 * unit * products + tiny);
}

static struct exact undecided(const struct seen *s, quad margin)
{
    quad first = s->z[0], last = s->z[0];
    for (int i = 1; i < 3; i++) {
        first = lesser(first, s->z[i]);
        last = greater(last, s->z[i]);
    }
    return (struct exact){UNDECIDED, 0, 0, first - margin, last + margin};
}

struct exact exact_triangle(const accel_ray *ray, const double *vertices)
{
    const struct seen s = see(ray, vertices);
    quad e[3], bound[3], sum = 0, doubt = 0, scaled = 0, far = 0;
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        e[i] = s.x[k] * s.y[j] - s.y[k] * s.x[j];
        bound[i] = edge_bound(&s, j, k);
        positive += e[i] > bound[i];
        negative += e[i] < -bound[i];
        sum += e[i];
        doubt += bound[i];
        scaled += e[i] * s.z[i];
        far = greater(far, absolute(s.z[i]));
    }
    const quad margin = safety * (10 * unit * far + tiny);
    if (positive > 0 && negative > 0)
        return (struct exact){NO_HIT, 0, 0, 0, 0};
    if (positive + negative < 3)
        return undecided(&s, margin);
    const quad t = scaled / sum;
    if (absolute(t) > (quad)DBL_MAX)
        return undecided(&s, margin);
    quad off = margin;
    for (int i = 0; i < 3; i++)
        off += bound[i] * absolute(s.z[i] - t) / (absolute(sum) - lesser(doubt, absolute(sum) / 2));
    return (struct exact){HIT, t, off, t - off, t + off};
}

/* Neither the squares of what is in this range nor the bounds lose bits at the ends of double's. */
static bool is_middling(double x)
{
    return x == 0 || (fabs(x) > 1e-60 && fabs(x) < 1e60);
}

bool exact_misses(const accel_ray *ray, const double *vertices)
{
    const int kz = longest(ray->dir), kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    const double sx = ray->dir[kx] / ray->dir[kz], sy = ray->dir[ky] / ray->dir[kz];
    double x[3], y[3], size = 0;
    if (!is_middling(ray->dir[kz]) || !is_middling(ray->dir[kx]) || !is_middling(ray->dir[ky]))
        return false;
    for (int i = 0; i < 3; i++) {
        double p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = vertices[3 * i + k] - ray->org[k];
            size = fmax(size, fabs(p[k]));
            if (!is_middling(p[k]))
                return false;
        }
        x[i] = p[kx] - sx * p[kz];
        y[i] = p[ky] - sy * p[kz];
    }
    bool positive = false, negative = false;
    const double d = 6 * 0x1p-53 * size;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double a = x[k] * y[j], b = y[k] * x[j];
        const double sum = fabs(x[j]) + fabs(y[j]) + fabs(x[k]) + fabs(y[k]);
        const double bound = 2 * (d * sum + 3 * 0x1p-53 * (fabs(a) + fabs(b))) + 1e-300;
        positive |= a - b > 2.01 * bound;
        negative |= a - b < -2.01 * bound;
    }
    return positive && negative;
}

/* The library's discriminant r^2 - |f + (b / a) d|^2 is off by at most 16 u |f| (2 |nearest| + 16 u
 * |f|) + 4 u r^2 (each component of the nearest point by 8 u |f|), its product with a by 4 u of it;
 * t by what that moves the root, and by the roundings of c = |f|^2 - r^2 over the root. Of these
 * lengths, which the library scales where they are far from 1, only t itself underflows. */
void exact_sphere(const accel_ray *ray, const double *sphere, struct exact out[2])
{
    quad ff = 0, a = 0, b = 0, nn = 0, f[3];
    const quad r = sphere[3];
    for (int k = 0; k < 3; k++) {
        f[k] = (quad)ray->org[k] - (quad)sphere[k];
        ff += f[k] * f[k];
        a += (quad)ray->dir[k] * (quad)ray->dir[k];
        b -= f[k] * (quad)ray->dir[k];
    }
    for (int k = 0; k < 3; k++) {
        const quad n = f[k] + b / a * (quad)ray->dir[k];
        nn += n * n;
    }
    const quad disc = r * r - nn, size = root(ff);
    const quad doubt =
        safety * (16 * unit * size * (2 * root(nn) + 16 * unit * size) + 4 * unit * (r * r + nn));
    const quad half = root(absolute(disc) / a);
    const quad middle = b / a, margin = safety * tiny;
    const quad span =
        half + root(doubt / a) + safety * 16 * unit * (absolute(middle) + root(ff / a)) + margin;
    for (int i = 0; i < 2; i++) {
        const quad t = middle + (i ? half : -half);
        out[i] = (struct exact){NO_HIT, 0, 0, middle - span, middle + span};
        if (absolute(disc) <= 2 * doubt || (disc > 0 && absolute(t) > (quad)DBL_MAX))
            out[i].verdict = UNDECIDED;
        else if (disc > 0) {
            out[i].verdict = HIT;
            out[i].t = t;
            out[i].off = doubt / (half * a) +
                         safety * 16 * unit * (ff + r * r) / (a * (absolute(middle) + half)) +
                         safety * 16 * unit * (absolute(middle) + half) + margin;
        }
    }
}

/* A line about a sphere, its lengths as given: |f + t dir|^2 = r^2. */
struct chord {
    quad ff, a, b, c; /* f . f, dir . dir, -(f . dir), f . f - r^2 */
};

static struct chord chord_of(const accel_ray *ray, const double *sphere)
{
    struct chord l = {0, 0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const quad f = (quad)ray->org[k] - (quad)sphere[k];
        l.ff += f * f;
        l.a += (quad)ray->dir[k] * (quad)ray->dir[k];
        l.b -= f * (quad)ray->dir[k];
    }
    l.c = l.ff - (quad)sphere[3] * (quad)sphere[3];
    return l;
}

/* For rays that graze; wider arithmetic decides but what it rounds itself. */
static struct exact left_wide(const struct chord *l)
{
    const quad square = l->b * l->b - l->a * l->c, bit = 64 * (quad)0x1p-113;
    const quad side = root(square), t = (l->b > 0 ? l->b + side : l->b - side) / l->a;
    const quad most = root(bit * l->ff / l->a);
    if (absolute(square) <= bit * l->a * l->ff || absolute(l->b) <= bit * root(l->a * l->ff))
        return (struct exact){UNDECIDED, 0, 0, -2 * absolute(t) - most, 2 * absolute(t) + most};
    if (square < 0)
        return (struct exact){NO_HIT, 0, 0, 0, 0};
    if (absolute(t) > (quad)DBL_MAX)
        return (struct exact){UNDECIDED, 0, 0, t, t};
    const quad off = 8 * unit * absolute(t) + bit * l->a * l->ff / (l->a * side) + tiny;
    return (struct exact){HIT, t, off, t - off, t + off};
}

/* The sum of the roots is 2 b / a, so the farther one is beyond b / a; b in double is off by at
 * most 4 u |f| |dir|, which leaves its sign as it is where b is greater. */
struct exact exact_sphere_left(const accel_ray *ray, const double *sphere, bool wide)
{
    struct exact both[2];
    const struct chord l = chord_of(ray, sphere);
    const quad square = l.b * l.b - l.a * l.c, r = sphere[3];
    if (wide && absolute(square) < (quad)0x1p-21 * l.a * r * r && l.ff < 4 * r * r)
        return left_wide(&l);
    exact_sphere(ray, sphere, both);
    const quad doubt = safety * (4 * unit * root(l.ff) * root(l.a) + tiny);
    struct exact farther = both[l.b > 0];
    if (farther.verdict == HIT && absolute(l.b) <= doubt)
        return (struct exact){UNDECIDED, 0, 0, both[0].t - both[0].off, both[1].t + both[1].off};
    if (farther.verdict == UNDECIDED && l.b > doubt)
        farther.first = greater((l.b - doubt) / l.a * (1 - 4 * unit), 0);
    if (farther.verdict == UNDECIDED && l.b < -doubt)
        farther.last = lesser((l.b + doubt) / l.a * (1 - 4 * unit), 0);
    return farther;
}
