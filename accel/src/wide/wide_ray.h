/* SPDX-License-Identifier: Apache-2.0
 *
 * A ray as the fast walks of wide trees see it, and why they pass by nothing that matters.
 *
 * Scaled: org and the boxes are multiplied by the tree's scale, dir by a power of two that takes
 * its largest component into [1, 2). Both are exact but for underflow, which the padding covers,
 * and so t is multiplied by a power of two as well (`to_scaled`). Let u = 2^-24, v = 2^-53, P a
 * plane of the true padded boxes, T = (P - o) / d.
 *
 * The node's plane is p = P moved out by at least 2.12 u (WIDE_PAD), |p| <= 1 + 3u. cr is 1 / d cut
 * to 24 bits, exactly a float: |cr| = (1 - e0) / |d|, -v <= e0 <= 2u. c = float(-o cr). What is
 * computed is t = p cr + c, by a fused multiplication or by two roundings:
 *     t = (p cr (1 + e1) - o cr (1 + e2)) (1 + e3)             |e1|, |e3| <= u, |e2| <= u (1 +
 * 2^-28) = cr ((p - o) (1 + e2) + p (e1 - e2)) (1 + e3) so an error of p, at most 2.01 u |p|, which
 * the padding is larger than, and relative errors else. With n the near and f the far plane of an
 * axis along which the ray goes up (down: mirrored):
 * - if P_n <= o then p_n - o <= -2.12 u (1 - 2u), and t_n <= 0; tmin is the greater;
 * - if P_n > o then 0 <= t_n <= T_n (1 + v) (1 + 1.01 u) (1 + u), or t_n < 0;
 * - if P_f >= o then t_f >= T_f (1 - 2u) (1 - 1.01 u) (1 - u) > 0.
 * So where S of the box is not empty and may matter, the greatest t_n, taken with tmin, exceeds the
 * least t_f, taken with the limit, by a factor of less than 1 + 6.1 u. Two floats that differ by
 * less than that are at most 13 steps apart, for a step is at least u of the larger: the comparison
 * allows WIDE_STEPS, which also covers the growth of S by 2^-50 and the limit's own rounding.
 *
 * Steep and parallel axes: |1 / d| counts as at most 2^60. Where the box holds o, t_n <= 0, and
 * t_f >= 2^60 * 2.1 u = 2^37 or so, while the axis of the largest component ends at (1 + |o|) / 1
 * <= 2^33 at the latest, as |o| <= 2^32 (WIDE_FAR): the axis cuts nothing off. Where the box lies
 * ahead, t_n only becomes less. Rays from farther away take accel_wide_walk.
 *
 * Underflow and flushing to zero move o, d, c, p or t by at most 2^-126 or so; t_f is 2.1 u cr >= u
 * or more where it matters, and all other errors above are relative to it or to the padding, both
 * of which have 2^-26 of themselves to spare.
 */
#ifndef ACCEL_WIDE_RAY_H
#define ACCEL_WIDE_RAY_H

#include <fenv.h>
#include <string.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "wide.h"

#define WIDE_FAR 0x1p32
#if !defined(WIDE_STEPS) /* a test makes it too small */
#define WIDE_STEPS 13
#endif

struct wide_ray {
    float inverse[3], offset[3]; /* cr and c */
    uint32_t sign;               /* bit k: dir[k] is negative, -0 included */
    float tmin;                  /* scaled, a little less */
    double to_scaled;            /* t in scaled coordinates is t times this */
    double org[3], dir[3];       /* not scaled */
    double far;                  /* largest |org| */
    double shear[3];             /* as query.shear */
    uint32_t axis[3];            /* as query.axis */
};

/* Do operations round to nearest? */
static inline bool wide_rounds_to_nearest(void)
{
#if defined(__SSE2__)
    return (_mm_getcsr() & 0x6000) == 0;
#else
    return fegetround() == FE_TONEAREST;
#endif
}

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

/* A limit in scaled coordinates, a little more. */
static inline float wide_limit(const struct wide_ray *r, double t)
{
    const double scaled = t * r->to_scaled;
    return scaled < 0x1p126 ? (float)scaled * (1.0f + 0x1p-21f) + 0x1p-126f : (float)INFINITY;
}

/* False if the ray must take accel_wide_walk, which also refuses what is no ray. tmin >= 0 or NaN.
 */
static inline bool wide_ray_from(struct wide_ray *r, const struct wide *w, const double org[3],
                                 const double dir[3], double tmin)
{
    const double a0 = fabs(dir[0]), a1 = fabs(dir[1]), a2 = fabs(dir[2]);
    const double o0 = fabs(org[0]), o1 = fabs(org[1]), o2 = fabs(org[2]);
    uint32_t kz = a1 > a0 ? 1 : 0;
    const double a01 = a1 > a0 ? a1 : a0;
    kz = a2 > a01 ? 2 : kz;
    const double largest = a2 > a01 ? a2 : a01;
    const double far = o0 > o1 ? (o0 > o2 ? o0 : o2) : (o1 > o2 ? o1 : o2);
    const uint64_t exponent = wide_bits(largest) >> 52;
    /* A NaN anywhere fails one of these: it is no less than, or its exponent is too large; those of
     * the smaller components show in the sum. */
    if (!(far * w->scale <= WIDE_FAR) || !(o0 + o1 + o2 + a0 + a1 + a2 < (double)INFINITY) ||
        !(tmin >= 0.0) || exponent < 23 || exponent > 2023 || !wide_rounds_to_nearest())
        return false;
    const double to_one = wide_double((2046 - exponent) << 52);
    r->to_scaled = w->scale / to_one;
    if (!(r->to_scaled >= 0x1p-1000 && r->to_scaled <= 0x1p1000))
        return false;
    r->sign = 0;
    for (int k = 0; k < 3; k++) {
        const double d = dir[k] * to_one, o = org[k] * w->scale;
        const double steep = 1.0 / fabs(d);
        const double inverse = steep < 0x1p60 ? steep : 0x1p60;
        const double cut = wide_double((wide_bits(inverse) & ~(uint64_t)0x1fffffff) |
                                       (wide_bits(dir[k]) & (uint64_t)1 << 63));
        r->inverse[k] = (float)cut;
        r->offset[k] = (float)(-(o * cut));
        r->sign |= (uint32_t)(wide_bits(dir[k]) >> 63) << k;
        r->org[k] = org[k];
        r->dir[k] = dir[k];
    }
    r->far = far;
    const double start = tmin * r->to_scaled;
    r->tmin = start < 0x1p126 ? (float)start * (1.0f - 0x1p-22f) + 0.0f : 0x1p126f; /* -0 to 0 */
    const uint32_t kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1;
    r->axis[0] = kx;
    r->axis[1] = ky;
    r->axis[2] = kz;
    r->shear[0] = dir[kx] / dir[kz];
    r->shear[1] = dir[ky] / dir[kz];
    r->shear[2] = 1.0 / dir[kz];
    return true;
}

#endif
