/* SPDX-License-Identifier: Apache-2.0
 *
 * A ray as the fast walks of wide trees see it, and why they pass by nothing that matters.
 *
 * Scaled: org and the boxes are multiplied by the tree's scale, dir by a power of two that takes
 * the sum of its |components| into [1, 2), so the largest into (1/3, 2). Both are exact but for
 * underflow, which the padding covers, and so t is multiplied by a power of two as well
 * (`to_scaled`). Let u = 2^-24, v = 2^-53, P a plane of the true padded boxes, T = (P - o) / d.
 *
 * The node's plane is p = P moved out by at least 2.12 u (WIDE_PAD), |p| <= 1 + 3u. cr is 1 / d cut
 * to 24 bits, exactly a float: |cr| = (1 - e0) / |d|, -v <= e0 <= 2u. c = float(-o cr). What is
 * computed is t = p cr + c, by a fused multiplication or by two roundings: with |e1|, |e3| <= u and
 * |e2| <= u (1 + 2^-28),
 * - t = (p cr (1 + e1) - o cr (1 + e2)) (1 + e3)
 * - = cr ((p - o) (1 + e2) + p (e1 - e2)) (1 + e3):
 * so an error of p, at most 2.01 u |p|, which the padding is larger than, and relative errors else.
 * With n the near and f the far plane of an axis along which the ray goes up (down: mirrored):
 * - if P_n <= o then p_n - o <= -2.12 u (1 - 2u), and t_n <= 0; tmin is the greater;
 * - if P_n > o then 0 <= t_n <= T_n (1 + v) (1 + 1.01 u) (1 + u), or t_n < 0;
 * - if P_f >= o then t_f >= T_f (1 - 2u) (1 - 1.01 u) (1 - u) > 0.
 * So where S of the box is not empty and may matter, the greatest t_n, taken with tmin, exceeds the
 * least t_f, taken with the limit, by a factor of less than 1 + 6.1 u. Two floats that differ by
 * less than that are at most 13 steps apart, for a step is at least u of the larger: the comparison
 * allows WIDE_STEPS, which also covers the growth of S by 2^-50 and the limit's own rounding.
 *
 * Steep and parallel axes: |1 / d| counts as at most 2^60. Where the box holds o, t_n <= 0, and
 * t_f >= 2^60 * 2.1 u = 2^37 or so, while the axis of the largest component ends at 3 (1 + |o|)
 * <= 2^34 at the latest, as |o| <= 2^32 (WIDE_FAR): the axis cuts nothing off. Where the box lies
 * ahead, t_n only becomes less. Rays from farther away take accel_wide_walk.
 *
 * Underflow and flushing to zero move o, d, c, p or t by at most 2^-126 or so; t_f is 2.1 u cr >= u
 * or more where it matters, and all other errors above are relative to it or to the padding, both
 * of which have 2^-26 of themselves to spare.
 */
#ifndef ACCEL_WIDE_RAY_H
#define ACCEL_WIDE_RAY_H

#include <string.h>

#include "wide_split.h"

#define WIDE_FAR 0x1p32
#if !defined(WIDE_STEPS) /* a test makes it too small */
#define WIDE_STEPS 13
#endif

struct wide_ray {
    float inverse[4], offset[4]; /* cr and c; the fourth is not used */
    uint32_t near[3];            /* side of the near planes: 1 where dir is negative, -0 included */
    float tmin;                  /* scaled, a little less */
    double to_scaled;            /* t in scaled coordinates is t times this */
};

/* Do operations round to nearest? Asked of the arithmetic itself: reading the mode takes a fifth of
 * the time of a ray that misses. Either sum is another number than 1 in each other mode. */
static inline bool wide_rounds_to_nearest(void)
{
    double one = 1.0;
#if defined(__SSE2__)
    __asm__("" : "+x"(one)); /* the compiler must not know it */
#else
    volatile double opaque = one;
    one = opaque;
#endif
    return one + 0x1p-60 == 1.0 && one - 0x1p-60 == 1.0;
}

/* A ray as leaves see it: made when it comes to its first one. */
struct leaf_ray {
    double org[3], shear[3]; /* along kx, ky, kz: as query.axis, query.shear */
    uint32_t axis[3];
    double far;    /* largest |org| */
    double square; /* dir . dir */
    bool safe;     /* as sphere.c has it */
};

static inline uint64_t wide_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double wide_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline double wide_larger(double a, double b)
{
    return a > b ? a : b;
}

/* A limit in scaled coordinates, a little more. */
static inline float wide_limit(const struct wide_ray *r, double t)
{
    const double scaled = t * r->to_scaled;
    return scaled < 0x1p126 ? (float)scaled * (1.0f + 0x1p-21f) + 0x1p-126f : (float)INFINITY;
}

/* Four lanes, of which three are used; gcc and clang make the best of them on every processor. */
typedef double wide_four __attribute__((vector_size(32)));
typedef uint64_t wide_four_bits __attribute__((vector_size(32)));
typedef float wide_four_floats __attribute__((vector_size(16)));

/* Reads three doubles one by one. Hosts have just written them so, and two that are read at once
 * wait until both stores have left the store buffer: a quarter of the time of a ray that meets
 * little. */
static inline void wide_read(const double from[3], double to[3])
{
    const volatile double *one = from;
    for (int k = 0; k < 3; k++)
        to[k] = one[k];
}

/* False if the ray must take accel_wide_walk, which also refuses what is no ray. */
static inline bool wide_ray_from(struct wide_ray *r, const struct wide *w, const double origin[3],
                                 const double direction[3], double tmin)
{
    double org[3], dir[3];
    wide_read(origin, org);
    wide_read(direction, dir);
    const double dir_sum = fabs(dir[0]) + fabs(dir[1]) + fabs(dir[2]);
    const double org_sum = fabs(org[0]) + fabs(org[1]) + fabs(org[2]);
    const uint64_t exponent = wide_bits(dir_sum) >> 52;
    const double from_one = wide_double(exponent << 52);
    r->to_scaled = w->scale * from_one;
    /* What is infinite or a NaN has too large an exponent. Within 2^-500 and 2^500, 1 / dir is
     * infinite only for a component that counts as steep anyway. */
    const double far = org_sum * w->scale;
    if (!(far <= WIDE_FAR) || exponent - 523 > 1000 || !(tmin >= 0.0) ||
        !(r->to_scaled >= 0x1p-1000 && r->to_scaled <= 0x1p1000) || !wide_rounds_to_nearest())
        return false;
    if (w->reach > 0.0 && far > SPLIT_FAR - 1.0)
        return false;
    const uint64_t negative = (uint64_t)1 << 63, dropped = 0x1fffffff;
    const wide_four d = {dir[0], dir[1], dir[2], 1.0}, o = {org[0], org[1], org[2], 0.0};
    const wide_four_bits sign = (wide_four_bits)d & negative;
    const wide_four steep = 1.0 / (wide_four)((wide_four_bits)d & ~negative) * from_one;
    const wide_four_bits most = {0x43b0000000000000, 0x43b0000000000000, 0x43b0000000000000,
                                 0x43b0000000000000}; /* 2^60 */
    const wide_four_bits small = (wide_four_bits)(steep < (wide_four)most);
    const wide_four_bits inverse = ((wide_four_bits)steep & small) | (most & ~small);
    const wide_four cut = (wide_four)((inverse & ~dropped) | sign);
    const wide_four_floats cr = __builtin_convertvector(cut, wide_four_floats);
    const wide_four_floats c = __builtin_convertvector(-(o * w->scale * cut), wide_four_floats);
    memcpy(r->inverse, &cr, sizeof cr);
    memcpy(r->offset, &c, sizeof c);
    for (int k = 0; k < 3; k++)
        r->near[k] = (uint32_t)(wide_bits(dir[k]) >> 63);
    const double start = tmin * r->to_scaled;
    r->tmin = start < 0x1p126 ? (float)start * (1.0f - 0x1p-22f) + 0.0f : 0x1p126f; /* -0 to 0 */
    return true;
}

static inline void leaf_ray_from(struct leaf_ray *l, const accel_ray *ray)
{
    const double *org = ray->org, *dir = ray->dir;
    const double a0 = fabs(dir[0]), a1 = fabs(dir[1]), a2 = fabs(dir[2]);
    const uint32_t kz = a2 > wide_larger(a1, a0) ? 2 : a1 > a0 ? 1 : 0;
    const uint32_t kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1;
    const double x = dir[kx], y = dir[ky], z = dir[kz];
    l->axis[0] = kx;
    l->axis[1] = ky;
    l->axis[2] = kz;
    l->org[0] = org[kx];
    l->org[1] = org[ky];
    l->org[2] = org[kz];
    l->shear[0] = x / z;
    l->shear[1] = y / z;
    l->shear[2] = 1.0 / z;
    l->square = dir[0] * dir[0] + dir[1] * dir[1] + dir[2] * dir[2];
    l->safe = l->square > 0x1p-400 && l->square < 0x1p400;
    l->far = wide_larger(wide_larger(fabs(org[0]), fabs(org[1])), fabs(org[2]));
}

#endif
